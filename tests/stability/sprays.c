/* Criteria that nothing or everything meets, no water, nozzles a nanometre off a wall and outside of the vessel, and
 * the edge of reach: the right answer by both evaluators. */
#include "stage.h"

static void open_room(scene *s, sp_trajectory trajectory, double texel)
{
    rectangle faces[6];
    box_rectangles(sp_v(-1, -0.8, 0), sp_v(2, 1.6, 1.5), faces);
    scene_open(s, mesh_of_rectangles(faces, 6), trajectory, texel);
    s->setup.fidelity.texel = texel;
    s->setup.fidelity.jets = STAGE_JETS;
    s->setup.cavity = SP_CAVITY_POINT;
    s->setup.cavity_point = sp_v(0.1, 0.2, 0.8);
}

static void criteria_that_nothing_or_everything_meets(void **state)
{
    (void)state;
    static const sp_criterion nothing[] = {{1e6, 0, M_PI / 2, SP_COMBINE_SUM, 0},
                                           {1e300, 0, M_PI / 2, SP_COMBINE_SINGLE, 0},
                                           {0, 1e3, M_PI / 2, SP_COMBINE_SUM, 0},
                                           {0, 0, 1e-9, SP_COMBINE_SUM, 0}},
                              everything[] = {{0, 0, M_PI / 2, SP_COMBINE_SUM, 0},
                                              {1e-300, 1e-300, M_PI / 2, SP_COMBINE_SINGLE, 0},
                                              {1e-12, 1e-3, M_PI / 2, SP_COMBINE_SUM, 0}};
    sp_nozzle_type ball = spray_type(SP_PATTERN_FULL_CONE, 360);
    sp_nozzle nozzle = nozzle_at(&ball, sp_v(0.11, 0.03, 0.71), sp_v(0, 0, 1), 20);
    double off[2] = {0};
    for (int t = SP_TRAJECTORY_LINE; t <= SP_TRAJECTORY_PARABOLA; t++)
        for (int c = 0; c < 7; c++) {
            scene s;
            open_room(&s, (sp_trajectory)t, 0.1);
            s.setup.fidelity.jets = 400000;
            s.setup.criterion = c < 4 ? nothing[c] : everything[c - 4];
            sp_evaluator *evaluator = scene_evaluator(&s);
            for (int inverse = 0; inverse < 2; inverse++) {
                sp_coverage *coverage = sound_cover(evaluator, &nozzle, 1, inverse);
                double expected = c < 4 ? 0 : 1;
                off[inverse] = fmax(off[inverse], fabs(coverage->fraction - expected));
                if (fabs(coverage->fraction - expected) > (inverse || c < 4 ? 1e-9 : 1e-3)) /* jets miss cells */
                    fail_msg("criterion %d, trajectory %d, inverse %d: coverage %.12f", c, t, inverse,
                             coverage->fraction);
                sp_coverage_destroy(coverage);
            }
            sp_evaluator_destroy(evaluator);
            scene_close(&s);
        }
    print_message("coverage off by at most %.2g by jets, %.2g by flights\n", off[0], off[1]);
}

