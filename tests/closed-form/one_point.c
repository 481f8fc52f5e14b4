/* Patterns that leave one point: members of a cluster, and layers of an image by speed, whose edges coincide or abut
 * together cover what one cone does, whose disc on a plate is known. */
#include "measure.h"

#include <string.h>

#define HEIGHT 1.0
#define ROWS 180

typedef struct {
    const char *name;
    sp_nozzle_type type;
    sp_member *members; /* NULL: it is one cone */
    sp_speed_layer layers[SP_SPEEDS];
    size_t layer_count;
} spray;

static spray cone(void)
{
    return (spray){.name = "cone", .type = spray_type(SP_PATTERN_FULL_CONE, 90)};
}

static spray cluster(const char *name, size_t count)
{
    spray s = {.name = name, .type = spray_type(SP_PATTERN_CLUSTER, 0), .members = calloc(count, sizeof *s.members)};
    assert_non_null(s.members);
    s.type.members = s.members;
    s.type.member_count = count;
    for (size_t i = 0; i < count; i++)
        s.members[i] = (sp_member){.axis = {0, 0, 1}, .share = 1};
    return s;
}

/* Of a full cone and a ring out to 45 deg from the axis. */
static spray cone_and_ring(const char *name, double degrees, double hollow)
{
    spray s = cluster(name, 2);
    s.members[0].type = spray_type(SP_PATTERN_FULL_CONE, degrees);
    s.members[1].type = spray_type(SP_PATTERN_HOLLOW_CONE, 90);
    s.members[1].type.hollow = hollow;
    return s;
}

/* The full cone as an image whose liquid has this speed at a polar angle (deg). */
static spray image(const char *name, double (*speed)(double))
{
    float even[ROWS], speeds[ROWS];
    sp_error error = {0};
    spray s = {.name = name};
    for (size_t j = 0; j < ROWS; j++) {
        even[j] = 1;
        speeds[j] = (float)speed(45 * ((double)j + 0.5) / ROWS);
    }
    size_t count = sp_patternation_layers(even, speeds, 1, ROWS, deg(90), s.layers, &error);
    assert_no_error(&error);
    assert_true(count > 1);
    sp_speed_layer layers[SP_SPEEDS];
    memcpy(layers, s.layers, sizeof layers);
    s = cluster(name, count);
    memcpy(s.layers, layers, sizeof layers);
    s.layer_count = count;
    for (size_t i = 0; i < count; i++) {
        s.members[i].type = spray_type(SP_PATTERN_MEASURED, 90);
        s.members[i].type.patternation = layers[i].patternation;
        s.members[i].share = layers[i].share;
        s.members[i].speed = layers[i].speed;
    }
    return s;
}

static double two_speeds(double polar)
{
    return polar < 30 ? 1 : 0.7;
}

static double ever_slower(double polar)
{
    return 1 - 0.4 * polar / 45;
}

static void forget(spray *s)
{
    for (size_t i = 0; i < s->layer_count; i++)
        sp_patternation_destroy(s->layers[i].patternation);
    free(s->members);
}

/* m², of a plate that a spray hits straight from a height. */
static double covered_from(const spray *s, double height, double texel, sp_trajectory trajectory, bool inverse)
{
    rectangle plate = level_rectangle(3, 3, 0);
    scene scene;
    scene_open(&scene, mesh_of_rectangles(&plate, 1), trajectory, texel);
    sp_evaluator *evaluator = scene_evaluator(&scene);
    sp_nozzle nozzle = nozzle_at(&s->type, sp_v(0.013, -0.007, height), sp_v(0, 0, -1), 0);
    sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, inverse);
    double area = coverage->covered_area;
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    scene_close(&scene);
    return area;
}

enum { SPRAYS = 6 };

static void make(spray sprays[SPRAYS])
{
    sprays[0] = cone();
    sprays[1] = cone_and_ring("edges coincide", 90, 0.6);
    sprays[2] = cone_and_ring("edges abut", 60, 60.0 / 90);
    sprays[3] = cone_and_ring("rings overlap", 70, 50.0 / 90);
    sprays[4] = image("two speeds", two_speeds);
    sprays[5] = image("ever slower", ever_slower);
}

static void together_they_are_a_cone(void **state)
{
    (void)state;
    static const double texels[] = {0.05, 0.025, 0.0125};
    spray sprays[SPRAYS];
    make(sprays);
    for (size_t i = 0; i < SPRAYS; i++) {
        for (size_t t = 0; t < 3; t++) {
            double found = covered_from(&sprays[i], HEIGHT, texels[t] / COARSER, SP_TRAJECTORY_LINE, true);
            print_message("%g mm: ", 1e3 * texels[t]);
            compare_with(sprays[i].name, "inverse", found, M_PI * HEIGHT * HEIGHT, 0.002);
        }
        forget(&sprays[i]);
    }
}

/* Where patches are cut into cells. Many layers are more than what samples of so few patches tell apart. */
static void also_near_the_plate(void **state)
{
    (void)state;
    const double height = 0.12;
    spray sprays[SPRAYS];
    make(sprays);
    for (size_t i = 0; i < SPRAYS; i++) {
        if (sprays[i].layer_count <= 2) {
            double found = covered_from(&sprays[i], height, 0.05 / COARSER, SP_TRAJECTORY_LINE, true);
            compare_with(sprays[i].name, "near", found, M_PI * height * height, 0.06);
        }
        forget(&sprays[i]);
    }
}

/* Slow liquid of several speeds, whose edges lie near each other: as on fine texels. */
static void falling_liquid_too(void **state)
{
    (void)state;
    spray sprays[SPRAYS];
    make(sprays);
    for (size_t i = 0; i < SPRAYS; i++) {
        double coarse = covered_from(&sprays[i], HEIGHT, 0.05, SP_TRAJECTORY_PARABOLA, true),
               fine = covered_from(&sprays[i], HEIGHT, 0.0125, SP_TRAJECTORY_PARABOLA, true);
        compare_with(sprays[i].name, "falling", coarse, fine, 0.004 * COARSER);
        forget(&sprays[i]);
    }
}

static void jets_find_the_same(void **state)
{
    (void)state;
    spray sprays[] = {cone_and_ring("edges coincide", 90, 0.6), cone_and_ring("edges abut", 60, 60.0 / 90)};
    for (size_t i = 0; i < 2; i++) {
        double found = covered_from(&sprays[i], HEIGHT, 0.05, SP_TRAJECTORY_LINE, false);
        compare_with(sprays[i].name, "forward", found, M_PI * HEIGHT * HEIGHT, 0.01 * COARSER);
        forget(&sprays[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(together_they_are_a_cone),
        cmocka_unit_test(also_near_the_plate),
        cmocka_unit_test(falling_liquid_too),
        cmocka_unit_test(jets_find_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
