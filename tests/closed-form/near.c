/* Nozzles nearer to a wall than a texel is long, and liquid that falls within one or comes to the limit of its reach:
 * what arrives and what it covers, against closed forms. */
#include "measure.h"

#include <stdio.h>
#include <string.h>

#ifdef SPRAYPLAN_SANITIZE
#define TEXTURES 2
#define EVERY 3 /* of the heights */
#else
#define TEXTURES 4
#define EVERY 1
#endif
#define TEXEL 0.02 /* m, of the plates before which nozzles stand */
#define WIDTH 1.0  /* m, of these */

static sp_evaluator *plate_open(scene *s, double width, sp_trajectory trajectory, double texel)
{
    rectangle plate = level_rectangle(width, width, 0);
    scene_open(s, mesh_of_rectangles(&plate, 1), trajectory, texel);
    s->setup.fidelity.texel = texel;
    return scene_evaluator(s);
}

static double landed(const sp_coverage *coverage)
{
    return coverage->flux_mean * coverage->area / coverage->flow;
}

/* The largest error of some figures. */
static double worse(double worst, double found, double expected)
{
    return fmax(worst, fabs(found / expected - 1));
}

static void assert_within(const char *what, double size, double error, double bound)
{
    print_message("%-24s %8g: error at most %6.2f %%\n", what, size, 100 * error);
    if (!(error <= bound))
        fail_msg("%s %g: error %.2f %%, allowed %.2f %%", what, size, 100 * error, 100 * bound);
}

/* From a micrometre to some texels. */
static const double heights[] = {1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 0.01, 0.02, 0.04, 0.06, 0.08, 0.1, 0.13};
#define HEIGHTS (sizeof heights / sizeof *heights)

/* Anywhere over its texel. */
static sp_vec3 place_at(size_t i, double height)
{
    return sp_v(TEXEL * fmod(0.618 * (double)i, 1), TEXEL * fmod(0.755 * (double)i, 1), height);
}

/* A cone at the plate brings all its liquid to a disc; an edge is blurred by a fifth of a radian. */
static void cones_before_a_wall(void **state)
{
    (void)state;
    static const struct {
        double angle, liquid, area; /* deg; largest errors */
    } cones[] = {{20, 0.08, 0.12}, {60, 0.015, 0.025}, {120, 0.015, 0.07}};
    scene s;
    sp_evaluator *evaluator = plate_open(&s, WIDTH, SP_TRAJECTORY_LINE, TEXEL);
    for (size_t k = 0; k < 3; k++) {
        sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, cones[k].angle);
        double liquid = 0, area = 0;
        for (size_t i = 0; i < HEIGHTS; i += EVERY) {
            sp_nozzle nozzle = nozzle_at(&type, place_at(i, heights[i]), sp_v(0, 0, -1), 0);
            sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
            double radius = heights[i] * tan(deg(cones[k].angle) / 2);
            liquid = worse(liquid, landed(coverage), 1);
            area = worse(area, coverage->covered_area, M_PI * radius * radius);
            sp_coverage_destroy(coverage);
        }
        assert_within("cone's liquid, deg", cones[k].angle, liquid, cones[k].liquid);
        assert_within("cone's area, deg", cones[k].angle, area, cones[k].area);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* What of a ball's liquid meets the plate is the solid angle of four rectangles with a corner below it. */
static double share_of_ball(sp_vec3 from)
{
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        double a = WIDTH / 2 + (i & 1 ? from.x : -from.x), b = WIDTH / 2 + (i & 2 ? from.y : -from.y);
        sum += atan(a * b / (from.z * sqrt(a * a + b * b + from.z * from.z)));
    }
    return sum / (4 * M_PI);
}

