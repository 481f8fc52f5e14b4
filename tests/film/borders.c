/* The borders of texels: that they close, that either side sees them, and where the surface goes on beyond. */
#include "../spray/shapes.h"

#include "atlas/texels/borders.h"

#define MOST 400000

/* A border as one of the texels that share it sees it, on one side of the surface. */
typedef struct {
    uint32_t texel, triangle, other;
    int side, other_side;
    sp_vec3 outward;
} seen;

typedef struct {
    sp_mesh *mesh;
    sp_atlas *atlas;
    double texel;
    size_t count;
    seen *borders;
} bordered;

static void keep_seen(bordered *b, const sp_border *border, int k, int side)
{
    int sides[2] = {side, border->turned ? 1 - side : side};
    seen one = {border->texel[k], border->triangle[k], border->texel[1 - k],
                sides[k],         sides[1 - k],        border->outward[k]};
    assert_true(b->count < MOST);
    assert_true(one.texel < b->atlas->texel_count && one.triangle < b->mesh->triangle_count);
    assert_true(one.other < b->atlas->texel_count || one.other == SP_NONE);
    assert_true(sp_length(one.outward) < 2 * b->texel);
    b->borders[b->count++] = one;
}

static bool keep(void *user, const sp_border *border)
{
    assert_true(border->on_front || border->on_back);
    for (int k = 0; k < 2; k++)
        for (int side = 0; side < 2; side++)
            if (border->texel[k] != SP_NONE && (side ? border->on_back : border->on_front))
                keep_seen(user, border, k, side);
    return true;
}

/* Of all charts. */
static bool visit_all(const bordered *b, sp_border_visitor *visit, void *user, sp_error *error)
{
    sp_vec3 *normals = malloc(b->mesh->triangle_count * sizeof *normals);
    bool *asked = malloc(b->atlas->chart_count * sizeof *asked);
    assert_true(normals && asked);
    memset(asked, true, b->atlas->chart_count);
    for (uint32_t t = 0; t < b->mesh->triangle_count; t++)
        normals[t] = sp_triangle_normal(b->mesh, t);
    bool done = sp_atlas_visit_borders(b->atlas, b->mesh, 0, asked, normals, visit, user, error);
    free(normals);
    free(asked);
    return done;
}

static bordered find_borders(sp_mesh *mesh, double texel)
{
    sp_error error = {0};
    bordered b = {.mesh = mesh, .texel = texel, .borders = malloc(MOST * sizeof(seen))};
    sp_charts *charts = sp_charts_create(mesh, INFINITY, &error);
    assert_non_null(charts);
    b.atlas = sp_atlas_create(mesh, charts, &(sp_atlas_options){.texel = texel}, &error);
    assert_string_equal(error.message, "");
    sp_charts_destroy(charts);
    assert_true(visit_all(&b, keep, &b, &error));
    assert_true(b.count > 0);
    return b;
}

static void forget(bordered *b)
{
    free(b->borders);
    sp_atlas_destroy(b->atlas);
    sp_mesh_destroy(b->mesh);
}

/* By texel, triangle and side; where these are the same, as they came. */
static int by_piece(const void *left, const void *right)
{
    const seen *a = left, *b = right;
    if (a->texel != b->texel)
        return a->texel < b->texel ? -1 : 1;
    if (a->triangle != b->triangle)
        return a->triangle < b->triangle ? -1 : 1;
    return a->side - b->side;
}

/* Of every texel in one triangle, on either side: its outward vectors sum to 0. Edges of the mesh inside a texel are no
 * borders: a texel in several triangles closes as a whole, if these lie in one plane. */
static void assert_closed(bordered *b, bool plane)
{
    sp_error error = {0};
    sp_fragments fragments;
    assert_true(sp_fragments_create(&fragments, b->atlas, b->mesh, &error));
    qsort(b->borders, b->count, sizeof *b->borders, by_piece);
    size_t closed = 0;
    for (int side = 0; side < 2; side++)
        for (size_t i = 0, end; i < b->count; i = end) {
            uint32_t texel = b->borders[i].texel;
            sp_vec3 sum = {0};
            for (end = i; end < b->count && b->borders[end].texel == texel; end++)
                if (b->borders[end].side == side)
                    sum = sp_add(sum, b->borders[end].outward);
            if (!plane && fragments.start[texel + 1] != fragments.start[texel] + 1)
                continue;
            closed++;
            if (!(sp_length(sum) <= 1e-12 * b->texel))
                fail_msg("texel %u of %zu, side %d: outward vectors sum to %g texels", texel, b->atlas->texel_count,
                         side, sp_length(sum) / b->texel);
        }
    assert_true(closed > 0);
    sp_fragments_destroy(&fragments);
}

