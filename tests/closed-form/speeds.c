/* Measured nozzles whose liquid leaves at several speeds: where it lands, and which of it is fast enough. */
#include "measure.h"

#include <stdlib.h>

enum { COLUMNS = 360, ROWS = 60 };

/* Of the exit speed, at an azimuth (rad). */
typedef double speed_at(double azimuth);

static double slow(double azimuth)
{
    (void)azimuth;
    return 0.6;
}
static double slower_one_side(double azimuth)
{
    return 0.8 + 0.2 * cos(azimuth);
}
static double half_as_fast(double azimuth)
{
    return azimuth < M_PI ? 1 : 0.5;
}

/* As a catalogue with such an image has it: as much liquid everywhere; the caller gives the members back. */
static sp_nozzle_type measured(speed_at *speed, double degrees)
{
    float values[COLUMNS * ROWS], speeds[COLUMNS * ROWS];
    sp_speed_layer layers[SP_SPEEDS];
    sp_error error = {0};
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        values[i] = 1;
        speeds[i] = (float)speed(2 * M_PI * (i % COLUMNS + 0.5) / COLUMNS);
    }
    sp_nozzle_type type = spray_type(SP_PATTERN_CLUSTER, 0), layer = spray_type(SP_PATTERN_MEASURED, degrees);
    type.member_count = sp_patternation_layers(values, speeds, COLUMNS, ROWS, deg(degrees), layers, &error);
    assert_no_error(&error);
    type.members = calloc(SP_SPEEDS, sizeof *type.members);
    assert_non_null(type.members);
    for (size_t k = 0; k < type.member_count; k++) {
        layer.patternation = layers[k].patternation;
        type.members[k] = (sp_member){layer, {0, 0, 0}, {0, 0, 1}, 0, layers[k].share, layers[k].speed};
    }
    return type;
}

static void forget(sp_nozzle_type *type)
{
    for (size_t k = 0; k < type->member_count; k++)
        sp_patternation_destroy((sp_patternation *)type->members[k].type.patternation);
    free(type->members);
}

/* A level beam falls h on its way: its liquid lands at s v √(2h/g) of its own part s of the exit speed, on average at
 * the mean of s times that. */
static void assert_lands(const char *what, speed_at *speed, double mean_speed)
{
    const double height = 1;
    const rectangle floor = level_rectangle(12, 1, -height);
    scene s;
    scene_open(&s, mesh_of_rectangles(&floor, 1), SP_TRAJECTORY_PARABOLA, 0.04);
    sp_nozzle_type type = measured(speed, 2);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(-5.5, 0, 0), sp_v(1, 0, 0), 0);
    nozzle.jets = JETS / 4;
    nozzle.roll = 0; /* what leaves upwards is as fast as what leaves downwards */
    sp_evaluator *evaluator = scene_evaluator(&s);
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    double expected = mean_speed * sp_nozzle_speed(&nozzle, &s.setup.liquid) * sqrt(2 * height / s.setup.gravity);
    for (int inverse = 0; inverse < 2; inverse++) {
        sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, inverse);
        double liquid = 0, carried = 0;
        for (size_t i = 0; i < patches->count; i++) {
            double brings = coverage->deposits.flux[i] * patches->area[i];
            liquid += brings;
            carried += brings * (patches->point[i].x - nozzle.position.x);
        }
        compare_with(what, inverse ? "inverse" : "forward", carried / liquid, expected, 0.002 * COARSER);
        compare_with("liquid on the floor", inverse ? "inverse" : "forward", liquid,
                     sp_nozzle_flow(&nozzle, &s.setup.liquid), 0.01 * COARSER);
        sp_coverage_destroy(coverage);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
    forget(&type);
}

static void beams_land_by_their_speeds(void **state)
{
    (void)state;
    assert_lands("beam at .6 of its speed", slow, 0.6);
    assert_lands("beam at .6 to 1", slower_one_side, 0.8);
}

/* Of a cone straight down the half that is fast enough covers half of its disc: between the columns where that ends its
 * liquid goes from all to none, and about half of all is asked for. */
static void half_a_cone_is_fast_enough(void **state)
{
    (void)state;
    const double height = 0.5, rim = height * tan(deg(30));
    const rectangle floor = level_rectangle(1, 1, -height);
    scene s;
    scene_open(&s, mesh_of_rectangles(&floor, 1), SP_TRAJECTORY_LINE, 0.01);
    sp_nozzle_type type = measured(half_as_fast, 60);
    sp_nozzle nozzle = nozzle_at(&type, sp_v(0.013, 0.007, 0), sp_v(0, 0, -1), 0);
    s.setup.criterion.flux =
        0.4 * sp_nozzle_flow(&nozzle, &s.setup.liquid) / (2 * M_PI * (1 - cos(deg(30))) * height * height);
    s.setup.criterion.impact_speed = 0.75 * sp_nozzle_speed(&nozzle, &s.setup.liquid);
    assert_covers("half of a disc", &s, &nozzle, 1, 0.5 * M_PI * rim * rim, BY_BOTH);
    scene_close(&s);
    forget(&type);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beams_land_by_their_speeds),
        cmocka_unit_test(half_a_cone_is_fast_enough),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
