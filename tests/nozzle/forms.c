/* What others ask of a pattern, held against directions. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "nozzle/pattern.h"
#include "nozzle/rotation.h"

#define DIRECTIONS 2000
#define CASES 8

static const sp_nozzle_type types[CASES] = {
    {.pattern = SP_PATTERN_FULL_CONE, .angle = 1.2},
    {.pattern = SP_PATTERN_FULL_CONE, .angle = 2 * M_PI},
    {.pattern = SP_PATTERN_HOLLOW_CONE, .angle = 1.9, .hollow = 0.6},
    {.pattern = SP_PATTERN_SOLID_STREAM, .angle = 0.05},
    {.pattern = SP_PATTERN_FLAT_FAN, .angle = 1.4, .thickness = 0.2},
    {.pattern = SP_PATTERN_FLAT_FAN, .angle = 4.2, .thickness = 0.7},
    {.pattern = SP_PATTERN_FLAT_FAN, .angle = 2 * M_PI, .thickness = 0.3},
    {.pattern = SP_PATTERN_ROTATING,
     .angle = 0.4,
     .thickness = 0.1,
     .rotation = {.jet = SP_PATTERN_FLAT_FAN, .tilt = 1}},
};
static const sp_vec3 up = {0, 0, 1};

/* All over the sphere. */
static sp_vec3 direction(uint64_t i)
{
    sp_nozzle_type all = {.pattern = SP_PATTERN_FULL_CONE, .angle = 2 * M_PI};
    sp_spray sphere = sp_spray_create(&all, all.angle);
    return sp_spray_direction(&sphere, i, DIRECTIONS, 5);
}

static void rolled_by_the_period_it_sprays_the_same(void **state)
{
    (void)state;
    for (int k = 0; k < CASES; k++) {
        sp_spray spray = sp_spray_create(&types[k], types[k].angle);
        double period = sp_type_roll_period(&types[k]), roll = period > 0 ? period : 1.1;
        sp_frame frame = sp_nozzle_frame(sp_v(1, 2, -3), 0.3, up),
                 rolled = sp_nozzle_frame(sp_v(1, 2, -3), 0.3 + roll, up),
                 half = sp_nozzle_frame(sp_v(1, 2, -3), 0.3 + 0.5 * period, up);
        size_t changed = 0;
        for (uint64_t i = 0; i < DIRECTIONS; i++) {
            double share = sp_spray_share(&spray, &frame, direction(i), 0.1);
            assert_float_equal(share, sp_spray_share(&spray, &rolled, direction(i), 0.1), 1e-9);
            changed += fabs(share - sp_spray_share(&spray, &half, direction(i), 0.1)) > 0.1;
        }
        assert_true((changed > 0) == (period > 0));
        assert_true(sp_spray_is_isotropic(&spray) == (k == 1));
    }
}

static void what_it_holds_lies_within_its_limits(void **state)
{
    (void)state;
    for (int k = 0; k < CASES; k++) {
        sp_spray spray = sp_spray_create(&types[k], types[k].angle);
        sp_frame frame = sp_nozzle_frame(sp_v(1, 2, -3), 0.3, up);
        size_t held = 0;
        for (uint64_t i = 0; i < DIRECTIONS; i++) {
            sp_vec3 d = direction(i);
            if (!sp_spray_holds(&spray, &frame, d))
                continue;
            held++;
            assert_true(fabs(asin(sp_dot(d, frame.y))) <= sp_spray_latitude(&spray) + 1e-12);
            assert_true(sp_dot(d, frame.z) >= cos(sp_spray_reach(&spray)) - 1e-12);
            assert_true(sp_dot(d, frame.z) <= cos(spray.low) + 1e-12);
        }
        assert_true(held > 0 || k == 3);
        for (int i = 0; i < 40; i++)
            assert_true(fabs(sp_spray_margin(&spray, sp_spray_rim(&spray, i, 40))) < 1e-9 ||
                        types[k].angle >= 2 * M_PI);
    }
}

/* By differences twice as wide as its own, away from where margins bend. */
static void margins_change_as_their_slope_says(void **state)
{
    (void)state;
    const double step = 2e-6;
    for (int k = 0; k < CASES; k++) {
        sp_spray spray = sp_spray_create(&types[k], types[k].angle);
        size_t off = 0;
        for (uint64_t i = 0; i < DIRECTIONS; i++) {
            sp_vec3 d = direction(i), gradient, across = sp_unit(sp_cross(d, sp_v(0.3, -0.5, 0.8)));
            double margin = sp_spray_margin_slope(&spray, d, &gradient);
            assert_float_equal(margin, sp_spray_margin(&spray, d), 1e-12);
            assert_true(margin == sp_spray_margin_slope(&spray, d, NULL));
            double slope = (sp_spray_margin(&spray, sp_unit(sp_along(d, step, across))) - margin) / step;
            off += fabs(slope - sp_dot(gradient, across)) > 1e-4;
        }
        assert_in_range(off, 0, DIRECTIONS / 100);
    }
}

/* A number from -1 to 1. */
static double next(uint64_t *random)
{
    *random = *random * 6364136223846793005u + 1442695040888963407u;
    return (double)(*random >> 11) * 0x1p-52 - 1;
}

