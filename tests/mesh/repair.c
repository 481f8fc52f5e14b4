/* Meshes that are not sound, mended: closed forms, what must stay as it is, and soups of which nothing is known. */
#include "mesh/diagnosis/flaw.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const sp_vec3 box[8] = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}};
/* Bottom, top, then the sides. */
static const uint32_t sides[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                      {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
enum { MOST_POINTS = 64, MOST_TRIANGLES = 128 };

/* What a test draws. */
typedef struct {
    sp_vec3 points[MOST_POINTS];
    uint32_t triangles[MOST_TRIANGLES][3];
    uint32_t point_count, count;
} drawing;

static uint32_t put_point(drawing *d, double x, double y, double z)
{
    assert_true(d->point_count < MOST_POINTS);
    d->points[d->point_count] = sp_v(x, y, z);
    return d->point_count++;
}

static void put(drawing *d, uint32_t a, uint32_t b, uint32_t c)
{
    assert_true(d->count < MOST_TRIANGLES);
    memcpy(d->triangles[d->count++], (uint32_t[3]){a, b, c}, sizeof *d->triangles);
}

/* The box's triangles from `first` on. */
static void put_box(drawing *d, sp_vec3 at, sp_vec3 size, int first)
{
    uint32_t base = d->point_count;
    for (int i = 0; i < 8; i++)
        put_point(d, at.x + size.x * box[i].x, at.y + size.y * box[i].y, at.z + size.z * box[i].z);
    for (int t = first; t < 12; t++)
        put(d, base + sides[t][0], base + sides[t][1], base + sides[t][2]);
}

static drawing one_box(int first)
{
    drawing d = {0};
    put_box(&d, sp_v(0, 0, 0), sp_v(1, 1, 1), first);
    return d;
}

static sp_mesh *make(const drawing *d)
{
    sp_mesh *mesh = sp_mesh_create(d->points, d->point_count, d->triangles, d->count, NULL, NULL, 0, NULL);
    assert_non_null(mesh);
    return mesh;
}

static bool same_point(sp_vec3 p, sp_vec3 q)
{
    return memcmp(&p, &q, sizeof p) == 0;
}

/* Triangle by triangle, part by part, to the last bit. */
static bool is_same(const sp_mesh *a, const sp_mesh *b)
{
    bool same = a->triangle_count == b->triangle_count;
    for (size_t t = 0; same && t < a->triangle_count; t++) {
        same &= strcmp(a->parts[a->part[t]].name, b->parts[b->part[t]].name) == 0;
        for (int k = 0; k < 3; k++)
            same &= same_point(a->vertices[a->triangles[t][k]], b->vertices[b->triangles[t][k]]);
    }
    return same;
}

static size_t changes(const sp_repair_account *a)
{
    return a->dropped + a->copies + a->joined + a->split + a->turned + a->filled;
}

/* The rim of a sheet that lay there twice is open once it lies there once, having been flipped before. */
static void expect_no_more_flaws(const sp_repair_account *account)
{
    const sp_mesh_diagnosis *b = &account->before, *a = &account->after;
    assert_int_equal(a->degenerate.count, 0);
    assert_true(a->open_edges.count <= b->open_edges.count + (account->copies ? 3 * account->copies : 0));
    assert_true(a->non_manifold_edges.count <= b->non_manifold_edges.count);
    assert_true(a->flipped_edges.count <= b->flipped_edges.count);
    assert_true(a->duplicate_triangles.count <= b->duplicate_triangles.count);
    assert_true(account->copies || a->cracks.count <= b->cracks.count);
    assert_true(account->copies || a->bits.count <= b->bits.count);
}

static size_t crossings_anywhere(const sp_mesh *mesh)
{
    sp_flaw crossings = {0};
    assert_true(sp_find_crossings(mesh, NULL, &crossings, NULL, NULL));
    return crossings.count;
}

/* Mends, with what holds of any mesh: the diagnosis told is that of the copy, nothing is worse, and mending the copy
 * changes nothing. */
static sp_mesh *mend(const sp_mesh *mesh, sp_repair_account *account)
{
    sp_mesh *mended = sp_mesh_repair(mesh, NULL, account, NULL);
    assert_non_null(mended);
    sp_mesh_diagnosis after;
    assert_true(sp_mesh_diagnose(mended, &after, NULL));
    assert_int_equal(after.open_edges.count, account->after.open_edges.count);
    assert_int_equal(after.crossings.count, account->after.crossings.count);
    assert_int_equal(after.closed_shells, account->after.closed_shells);
    expect_no_more_flaws(account);
    if (after.crossings.count > account->before.crossings.count) /* between what had been two shells */
        assert_true(crossings_anywhere(mended) <= crossings_anywhere(mesh));
    sp_repair_account again;
    sp_mesh *twice = sp_mesh_repair(mended, NULL, &again, NULL);
    assert_non_null(twice);
    assert_int_equal(changes(&again), 0);
    assert_true(is_same(mended, twice));
    if (!changes(account))
        assert_true(is_same(mesh, mended));
    sp_mesh_destroy(twice);
    return mended;
}

static double volume_of(const sp_mesh *mesh)
{
    double volume;
    assert_true(sp_mesh_volumes(mesh, &volume, NULL));
    return volume;
}

/* Mends a drawing of a body into a closed one of that area and volume. */
static sp_repair_account expect_body(const drawing *d, double area, double volume)
{
    sp_repair_account account;
    sp_mesh *mesh = make(d), *mended = mend(mesh, &account);
    assert_int_equal(account.after.closed_shells, account.after.shells);
    assert_int_equal(account.after.inside_out.count, 0);
    assert_true(fabs(account.after.area - area) < 1e-12 * area);
    assert_true(fabs(volume_of(mended) - volume) < 1e-12 * fabs(volume));
    sp_mesh_destroy(mended);
    sp_mesh_destroy(mesh);
    return account;
}

/* Nothing is done. */
static sp_repair_account expect_left(const drawing *d)
{
    sp_repair_account account;
    sp_mesh *mesh = make(d), *mended = mend(mesh, &account);
    assert_int_equal(changes(&account), 0);
    sp_mesh_destroy(mended);
    sp_mesh_destroy(mesh);
    return account;
}

static void sound_bodies_stay(void **state)
{
    (void)state;
    drawing d = one_box(0);
    put_box(&d, sp_v(3, 0, 0), sp_v(1, 1, 1), 0);
    put_box(&d, sp_v(6, 0, 0), sp_v(1, 1, 1), 2); /* without a bottom */
    expect_left(&d);
}

static void triangles_are_turned(void **state)
{
    (void)state;
    for (int both = 0; both < 2; both++) {
        drawing d = one_box(0);
        for (int t = 4; t < 5 + both; t++)
            memcpy(d.triangles[t], (uint32_t[3]){sides[t][0], sides[t][2], sides[t][1]}, sizeof *d.triangles);
        sp_repair_account account = expect_body(&d, 22, 6);
        assert_int_equal(account.turned, 1 + both);
        assert_int_equal(changes(&account), account.turned);
        assert_int_equal(account.before.flipped_edges.count, both ? 4 : 3);
    }
}

/* A room with a wall drawn from outside stays a room. */
static void most_of_a_shell_decides(void **state)
{
    (void)state;
    drawing d = one_box(0);
    for (int t = 0; t < 12; t++)
        if (t / 2 != 2)
            memcpy(d.triangles[t], (uint32_t[3]){sides[t][0], sides[t][2], sides[t][1]}, sizeof *d.triangles);
    sp_repair_account account;
    sp_mesh *mesh = make(&d), *mended = mend(mesh, &account);
    assert_int_equal(account.turned, 2);
    assert_true(fabs(volume_of(mended) + 6) < 1e-12);
    assert_int_equal(account.after.inside_out.count, 1);
    sp_mesh_destroy(mended);
    sp_mesh_destroy(mesh);
}

/* The lid of the box reaches over `pieces` of each side, whose upper edges are cut at these. */
static drawing finely_cut_sides(uint32_t pieces, double off)
{
    drawing d = one_box(0);
    d.count = 4;
    for (uint32_t s = 0; s < 4; s++) {
        uint32_t a = s, b = (s + 1) % 4, before = a + 4;
        for (uint32_t i = 1; i <= pieces; i++) {
            sp_vec3 from = d.points[a + 4], way = sp_sub(d.points[b + 4], from);
            sp_vec3 p = sp_along(from, (double)i / pieces, way);
            uint32_t next = i < pieces ? put_point(&d, p.x, p.y, p.z + off) : b + 4;
            put(&d, a, next, before);
            before = next;
        }
        put(&d, a, b, b + 4);
    }
    return d;
}

static void edges_that_meet_halfway_are_cut(void **state)
{
    (void)state;
    sp_repair_account account;
    for (uint32_t pieces = 2; pieces <= 8; pieces *= 2) {
        drawing d = finely_cut_sides(pieces, 0);
        account = expect_body(&d, 22, 6);
        assert_int_equal(account.split, 4); /* either triangle of the lid at two of its edges */
        assert_int_equal(account.before.open_edges.count, 4 + 4 * pieces);
        assert_int_equal(account.after.open_edges.count, 0);
    }
    drawing d = finely_cut_sides(4, 0); /* beside it, one that would gain nothing */
    uint32_t first = d.point_count;
    const double strip[][2] = {{0, 0}, {6, 0}, {3, 3}, {2, 0}, {4, 0}, {3, -1}};
    for (int i = 0; i < 6; i++)
        put_point(&d, strip[i][0], strip[i][1], 9);
    put(&d, first, first + 1, first + 2);
    put(&d, first + 3, first + 5, first + 4);
    sp_mesh *beside = make(&d), *split = mend(beside, &account);
    assert_int_equal(account.split, 4);
    sp_mesh_destroy(split);
    sp_mesh_destroy(beside);
    d = finely_cut_sides(4, 1e-5);
    sp_mesh *mesh = make(&d), *mended = mend(mesh, &account);
    assert_int_equal(account.after.closed_shells, 1);
    assert_true(fabs(volume_of(mended) - 6) < 6e-5);
    sp_mesh_destroy(mended);
    sp_mesh_destroy(mesh);
    d = finely_cut_sides(4, 0.1); /* no crack any more */
    expect_left(&d);
}

/* A lid of its own corners, `gap` above the sides. */
static drawing loose_lid(double gap)
{
    drawing d = one_box(0);
    for (int i = 4; i < 8; i++)
        put_point(&d, box[i].x, box[i].y, box[i].z + gap);
    for (int t = 2; t < 4; t++)
        for (int k = 0; k < 3; k++)
            d.triangles[t][k] += 4;
    return d;
}

static void cracks_are_joined(void **state)
{
    (void)state;
    drawing d = loose_lid(1e-5);
    sp_repair_account account = expect_body(&d, 22, 6);
    assert_int_equal(account.joined, 4);
    assert_int_equal(account.before.cracks.count, 8);
    assert_int_equal(account.after.cracks.count, 0);
    d = loose_lid(-1e-5);
    expect_body(&d, 22, 6);
    d = loose_lid(1e-3);
    expect_left(&d);
    d = loose_lid(1e-5); /* a lid drawn from inside is turned as well */
    for (int t = 2; t < 4; t++) {
        uint32_t swap = d.triangles[t][0];
        d.triangles[t][0] = d.triangles[t][1];
        d.triangles[t][1] = swap;
    }
    account = expect_body(&d, 22, 6);
    assert_int_equal(account.turned, 2);
}

static void copies_are_taken_out(void **state)
{
    (void)state;
    drawing d = one_box(0);
    put(&d, 4, 5, 6);
    put(&d, 6, 7, 4); /* the lid twice */
    sp_repair_account account = expect_body(&d, 22, 6);
    assert_int_equal(account.copies, 2);
    d = one_box(0);
    put(&d, 4, 6, 5); /* half of it from inside too, */
    account = expect_body(&d, 22, 6);
    assert_int_equal(account.copies, 1);
    d = (drawing){0};
    for (int i = 0; i < 8; i++)
        put_point(&d, box[i].x, box[i].y, box[i].z);
    put(&d, 4, 6, 5); /* and as the first */
    for (int t = 0; t < 12; t++)
        put(&d, sides[t][0], sides[t][1], sides[t][2]);
    account = expect_body(&d, 22, 6);
    assert_int_equal(account.copies, 1);
    d = one_box(0);
    put_box(&d, sp_v(0, 0, 0), sp_v(1, 1, 1), 0); /* the whole body twice */
    account = expect_body(&d, 22, 6);
    assert_int_equal(account.copies, 12);
}

static void a_sheet_there_twice_is_there_once(void **state)
{
    (void)state;
    drawing d = one_box(10), twice = d;
    put(&twice, d.triangles[0][0], d.triangles[0][1], d.triangles[0][2]);
    put(&twice, d.triangles[1][0], d.triangles[1][1], d.triangles[1][2]);
    sp_repair_account account;
    sp_mesh *mesh = make(&twice), *mended = mend(mesh, &account), *once = make(&d);
    assert_int_equal(account.copies, 2);
    assert_true(is_same(mended, once));
    sp_mesh_destroy(once);
    sp_mesh_destroy(mended);
    sp_mesh_destroy(mesh);
}

/* Bodies that touch have a face each, and so have the two sides of a sheet. */
static void copies_with_a_reason_stay(void **state)
{
    (void)state;
    drawing d = one_box(0);
    put_box(&d, sp_v(1, 0, 0), sp_v(1, 1, 1), 0); /* side by side: their walls are cut alike */
    memcpy(d.triangles[12 + 10], (uint32_t[3]){8 + 0, 8 + 7, 8 + 3}, sizeof *d.triangles);
    memcpy(d.triangles[12 + 11], (uint32_t[3]){8 + 0, 8 + 4, 8 + 7}, sizeof *d.triangles);
    sp_repair_account account = expect_left(&d);
    assert_int_equal(account.before.duplicate_triangles.count, 2);
    d = one_box(0);
    put_box(&d, sp_v(0, 0, 0), sp_v(1, 1, 0.5), 0); /* one in the other, on the same floor */
    account = expect_left(&d);
    assert_int_equal(account.before.duplicate_triangles.count, 2);
    d = one_box(10); /* a sheet from both sides */
    for (int t = 0; t < 2; t++)
        put(&d, d.triangles[t][2], d.triangles[t][1], d.triangles[t][0]);
    account = expect_left(&d);
    assert_int_equal(account.before.duplicate_triangles.count, 2);
}

/* The lid's diagonal has a corner on one side only, and a triangle without area between. */
static void slivers_are_split_into_their_neighbours(void **state)
{
    (void)state;
    drawing d = one_box(0);
    uint32_t middle = put_point(&d, 0.5, 1, 3);
    d.triangles[3][1] = middle; /* 4 6 7 becomes two */
    memcpy(d.triangles[3], (uint32_t[3]){4, middle, 7}, sizeof *d.triangles);
    put(&d, middle, 6, 7);
    put(&d, 4, 6, middle); /* without area */
    sp_repair_account account = expect_body(&d, 22, 6);
    assert_int_equal(account.dropped, 1);
    assert_int_equal(account.split, 1);
    d = one_box(0);
    put(&d, 4, 4, 5);
    account = expect_body(&d, 22, 6);
    assert_int_equal(changes(&account), 1);
}

/* Both halves of the lid are there twice, in other parts: 0, 1 and 2 are the box, the lid and half of it. */
static void what_parts_lose_is_reported(void **state)
{
    (void)state;
    static const char *const names[] = {"box", "lid", "half"};
    static const uint32_t orders[][3] = {{0, 1, 2}, {2, 0, 1}};
    for (int order = 0; order < 2; order++)
        for (uint32_t wanted = 0; wanted < 4; wanted++) {
            uint32_t part[15] = {0}, box_part = orders[order][0];
            drawing d = one_box(0);
            put(&d, 4, 5, 6);
            put(&d, 6, 7, 4);
            put(&d, 5, 6, 4);
            for (int t = 0; t < 15; t++)
                part[t] = t < 12 ? box_part : orders[order][t < 14 ? 1 : 2];
            const bool preferred[3] = {wanted == 0, wanted == 1, wanted == 2};
            sp_repair_account account;
            sp_mesh *mesh =
                sp_mesh_create(d.points, d.point_count, (const uint32_t(*)[3])d.triangles, 15, part, names, 3, NULL);
            sp_mesh *mended = sp_mesh_repair(mesh, wanted < 3 ? preferred : NULL, &account, NULL);
            assert_int_equal(account.copies, 3);
            double area[3] = {0}, lost[3] = {0};
            for (uint32_t t = 0; t < mended->triangle_count; t++)
                area[mended->part[t]] += sp_triangle_area(mended, t);
            for (size_t i = 0; i < account.yield_count; i++)
                lost[account.yields[i].part] += account.yields[i].area;
            uint32_t lid = orders[order][1], half = orders[order][2];
            bool to_lid = wanted == lid, to_half = wanted == half;
            assert_true(fabs(area[box_part] - (to_lid ? 20 : to_half ? 21 : 22)) < 1e-12);
            assert_true(fabs(area[lid] - (to_lid ? 2 : 0)) < 1e-12);
            assert_true(fabs(area[half] - (to_half ? 1 : 0)) < 1e-12);
            assert_true(fabs(lost[box_part] - (to_lid ? 2 : to_half ? 1 : 0)) < 1e-12);
            assert_true(fabs(lost[lid] - (to_lid ? 0 : 2)) < 1e-12);
            assert_true(fabs(lost[half] - (to_half ? 0 : 1)) < 1e-12);
            sp_mesh_destroy(mended);
            sp_mesh_destroy(mesh);
        }
}

/* The ends of a pipe of three walls, cut straight or at 45 degrees, are left open. */
static void ends_of_pipes_stay_open(void **state)
{
    (void)state;
    for (int slanted = 0; slanted < 2; slanted++) {
        drawing d = {0};
        for (int end = 0; end < 2; end++)
            for (int i = 0; i < 3; i++) {
                double x = cos(2 * M_PI * i / 3), y = sin(2 * M_PI * i / 3);
                put_point(&d, x, y, end ? 5 + slanted * x : 0);
            }
        for (uint32_t i = 0; i < 3; i++) {
            put(&d, i, (i + 1) % 3, 3 + (i + 1) % 3);
            put(&d, i, 3 + (i + 1) % 3, 3 + i);
        }
        expect_left(&d);
    }
}

static void what_is_put_in_is_reported(void **state)
{
    (void)state;
    enum { EDGE = 6 };
    drawing d = {0};
    for (uint32_t i = 0; i < (EDGE + 1) * (EDGE + 1); i++)
        put_point(&d, 1.0 * (i % (EDGE + 1)) * (i % (EDGE + 1)), i / (EDGE + 1), 0);
    for (uint32_t y = 0; y < EDGE; y++)
        for (uint32_t x = 0; x < EDGE; x++) {
            uint32_t at = y * (EDGE + 1) + x;
            if (y != 1 || (x != 1 && x != 3))
                put(&d, at, at + 1, at + EDGE + 2);
            put(&d, at, at + EDGE + 2, at + EDGE + 1);
        }
    sp_repair_account account;
    sp_mesh *mesh = make(&d), *mended = mend(mesh, &account);
    assert_int_equal(account.filled, 2);
    assert_true(fabs(account.filled_area - 5) < 1e-15); /* of 3 and of 7 by 1, half */
    assert_true(fabs(account.fillings[0].area - 3.5) < 1e-15 && fabs(account.fillings[1].area - 1.5) < 1e-15);
    assert_true(fabs(account.fillings[0].place.x - 41.0 / 3) < 1e-14);
    sp_mesh_destroy(mended);
    sp_mesh_destroy(mesh);
}

static void only_single_triangles_are_filled_in(void **state)
{
    (void)state;
    drawing d = one_box(1);
    sp_repair_account account = expect_body(&d, 22, 6);
    assert_int_equal(account.filled, 1);
    assert_true(fabs(account.filled_area - 1) < 1e-15);
    d = one_box(2);
    expect_left(&d);
    d = (drawing){0};
    for (int i = 0; i < 3; i++)
        put_point(&d, cos(2 * M_PI * i / 3), sin(2 * M_PI * i / 3), 0);
    put(&d, 0, 1, 2);
    expect_left(&d);
    put_point(&d, 0, 0, -1.3);
    for (uint32_t i = 0; i < 3; i++) /* a funnel */
        memcpy(d.triangles[i], (uint32_t[3]){(i + 1) % 3, i, 3}, sizeof *d.triangles);
    d.count = 3;
    expect_left(&d);
}

/* A strip of ten triangles, closed after half a twist, cannot be turned to agree. */
static void one_sided_strips_stay(void **state)
{
    (void)state;
    enum { STEPS = 5 };
    drawing d = {0};
    for (uint32_t i = 0; i < STEPS; i++) {
        double turn = 2 * M_PI * i / STEPS;
        for (int side = -1; side < 2; side += 2) {
            double r = 1 + 0.3 * side * cos(turn / 2);
            put_point(&d, r * cos(turn), r * sin(turn), 0.3 * side * sin(turn / 2));
        }
    }
    for (uint32_t i = 0; i < STEPS; i++) {
        uint32_t a = 2 * i, b = a + 1, c = i + 1 < STEPS ? a + 2 : 1, e = i + 1 < STEPS ? a + 3 : 0;
        put(&d, a, c, b);
        put(&d, b, c, e);
    }
    sp_repair_account account = expect_left(&d);
    assert_int_equal(account.before.flipped_edges.count, 1);
}

static uint64_t random_state;

/* 0 .. most - 1; Marsaglia's xorshift. */
static uint32_t any(uint32_t most)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (uint32_t)(random_state >> 32) % most;
}

typedef struct {
    uint32_t edge; /* points lie on a grid of that many along each axis */
    uint32_t triangles;
    double noise;       /* how far off it they lie */
    uint32_t copies_in; /* one triangle of so many is there again, 0: none */
} soup;

static sp_mesh *cook(const soup *s)
{
    uint32_t count = 0, most = 2 * s->triangles;
    sp_vec3 *points = malloc(3 * most * sizeof *points);
    uint32_t(*triangles)[3] = malloc(most * sizeof *triangles);
    assert_true(points && triangles);
    for (; count < s->triangles; count++) {
        bool again = count && s->copies_in && any(s->copies_in) == 0, over = any(3) == 0;
        uint32_t of = again ? any(count) : 0, t = count;
        for (uint32_t k = 0; k < 3; k++) {
            double at[3];
            for (int i = 0; i < 3; i++)
                at[i] = any(s->edge) + s->noise * (1e-9 * any(1000000000) - 0.5);
            points[3 * t + k] = again ? points[3 * of + (over ? 2 - k : k)] : sp_v(at[0], at[1], at[2]);
            triangles[t][k] = 3 * t + k;
        }
    }
    sp_mesh *mesh = sp_mesh_create(points, 3 * count, (const uint32_t(*)[3])triangles, count, NULL, NULL, 0, NULL);
    assert_non_null(mesh);
    free(points);
    free(triangles);
    return mesh;
}

static void soups_get_no_worse(void **state)
{
    (void)state;
    static const soup soups[] = {{2, 12, 0, 0},   {2, 30, 1e-5, 0}, {3, 40, 0, 0},  {3, 40, 0, 4},    {3, 60, 1e-4, 0},
                                 {4, 100, 0, 10}, {5, 200, 0, 0},   {9, 20, 0, 1},  {100, 300, 0, 0}, {2, 200, 0, 2},
                                 {1, 20, 1, 0},   {1, 20, 0, 0},    {3, 60, 0.3, 3}};
    size_t changed = 0;
    for (uint32_t i = 0; i < sizeof soups / sizeof *soups; i++)
        for (uint32_t seed = 1; seed <= 25; seed++) {
            random_state = 0x9E3779B97F4A7C15u * (seed + 1000 * i + 1);
            sp_repair_account account;
            sp_mesh *mesh = cook(&soups[i]), *mended = mend(mesh, &account);
            changed += changes(&account) > 0;
            sp_mesh_destroy(mended);
            sp_mesh_destroy(mesh);
        }
    assert_true(changed > 40);
}

/* A sphere of which each triangle has corners of its own, off by noise, and some are turned over or missing. */
static void a_torn_sphere_is_whole_again(void **state)
{
    (void)state;
    enum { ROUND = 24, HIGH = 12 };
    for (uint32_t seed = 1; seed < 6; seed++) {
        sp_vec3 points[6 * ROUND * HIGH];
        uint32_t triangles[2 * ROUND * HIGH][3], count = 0;
        random_state = 0x9E3779B97F4A7C15u * seed;
        for (uint32_t i = 0; i < 2 * ROUND * HIGH; i++) {
            uint32_t column = i / 2 % ROUND, row = i / 2 / ROUND;
            const uint32_t at[2][3][2] = {{{0, 0}, {1, 1}, {1, 0}}, {{0, 0}, {0, 1}, {1, 1}}};
            bool over = any(10) == 0;
            if ((row == 0 && i % 2 == 0) || (row == HIGH - 1 && i % 2))
                continue;
            for (uint32_t k = 0; k < 3; k++) {
                const uint32_t *corner = at[i % 2][k];
                double turn = 2 * M_PI * ((column + corner[0]) % ROUND) / ROUND, z = M_PI * (row + corner[1]) / HIGH;
                double wide = (row + corner[1]) % HIGH ? sin(z) : 0, noise = 1e-5 * (1e-9 * any(1000000000) - 0.5);
                points[3 * count + k] = sp_v(wide * cos(turn) + noise, wide * sin(turn) - noise, cos(z) + noise);
                triangles[count][k] = 3 * count + (over ? 2 - k : k);
            }
            count++;
        }
        sp_mesh *mesh =
            sp_mesh_create(points, 3 * count, (const uint32_t(*)[3])triangles, count - 1, NULL, NULL, 0, NULL);
        sp_repair_account account;
        sp_mesh *mended = mend(mesh, &account);
        assert_int_equal(account.before.shells, count - 1);
        assert_int_equal(account.after.closed_shells, 1);
        assert_int_equal(account.after.shells, 1);
        assert_int_equal(account.filled, 1);
        assert_true(fabs(account.after.area - account.before.area) < 0.02);
        sp_mesh_destroy(mended);
        sp_mesh_destroy(mesh);
    }
}

/* Fans of very many triangles about one edge and one point, and all triangles many times over. */
static void crowds_come_to_an_end(void **state)
{
    (void)state;
    enum { MANY = 800 };
    sp_vec3 points[MANY + 2] = {{0, 0, 0}, {0, 0, 1}};
    static uint32_t triangles[2 * MANY][3];
    for (uint32_t i = 0; i < MANY; i++) {
        double turn = 2 * M_PI * i / MANY;
        points[i + 2] = sp_v(cos(turn), sin(turn), 0);
    }
    for (int kind = 0; kind < 3; kind++) {
        for (uint32_t i = 0; i < 2 * MANY; i++) {
            const uint32_t corners[3][3] = {{0, 1, 2 + i % MANY}, {0, 2 + i % MANY, 2 + (i + 1) % MANY}, {2, 3, 4}};
            memcpy(triangles[i], corners[kind], sizeof *triangles);
        }
        sp_mesh *mesh = sp_mesh_create(points, MANY + 2, (const uint32_t(*)[3])triangles, kind ? 2 * MANY : MANY, NULL,
                                       NULL, 0, NULL);
        sp_repair_account account;
        sp_mesh *mended = mend(mesh, &account);
        assert_int_equal(account.copies, kind == 0 ? 0 : kind == 1 ? MANY : 2 * MANY - 1);
        sp_mesh_destroy(mended);
        sp_mesh_destroy(mesh);
    }
}

static void nothing_is_mended_of_nothing(void **state)
{
    (void)state;
    drawing d = {0};
    expect_left(&d);
    put_point(&d, 1, 2, 3);
    put(&d, 0, 0, 0);
    sp_repair_account account;
    sp_mesh *mesh = make(&d), *mended = mend(mesh, &account);
    assert_int_equal(mended->triangle_count, 0);
    assert_int_equal(account.dropped, 1);
    sp_mesh_destroy(mended);
    sp_mesh_destroy(mesh);
}

/* Of one triangle in twenty a quarter gets corners of its own, up to 5e-6 of the diagonal off, a quarter is turned
 * over, a quarter is there twice and the rest are missing. */
static sp_mesh *tear(const sp_mesh *mesh)
{
    sp_vec3 low, high;
    double off = 1e-5 * sp_mesh_box(mesh, &low, &high);
    size_t most = mesh->triangle_count, points = mesh->vertex_count, count = 0;
    sp_vec3 *vertices = malloc((points + 3 * most) * sizeof *vertices);
    uint32_t(*triangles)[3] = malloc(2 * most * sizeof *triangles);
    assert_true(vertices && triangles);
    memcpy(vertices, mesh->vertices, points * sizeof *vertices);
    for (size_t t = 0; t < most; t++) {
        uint32_t what = any(80), *corners = triangles[count];
        memcpy(corners, mesh->triangles[t], sizeof *triangles);
        for (int k = 0; k < 3 && what == 0; k++) {
            vertices[points] = sp_along(mesh->vertices[corners[k]], off * (1e-3 * any(1001) - 0.5), sp_v(1, 0.5, -1));
            corners[k] = (uint32_t)points++;
        }
        if (what == 1) {
            corners[0] = mesh->triangles[t][1];
            corners[1] = mesh->triangles[t][0];
        }
        if (what == 2)
            memcpy(triangles[++count], mesh->triangles[t], sizeof *triangles);
        count += what != 3;
    }
    sp_mesh *torn = sp_mesh_create(vertices, points, (const uint32_t(*)[3])triangles, count, NULL, NULL, 0, NULL);
    assert_non_null(torn);
    free(vertices);
    free(triangles);
    return torn;
}

static void print_account(const char *name, const sp_repair_account *account)
{
    const sp_mesh_diagnosis *b = &account->before, *a = &account->after;
    print_message(
        "%s: open %zu -> %zu, cracks %zu -> %zu, non-manifold %zu -> %zu, flipped %zu -> %zu, twice %zu -> %zu, "
        "crossings %zu -> %zu, bits %zu -> %zu, shells %zu -> %zu; joined %zu, split %zu, turned %zu, filled "
        "%zu, copies %zu; area %.6g -> %.6g\n",
        name, b->open_edges.count, a->open_edges.count, b->cracks.count, a->cracks.count, b->non_manifold_edges.count,
        a->non_manifold_edges.count, b->flipped_edges.count, a->flipped_edges.count, b->duplicate_triangles.count,
        a->duplicate_triangles.count, b->crossings.count, a->crossings.count, b->bits.count, a->bits.count, b->shells,
        a->shells, account->joined, account->split, account->turned, account->filled, account->copies, b->area,
        a->area);
}

/* Models that others made, as they are and torn. */
static void torn_models_are_nearly_whole_again(void **state)
{
    (void)state;
    static const char *const names[] = {"beetle", "horse", "elephant"};
    for (int i = 0; i < 3; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s.obj", DATA_DIR, names[i]);
        if (access(path, R_OK) != 0) {
            print_message("skipped: no %s\n", path);
            continue;
        }
        sp_repair_account whole, account;
        random_state = 88172645463325252u;
        sp_mesh *mesh = sp_mesh_load(path, 1, NULL);
        assert_non_null(mesh);
        sp_mesh *torn = tear(mesh), *mended = mend(torn, &account), *same = mend(mesh, &whole);
        assert_int_equal(changes(&whole), 0);
        print_account(names[i], &account);
        size_t open = whole.before.open_edges.count;
        assert_true(10 * (account.after.open_edges.count - open) < account.before.open_edges.count);
        assert_true(10 * account.after.cracks.count < account.before.cracks.count);
        assert_int_equal(account.after.flipped_edges.count, 0);
        assert_true(account.after.crossings.count <= account.before.crossings.count);
        sp_mesh_destroy(same);
        sp_mesh_destroy(mended);
        sp_mesh_destroy(torn);
        sp_mesh_destroy(mesh);
    }
}

/* Names that OBJ can write, numbers to the last bit, parts that alternate; a point that nothing uses is left out. */
static void a_written_copy_reads_back(void **state)
{
    (void)state;
    static const uint32_t part[] = {0, 1, 0, 1, 2, 2, 2, 2, 2, 2, 2, 2};
    static const char *const names[] = {"lid #2", "vessel/blade#2", "walls\\", "nothing"};
    drawing d = one_box(0);
    for (int i = 0; i < 8; i++)
        d.points[i] = sp_scale(d.points[i], 1.0 / 3);
    put_point(&d, 9, 9, 9);
    sp_mesh *mesh = sp_mesh_create(d.points, 9, (const uint32_t(*)[3])d.triangles, 12, part, names, 4, NULL);
    const char *path = BINARY_DIR "/tests/mesh-repair.obj";
    assert_true(sp_mesh_write_obj(mesh, path, NULL));
    sp_mesh *read = sp_mesh_load(path, 1, NULL);
    assert_non_null(read);
    assert_int_equal(read->part_count, 3);
    assert_int_equal(read->vertex_count, 8);
    assert_int_equal(read->triangle_count, 12);
    static const char *const expected[] = {"lid _2", "vessel/blade#2", "walls_"};
    for (size_t t = 0; t < 12; t++) {
        assert_string_equal(read->parts[read->part[t]].name, expected[part[t]]);
        for (int k = 0; k < 3; k++)
            assert_true(same_point(read->vertices[read->triangles[t][k]], mesh->vertices[mesh->triangles[t][k]]));
    }
    sp_mesh_destroy(read);
    unlink(path);
    sp_error error = {0};
    assert_false(sp_mesh_write_obj(mesh, BINARY_DIR "/tests/not-there/a.obj", &error));
    assert_int_equal(error.kind, SP_ERROR_FILE);
    if (access("/dev/full", W_OK) == 0) {
        error = (sp_error){0};
        assert_false(sp_mesh_write_obj(mesh, "/dev/full", &error));
        assert_int_equal(error.kind, SP_ERROR_FILE);
    }
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sound_bodies_stay),
        cmocka_unit_test(triangles_are_turned),
        cmocka_unit_test(most_of_a_shell_decides),
        cmocka_unit_test(edges_that_meet_halfway_are_cut),
        cmocka_unit_test(cracks_are_joined),
        cmocka_unit_test(copies_are_taken_out),
        cmocka_unit_test(a_sheet_there_twice_is_there_once),
        cmocka_unit_test(copies_with_a_reason_stay),
        cmocka_unit_test(slivers_are_split_into_their_neighbours),
        cmocka_unit_test(what_parts_lose_is_reported),
        cmocka_unit_test(ends_of_pipes_stay_open),
        cmocka_unit_test(what_is_put_in_is_reported),
        cmocka_unit_test(only_single_triangles_are_filled_in),
        cmocka_unit_test(one_sided_strips_stay),
        cmocka_unit_test(soups_get_no_worse),
        cmocka_unit_test(a_torn_sphere_is_whole_again),
        cmocka_unit_test(crowds_come_to_an_end),
        cmocka_unit_test(nothing_is_mended_of_nothing),
        cmocka_unit_test(torn_models_are_nearly_whole_again),
        cmocka_unit_test(a_written_copy_reads_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
