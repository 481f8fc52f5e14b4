/* How far it is around what charts lie on, against closed forms. */
#include "shapes.h"

/* Every chart of a mesh has that girth, within a share. */
static void expect_girth(sp_mesh *mesh, double extent, double expected, double within)
{
    sp_error error = {0};
    sp_charts *charts = charts_of(mesh, extent);
    double *girth = sp_charts_girth(charts, mesh, &error);
    assert_non_null(girth);
    for (size_t c = 0; c < charts->chart_count; c++)
        if (!(fabs(girth[c] / expected - 1) <= within))
            fail_msg("chart %zu of %zu: %g m around, not %g m", c, charts->chart_count, girth[c], expected);
    free(girth);
    sp_charts_destroy(charts);
    sp_mesh_destroy(mesh);
}

static sp_vec3 on_rod(double s, double t, double size)
{
    return on_circle(0.5 * size, s, 40 * size * t);
}

static sp_vec3 on_tube_ring(double s, double t, double size)
{
    double turn = t == 1 ? 0 : 2 * M_PI * t;
    sp_vec3 ring = on_circle(size * (1 + 0.05 * cos(turn)), s, 0);
    ring.z = 0.05 * size * sin(turn);
    return ring;
}

static sp_vec3 on_wavy_sheet(double s, double t, double size)
{
    return sp_v(size * s, size * t, 0.01 * size * cos(8 * M_PI * s));
}

static void rods_whole_and_in_pieces(void **state)
{
    (void)state;
    const double scales[] = {1e-3, 1, 1e3};
    for (int i = 0; i < 3; i++)
        for (int columns = 4; columns <= 64; columns *= 2) {
            double around = scales[i] * columns * sin(M_PI / columns);
            expect_girth(net(columns, 10, on_rod, scales[i]), INFINITY, around, 1e-6);
            expect_girth(net(columns, 40, on_rod, scales[i]), 2.5 * scales[i], around, 0.35);
        }
}

static void boxes_balls_and_rings(void **state)
{
    (void)state;
    expect_girth(box(1, 1, 1), INFINITY, 4, 0.34);
    expect_girth(box(0.003, 0.003, 1), INFINITY, 0.012, 0.02);
    expect_girth(net(80, 40, on_sphere, 1), INFINITY, 2 * M_PI, 0.1);
    expect_girth(net(200, 24, on_tube_ring, 1), INFINITY, 0.1 * M_PI, 0.15);
}

/* Sheets are not thin, whether flat, bent or wavy, however often their bends come back. */
static void sheets_have_none(void **state)
{
    (void)state;
    sp_mesh *meshes[] = {net(6, 5, on_washer, 1), net(160, 10, on_wavy_sheet, 1), one_triangle(1)};
    for (int i = 0; i < 3; i++) {
        sp_error error = {0};
        sp_charts *charts = charts_of(meshes[i], INFINITY);
        double *girth = sp_charts_girth(charts, meshes[i], &error);
        for (size_t c = 0; c < charts->chart_count; c++)
            assert_true(girth[c] > 20);
        free(girth);
        sp_charts_destroy(charts);
        sp_mesh_destroy(meshes[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rods_whole_and_in_pieces),
        cmocka_unit_test(boxes_balls_and_rings),
        cmocka_unit_test(sheets_have_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
