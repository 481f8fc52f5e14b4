/* Flat fans: a patch of the sphere projected on a plane. */
#include "measure.h"

/* On the plane at distance h, longitude atan(x/h) is within a and latitude asin(y/r) within b: x within X = h tan(a)
 * and y within tan(b) √(x² + h²), so the area is 2 tan(b) (X √(X² + h²) + h² asinh(X/h)). */
static double fan_area(double h, double a, double b)
{
    double x = h * tan(a);
    return 2 * tan(b) * (x * sqrt(x * x + h * h) + h * h * asinh(x / h));
}

static void assert_fan(const char *what, double degrees, double thickness, double texel, int methods)
{
    const double h = 0.8;
    sp_nozzle_type type = spray_type(SP_PATTERN_FLAT_FAN, degrees);
    type.thickness = deg(thickness);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, h), sp_v(0, 0, -1), 0);
    scene s;
    rectangle floor = level_rectangle(2.2, 2.2, 0);
    scene_open(&s, mesh_of_rectangles(&floor, 1), SP_TRAJECTORY_LINE, texel);
    assert_covers(what, &s, &nozzle, 1, fan_area(h, deg(degrees / 2), deg(thickness / 2)), methods);
    scene_close(&s);
}

static void thick_fan_on_a_plane(void **state)
{
    (void)state;
    assert_fan("fan of 70 by 30 degrees", 70, 30, 0.003, BY_BOTH);
}

/* Only the inverse evaluator: counting every texel that a jet touches widens so thin a strip by more than the bound. */
static void thin_fan_on_a_plane(void **state)
{
    (void)state;
    assert_fan("fan of 90 by 4 degrees", 90, 4, 0.003, BY_INVERSE);
}

/* A fan thinner than a texel must not fall between the texels' points: all its liquid arrives, and it covers what it is
 * as large as. Jets are too few to tell its edges as well. */
static void fan_thinner_than_a_texel(void **state)
{
    (void)state;
    const double h = 0.8, texel = 0.02;
    sp_nozzle_type type = spray_type(SP_PATTERN_FLAT_FAN, 70);
    type.thickness = deg(0.5);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, h), sp_v(0, 0, -1), 0);
    scene s;
    rectangle floor = level_rectangle(2.2, 2.2, 0);
    scene_open(&s, mesh_of_rectangles(&floor, 1), SP_TRAJECTORY_LINE, texel / COARSER);
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_coverage *inverse = scene_cover(evaluator, &nozzle, 1, true),
                *forward = scene_cover(evaluator, &nozzle, 1, false);
    compare_with("thin fan's liquid", "inverse", inverse->flux_mean * inverse->area, inverse->flow, 0.005);
    compare_with("thin fan's liquid", "forward", forward->flux_mean * forward->area, forward->flow, 1e-9);
    /* flat below the fan's middle: half a thickness times h² ∫ sec³ either side of it */
    double end = deg(35), area = type.thickness * h * h * (tan(end) / cos(end) + log(tan(end) + 1 / cos(end)));
    compare_with("thin fan's area", "inverse", inverse->covered_area, area, 0.01);
    compare_with("thin fan's area", "forward", forward->covered_area, area, 0.15 * sqrt(COARSER));
    sp_coverage_destroy(inverse);
    sp_coverage_destroy(forward);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* As lines a thin fan's flights are one arc a patch, as parabolas two: lines are never the dearer, but for the few
 * patches more that a straight fan may cross. Counted are the flights that arrive in an empty room, where none is
 * blocked. */
static void thin_fan_of_lines_is_not_dearer(void **state)
{
    (void)state;
    rectangle faces[6];
    box_rectangles(sp_v(-1, -0.8, 0), sp_v(2, 1.6, 1.5), faces);
    sp_nozzle_type type = spray_type(SP_PATTERN_FLAT_FAN, 90);
    type.thickness = deg(1);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.13, -0.47, 1.11), sp_v(0.1, 0.9, -0.5), 6);
    double flights[2] = {0};
    for (int parabolas = 0; parabolas < 2; parabolas++) {
        scene s;
        scene_open(&s, mesh_of_rectangles(faces, 6), parabolas ? SP_TRAJECTORY_PARABOLA : SP_TRAJECTORY_LINE, 0.01);
        s.setup.cavity = SP_CAVITY_POINT;
        s.setup.cavity_point = sp_v(0.6, -0.4, 1.2);
        sp_evaluator *evaluator = scene_evaluator(&s);
        sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
        for (size_t i = 0; i < coverage->deposits.count; i++)
            flights[parabolas] += coverage->deposits.jets[i];
        sp_coverage_destroy(coverage);
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
    print_message("flights of a thin fan: %.0f as lines, %.0f as parabolas\n", flights[0], flights[1]);
    assert_true(flights[0] > 0 && flights[0] <= 1.02 * flights[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thick_fan_on_a_plane),
        cmocka_unit_test(thin_fan_on_a_plane),
        cmocka_unit_test(fan_thinner_than_a_texel),
        cmocka_unit_test(thin_fan_of_lines_is_not_dearer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
