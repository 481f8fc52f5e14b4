/* Numbers that no spray has: liquid that hardly leaves its nozzle or falls at once, geometry far off or of no size that
 * is ever built. Either the answer is right, or it is refused at its cause. */
#include "stage.h"

#include <string.h>

#define HEIGHT 0.9   /* m */
#define TEXEL 0.0237 /* m */

static sp_mesh *plate(double size, double far)
{
    rectangle square = level_rectangle(size, size, 0);
    square.corner.x += far;
    return mesh_of_rectangles(&square, 1);
}

/* Of a cone that points down a jet at its edge lands where it falls to; all of it lands, and all of a ball. */
static void assert_falls(double speed, double gravity)
{
    sp_nozzle_type types[2] = {spray_type(SP_PATTERN_FULL_CONE, 100), spray_type(SP_PATTERN_FULL_CONE, 360)};
    scene s;
    scene_open(&s, plate(1, 0), SP_TRAJECTORY_PARABOLA, TEXEL);
    s.setup.gravity = gravity;
    s.setup.fidelity.jets = 2000;
    sp_evaluator *evaluator = scene_evaluator(&s);
    double down = speed * cos(deg(50)), time = (sqrt(down * down + 2 * gravity * HEIGHT) - down) / gravity;
    double area = M_PI * pow(speed * sin(deg(50)) * time, 2), largest[2] = {0};
    static const double places[][2] = {{0.0123, 0.0234}, {0, 0}, {0.2, -0.1}};
    for (int i = 0; i < 6; i++) {
        sp_nozzle nozzle =
            nozzle_at(&types[i % 2], sp_v(places[i / 2][0], places[i / 2][1], HEIGHT), sp_v(0, 0, -1), speed);
        sp_coverage *inverse = sound_cover(evaluator, &nozzle, 1, true),
                    *forward = sound_cover(evaluator, &nozzle, 1, false);
        largest[0] = fmax(largest[0], fabs(share_landed(inverse) - 1));
        largest[1] = fmax(largest[1], i % 2 ? 0 : fabs(inverse->covered_area / area - 1));
        assert_true(fabs(share_landed(forward) - 1) < 1e-9);
        assert_true(fabs(forward->balance.clean / forward->flow - 1) < 1e-9);
        sp_coverage_destroy(inverse);
        sp_coverage_destroy(forward);
    }
    print_message("%g m/s under %g m/s2: liquid off by %.2f %%, area by %.2f %%\n", speed, gravity, 100 * largest[0],
                  100 * largest[1]);
    assert_true(largest[0] < 0.03 && largest[1] < 0.05);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

static void any_trickle(void **state)
{
    (void)state;
    for (double speed = 1e-2; speed > 5e-9; speed /= 10)
        assert_falls(speed, 9.81);
}

static void any_gravity(void **state)
{
    (void)state;
    for (double gravity = 1e4; gravity < 2e18; gravity *= 100)
        assert_falls(19, gravity);
}

static void assert_refused(const sp_error *error, const char *beginning)
{
    print_message("%s\n", error->message);
    assert_int_equal(error->kind, SP_ERROR_INPUT);
    if (strncmp(error->message, beginning, strlen(beginning)) != 0)
        fail_msg("\"%s\" does not begin with \"%s\"", error->message, beginning);
}

static void speeds_that_cannot_be_told(void **state)
{
    (void)state;
    static const double speeds[] = {1e-9, 1e-300, 1.1e30, 1e300};
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 360);
    scene s;
    scene_open(&s, plate(1, 0), SP_TRAJECTORY_PARABOLA, TEXEL);
    sp_evaluator *evaluator = scene_evaluator(&s);
    for (size_t i = 0; i < sizeof speeds / sizeof *speeds; i++) {
        sp_nozzle nozzle = nozzle_at(&type, sp_v(0, 0, HEIGHT), sp_v(0, 0, -1), speeds[i]);
        sp_layout *layout = sp_layout_create(&nozzle, 1, NULL);
        sp_error errors[2] = {0};
        assert_null(sp_evaluate_inverse(evaluator, layout, &errors[0]));
        assert_null(sp_evaluate(evaluator, layout, &errors[1]));
        assert_refused(&errors[0], "nozzle n: exit speed ");
        assert_string_equal(errors[0].message, errors[1].message);
        sp_layout_destroy(layout);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* As lines even the slowest arrives. */
static void lines_have_no_slowest(void **state)
{
    (void)state;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 30);
    scene s;
    scene_open(&s, plate(2, 0), SP_TRAJECTORY_LINE, TEXEL);
    sp_evaluator *evaluator = scene_evaluator(&s);
    for (double speed = 1e-150; speed < 1e30; speed *= 1e30) {
        sp_nozzle nozzle = nozzle_at(&type, sp_v(0, 0, HEIGHT), sp_v(0, 0, -1), speed);
        sp_coverage *coverage = sound_cover(evaluator, &nozzle, 1, true);
        double radius = HEIGHT * tan(deg(15)), area_off = coverage->covered_area / (M_PI * radius * radius) - 1,
               liquid_off = share_landed(coverage) - 1;
        print_message("lines at %g m/s: liquid off by %.2g, area by %.2g\n", speed, liquid_off, area_off);
        assert_true(fabs(area_off) < 0.01 && fabs(liquid_off) < 0.01);
        sp_coverage_destroy(coverage);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* Size and place of the plate, gravity and texel, m and m/s²: refused, or not where `error` is NULL. */
static void geometry_that_cannot_be_told(void **state)
{
    (void)state;
    static const struct {
        double size, far, gravity, texel;
        const char *error;
    } cases[] = {
        {1, 0, 1e160, 0.03, "gravity: 1e+160 m/s2 found"},
        {1, 0, 1e300, 0.03, "gravity: 1e+300 m/s2 found"},
        {1, 0, 1e60, 0.03, "gravity: 1e+60 m/s2 found"},
        {1, 0, 1e58, 0.03, NULL},
        {1, 4e9, 9.81, 0.03, NULL},
        {1, 1e13, 9.81, 0.03, "geometry: coordinates up to 1e+13 m found"},
        {1, 1e14, 9.81, 0.03, "geometry: coordinates up to 1e+14 m found"},
        {1, 1e8, 9.81, 1e-6, "texel: 1e-06 m found, too small for coordinates up to 1e+08 m"},
        {1, 0, 9.81, 1e-300, "texel: 1e-300 m found, too small for coordinates"},
        {1e-51, 0, 9.81, 0, "geometry: 1.41421e-51 m across found"},
        {1e-40, 0, 9.81, 0, NULL},
        {1e29, 0, 9.81, 0, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scene s;
        scene_open(&s, plate(cases[i].size, cases[i].far), SP_TRAJECTORY_PARABOLA, 1);
        s.setup.fidelity.texel = cases[i].texel;
        s.setup.gravity = cases[i].gravity;
        sp_error error = {0};
        sp_evaluator *evaluator = sp_evaluator_create(&s.setup, &error);
        if (cases[i].error)
            assert_refused(&error, cases[i].error);
        else
            assert_no_error(&error);
        assert_int_equal(evaluator != NULL, !cases[i].error);
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_trickle),
        cmocka_unit_test(any_gravity),
        cmocka_unit_test(speeds_that_cannot_be_told),
        cmocka_unit_test(lines_have_no_slowest),
        cmocka_unit_test(geometry_that_cannot_be_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
