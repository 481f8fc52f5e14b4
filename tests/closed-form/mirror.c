/* Reflections, which the forward evaluator alone knows: an upward cone under a ceiling that is not to be cleaned. */
#include "measure.h"

static const double above = 0.4, below = 0.8, a = 30 * M_PI / 180;

/* The nozzle is at the origin. */
static void assert_from_ceiling(const char *what, double restitution, sp_trajectory trajectory, double speed,
                                double radius)
{
    rectangle room[2] = {level_rectangle(4, 4, -below), level_rectangle(4, 4, above)};
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 60);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, 0), sp_v(0, 0, 1), speed);
    scene s;
    scene_open(&s, mesh_of_rectangles(room, 2), trajectory, radius / 180);
    s.surfaces[1].clean = false;
    s.surfaces[1].restitution = restitution;
    s.setup.fidelity.reflections = 1;
    assert_covers(what, &s, &nozzle, 1, M_PI * radius * radius, BY_FORWARD);
    scene_close(&s);
}

/* As from the mirror image of the nozzle. */
static void mirror_ceiling(void **state)
{
    (void)state;
    assert_from_ceiling("mirror ceiling", 1, SP_TRAJECTORY_LINE, 0, (2 * above + below) * tan(a));
}

/* The normal speed goes down to e times itself, so that the way down takes longer. */
static void dull_ceiling(void **state)
{
    (void)state;
    assert_from_ceiling("ceiling of restitution 0.6", 0.6, SP_TRAJECTORY_LINE, 0,
                        (above + (above + below) / 0.6) * tan(a));
}

static void mirror_ceiling_of_parabolas(void **state)
{
    (void)state;
    const double v = 6, g = 9.81, rise = v * cos(a);
    double hit = sqrt(rise * rise - 2 * g * above),
           up = (rise - hit) / g; /* vertical speed at the ceiling, time to it */
    double fall = (sqrt(hit * hit + 2 * g * (above + below)) - hit) / g;
    assert_from_ceiling("mirror ceiling, parabolas", 1, SP_TRAJECTORY_PARABOLA, v, v * sin(a) * (up + fall));
}

/* The rebound is what flies on: the floor gets that share of the liquid, the ceiling all of it. */
static void rebound_shares_the_liquid(void **state)
{
    (void)state;
    rectangle room[2] = {level_rectangle(4, 4, -below), level_rectangle(4, 4, above)};
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 60);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, 0), sp_v(0, 0, 1), 0);
    nozzle.jets = 50000;
    scene s;
    scene_open(&s, mesh_of_rectangles(room, 2), SP_TRAJECTORY_LINE, 0.02);
    s.surfaces[1] = (sp_surface){.clean = true, .restitution = 1, .rebound = 0.7};
    s.setup.fidelity.reflections = 1;
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, false);
    compare_with("liquid on ceiling and floor", "forward", coverage->flux_mean * coverage->area, 1.7 * coverage->flow,
                 1e-9);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mirror_ceiling),
        cmocka_unit_test(dull_ceiling),
        cmocka_unit_test(mirror_ceiling_of_parabolas),
        cmocka_unit_test(rebound_shares_the_liquid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