/* One way across a border. */
typedef struct {
    uint64_t from, to; /* 2 texel + side */
    double length;
} crossing;

static int by_ends(const void *left, const void *right)
{
    const crossing *a = left, *b = right;
    if (a->from != b->from)
        return a->from < b->from ? -1 : 1;
    return (a->to > b->to) - (a->to < b->to);
}

/* All that leads from one to another, in order. */
static size_t sum_crossings(const bordered *b, bool reverse, crossing *sums)
{
    size_t count = 0;
    crossing *all = malloc((b->count + 1) * sizeof *all);
    for (size_t i = 0; i < b->count; i++) {
        const seen *border = &b->borders[i];
        if (border->other == SP_NONE)
            continue;
        uint64_t from = 2 * (uint64_t)border->texel + border->side;
        uint64_t to = 2 * (uint64_t)border->other + border->other_side;
        all[count++] = (crossing){reverse ? to : from, reverse ? from : to, sp_length(border->outward)};
    }
    qsort(all, count, sizeof *all, by_ends);
    size_t sum = 0;
    for (size_t i = 0; i < count; i++) {
        if (sum && by_ends(&sums[sum - 1], &all[i]) == 0)
            sums[sum - 1].length += all[i].length;
        else
            sums[sum++] = all[i];
    }
    free(all);
    size_t kept = 0; /* where borders of pixels cross an edge in one point, round-off leaves one of the walks a crumb */
    for (size_t i = 0; i < sum; i++)
        if (sums[i].length > 1e-12 * b->texel)
            sums[kept++] = sums[i];
    return kept;
}

/* What leads from a to b is as long as what leads from b to a. */
static void assert_seen_from_both(const bordered *b)
{
    crossing *there = malloc((b->count + 1) * sizeof *there), *back = malloc((b->count + 1) * sizeof *back);
    size_t count = sum_crossings(b, false, there);
    assert_int_equal(count, sum_crossings(b, true, back));
    assert_true(count > 0);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(by_ends(&there[i], &back[i]), 0);
        if (!(fabs(there[i].length - back[i].length) <= 1e-12 * b->texel))
            fail_msg("%g m one way, %g m the other", there[i].length, back[i].length);
    }
    free(there);
    free(back);
}

/* m, of borders where the surface ends, on one side. */
static double rim_of(const bordered *b, int side)
{
    double length = 0;
    for (size_t i = 0; i < b->count; i++)
        if (b->borders[i].side == side && b->borders[i].other == SP_NONE)
            length += sp_length(b->borders[i].outward);
    return length;
}

static void close_on_closed_meshes(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        shape s = shape_create();
        shape_part(&s, "all");
        if (kind == 0)
            shape_box(&s, sp_v(0, 0, 0), sp_v(1, 0.7, 0.4), false);
        else
            shape_sphere(&s, 0.5, kind == 2, kind == 1 ? 12 : 30);
        bordered b = find_borders(shape_mesh(&s), kind == 2 ? 0.11 : 0.03);
        assert_true(rim_of(&b, 0) == 0 && rim_of(&b, 1) == 0);
        assert_seen_from_both(&b);
        assert_closed(&b, false);
        forget(&b);
    }
}

