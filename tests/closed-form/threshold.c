/* The criteria: flux, impact speed, incidence, and how several nozzles combine. */
#include "measure.h"

static const double height = 0.5;

static void open_floor(scene *s, double edge, sp_trajectory trajectory, double texel)
{
    rectangle floor = level_rectangle(edge, edge, 0);
    scene_open(s, mesh_of_rectangles(&floor, 1), trajectory, texel);
}

/* Below a nozzle at height h the flux is Q h / (Ω r³): at least q within r³ = Q h / (Ω q). */
static double flux_disc(double flow, double solid_angle, double flux)
{
    double r = cbrt(flow * height / (solid_angle * flux));
    return M_PI * (r * r - height * height);
}

static void flux_threshold(void **state)
{
    (void)state;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 110);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, height), sp_v(0, 0, -1), 0);
    double solid_angle = 2 * M_PI * (1 - cos(deg(55)));
    double flux = 0.5 * type.flow / (solid_angle * height * height); /* half of that right below */
    scene s;
    open_floor(&s, 1.6, SP_TRAJECTORY_LINE, 0.0075);
    s.setup.criterion.flux = flux;
    assert_covers("flux threshold", &s, &nozzle, 1, flux_disc(type.flow, solid_angle, flux), BY_BOTH);
    scene_close(&s);
}

/* Two nozzles at one place: their fluxes add up, or each has to do alone. */
static void combined_nozzles(void **state)
{
    (void)state;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 110);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, height), sp_v(0, 0, -1), 0), pair[2] = {nozzle, nozzle};
    double solid_angle = 2 * M_PI * (1 - cos(deg(55))), flux = 0.6 * type.flow / (solid_angle * height * height);
    scene s;
    open_floor(&s, 1.6, SP_TRAJECTORY_LINE, 0.0075);
    s.setup.criterion.flux = flux;
    assert_covers("two nozzles, sum", &s, pair, 2, flux_disc(2 * type.flow, solid_angle, flux), BY_BOTH);
    s.setup.criterion.combine = SP_COMBINE_SINGLE;
    assert_covers("two nozzles, single", &s, pair, 2, flux_disc(type.flow, solid_angle, flux), BY_BOTH);
    scene_close(&s);
}

static void steepest_incidence(void **state)
{
    (void)state;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 110);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, height), sp_v(0, 0, -1), 0);
    scene s;
    open_floor(&s, 1.6, SP_TRAJECTORY_LINE, 0.002);
    s.setup.criterion.incidence = deg(40);
    double radius = height * tan(deg(40));
    assert_covers("incidence at most 40 degrees", &s, &nozzle, 1, M_PI * radius * radius, BY_BOTH);
    scene_close(&s);
}

/* On a wall the impact speed is √(v² - 2 g z) at height z over the nozzle, so that a least speed draws a level line. A
 * narrow cone would not do: this one is wide and its near half alone is looked at. */
static void least_impact_speed(void **state)
{
    (void)state;
    const double v = 6, g = 9.81, distance = 0.5, line = 0.1234;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 170);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0, 0, 0), sp_v(1, 0, 0), v);
    rectangle wall = {sp_v(distance, -0.5, -0.4), sp_v(0, 0, 0.8), sp_v(0, 1, 0)}; /* all of it within reach */
    scene s;
    scene_open(&s, mesh_of_rectangles(&wall, 1), SP_TRAJECTORY_PARABOLA, 0.004);
    s.setup.criterion.impact_speed = sqrt(v * v - 2 * g * line);
    assert_covers("impact speed on a wall", &s, &nozzle, 1, 0.4 + line, BY_BOTH);
    scene_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flux_threshold),
        cmocka_unit_test(combined_nozzles),
        cmocka_unit_test(steepest_incidence),
        cmocka_unit_test(least_impact_speed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