/* A catalogue's flow is above 0; a program's may not be. */
static void no_water_covers_nothing(void **state)
{
    (void)state;
    sp_nozzle_type dry = spray_type(SP_PATTERN_FULL_CONE, 120);
    dry.flow = 0;
    sp_nozzle nozzle = nozzle_at(&dry, sp_v(0.11, 0.03, 0.71), sp_v(0, 0, 1), 20);
    scene s;
    open_room(&s, SP_TRAJECTORY_PARABOLA, 0.1);
    sp_evaluator *evaluator = scene_evaluator(&s);
    for (int count = 0; count < 2; count++)
        for (int inverse = 0; inverse < 2; inverse++) {
            sp_coverage *coverage = sound_cover(evaluator, &nozzle, (size_t)count, inverse);
            assert_true(coverage->fraction == 0 && coverage->flow == 0 && coverage->area_per_water == 0);
            sp_coverage_destroy(coverage);
        }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* Half of a ball's liquid goes into the wall it stands before, however near. */
static void a_nanometre_off_a_wall(void **state)
{
    (void)state;
    sp_nozzle_type ball = spray_type(SP_PATTERN_FULL_CONE, 360);
    for (int t = SP_TRAJECTORY_LINE; t <= SP_TRAJECTORY_PARABOLA; t++) {
        scene s;
        open_room(&s, (sp_trajectory)t, STAGE_TEXEL);
        sp_evaluator *evaluator = scene_evaluator(&s);
        for (double off = 1e-9; off < 1e-2; off *= 100) {
            sp_nozzle nozzle = nozzle_at(&ball, sp_v(-1 + off, 0.0523, 0.7123), sp_v(0, 0, 1), 20);
            double into[2];
            for (int inverse = 0; inverse < 2; inverse++) {
                sp_coverage *coverage = sound_cover(evaluator, &nozzle, 1, inverse);
                const sp_patches *patches = sp_evaluator_patches(evaluator);
                into[inverse] = 0;
                for (size_t i = 0; i < patches->count; i++)
                    into[inverse] += patches->point[i].x < -1 + 1e-9
                                         ? coverage->deposits.flux[i] * patches->area[i] / coverage->flow
                                         : 0;
                assert_true(fabs(share_landed(coverage) - 1) < (inverse ? 0.01 : 1e-9));
                sp_coverage_destroy(coverage);
            }
            print_message("%g m off a wall, trajectory %d: %.5f of the liquid into it by jets, %.5f by flights\n", off,
                          t, into[0], into[1]);
            assert_true(fabs(into[0] - 0.5) < 0.005 && fabs(into[1] - 0.5) < 0.005);
        }
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
}

/* What is sprayed at a vessel from outside cleans nothing in it. */
static void outside_of_the_vessel(void **state)
{
    (void)state;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 30);
    sp_error error = {0};
    scene s;
    open_room(&s, SP_TRAJECTORY_PARABOLA, 0.1);
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(-2, 0, 0.7), sp_v(1, 0, 0), 20);
    sp_layout *layout = sp_layout_create(&nozzle, 1, NULL);
    assert_false(sp_evaluator_admits(evaluator, &nozzle, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    error = (sp_error){0};
    for (int inverse = 0; inverse < 2; inverse++) {
        sp_coverage *coverage = sound_cover(evaluator, &nozzle, 1, inverse);
        assert_true(sp_evaluate_balance(evaluator, layout, coverage, &error));
        assert_true(coverage->fraction == 0);
        assert_true(fabs(coverage->balance.other / coverage->flow - 1) < 1e-9);
        sp_coverage_destroy(coverage);
    }
    sp_layout_destroy(layout);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* A ball's liquid on the floor between 0.9 and 1.1 of the radius that it reaches, v²/g √(1 + 2gh/v²): the densest of
 * all, by both evaluators the same but for what a texel there is worth. */
static void at_the_edge_of_reach(void **state)
{
    (void)state;
    const double v = 2.5, g = 9.81, h = 0.3, radius = v * v / g * sqrt(1 + 2 * g * h / (v * v));
    sp_nozzle_type ball = spray_type(SP_PATTERN_FULL_CONE, 360);
    rectangle floor = level_rectangle(2.2, 2.2, 0);
    for (double texel = STAGE_TEXEL; texel > 0.4 * STAGE_TEXEL; texel /= 2) {
        scene s;
        scene_open(&s, mesh_of_rectangles(&floor, 1), SP_TRAJECTORY_PARABOLA, 1);
        s.setup.fidelity.texel = texel;
        s.setup.fidelity.jets = 4 * STAGE_JETS;
        sp_evaluator *evaluator = scene_evaluator(&s);
        const sp_patches *patches = sp_evaluator_patches(evaluator);
        sp_nozzle nozzle = nozzle_at(&ball, sp_v(0.0123, -0.0071, h), sp_v(0, 0, 1), v);
        double liquid[2] = {0}, area[2];
        for (int inverse = 0; inverse < 2; inverse++) {
            sp_coverage *coverage = sound_cover(evaluator, &nozzle, 1, inverse);
            for (size_t i = 0; i < patches->count; i++) {
                double r = hypot(patches->point[i].x - 0.0123, patches->point[i].y + 0.0071) / radius;
                liquid[inverse] += r > 0.9 ? coverage->deposits.flux[i] * patches->area[i] / coverage->flow : 0;
            }
            area[inverse] = coverage->covered_area / (M_PI * radius * radius);
            sp_coverage_destroy(coverage);
        }
        print_message("texel %.3g mm: at the edge of reach %.5f of the liquid by jets, %.5f by flights; area %+.2f %% "
                      "and %+.2f %%\n",
                      1e3 * texel, liquid[0], liquid[1], 100 * (area[0] - 1), 100 * (area[1] - 1));
        assert_true(liquid[0] > 0.1 && fabs(liquid[1] - liquid[0]) < 0.02);
        /* half of the texels along the edge */
        assert_true(fabs(area[0] - 1) < texel / radius && fabs(area[1] - 1) < texel / radius);
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(criteria_that_nothing_or_everything_meets),
        cmocka_unit_test(no_water_covers_nothing),
        cmocka_unit_test(a_nanometre_off_a_wall),
        cmocka_unit_test(outside_of_the_vessel),
        cmocka_unit_test(at_the_edge_of_reach),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
