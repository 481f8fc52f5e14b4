/* Texels: their areas, to whom they belong, which point lies in which, and which of them touch. */
#include "shapes.h"

#include "atlas/texels/texels.h"

/* Where a point of a triangle lies on its page. */
static void page_point(const sp_atlas *atlas, uint32_t t, double u, double v, double point[2])
{
    for (int k = 0; k < 2; k++)
        point[k] = (1 - u - v) * atlas->uv[t][0][k] + u * atlas->uv[t][1][k] + v * atlas->uv[t][2][k];
}

static sp_fragments fragments_of(const sp_atlas *atlas, const sp_mesh *mesh)
{
    sp_error error = {0};
    sp_fragments fragments;
    if (!sp_fragments_create(&fragments, atlas, mesh, &error))
        fail_msg("%s", error.message);
    return fragments;
}

static sp_texel_links links_of(const sp_atlas *atlas, const sp_mesh *mesh)
{
    sp_error error = {0};
    sp_texel_links links;
    if (!sp_texel_links_create(&links, atlas, mesh, &error))
        fail_msg("%s", error.message);
    return links;
}

static bool holds(const sp_fragments *fragments, uint32_t texel, uint32_t triangle)
{
    for (uint32_t f = fragments->start[texel]; f < fragments->start[texel + 1]; f++)
        if (fragments->items[f].triangle == triangle)
            return true;
    return false;
}