/* Opened to any angle between two, turned and rolled as far as was said. */
static void widened_holds_all_that_are_meant(void **state)
{
    (void)state;
    const double turn = 0.15, roll = 0.2;
    uint64_t random = 3;
    for (int k = 0; k < CASES; k++) {
        if (!sp_type_is_uniform(&types[k]))
            continue;
        double low = 0.8 * types[k].angle, high = types[k].angle;
        sp_spray narrow = sp_spray_create(&types[k], low), wide = sp_spray_create(&types[k], high);
        sp_spray all = sp_spray_widened(&narrow, &wide, turn, roll, 1e-6);
        sp_frame frame = sp_nozzle_frame(sp_v(1, 2, -3), 0.3, up);
        for (uint64_t i = 0; i < DIRECTIONS; i++) {
            sp_spray own = sp_spray_create(&types[k], low + (high - low) * 0.5 * (1 + next(&random)));
            sp_vec3 about = sp_unit(sp_v(next(&random), next(&random), next(&random)));
            double angle = turn * next(&random), c = cos(roll * next(&random)), s = sqrt(1 - c * c);
            sp_vec3 d = sp_spray_direction(&own, i, DIRECTIONS, 9),
                    rolled = sp_v(c * d.x - s * d.y, s * d.x + c * d.y, d.z);
            sp_vec3 world = sp_along(sp_along(sp_scale(frame.x, rolled.x), rolled.y, frame.y), rolled.z, frame.z);
            sp_vec3 turned = sp_add(sp_scale(world, cos(angle)), sp_scale(sp_cross(about, world), sin(angle)));
            turned = sp_unit(sp_along(turned, sp_dot(about, world) * (1 - cos(angle)), about));
            assert_true(sp_spray_holds(&all, &frame, turned));
        }
    }
}

static void opened_so_far_it_just_reaches(void **state)
{
    (void)state;
    for (int k = 0; k < CASES; k++)
        for (int i = 1; sp_type_is_uniform(&types[k]) && i < 30; i++) {
            double polar = i * M_PI / 30, angle = sp_type_angle_reaching(&types[k], polar);
            sp_spray spray = sp_spray_create(&types[k], angle), less = sp_spray_create(&types[k], 0.99 * angle);
            /* a fan's thickness reaches so far by itself */
            assert_true(angle > 0 || polar <= 0.5 * types[k].thickness + 1e-9);
            assert_true(spray.high >= polar * (1 - 1e-9));
            assert_true(angle == 0 || less.high < polar * (1 - 1e-4));
        }
}

/* A hollow cone of a half-space and more has its largest solid angle at neither end of its range. */
static void between_two_angles_none_has_a_larger_solid_angle(void **state)
{
    (void)state;
    const sp_nozzle_type hollow = {.pattern = SP_PATTERN_HOLLOW_CONE, .hollow = 0.8};
    const double ranges[][2] = {{3, 2 * M_PI}, {1, 2}, {1, 5}, {5.5, 6}, {4, 4}};
    for (int k = 0; k < CASES + 1; k++) {
        const sp_nozzle_type *type = k < CASES ? &types[k] : &hollow;
        for (size_t r = 0; sp_type_is_uniform(type) && r < sizeof ranges / sizeof *ranges; r++) {
            double low = ranges[r][0], high = ranges[r][1], found = 0;
            for (int i = 0; i <= 5000; i++)
                found = fmax(found, sp_spray_create(type, low + (high - low) * i / 5000).solid_angle);
            double most = sp_type_solid_angle_most(type, low, high);
            assert_true(most >= found && most <= found * (1 + 1e-6));
        }
    }
    double widest = sp_spray_create(&hollow, 2 * M_PI).solid_angle, half = sp_spray_create(&hollow, 3).solid_angle;
    assert_true(sp_type_solid_angle_most(&hollow, 3, 2 * M_PI) > 1.3 * fmax(widest, half));
}

static void jets_that_turn_are_cones_fans_or_streams(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_nozzle_type turning = {.name = "t", .pattern = SP_PATTERN_ROTATING, .rotation = {.jet = SP_PATTERN_MEASURED}};
    assert_false(sp_type_is_valid(&turning, &error));
    assert_string_equal(error.message, "type t: rotating, expected a cone, fan or stream as jet");
    assert_true(sp_pattern_fits_hub(SP_PATTERN_HOLLOW_CONE) && !sp_pattern_fits_hub(SP_PATTERN_FLAT_FAN));
    assert_true(sp_type_jets(&types[7]) == 1 && !sp_type_has_tracks(&types[7]) && !sp_type_leaves_as_stream(&types[7]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rolled_by_the_period_it_sprays_the_same),
        cmocka_unit_test(what_it_holds_lies_within_its_limits),
        cmocka_unit_test(margins_change_as_their_slope_says),
        cmocka_unit_test(widened_holds_all_that_are_meant),
        cmocka_unit_test(opened_so_far_it_just_reaches),
        cmocka_unit_test(between_two_angles_none_has_a_larger_solid_angle),
        cmocka_unit_test(jets_that_turn_are_cones_fans_or_streams),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