/* Its flux at a way w across the plate is Q/4π h / (h² + w²)^3/2; what has as much as at twice the height is a disc. */
static void balls_before_a_wall(void **state)
{
    (void)state;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 360);
    double liquid = 0, area = 0;
    scene s;
    sp_evaluator *evaluator = plate_open(&s, WIDTH, SP_TRAJECTORY_LINE, TEXEL);
    for (size_t i = 0; i < HEIGHTS; i += EVERY) {
        double h = heights[i], radius = 2 * h;
        sp_nozzle nozzle = nozzle_at(&type, place_at(i, h), sp_v(0, 0, -1), 0);
        sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
        liquid = worse(liquid, landed(coverage), share_of_ball(nozzle.position));
        s.setup.criterion.flux = coverage->flow / (4 * M_PI) * h / pow(h * h + radius * radius, 1.5);
        sp_coverage_destroy(coverage);
        sp_evaluator *strict = scene_evaluator(&s);
        coverage = scene_cover(strict, &nozzle, 1, true);
        area = worse(area, coverage->covered_area, M_PI * radius * radius);
        sp_coverage_destroy(coverage);
        sp_evaluator_destroy(strict);
    }
    assert_within("ball's liquid, deg", 360, liquid, 0.005);
    assert_within("ball's area, deg", 360, area, 0.05);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* A fan along the plate: half of it flies down, and in every direction of the plate lands from where its edge does. */