static void expect_areas(const sp_atlas *atlas, const sp_fragments *fragments, const sp_mesh *mesh)
{
    double *of_triangle = calloc(mesh->triangle_count, sizeof *of_triangle);
    for (size_t i = 0; i < atlas->texel_count; i++) {
        double sum = 0;
        for (uint32_t f = fragments->start[i]; f < fragments->start[i + 1]; f++) {
            const sp_fragment *fragment = &fragments->items[f];
            assert_true(f == fragments->start[i] || fragment[-1].triangle < fragment->triangle);
            assert_true(fragment->area > 0);
            sum += fragment->area;
            of_triangle[fragment->triangle] += fragment->area;
        }
        assert_true(sum > 0 && fabs(sum - atlas->texel_area[i]) <= 1e-15 * sum);
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        assert_true(fabs(of_triangle[t] - sp_triangle_area(mesh, t)) <= 1e-12 * of_triangle[t]);
    assert_true(figures_of(atlas, mesh).area_error <= 1e-12);
    free(of_triangle);
}

static void expect_order(const sp_atlas *atlas)
{
    uint64_t edge = atlas->page_edge, before = 0;
    for (uint32_t i = 0; i < atlas->texel_count; i++) {
        sp_texel_place place = sp_atlas_place(atlas, i);
        assert_true(place.page < atlas->page_count && place.x < edge && place.y < edge);
        uint64_t here = (place.page * edge + place.y) * edge + place.x;
        assert_true(i == 0 || i == atlas->pixel_count || (i < atlas->pixel_count ? before < here : before <= here));
        uint32_t first = sp_atlas_pixel(atlas, place.page, place.x, place.y);
        assert_true(i < atlas->pixel_count ? first == i : first == atlas->behind[i - atlas->pixel_count]);
        assert_true(i < atlas->pixel_count || atlas->texel_area[i] <= atlas->texel_area[first]);
        before = here;
    }
    assert_true(sp_atlas_pixel(atlas, (uint32_t)atlas->page_count, 0, 0) == SP_NONE);
    assert_true(sp_atlas_pixel(atlas, 0, (uint32_t)edge, 0) == SP_NONE);
    size_t used = 0;
    for (uint32_t page = 0; page < atlas->page_count; page++)
        for (uint32_t y = 0; y < edge; y++)
            for (uint32_t x = 0; x < edge; x++)
                used += sp_atlas_pixel(atlas, page, x, y) != SP_NONE;
    assert_int_equal(used, atlas->pixel_count);
}

static void expect_points_found(const sp_atlas *atlas, const sp_fragments *fragments, int count)
{
    uint64_t seed = 11;
    for (int i = 0; i < count; i++) {
        uint32_t t = (uint32_t)(random_number(&seed) * (double)atlas->triangle_count);
        double u = random_number(&seed), v = (1 - u) * random_number(&seed), point[2];
        if (i % 10 < 3) /* on the edges and corners too */
            v = i % 10 ? 1 - u : 0;
        if (i % 50 == 0)
            u = v = 0;
        uint32_t texel = sp_atlas_texel(atlas, t, u, v);
        assert_true(texel < atlas->texel_count && holds(fragments, texel, t));
        page_point(atlas, t, u, v, point);
        sp_texel_place place = sp_atlas_place(atlas, texel);
        assert_true(point[0] >= place.x - 1e-6 && point[0] <= place.x + 1 + 1e-6);
        assert_true(point[1] >= place.y - 1e-6 && point[1] <= place.y + 1 + 1e-6);
    }
}

/* True where the triangle and the square overlap by more than round-off: no edge of either separates them. */
static bool meets_square(const double uv[3][2], double x, double y)
{
    const double slack = 1e-6, corner[4][2] = {{x, y}, {x + 1, y}, {x, y + 1}, {x + 1, y + 1}};
    for (int k = 0; k < 2; k++)
        if (fmax(uv[0][k], fmax(uv[1][k], uv[2][k])) <= corner[0][k] + slack ||
            fmin(uv[0][k], fmin(uv[1][k], uv[2][k])) >= corner[3][k] - slack)
            return false;
    for (int i = 0; i < 3; i++) {
        double dx = uv[(i + 1) % 3][0] - uv[i][0], dy = uv[(i + 1) % 3][1] - uv[i][1];
        int outside = 0;
        for (int c = 0; c < 4; c++)
            outside += dy * (corner[c][0] - uv[i][0]) - dx * (corner[c][1] - uv[i][1]) >= -slack * hypot(dx, dy);
        if (outside == 4)
            return false;
    }
    return true;
}

/* Paints the pages anew from the UVs alone: charts keep a texel apart, and what is painted is a texel of that chart. */
static void expect_charts_apart(const sp_atlas *atlas)
{
    size_t edge = atlas->page_edge;
    uint32_t *paint = calloc(edge * edge * atlas->page_count, sizeof *paint);
    for (size_t t = 0; t < atlas->triangle_count; t++) {
        const double(*uv)[2] = (const double(*)[2])atlas->uv[t];
        uint32_t *page = paint + atlas->chart_page[atlas->chart[t]] * edge * edge, chart = atlas->chart[t] + 1;
        size_t right = (size_t)fmax(uv[0][0], fmax(uv[1][0], uv[2][0])),
               top = (size_t)fmax(uv[0][1], fmax(uv[1][1], uv[2][1]));
        for (size_t y = (size_t)fmin(uv[0][1], fmin(uv[1][1], uv[2][1])); y <= top; y++)
            for (size_t x = (size_t)fmin(uv[0][0], fmin(uv[1][0], uv[2][0])); x <= right; x++) {
                if (!meets_square(uv, (double)x, (double)y))
                    continue;
                for (size_t b = y - (y > 0); b <= y + 1 && b < edge; b++)
                    for (size_t a = x - (x > 0); a <= x + 1 && a < edge; a++)
                        assert_true(page[b * edge + a] == 0 || page[b * edge + a] == chart);
                page[y * edge + x] = chart;
            }
    }
    for (uint32_t i = 0; i < atlas->pixel_count; i++) {
        sp_texel_place place = sp_atlas_place(atlas, i);
        uint32_t *cell = &paint[(place.page * edge + place.y) * edge + place.x];
        assert_true(*cell == 0 || *cell == place.chart + 1); /* 0: no more than round-off */
        *cell = 0;
    }
    for (size_t i = 0; i < edge * edge * atlas->page_count; i++)
        assert_int_equal(paint[i], 0);
    free(paint);
}

static bool are_neighbours(const sp_texel_links *links, uint32_t a, uint32_t b)
{
    for (uint32_t i = links->start[a]; i < links->start[a + 1]; i++)
        if (links->items[i] == b)
            return true;
    return false;
}

static void expect_neighbours_sound(const sp_atlas *atlas, const sp_texel_links *links)
{
    for (uint32_t i = 0; i < atlas->texel_count; i++)
        for (uint32_t n = links->start[i]; n < links->start[i + 1]; n++) {
            assert_true(n == links->start[i] || links->items[n - 1] < links->items[n]);
            assert_true(links->items[n] < atlas->texel_count && links->items[n] != i);
            assert_true(are_neighbours(links, links->items[n], i));
        }
}

/* The edge lies on the edge, what is inside of it lies beyond the other side, and the way back leads back. */
static void expect_across(const sp_atlas *atlas, const sp_mesh *mesh, const sp_seam *seam)
{
    const sp_seam back = {seam->other, seam->texel, seam->across, seam->edge, seam->length};
    uint32_t turned = sp_half_edge_from(mesh, seam->edge) != sp_half_edge_from(mesh, seam->across),
             k = seam->across % 3;
    const double(*here)[2] = (const double(*)[2])atlas->uv[seam->edge / 3];
    const double(*there)[2] = (const double(*)[2])atlas->uv[seam->across / 3];
    const double *expected[2] = {there[(k + turned) % 3], there[(k + 1 - turned) % 3]}, *other = there[(k + 2) % 3];
    double at[3][2], again[2], side[2];
    for (uint32_t i = 0; i < 3; i++) {
        const double *corner = here[(seam->edge % 3 + i) % 3];
        sp_atlas_across(atlas, mesh, seam, corner, at[i]);
        sp_atlas_across(atlas, mesh, &back, at[i], again);
        assert_true(hypot(again[0] - corner[0], again[1] - corner[1]) < 1e-6);
        if (i < 2)
            assert_true(hypot(at[i][0] - expected[i][0], at[i][1] - expected[i][1]) < 1e-6);
    }
    const double *beyond[2] = {at[2], other};
    for (int i = 0; i < 2; i++)
        side[i] = (at[1][0] - at[0][0]) * (beyond[i][1] - at[0][1]) - (at[1][1] - at[0][1]) * (beyond[i][0] - at[0][0]);
    assert_true(side[0] * side[1] < 0);
}

/* Every length of every edge whose sides lie apart on the pages, but where both sides lie in one texel. */
static void expect_seams(const sp_atlas *atlas, const sp_texel_links *links, const sp_mesh *mesh)
{
    double sum = 0, cut = 0, sampled = 0;
    bool lips = false; /* of a cut inside a chart, which may share a texel at its end */
    for (size_t i = 0; i < atlas->seam_count; i++) {
        const sp_seam *seam = &atlas->seams[i];
        assert_true(seam->length > 0 && seam->texel != seam->other);
        assert_true(i == 0 || seam[-1].texel < seam->texel ||
                    (seam[-1].texel == seam->texel && seam[-1].other < seam->other));
        assert_true(are_neighbours(links, seam->texel, seam->other));
        expect_across(atlas, mesh, seam);
        size_t count, found = 0;
        const sp_seam *back = sp_atlas_seams(atlas, seam->other, &count);
        for (size_t k = 0; k < count; k++)
            found += back[k].other == seam->texel && back[k].length == seam->length && back[k].edge == seam->across &&
                     back[k].across == seam->edge;
        assert_int_equal(found, 1);
        sum += 0.5 * seam->length;
    }
    sp_half_edges edges = {0};
    assert_true(sp_half_edges_create(mesh, &edges, NULL));
    for (uint32_t a = 0; a < 3 * mesh->triangle_count; a++) {
        uint32_t b = edges.opposite[a];
        if (b == SP_NONE || b < a)
            continue;
        const double *p = atlas->uv[a / 3][a % 3], *q = atlas->uv[b / 3][(b % 3 + 1) % 3];
        const double *r = atlas->uv[a / 3][(a % 3 + 1) % 3], *s = atlas->uv[b / 3][b % 3];
        if (atlas->chart[a / 3] == atlas->chart[b / 3] && hypot(p[0] - q[0], p[1] - q[1]) < 1e-5 &&
            hypot(r[0] - s[0], r[1] - s[1]) < 1e-5)
            continue;
        lips = lips || atlas->chart[a / 3] == atlas->chart[b / 3];
        double length =
            sp_distance(mesh->vertices[sp_half_edge_from(mesh, a)], mesh->vertices[sp_half_edge_to(mesh, a)]);
        enum { SAMPLES = 64 };
        for (int i = 0; i < SAMPLES; i++) {
            double t = (i + 0.5) / SAMPLES, at_a[2], at_b[2];
            sp_edge_weights(a, t, &at_a[0], &at_a[1]);
            sp_edge_weights(b, 1 - t, &at_b[0], &at_b[1]);
            uint32_t one = sp_atlas_texel(atlas, a / 3, at_a[0], at_a[1]),
                     other = sp_atlas_texel(atlas, b / 3, at_b[0], at_b[1]);
            sampled += one == other ? length / SAMPLES : 0;
        }
        cut += length;
    }
    sp_half_edges_destroy(&edges);
    assert_true(fabs(sum + sampled - cut) <= (lips ? 0.02 : 1e-6) * cut);
    assert_true(lips || sampled == 0);
}

/* How many pieces the texels fall into. */
static size_t count_pieces(const sp_atlas *atlas, const sp_texel_links *links)
{
    uint8_t *seen = calloc(atlas->texel_count, 1);
    uint32_t *queue = malloc(atlas->texel_count * sizeof *queue);
    size_t pieces = 0;
    for (uint32_t start = 0; start < atlas->texel_count; start++) {
        if (seen[start])
            continue;
        size_t count = 0;
        queue[count++] = start;
        seen[start] = 1;
        pieces++;
        while (count) {
            uint32_t at = queue[--count];
            for (uint32_t n = links->start[at]; n < links->start[at + 1]; n++)
                if (!seen[links->items[n]]) {
                    seen[links->items[n]] = 1;
                    queue[count++] = links->items[n];
                }
        }
    }
    free(seen);
    free(queue);
    return pieces;
}

/* Each fragment's polygon has the fragment's area and lies on the surface of its triangle. */
static void expect_polygons(const sp_atlas *atlas, const sp_fragments *fragments, const sp_mesh *mesh)
{
    for (uint32_t i = 0; i < atlas->texel_count; i++)
        for (uint32_t f = fragments->start[i]; f < fragments->start[i + 1]; f++) {
            sp_vec3 polygon[SP_FRAGMENT_POINTS], twice = {0, 0, 0};
            uint32_t t = fragments->items[f].triangle;
            int count = sp_atlas_fragment_polygon(atlas, mesh, i, t, polygon);
            double whole = sp_triangle_area(mesh, t);
            for (int k = 2; k < count; k++)
                twice = sp_add(twice, sp_cross(sp_sub(polygon[k - 1], polygon[0]), sp_sub(polygon[k], polygon[0])));
            double round_off = 1e-8 * whole + 1e-14 * sqrt(whole) * atlas->texel;
            assert_true(fabs(0.5 * sp_length(twice) - fragments->items[f].area) <= round_off);
            assert_true(sp_dot(twice, sp_triangle_normal(mesh, t)) >= 0);
        }
}

/* No texel has triangles of two faces that meet at a right angle. */
static void expect_one_face(const sp_fragments *fragments, size_t texel_count, const sp_mesh *mesh)
{
    for (size_t texel = 0; texel < texel_count; texel++) {
        sp_vec3 first = sp_triangle_normal(mesh, fragments->items[fragments->start[texel]].triangle);
        for (uint32_t f = fragments->start[texel]; f < fragments->start[texel + 1]; f++)
            assert_true(sp_dot(first, sp_triangle_normal(mesh, fragments->items[f].triangle)) > 0.5);
    }
}

static void faces_of_a_box_share_no_texel(void **state)
{
    (void)state;
    sp_mesh *mesh = box(1, 2, 3);
    for (int k = 0; k < 20; k++) {
        sp_atlas *atlas = atlas_of(mesh, 0.09 + 0.013 * k, 0);
        sp_fragments fragments = fragments_of(atlas, mesh);
        assert_true(atlas->chart_count < 6);
        assert_true(atlas->texel_count > atlas->pixel_count);
        expect_one_face(&fragments, atlas->texel_count, mesh);
        sp_fragments_destroy(&fragments);
        sp_atlas_destroy(atlas);
    }
    sp_mesh_destroy(mesh);
}

static void expect_sound(sp_mesh *mesh, double texel, uint32_t page_edge)
{
    sp_atlas *atlas = atlas_of(mesh, texel, page_edge);
    sp_fragments fragments = fragments_of(atlas, mesh);
    sp_texel_links links = links_of(atlas, mesh);
    expect_areas(atlas, &fragments, mesh);
    expect_order(atlas);
    expect_points_found(atlas, &fragments, 20000);
    expect_charts_apart(atlas);
    expect_neighbours_sound(atlas, &links);
    expect_seams(atlas, &links, mesh);
    expect_polygons(atlas, &fragments, mesh);
    assert_int_equal(figures_of(atlas, mesh).shared_texels, 0);
    sp_mesh_diagnosis diagnosis;
    assert_true(sp_mesh_diagnose(mesh, &diagnosis, NULL));
    if (diagnosis.shells == 1)
        assert_int_equal(count_pieces(atlas, &links), 1);
    sp_fragments_destroy(&fragments);
    sp_texel_links_destroy(&links);
    sp_atlas_destroy(atlas);
}

static void every_shape_at_every_texel(void **state)
{
    (void)state;
    sp_mesh *meshes[] = {one_triangle(1),
                         box(1, 2, 3),
                         net(64, 16, on_cylinder, 1),
                         net(48, 12, on_cone, 1),
                         net(40, 20, on_sphere, 1),
                         net(24, 24, on_saddle, 1)};
    for (int i = 0; i < 6; i++) {
        const double texels[] = {100, 0.5, 0.1, 0.0173};
        for (int k = 0; k < 4; k++)
            expect_sound(meshes[i], texels[k], 0);
        expect_sound(meshes[i], 0.05, 130); /* several pages */
        sp_mesh_destroy(meshes[i]);
    }
}

static void every_scale(void **state)
{
    (void)state;
    for (double size = 1e-6; size < 1e7; size *= 1e6) {
        sp_mesh *meshes[] = {box(size, 2 * size, 3 * size), net(40, 20, on_sphere, size)};
        for (int i = 0; i < 2; i++) {
            expect_sound(meshes[i], 0.03 * size, 0);
            sp_mesh_destroy(meshes[i]);
        }
    }
}

/* Large and very small triangles side by side: a corner cut into ever smaller triangles. */
static void triangles_of_all_sizes(void **state)
{
    (void)state;
    enum { COUNT = 40 };
    sp_vec3 vertices[2 * COUNT + 1];
    uint32_t triangles[2 * COUNT][3];
    double size = 1;
    for (uint32_t i = 0; i < COUNT; i++, size /= 2) {
        vertices[2 * i] = sp_v(size, 0, 0);
        vertices[2 * i + 1] = sp_v(0, size, 0);
        uint32_t next = 2 * i + 2;
        memcpy(triangles[2 * i], (uint32_t[]){2 * i, 2 * i + 1, next}, sizeof triangles[0]);
        memcpy(triangles[2 * i + 1], (uint32_t[]){next, 2 * i + 1, next + 1}, sizeof triangles[0]);
    }
    vertices[2 * COUNT] = sp_v(0, 0, 0);
    sp_mesh *mesh = mesh_of(vertices, 2 * COUNT + 1, (const uint32_t(*)[3])triangles, 2 * COUNT - 1);
    expect_sound(mesh, 0.01, 0);
    expect_sound(mesh, 10, 0);
    sp_mesh_destroy(mesh);
}

static void whole_texels_of_a_sheet_are_whole(void **state)
{
    (void)state;
    const sp_vec3 vertices[] = {{0, 0, 0}, {1, 0, 0}, {1, 0.5, 0}, {0, 0.5, 0}};
    sp_mesh *mesh = mesh_of(vertices, 4, (const uint32_t[][3]){{0, 1, 2}, {0, 2, 3}}, 2);
    sp_atlas *atlas = atlas_of(mesh, 0.1, 0);
    sp_texel_links links = links_of(atlas, mesh);
    assert_int_equal(atlas->texel_count, 50);
    for (size_t i = 0; i < atlas->texel_count; i++)
        assert_true(fabs(atlas->texel_area[i] - 0.01) < 1e-12);
    assert_int_equal(links.start[50], 2 * (9 * 5 + 10 * 4));
    assert_int_equal(atlas->seam_count, 0);
    sp_texel_links_destroy(&links);
    sp_atlas_destroy(atlas);
    sp_mesh_destroy(mesh);
}

/* A sheet slit from the top halfway down: the lips lie side by side but touch only below the slit. */
static void lips_of_a_cut_do_not_touch(void **state)
{
    (void)state;
    const double slit = 1 + 1e-9, right = 2.1; /* the slit runs through pixels, not between them */
    const sp_vec3 vertices[] = {{0, 0, 0},     {1, 0, 0}, {right, 0, 0}, {0, 1, 0},    {1, 1, 0},    {slit, 1, 0},
                                {right, 1, 0}, {0, 2, 0}, {1, 2, 0},     {slit, 2, 0}, {right, 2, 0}};
    const uint32_t triangles[][3] = {{0, 1, 4}, {0, 4, 3}, {1, 5, 4},  {1, 2, 6}, {1, 6, 5},
                                     {3, 4, 8}, {3, 8, 7}, {5, 6, 10}, {5, 10, 9}};
    sp_mesh *mesh = mesh_of(vertices, 11, triangles, 9);
    sp_atlas *atlas = atlas_of(mesh, 0.25, 0);
    sp_texel_links links = links_of(atlas, mesh);
    assert_int_equal(atlas->chart_count, 1);
    assert_int_equal(count_pieces(atlas, &links), 1);
    int above = 0, below = 0;
    for (double t = 0.25; t < 1; t += 0.25) {
        /* Left and right of x = 1 at height t and at height 1 + t, as points of triangles 0, 4, 5 and 8. */
        uint32_t left_below = sp_atlas_texel(atlas, 0, 1 - 0.1 - t, t),
                 right_below = sp_atlas_texel(atlas, 4, 0.1, t - 0.1);
        uint32_t left_above = sp_atlas_texel(atlas, 5, 0.9 - t, t),
                 right_above = sp_atlas_texel(atlas, 8, 0.1, t - 0.1);
        below += left_below == right_below || are_neighbours(&links, left_below, right_below);
        assert_true(left_above != right_above);
        above += are_neighbours(&links, left_above, right_above);
    }
    assert_int_equal(below, 3);
    assert_int_equal(above, 0);
    /* Both lips cross the same pixels, and each has a texel of its own there. */
    assert_true(atlas->texel_count >= atlas->pixel_count + 3);
    sp_fragments fragments = fragments_of(atlas, mesh);
    expect_areas(atlas, &fragments, mesh);
    expect_order(atlas);
    expect_points_found(atlas, &fragments, 20000);
    expect_polygons(atlas, &fragments, mesh);
    sp_fragments_destroy(&fragments);
    sp_texel_links_destroy(&links);
    sp_atlas_destroy(atlas);
    sp_mesh_destroy(mesh);
}

/* Two points close to each other across any edge of the mesh lie in texels that touch, or nearly so. */
static void seams_are_bridged(void **state)
{
    (void)state;
    sp_mesh *mesh = net(40, 20, on_sphere, 1);
    sp_atlas *atlas = atlas_of(mesh, 0.02, 0);
    sp_texel_links links = links_of(atlas, mesh);
    size_t edges = 0, direct = 0;
    uint64_t seed = 5;
    for (uint32_t a = 0; a < 3 * mesh->triangle_count; a++)
        for (uint32_t b = a + 1; b < 3 * mesh->triangle_count; b++) {
            const uint32_t *p = mesh->triangles[a / 3], *q = mesh->triangles[b / 3];
            if (p[a % 3] != q[(b % 3 + 1) % 3] || p[(a % 3 + 1) % 3] != q[b % 3])
                continue;
            double t = random_number(&seed), s = 1 - t;
            const double weights_a[3][2] = {{t, 0}, {1 - t, t}, {0, 1 - t}},
                         weights_b[3][2] = {{s, 0}, {1 - s, s}, {0, 1 - s}};
            uint32_t one = sp_atlas_texel(atlas, a / 3, weights_a[a % 3][0], weights_a[a % 3][1]);
            uint32_t other = sp_atlas_texel(atlas, b / 3, weights_b[b % 3][0], weights_b[b % 3][1]);
            edges++;
            direct += one == other || are_neighbours(&links, one, other);
        }
    assert_int_equal(edges, 3 * mesh->triangle_count / 2);
    assert_true(direct > 0.97 * edges);
    sp_texel_links_destroy(&links);
    sp_atlas_destroy(atlas);
    sp_mesh_destroy(mesh);
}

static bool same(const void *a, const void *b, size_t count, size_t size)
{
    return memcmp(a, b, count * size) == 0;
}

static void twice_gives_the_same_bytes(void **state)
{
    (void)state;
    sp_mesh *mesh = net(40, 20, on_sphere, 1);
    sp_atlas *a = atlas_of(mesh, 0.03, 0), *b = atlas_of(mesh, 0.03, 0);
    assert_true(a->texel_count == b->texel_count && a->chart_count == b->chart_count && a->page_edge == b->page_edge);
    assert_true(same(a->uv, b->uv, a->triangle_count, sizeof *a->uv));
    assert_true(same(a->texel_area, b->texel_area, a->texel_count, sizeof *a->texel_area));
    assert_true(a->run_count == b->run_count && a->seam_count == b->seam_count && a->shared_count == b->shared_count);
    assert_true(same(a->runs, b->runs, a->run_count, sizeof *a->runs));
    assert_true(same(a->shared, b->shared, a->shared_count, sizeof *a->shared));
    for (size_t i = 0; i < a->seam_count; i++)
        assert_true(a->seams[i].texel == b->seams[i].texel && a->seams[i].other == b->seams[i].other &&
                    a->seams[i].length == b->seams[i].length);
    sp_atlas_destroy(a);
    sp_atlas_destroy(b);
    sp_mesh_destroy(mesh);
}

static void refuses_what_does_not_fit(void **state)
{
    (void)state;
    sp_mesh *mesh = one_triangle(1), *other = box(1, 1, 1);
    sp_charts *charts = charts_of(mesh, INFINITY);
    sp_error error = {0};
    assert_null(sp_atlas_create(mesh, charts, &(sp_atlas_options){.texel = 0.01, .page_edge = 100}, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    error = (sp_error){0};
    assert_null(sp_atlas_create(mesh, charts, &(sp_atlas_options){.texel = 1e-300, .page_edge = 0}, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    const double texels[] = {0, -1, NAN, INFINITY};
    for (int i = 0; i < 4; i++) {
        error = (sp_error){0};
        assert_null(sp_atlas_create(mesh, charts, &(sp_atlas_options){.texel = texels[i], .page_edge = 0}, &error));
        assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    }
    error = (sp_error){0};
    assert_null(sp_atlas_create(other, charts, &(sp_atlas_options){.texel = 1, .page_edge = 0}, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    assert_null(sp_atlas_create(mesh, NULL, &(sp_atlas_options){.texel = 1, .page_edge = 0}, NULL));
    sp_atlas_destroy(NULL);
    sp_charts_destroy(charts);
    sp_mesh_destroy(mesh);
    sp_mesh_destroy(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_shape_at_every_texel),    cmocka_unit_test(every_scale),
        cmocka_unit_test(triangles_of_all_sizes),        cmocka_unit_test(whole_texels_of_a_sheet_are_whole),
        cmocka_unit_test(lips_of_a_cut_do_not_touch),    cmocka_unit_test(seams_are_bridged),
        cmocka_unit_test(twice_gives_the_same_bytes),    cmocka_unit_test(refuses_what_does_not_fit),
        cmocka_unit_test(faces_of_a_box_share_no_texel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