static void close_on_open_sheets(void **state)
{
    (void)state;
    for (int turned = 0; turned < 4; turned++) {
        shape s = shape_create();
        shape_part(&s, "sheet");
        double angle = 0.4 * turned;
        sp_vec3 x = sp_v(cos(angle), sin(angle), 0.3), y = sp_v(-0.8 * sin(angle), 0.8 * cos(angle), 0.2);
        shape_sheet(&s, sp_v(0.1, 0.2, 0.3), x, y, 1 + 6 * turned);
        bordered b = find_borders(shape_mesh(&s), 0.07);
        double around = 2 * (sp_length(x) + sp_length(y));
        for (int side = 0; side < 2; side++)
            assert_true(fabs(rim_of(&b, side) - around) < 1e-12 * around);
        assert_seen_from_both(&b);
        assert_closed(&b, true);
        forget(&b);
    }
}

/* Which of the sheets that stand about the z axis a texel of that triangle belongs to. */
static int sheet_of(const bordered *b, uint32_t triangle, const double *angles, int count)
{
    sp_vec3 middle = sp_triangle_point(b->mesh, triangle, 1.0 / 3, 1.0 / 3);
    int nearest = 0;
    for (int i = 1; i < count; i++)
        if (cos(atan2(middle.y, middle.x) - angles[i]) > cos(atan2(middle.y, middle.x) - angles[nearest]))
            nearest = i;
    return nearest;
}

static uint32_t triangle_of(const sp_fragments *fragments, uint32_t texel)
{
    return fragments->items[fragments->start[texel]].triangle;
}

/* True where that side of the triangle faces the way round the z axis in which angles grow. */
static bool faces_ahead(const bordered *b, uint32_t triangle, int side)
{
    sp_vec3 middle = sp_triangle_point(b->mesh, triangle, 1.0 / 3, 1.0 / 3);
    double ahead = sp_dot(sp_triangle_normal(b->mesh, triangle), sp_v(-middle.y, middle.x, 0));
    return (ahead > 0) == (side == 0);
}

/* Sheets like the leaves of a book, front now to one side, now to the other: the side that faces ahead goes on in the
 * next leaf, on its side that faces back. */
static void check_book(const double *angles, int count, unsigned flipped)
{
    sp_error error = {0};
    shape s = shape_create();
    shape_part(&s, "leaves");
    for (int i = 0; i < count; i++) {
        sp_vec3 out = sp_v(cos(angles[i]), sin(angles[i]), 0), up = sp_v(0, 0, 1);
        shape_sheet(&s, sp_v(0, 0, 0), flipped >> i & 1 ? out : up, flipped >> i & 1 ? up : out, 2);
    }
    bordered b = find_borders(shape_mesh(&s), 0.17);
    sp_fragments fragments;
    assert_true(sp_fragments_create(&fragments, b.atlas, b.mesh, &error));
    double from_sheet[8][2] = {0};
    for (size_t i = 0; i < b.count; i++) {
        const seen *border = &b.borders[i];
        if (border->other == SP_NONE)
            continue;
        uint32_t beyond = triangle_of(&fragments, border->other);
        int here = sheet_of(&b, border->triangle, angles, count), there = sheet_of(&b, beyond, angles, count);
        if (here == there)
            continue;
        bool ahead = faces_ahead(&b, border->triangle, border->side);
        assert_int_equal(there, (here + (ahead ? 1 : count - 1)) % count);
        assert_int_equal(faces_ahead(&b, beyond, border->other_side), !ahead);
        from_sheet[here][ahead] += sp_length(border->outward);
    }
    for (int i = 0; i < count; i++)
        assert_true(fabs(from_sheet[i][0] - 1) < 1e-12 && fabs(from_sheet[i][1] - 1) < 1e-12);
    assert_seen_from_both(&b);
    sp_fragments_destroy(&fragments);
    forget(&b);
}

static void go_on_in_the_next_leaf(void **state)
{
    (void)state;
    static const double tee[3] = {0, M_PI / 2, M_PI}, five[5] = {0.1, 0.2, 2, 3.5, 5.9}, two[2] = {0.3, 1.7};
    for (unsigned flipped = 0; flipped < 8; flipped++)
        check_book(tee, 3, flipped);
    for (unsigned flipped = 0; flipped < 32; flipped += 5)
        check_book(five, 5, flipped);
    for (unsigned flipped = 0; flipped < 4; flipped++)
        check_book(two, 2, flipped);
}

