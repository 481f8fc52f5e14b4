/* Numbers as the report writes them. */
#include "report/markup.h"

#include <sprayplan/result.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <cmocka.h>

static void expect(double value, int decimals, const char *expected)
{
    sp_text text = {0};
    sp_error error = {0};
    sp_markup_decimals(&text, value, decimals);
    char *found = sp_text_finish(&text, &error);
    assert_string_equal(found, expected);
    free(found);
}

static void what_rounds_to_zero_has_no_sign(void **state)
{
    (void)state;
    expect(-0.0, 2, "0.00");
    expect(-0.0049, 2, "0.00");
    expect(-1e-300, 0, "0");
    expect(-0.0051, 2,
           "\xe2\x88\x92"
           "0.01");
    expect(-1.5e6, 1,
           "\xe2\x88\x92"
           "1500000.0");
    expect(0.25, 2, "0.25");
    expect(NAN, 2, "\xe2\x80\x93");
}

static void expect_significant(double value, int digits, const char *expected)
{
    sp_text text = {0};
    sp_error error = {0};
    sp_markup_significant(&text, value, digits);
    char *found = sp_text_finish(&text, &error);
    assert_string_equal(found, expected);
    free(found);
}

static void what_is_next_to_nothing_is_zero(void **state)
{
    (void)state;
    expect_significant(3.8e-11, 3, "0");
    expect_significant(0, 3, "0");
    expect_significant(6e-10, 3, "0.000000001");
    expect_significant(1.234e-5, 3, "0.0000123");
    expect_significant(1234.5, 3, "1234");
}

static void expect_water(double l_min, const char *expected)
{
    sp_text text = {0};
    sp_error error = {0};
    sp_markup_water(&text, l_min);
    char *found = sp_text_finish(&text, &error);
    assert_string_equal(found, expected);
    free(found);
}

/* The tenth from 10 L/min on, three significant digits below, of what it rounds to. */
static void little_water_is_reported_as_well_as_much(void **state)
{
    (void)state;
    expect_water(1234.56, "1234.6");
    expect_water(10, "10.0");
    expect_water(9.996, "10.0");
    expect_water(9.994, "9.99");
    expect_water(1, "1.00");
    expect_water(0.09996, "0.100");
    expect_water(0.04, "0.0400");
    expect_water(1.234e-5, "0.0000123");
    expect_water(-0.04, "\xe2\x88\x92"
                        "0.0400");
    expect_water(0, "0.0");
    expect_water(1e-12, "0.0");
    expect_water(NAN, "\xe2\x80\x93");
}

/* Of more water it has the digits of that. */
static void a_part_of_water_is_as_exact_as_the_whole(void **state)
{
    (void)state;
    sp_text text = {0};
    sp_error error = {0};
    sp_markup_water_of(&text, 3.333, 20);
    sp_markup_water_of(&text, 0, 0.1);
    sp_markup_water_of(&text, -0.02, 0.06);
    char *found = sp_text_finish(&text, &error);
    assert_string_equal(found, "3.30.000\xe2\x88\x92"
                               "0.0200");
    free(found);
}

/* And of several each is more than nothing. */
static void little_water_beside_much_is_reported(void **state)
{
    (void)state;
    sp_text text = {0};
    sp_error error = {0};
    sp_markup_water_beside(&text, 9, 103);
    sp_text_add(&text, " ");
    sp_markup_water_beside(&text, 0.04, 103);
    char *found = sp_text_finish(&text, &error);
    assert_string_equal(found, "9.0 0.040");
    free(found);
}

/* However it is rounded, what is told is not more than what is proved, and less by no more than a hundredth. */
static void a_bound_of_water_is_rounded_down(void **state)
{
    (void)state;
    assert_true(sp_water_at_least(31.29) == 31.2);
    assert_true(sp_water_at_least(0.0599999) == 0.0599);
    assert_true(sp_water_at_least(0.06 * (1 - 1e-12)) == 0.06);
    assert_true(sp_water_at_least(0) == 0);
    assert_true(sp_water_at_least(0.09996) == 0.0999);
    for (double proved = 1e-4; proved < 100; proved *= 1.00137) {
        double told = sp_water_at_least(proved);
        char digits[40];
        snprintf(digits, sizeof digits, "%.*f", sp_water_decimals(told), told);
        assert_true(atof(digits) <= proved && atof(digits) > 0.99 * proved);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_rounds_to_zero_has_no_sign),
        cmocka_unit_test(what_is_next_to_nothing_is_zero),
        cmocka_unit_test(little_water_is_reported_as_well_as_much),
        cmocka_unit_test(a_part_of_water_is_as_exact_as_the_whole),
        cmocka_unit_test(little_water_beside_much_is_reported),
        cmocka_unit_test(a_bound_of_water_is_rounded_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
