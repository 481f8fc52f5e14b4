/* In a closed vessel all the liquid arrives, whatever the pattern and wherever the nozzle points. */
#include "measure.h"

#include <stdio.h>

#define COUNT 7

static sp_nozzle_type types[COUNT];
static sp_nozzle nozzles[COUNT];

static void make_nozzles(double speed)
{
    static const struct {
        sp_pattern pattern;
        double degrees;
    } kinds[COUNT] = {{SP_PATTERN_FULL_CONE, 360}, {SP_PATTERN_FULL_CONE, 75},   {SP_PATTERN_HOLLOW_CONE, 100},
                      {SP_PATTERN_FLAT_FAN, 80},   {SP_PATTERN_SOLID_STREAM, 1}, {SP_PATTERN_SOLID_STREAM, 1.5},
                      {SP_PATTERN_FLAT_FAN, 110}};
    for (int i = 0; i < COUNT; i++) {
        types[i] = spray_type(kinds[i].pattern, kinds[i].degrees);
        nozzles[i] = nozzle_at(&types[i], sp_v(0.1 * i - 0.3, 0.2 - 0.05 * i, 0.03 * i),
                               sp_v(0.3 * i - 1, 0.2, 0.5 - 0.2 * i), speed);
    }
    types[COUNT - 1].thickness = deg(1.5);
    types[2].hollow = 0.97;
}

static void assert_all_arrives(const char *vessel, scene *s, double bound)
{
    s->setup.fidelity.jets = 20000;
    s->setup.cavity = SP_CAVITY_POINT;
    sp_evaluator *evaluator = scene_evaluator(s);
    assert_true(fabs(sp_evaluator_patches(evaluator)->total_area / sp_mesh_area(s->mesh) - 1) < 1e-9);
    for (int i = 0; i < COUNT; i++) {
        char what[64];
        snprintf(what, sizeof what, "liquid in a %s, nozzle %d", vessel, i);
        for (int inverse = 0; inverse < 2; inverse++) {
            sp_coverage *coverage = scene_cover(evaluator, &nozzles[i], 1, inverse);
            compare_with(what, inverse ? "inverse" : "forward", coverage->flux_mean * coverage->area, coverage->flow,
                         inverse ? bound : 1e-9);
            sp_coverage_destroy(coverage);
        }
    }
    sp_evaluator_destroy(evaluator);
}

static void all_arrives_in_a_box(void **state)
{
    (void)state;
    rectangle faces[6];
    box_rectangles(sp_v(-0.9, -0.8, -0.7), sp_v(1.9, 1.7, 1.5), faces);
    scene s;
    scene_open(&s, mesh_of_rectangles(faces, 6), SP_TRAJECTORY_LINE, 0.02);
    make_nozzles(0);
    /* the error of streams much narrower than a texel grows faster than texels do */
    assert_all_arrives("box, lines", &s, COARSER > 1 ? 0.05 : 0.01);
    s.setup.fidelity.trajectory = SP_TRAJECTORY_PARABOLA;
    make_nozzles(6);
    assert_all_arrives("box, parabolas", &s, 0.01 * COARSER);
    scene_close(&s);
}

static void all_arrives_in_a_sphere(void **state)
{
    (void)state;
    scene s;
    scene_open(&s, mesh_of_sphere(1, 4), SP_TRAJECTORY_PARABOLA, 0.02);
    make_nozzles(6);
    assert_all_arrives("sphere, parabolas", &s, 0.01 * COARSER);
    scene_close(&s);
}

/* Column by column the same bytes. */
static void assert_same(const sp_deposits *a, const sp_deposits *b)
{
    const double *columns[2][9] = {{a->flux, a->counted, a->jets, a->speed, a->speed_max, a->incidence,
                                    a->incidence_min, a->impact, a->impact_max},
                                   {b->flux, b->counted, b->jets, b->speed, b->speed_max, b->incidence,
                                    b->incidence_min, b->impact, b->impact_max}};
    assert_int_equal(a->count, b->count);
    for (int i = 0; i < 9; i++)
        assert_memory_equal(columns[0][i], columns[1][i], a->count * sizeof(double));
    assert_memory_equal(a->covered, b->covered, a->count * sizeof(bool));
}

static void same_bytes_for_any_number_of_threads(void **state)
{
    (void)state;
    rectangle faces[6];
    box_rectangles(sp_v(-0.9, -0.8, -0.7), sp_v(1.9, 1.7, 1.5), faces);
    scene s;
    scene_open(&s, mesh_of_rectangles(faces, 6), SP_TRAJECTORY_PARABOLA, 0.03);
    make_nozzles(6);
    s.setup.fidelity.jets = 20000;
    s.setup.cavity = SP_CAVITY_POINT;
    sp_coverage *found[2][2];
    sp_reach *reaches[2];
    for (int i = 0; i < 2; i++) {
        s.setup.run.threads = i == 0 ? 1 : 5;
        sp_evaluator *evaluator = scene_evaluator(&s);
        for (int inverse = 0; inverse < 2; inverse++)
            found[i][inverse] = scene_cover(evaluator, nozzles, COUNT, inverse);
        reaches[i] =
            sp_evaluator_reach(evaluator, sp_v(0.1, 0.2, 0.1), (sp_launch){.speed = 6}, sp_v(0, 0, 1), 2.5, NULL);
        assert_non_null(reaches[i]);
        sp_evaluator_destroy(evaluator);
    }
    for (int inverse = 0; inverse < 2; inverse++) {
        assert_same(&found[0][inverse]->deposits, &found[1][inverse]->deposits);
        assert_true(found[0][inverse]->covered_area == found[1][inverse]->covered_area);
    }
    assert_int_equal(reaches[0]->count, reaches[1]->count);
    assert_true(reaches[0]->count > 1000);
    for (size_t i = 0; i < reaches[0]->count; i++) {
        const sp_arrival *a = &reaches[0]->arrivals[i], *b = &reaches[1]->arrivals[i];
        assert_true(a->patch == b->patch && a->passes == b->passes && a->transfer == b->transfer &&
                    a->speed == b->speed && sp_arrival_incidence(a) == sp_arrival_incidence(b) &&
                    sp_distance(a->direction, b->direction) == 0);
    }
    for (int i = 0; i < 2; i++) {
        sp_coverage_destroy(found[i][0]);
        sp_coverage_destroy(found[i][1]);
        sp_reach_destroy(reaches[i]);
    }
    scene_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_arrives_in_a_box),
        cmocka_unit_test(all_arrives_in_a_sphere),
        cmocka_unit_test(same_bytes_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
