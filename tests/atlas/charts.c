/* Unfolding: what is developable stays whole and keeps its lengths; nothing overlaps; cuts are where they must be. */
#include "shapes.h"

static void expect_isometric(const sp_mesh *mesh, const sp_charts *charts)
{
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        const double(*p)[2] = (const double(*)[2])charts->flat[t];
        double twice = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        assert_true(twice > 0);
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3;
            double length = sp_distance(mesh->vertices[mesh->triangles[t][i]], mesh->vertices[mesh->triangles[t][j]]);
            assert_true(fabs(hypot(p[j][0] - p[i][0], p[j][1] - p[i][1]) - length) <= 1e-10 * length);
        }
    }
}

/* Charts of a developable mesh, which is destroyed. */
static size_t count_charts(sp_mesh *mesh)
{
    sp_charts *charts = charts_of(mesh, INFINITY);
    expect_isometric(mesh, charts);
    size_t count = charts->chart_count;
    sp_charts_destroy(charts);
    sp_mesh_destroy(mesh);
    return count;
}

static void developable_surfaces_are_one_chart(void **state)
{
    (void)state;
    assert_int_equal(count_charts(one_triangle(1)), 1);
    assert_true(count_charts(box(1, 2, 3)) <= 2); /* the last side may not find room */
    assert_int_equal(count_charts(net(64, 16, on_cylinder, 1)), 1);
    assert_int_equal(count_charts(net(999, 3, on_cylinder, 1)), 1);
    assert_int_equal(count_charts(net(48, 12, on_cone, 1)), 1);
    for (double size = 1e-6; size < 1e7; size *= 1000) {
        assert_int_equal(count_charts(net(64, 16, on_cylinder, size)), 1);
        assert_int_equal(count_charts(net(48, 12, on_cone, size)), 1);
    }
}

static void a_cylinder_keeps_its_size(void **state)
{
    (void)state;
    sp_mesh *mesh = net(64, 16, on_cylinder, 1);
    sp_charts *charts = charts_of(mesh, INFINITY);
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 2; k++) {
                low[k] = fmin(low[k], charts->flat[t][i][k]);
                high[k] = fmax(high[k], charts->flat[t][i][k]);
            }
    /* Unrolled it is at least as long as its polygon is round and exactly as high, the seam running askew or straight.
     */
    double around = 64 * sin(M_PI / 64);
    assert_true((high[0] - low[0]) * (high[1] - low[1]) >= around * (1 - 1e-9));
    assert_true(fabs(high[1] - low[1] - 1) < 1e-9);
    sp_charts_destroy(charts);
    sp_mesh_destroy(mesh);
}

static void curved_surfaces_do_not_overlap(void **state)
{
    (void)state;
    sp_mesh *meshes[] = {net(40, 20, on_sphere, 1), net(24, 24, on_saddle, 1)};
    for (int i = 0; i < 2; i++) {
        sp_charts *charts = charts_of(meshes[i], INFINITY);
        assert_true(charts->chart_count > 1 && charts->chart_count <= 14);
        sp_charts_destroy(charts);
        sp_atlas *atlas = atlas_of(meshes[i], 0.05, 0);
        sp_atlas_figures figures = figures_of(atlas, meshes[i]);
        assert_int_equal(figures.overlaps, 0);
        assert_int_equal(figures.shared_texels, 0);
        assert_true(figures.strain95 <= 0.05);
        sp_atlas_destroy(atlas);
        sp_mesh_destroy(meshes[i]);
    }
}

/* Two triangles on a square and, in turn, what forbids to unfold one across the other's edge. */
static void cuts_at_edges_that_are_no_surface(void **state)
{
    (void)state;
    const sp_vec3 vertices[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
    assert_int_equal(count_charts(mesh_of(vertices, 4, (const uint32_t[][3]){{0, 1, 2}, {0, 2, 3}}, 2)), 1);
    assert_int_equal(count_charts(mesh_of(vertices, 4, (const uint32_t[][3]){{0, 1, 2}, {0, 3, 2}}, 2)), 2);
    assert_int_equal(count_charts(mesh_of(vertices, 5, (const uint32_t[][3]){{0, 1, 2}, {0, 2, 3}, {0, 2, 4}}, 3)), 3);
    assert_int_equal(count_charts(mesh_of(vertices, 4, (const uint32_t[][3]){{0, 1, 2}, {0, 1, 2}}, 2)), 2);
    const sp_vec3 apart[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}, {2, 1, 0}};
    assert_int_equal(count_charts(mesh_of(apart, 6, (const uint32_t[][3]){{0, 1, 2}, {3, 4, 5}}, 2)), 2);
}

static void no_chart_exceeds_the_extent(void **state)
{
    (void)state;
    sp_mesh *mesh = net(64, 32, on_cylinder, 1);
    for (double extent = 2; extent > 0.02; extent /= 2) {
        sp_charts *charts = charts_of(mesh, extent);
        double(*span)[4] = malloc(charts->chart_count * sizeof *span);
        size_t *size = calloc(charts->chart_count, sizeof *size);
        for (size_t c = 0; c < charts->chart_count; c++)
            memcpy(span[c], (double[]){INFINITY, INFINITY, -INFINITY, -INFINITY}, sizeof *span);
        for (size_t t = 0; t < mesh->triangle_count; t++) {
            double *s = span[charts->chart[t]];
            size[charts->chart[t]]++;
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 2; k++) {
                    s[k] = fmin(s[k], charts->flat[t][i][k]);
                    s[k + 2] = fmax(s[k + 2], charts->flat[t][i][k]);
                }
        }
        for (size_t c = 0; c < charts->chart_count; c++)
            assert_true(size[c] == 1 || fmax(span[c][2] - span[c][0], span[c][3] - span[c][1]) <= extent * (1 + 1e-12));
        free(span);
        free(size);
        sp_charts_destroy(charts);
    }
    sp_mesh_destroy(mesh);
}

static void a_fan_of_needles_stays_whole(void **state)
{
    (void)state;
    enum { COUNT = 2000 };
    sp_vec3 *vertices = malloc((COUNT + 1) * sizeof *vertices);
    uint32_t(*triangles)[3] = malloc(COUNT * sizeof *triangles);
    vertices[COUNT] = sp_v(0, 0, 0);
    for (uint32_t i = 0; i < COUNT; i++) {
        vertices[i] = on_circle(1, (double)i / COUNT, 0);
        memcpy(triangles[i], (uint32_t[]){COUNT, i, (i + 1) % COUNT}, sizeof *triangles);
    }
    assert_int_equal(count_charts(mesh_of(vertices, COUNT + 1, (const uint32_t(*)[3])triangles, COUNT)), 1);
    free(vertices);
    free(triangles);
}

static void refuses_what_makes_no_sense(void **state)
{
    (void)state;
    sp_mesh *mesh = one_triangle(1);
    const double extents[] = {0, -1, NAN};
    for (int i = 0; i < 3; i++) {
        sp_error error = {0};
        assert_null(sp_charts_create(mesh, extents[i], &error));
        assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    }
    assert_null(sp_charts_create(NULL, 1, NULL));
    sp_charts_destroy(NULL);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(developable_surfaces_are_one_chart), cmocka_unit_test(a_cylinder_keeps_its_size),
        cmocka_unit_test(curved_surfaces_do_not_overlap),     cmocka_unit_test(cuts_at_edges_that_are_no_surface),
        cmocka_unit_test(no_chart_exceeds_the_extent),        cmocka_unit_test(a_fan_of_needles_stays_whole),
        cmocka_unit_test(refuses_what_makes_no_sense),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
