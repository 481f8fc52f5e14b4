/* Nozzles nearer to a wall than a texel is long, and liquid that falls within one: what arrives and what it covers,
 * against closed forms. */
#include "measure.h"
#include <stdio.h>

#define TEXEL 0.02 /* m, of the plates */
#define WIDTH 1.0  /* m */

static sp_evaluator *plate_open(scene *s, double width, sp_trajectory trajectory, double texel)
{
    rectangle plate = level_rectangle(width, width, 0);
    scene_open(s, mesh_of_rectangles(&plate, 1), trajectory, 1);
    s->setup.fidelity.texel = texel;
    return scene_evaluator(s);
}

static double landed(const sp_coverage *coverage)
{
    return coverage->flux_mean * coverage->area / coverage->flow;
}

/* From a micrometre to several texels. */
static const double heights[] = {1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 0.01, 0.02, 0.04, 0.06, 0.08, 0.1, 0.13};
#define HEIGHTS (sizeof heights / sizeof *heights)

/* Anywhere over its texel. */
static sp_vec3 place_at(size_t i, double height)
{
    return sp_v(TEXEL * fmod(0.618 * (double)i, 1), TEXEL * fmod(0.755 * (double)i, 1), height);
}

/* A cone at the plate brings all its liquid to a disc. */
static void cones_before_a_wall(void **state)
{
    (void)state;
    static const double angles[] = {20, 60, 120};
    scene s;
    sp_evaluator *evaluator = plate_open(&s, WIDTH, SP_TRAJECTORY_LINE, TEXEL);
    for (size_t k = 0; k < 3; k++) {
        sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, angles[k]);
        double liquid = 0, area = 0;
        for (size_t i = 0; i < HEIGHTS; i++) {
            sp_nozzle nozzle = nozzle_at(&type, place_at(i, heights[i]), sp_v(0, 0, -1), 0);
            sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
            double radius = heights[i] * tan(deg(angles[k]) / 2), disc = M_PI * radius * radius;
            printf("  %g: %g %g\n", heights[i], landed(coverage), coverage->covered_area / disc);
            liquid = fmax(liquid, fabs(landed(coverage) - 1));
            area = fmax(area, fabs(coverage->covered_area / disc - 1));
            sp_coverage_destroy(coverage);
        }
        print_message("cone of %g deg: liquid within %.2f %%, area within %.2f %%\n", angles[k], 100 * liquid,
                      100 * area);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* What of a ball's liquid meets a plate is the solid angle of four rectangles with a corner below it. */
static double solid_angle(sp_vec3 from, double half)
{
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        double a = half + (i & 1 ? from.x : -from.x), b = half + (i & 2 ? from.y : -from.y);
        sum += atan(a * b / (from.z * sqrt(a * a + b * b + from.z * from.z)));
    }
    return sum;
}

static void balls_before_a_wall(void **state)
{
    (void)state;
    scene s;
    sp_evaluator *evaluator = plate_open(&s, WIDTH, SP_TRAJECTORY_LINE, TEXEL);
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 360);
    for (size_t i = 0; i < HEIGHTS; i++) {
        sp_nozzle nozzle = nozzle_at(&type, place_at(i, heights[i]), sp_v(0, 0, -1), 0);
        double share = solid_angle(nozzle.position, WIDTH / 2) / (4 * M_PI);
        sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
        printf("  %g: %g\n", heights[i], landed(coverage)/share);
        sp_coverage_destroy(coverage);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

static void balls_before_a_wall_flux(void **state)
{
    (void)state;
    scene s;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 360);
    rectangle plate = level_rectangle(WIDTH, WIDTH, 0);
    scene_open(&s, mesh_of_rectangles(&plate, 1), SP_TRAJECTORY_LINE, 1);
    s.setup.fidelity.texel = TEXEL;
    for (size_t i = 0; i < HEIGHTS; i++) {
        double radius = 2 * heights[i];
        sp_nozzle nozzle = nozzle_at(&type, place_at(i, heights[i]), sp_v(0, 0, -1), 0);
        s.setup.criterion.flux = 2e-4 / (4 * M_PI) * heights[i] / pow(5 * heights[i] * heights[i], 1.5);
        sp_evaluator *evaluator = scene_evaluator(&s);
        sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
        printf("  %g: %g\n", heights[i], coverage->covered_area / (M_PI * radius * radius));
        sp_coverage_destroy(coverage);
        sp_evaluator_destroy(evaluator);
    }
    scene_close(&s);
}

static void fans_along_a_wall(void **state)
{
    (void)state;
    scene s;
    sp_evaluator *evaluator = plate_open(&s, WIDTH, SP_TRAJECTORY_LINE, TEXEL);
    sp_nozzle_type type = spray_type(SP_PATTERN_FLAT_FAN, 80);
    for (size_t i = 0; i < HEIGHTS; i++) {
        sp_nozzle nozzle = nozzle_at(&type, place_at(i, heights[i]), sp_v(1, 0, 0), 0);
        nozzle.roll = 0;
        sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
        printf("  %g: %g %g\n", heights[i], landed(coverage), coverage->covered_area);
        sp_coverage_destroy(coverage);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

static void slow(void **state)
{
    (void)state;
    static const double speeds[] = {1e-6, 1e-3, 0.0425, 0.05, 0.1, 0.2, 0.5, 1};
    for (int t = 0; t < 3; t++) {
        scene s;
        sp_evaluator *evaluator = plate_open(&s, 2, SP_TRAJECTORY_PARABOLA, (double[]){0.08, 0.04, 0.02}[t]);
        sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 100);
        for (size_t i = 0; i < 8; i++) {
            sp_nozzle nozzle = nozzle_at(&type, place_at(i, 1.2), sp_v(1, 0, 0.1), speeds[i]);
            sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
            double wet = 0; for (size_t p = 0; p < coverage->deposits.count; p++) wet += coverage->deposits.jets[p] > 0;
            printf("  %d %g: %g %g\n", t, speeds[i], landed(coverage), wet);
            sp_coverage_destroy(coverage);
        }
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
}

static void fountain(void **state)
{
    (void)state;
    for (int t = 0; t < 4; t++) {
        scene s;
        sp_evaluator *evaluator = plate_open(&s, 6, SP_TRAJECTORY_PARABOLA, (double[]){0.08, 0.04, 0.02, 0.01}[t]);
        for (int k = 0; k < 2; k++) {
            sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, k ? 360 : 120);
            for (size_t i = 0; i < 3; i++) {
                sp_nozzle nozzle = nozzle_at(&type, place_at(i, 0.3), sp_v(0, 0, 1), 4.5);
                sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
                printf("  %d %d: %g\n", t, k, landed(coverage));
                sp_coverage_destroy(coverage);
            }
        }
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cones_before_a_wall),
        cmocka_unit_test(balls_before_a_wall),
        cmocka_unit_test(balls_before_a_wall_flux),
        cmocka_unit_test(fans_along_a_wall),
        cmocka_unit_test(slow),
        cmocka_unit_test(fountain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
