/* Catalogue types whose flow is given at several pressures. */
#include "scratch.h"

#include <sprayplan/scene.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#define LITRES_PER_MINUTE (1e-3 / 60)

static const char scene_text[] =
    "geometry: [{file: tank.obj}]\n"
    "catalogue: points.yaml\n"
    "nozzles:\n"
    "  - {name: N, type: cone, position: [0.1, 0.1, 0.1], axis: [0, 0, 1], pressure: 3 bar}\n";

static sp_scene *load(const char *keys, sp_error *error)
{
    char text[512];
    *error = (sp_error){0};
    snprintf(text, sizeof text, "nozzles:\n  - {name: cone, pattern: full_cone, angle: 60 deg, %s}\n", keys);
    scratch_write("points.yaml", text);
    scratch_write("scene.yaml", scene_text);
    return sp_scene_load("scene.yaml", error);
}

static double flow_at_three_bar(const char *keys)
{
    sp_error error;
    sp_scene *scene = load(keys, &error);
    assert_string_equal(error.message, "");
    double flow = sp_nozzle_flow(&sp_scene_layout(scene)->nozzles[0], &sp_scene_setup(scene)->liquid);
    sp_scene_destroy(scene);
    return flow / LITRES_PER_MINUTE;
}

/* Points on a power of the pressure give that power back; others the best, which here is known. */
static void points_show_the_power(void **state)
{
    (void)state;
    assert_true(fabs(flow_at_three_bar("flow: [2 L/min, 4 L/min, 8 L/min], at: [1 bar, 4 bar, 16 bar]") - 2 * sqrt(3)) <
                1e-12);
    assert_true(fabs(flow_at_three_bar("flow: [5 L/min, 7 L/min], at: [2 bar, 4 bar]") - 5 * pow(1.5, log2(1.4))) <
                1e-12);
    /* of three at equal distances the fit goes through the mean of the logarithms at the middle one */
    double middle = exp((log(1.9) + log(3.24)) / 3);
    assert_true(fabs(flow_at_three_bar("flow: [1 L/min, 1.9 L/min, 3.24 L/min], at: [1 bar, 3 bar, 9 bar]") - middle) <
                1e-12);
}

static void slips_are_reported(void **state)
{
    (void)state;
    static const char *const slips[][2] = {
        {"flow: [2 L/min, 4 L/min], at: 2 bar", "flow: found a list, expected one of 2 to 64 flows"},
        {"flow: 2 L/min, at: [2 bar, 3 bar]", "at: found a list, expected one of 2 to 64 flows"},
        {"flow: [2 L/min], at: [2 bar]", "flow: found a list, expected one of 2 to 64 flows"},
        {"flow: [2 L/min, 3 L/min], at: [2 bar, 4 bar], exponent: 0.5", "exponent: found beside several flows"},
        {"flow: [2 L/min, 2 L/min], at: [2 bar, 4 bar]", "flow: found '2 L/min', expected more than the one before it"},
        {"flow: [2 L/min, 3 L/min], at: [4 bar, 2 bar]", "at: found '2 bar', expected more than the one before it"},
        {"flow: [2 L/min, 9 L/min], at: [2 bar, 4 bar]", "flow: found to grow with the power 2.17 of `at`"},
        {"flow: [2 L/min, 2.1 L/min, 4 L/min], at: [1 bar, 4 bar, 16 bar]",
         "flow: found '2.1 L/min', expected no more than 10 % off the power 0.25 of `at`"},
        {"flow: [2 L/min, 3], at: [2 bar, 4 bar]", "flow: found '3', expected a flow above 0"},
    };
    for (size_t i = 0; i < sizeof slips / sizeof *slips; i++) {
        sp_error error;
        char message[2000];
        assert_null(load(slips[i][0], &error));
        sp_error_text(&error, message, sizeof message);
        if (!strstr(message, slips[i][1]) || strncmp(message, "points.yaml:2:", 14))
            fail_msg("%s\nexpected %s", message, slips[i][1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(points_show_the_power), cmocka_unit_test(slips_are_reported)};
    return cmocka_run_group_tests(tests, scratch_make, scratch_remove);
}