static void fans_along_a_wall(void **state)
{
    (void)state;
    const int steps = 1000;
    scene s;
    sp_evaluator *evaluator = plate_open(&s, WIDTH, SP_TRAJECTORY_LINE, TEXEL);
    sp_nozzle_type type = spray_type(SP_PATTERN_FLAT_FAN, 80);
    double half = type.thickness / 2, liquid = 0, area = 0;
    for (size_t i = 0; heights[i] < TEXEL / 4; i++) {
        double h = heights[i], expected_liquid = 0, expected_area = 0;
        sp_nozzle nozzle = nozzle_at(&type, place_at(i, h), sp_v(1, 0, 0), 0);
        nozzle.roll = 0;
        for (int k = 0; k < steps; k++) {
            double turn = deg(80) * ((k + 0.5) / steps - 0.5), edge = (WIDTH / 2 - nozzle.position.x) / cos(turn);
            double side = (WIDTH / 2 - copysign(nozzle.position.y, turn * nozzle.position.y)) / fabs(sin(turn));
            double far = fmin(edge, side), first = h / tan(half);
            expected_liquid += (1 - h / hypot(h, far) / sin(half)) / 2 / steps;
            expected_area += (far * far - first * first) / 2 * deg(80) / steps;
        }
        sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
        liquid = worse(liquid, landed(coverage), expected_liquid);
        area = worse(area, coverage->covered_area, expected_area);
        sp_coverage_destroy(coverage);
    }
    assert_within("fan's liquid, deg", 80, liquid, 0.04);
    assert_within("fan's area, deg", 80, area, 0.03);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* What hardly leaves the nozzle falls about the plumb line: at 1 Pa within a texel; all of it lands. */
static void feeble_sprays(void **state)
{
    (void)state;
    static const double speeds[] = {1e-6, 1e-3, 0.0425, 0.05, 0.1, 0.2, 0.5, 1}, texels[] = {0.08, 0.04, 0.02};
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 100);
    for (size_t t = 0; t < 3; t++) {
        scene s;
        sp_evaluator *evaluator = plate_open(&s, 2, SP_TRAJECTORY_PARABOLA, texels[t]);
        double liquid = 0;
        for (size_t i = 0; i < sizeof speeds / sizeof *speeds; i++) {
            sp_nozzle nozzle = nozzle_at(&type, place_at(i, 1.2), sp_v(1, 0, 0.1), speeds[i]);
            sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
            liquid = worse(liquid, landed(coverage), 1);
            sp_coverage_destroy(coverage);
        }
        assert_within("feeble, texel", texels[t], liquid, 0.03);
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
}

/* A fountain's liquid is densest at the parabola of safety, however fine the texels there. */
static void fountains(void **state)
{
    (void)state;
    static const double texels[] = {0.08, 0.04, 0.02, 0.01}, bounds[] = {0.03, 0.02, 0.015, 0.01};
    for (size_t t = 0; t < TEXTURES; t++) {
        scene s;
        sp_evaluator *evaluator = plate_open(&s, 6, SP_TRAJECTORY_PARABOLA, texels[t]);
        double liquid = 0;
        for (size_t i = 0; i < 6; i++) {
            sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, i % 2 ? 360 : 120);
            sp_nozzle nozzle = nozzle_at(&type, place_at(i, 0.3), sp_v(0, 0, 1), 4.5);
            sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
            liquid = worse(liquid, landed(coverage), 1);
            sp_coverage_destroy(coverage);
        }
        assert_within("fountain, texel", texels[t], liquid, bounds[t]);
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
}

/* In a sphere the limit of reach lies across a curved wall. */
static void falls_in_a_sphere(void **state)
{
    (void)state;
    double liquid = 0;
    scene s;
    scene_open(&s, mesh_of_sphere(1, 4), SP_TRAJECTORY_PARABOLA, 0.03);
    s.setup.cavity = SP_CAVITY_POINT;
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 360);
    for (double speed = 0.5; speed < 5; speed += 0.5) {
        sp_nozzle nozzle = nozzle_at(&type, sp_v(0.1, 0.2, -0.1), sp_v(0, 0, 1), speed);
        sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
        liquid = worse(liquid, landed(coverage), 1);
        sp_coverage_destroy(coverage);
    }
    assert_within("sphere, texel", 0.03, liquid, 0.02 * COARSER);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* Cells are the same whoever asks for which patches, and what lies in the way of them is found again. */
static void told_again_in_parts(void **state)
{
    (void)state;
    rectangle faces[7];
    box_rectangles(sp_v(-0.5, -0.5, 0), sp_v(1, 1, 0.6), faces);
    faces[6] = (rectangle){sp_v(0.02, -0.1, 0.01), sp_v(0, 0.2, 0), sp_v(0.03, 0, 0.1)};
    sp_error error = {0};
    scene s;
    scene_open(&s, mesh_of_rectangles(faces, 7), SP_TRAJECTORY_PARABOLA, TEXEL);
    s.setup.cavity = SP_CAVITY_POINT;
    s.setup.cavity_point = sp_v(-0.2, 0.3, 0.4);
    for (int threads = 1; threads <= 3; threads += 2) {
        s.setup.run.threads = threads;
        sp_evaluator *evaluator = scene_evaluator(&s);
        size_t patches = sp_evaluator_patches(evaluator)->count, at = 0, cells = 0;
        uint8_t *known = calloc(patches / 4 + 1, 1);
        sp_vec3 position = sp_v(0.001, 0.013, 0.017), axis = sp_v(0, 0, -1);
        sp_reach *whole =
            sp_evaluator_reach_passing(evaluator, position, (sp_launch){.speed = 2}, axis, M_PI, NULL, &error);
        assert_non_null(whole);
        for (size_t i = 0; i < whole->count; i++) {
            size_t bit = 2 * (size_t)whole->arrivals[i].patch + whole->arrivals[i].arc;
            known[bit / 8] |= (uint8_t)(1u << bit % 8);
        }
        for (size_t first = 0; first < patches; first += 700) {
            size_t end = first + 700 < patches ? first + 700 : patches;
            sp_reach *part = sp_evaluator_reach_part(evaluator, position, (sp_launch){.speed = 2}, axis, M_PI, first,
                                                     end, known, &error);
            assert_non_null(part);
            for (size_t i = 0; i < part->count; i++) {
                const sp_arrival *a = &whole->arrivals[at++], *b = &part->arrivals[i];
                assert_true(a->patch == b->patch && a->arc == b->arc && a->part == b->part &&
                            a->transfer == b->transfer && a->breadth == b->breadth &&
                            !memcmp(&a->point, &b->point, sizeof a->point));
                cells += a->part < 1;
            }
            sp_reach_destroy(part);
        }
        assert_int_equal(at, whole->count);
        assert_true(cells > 500);
        sp_reach_destroy(whole);
        free(known);
        sp_evaluator_destroy(evaluator);
    }
    scene_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cones_before_a_wall), cmocka_unit_test(balls_before_a_wall),
        cmocka_unit_test(fans_along_a_wall),   cmocka_unit_test(feeble_sprays),
        cmocka_unit_test(fountains),           cmocka_unit_test(falls_in_a_sphere),
        cmocka_unit_test(told_again_in_parts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
