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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_rounds_to_zero_has_no_sign),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
