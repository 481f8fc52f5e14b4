/* Numbers as the report writes them. */
#include "report/markup.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_rounds_to_zero_has_no_sign),
        cmocka_unit_test(what_is_next_to_nothing_is_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
