/* Obstacles: the shadow of a plate on a floor, and both evaluators patch by patch behind a box. */
#include "measure.h"

/* A level plate casts its own shape, larger by the ratio of the heights. */
static void plate_over_a_floor(void **state)
{
    (void)state;
    const double height = 1.2, plate = 0.25, over = 0.5;
    rectangle shapes[2] = {level_rectangle(2.4, 2.4, 0), level_rectangle(plate, plate, over)};
    shapes[1].corner = sp_add(shapes[1].corner, sp_v(0.11, -0.06, 0));
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 80);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, -0.007, height), sp_v(0, 0, -1), 0);
    double radius = height * tan(deg(40)), edge = plate * height / (height - over);
    scene s;
    scene_open(&s, mesh_of_rectangles(shapes, 2), SP_TRAJECTORY_LINE, 0.005);
    s.surfaces[1].clean = false;
    assert_covers("shadow of a plate", &s, &nozzle, 1, M_PI * radius * radius - edge * edge, BY_BOTH);
    scene_close(&s);
}

/* A texel that the forward evaluator's jets touch with a corner would count whole; a criterion of about half the flux
 * at the spray's edge takes such texels away, so that only the texels' own size is left between the evaluators. */
static void evaluators_agree_behind_a_box(void **state)
{
    (void)state;
    rectangle shapes[7] = {level_rectangle(3, 3, 0)};
    box_rectangles(sp_v(0.2, -0.3, 0), sp_v(0.4, 0.5, 0.3), shapes + 1);
    scene s;
    scene_open(&s, mesh_of_rectangles(shapes, 7), SP_TRAJECTORY_PARABOLA, 0.01);
    sp_nozzle_type types[3] = {spray_type(SP_PATTERN_FULL_CONE, 100), spray_type(SP_PATTERN_HOLLOW_CONE, 70),
                               spray_type(SP_PATTERN_FLAT_FAN, 90)};
    sp_nozzle nozzles[3] = {nozzle_at(&types[0], sp_v(-0.5, 0, 0.8), sp_v(0.4, 0, -1), 6),
                            nozzle_at(&types[1], sp_v(0.4, 0.9, 0.9), sp_v(0, -0.3, -1), 6),
                            nozzle_at(&types[2], sp_v(0.3, -0.1, 1), sp_v(0.2, 0.1, -1), 6)};
    s.setup.cavity = SP_CAVITY_OUTSIDE;
    s.setup.fidelity.jets = JETS / 4;
    const double edges[3] = {0.1, 0.75, 0.75}; /* 1/m²: about half the flux at the edge over the flow */
    for (int i = 0; i < 3; i++) {
        s.setup.criterion.flux = edges[i] * types[i].flow;
        sp_evaluator *evaluator = scene_evaluator(&s);
        const sp_patches *patches = sp_evaluator_patches(evaluator);
        sp_coverage *inverse = scene_cover(evaluator, &nozzles[i], 1, true);
        sp_coverage *forward = scene_cover(evaluator, &nozzles[i], 1, false);
        compare_with("behind a box, as forward", "inverse", inverse->covered_area, forward->covered_area,
                     0.025 * COARSER);
        double apart = 0, liquid = 0;
        for (size_t p = 0; p < patches->count; p++) {
            apart += inverse->deposits.covered[p] != forward->deposits.covered[p] ? patches->area[p] : 0;
            liquid += fabs(inverse->deposits.flux[p] - forward->deposits.flux[p]) * patches->area[p];
        }
        print_message("  nozzle %d: %.2f %% of the area and %.2f %% of the liquid apart\n", i,
                      100 * apart / forward->covered_area, 100 * liquid / forward->flow);
        assert_true(apart < 0.03 * COARSER * forward->covered_area);
        assert_true(liquid < 0.06 * COARSER * forward->flow);
        sp_coverage_destroy(inverse);
        sp_coverage_destroy(forward);
        sp_evaluator_destroy(evaluator);
    }
    scene_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plate_over_a_floor),
        cmocka_unit_test(evaluators_agree_behind_a_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