/* Two sheets in one plane whose fronts face opposite ways. */
static void flipped_neighbours_map_front_to_back(void **state)
{
    (void)state;
    for (int flipped = 0; flipped < 2; flipped++) {
        shape s = shape_create();
        shape_part(&s, "sheets");
        sp_vec3 x = sp_v(1, 0, 0), y = sp_v(0, 1, 0);
        shape_sheet(&s, sp_v(0, 0, 0), x, y, 3);
        shape_sheet(&s, sp_v(1, 0, 0), flipped ? y : x, flipped ? x : y, 3);
        bordered b = find_borders(shape_mesh(&s), 0.13);
        double across[2] = {0};
        for (size_t i = 0; i < b.count; i++) {
            const seen *border = &b.borders[i];
            bool changes = border->other != SP_NONE && border->side != border->other_side;
            if (!changes)
                continue;
            across[border->side] += sp_length(border->outward);
            assert_true(fabs(border->outward.y) < 1e-12 && border->outward.z == 0);
        }
        for (int side = 0; side < 2; side++) /* from either sheet, along the metre that they share */
            assert_true(fabs(across[side] - 2 * flipped) < 1e-12);
        assert_seen_from_both(&b);
        forget(&b);
    }
}

static sp_vec3 on_moebius(double around, double across)
{
    double a = 2 * M_PI * around, r = 1 + across * cos(a / 2);
    return sp_v(r * cos(a), r * sin(a), across * sin(a / 2));
}

static sp_mesh *moebius(int segments)
{
    shape s = shape_create();
    shape_part(&s, "strip");
    for (int i = 0; i < segments; i++) {
        double from = (double)i / segments, to = (i + 1.0) / segments;
        bool last = i + 1 == segments; /* the same points as the first ones', the other way round */
        sp_vec3 a = on_moebius(from, -0.2), b = on_moebius(from, 0.2);
        sp_vec3 c = last ? on_moebius(0, -0.2) : on_moebius(to, 0.2);
        sp_vec3 d = last ? on_moebius(0, 0.2) : on_moebius(to, -0.2);
        shape_triangle(&s, a, b, c);
        shape_triangle(&s, a, c, d);
    }
    return shape_mesh(&s);
}

/* Once round a strip with a twist, its front has become its back. */
static void strip_with_a_twist(void **state)
{
    (void)state;
    bordered b = find_borders(moebius(24), 0.06);
    double changes = 0;
    for (size_t i = 0; i < b.count; i++)
        if (b.borders[i].other != SP_NONE && b.borders[i].side != b.borders[i].other_side)
            changes += sp_length(b.borders[i].outward);
    assert_true(fabs(changes - 4 * 0.4) < 1e-12); /* either side, from either end */
    assert_seen_from_both(&b);
    assert_closed(&b, false);
    forget(&b);
}

static void faces_twice_there(void **state)
{
    (void)state;
    for (int reversed = 0; reversed < 2; reversed++) {
        shape s = shape_create();
        shape_part(&s, "faces");
        sp_vec3 x = sp_v(1, 0, 0), y = sp_v(0, 1, 0);
        shape_sheet(&s, sp_v(0, 0, 0), x, y, 2);
        shape_sheet(&s, sp_v(0, 0, 0), reversed ? y : x, reversed ? x : y, 2);
        shape_box(&s, sp_v(0, 0, 0), sp_v(1, 1, 1), reversed);
        bordered b = find_borders(shape_mesh(&s), 0.21);
        assert_seen_from_both(&b);
        assert_closed(&b, false);
        forget(&b);
    }
}

static bool stop(void *user, const sp_border *border)
{
    (void)border;
    return ++*(int *)user < 3;
}

static void stops_when_told(void **state)
{
    (void)state;
    sp_error error = {0};
    int visits = 0;
    bordered b = find_borders(moebius(24), 0.06);
    assert_false(visit_all(&b, stop, &visits, &error));
    assert_int_equal(visits, 3);
    forget(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(close_on_closed_meshes), cmocka_unit_test(close_on_open_sheets),
        cmocka_unit_test(go_on_in_the_next_leaf), cmocka_unit_test(flipped_neighbours_map_front_to_back),
        cmocka_unit_test(strip_with_a_twist),     cmocka_unit_test(faces_twice_there),
        cmocka_unit_test(stops_when_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
