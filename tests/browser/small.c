/* The page tells the little water of a small vessel, where it evaluates layouts itself, as its tables do. */
#include "../cli/small_vessel.h"
#include "browser.h"

static json_t *found;

static int ask_the_page(void **state)
{
    if (open_workplace(state) != 0)
        return -1;
    write_small_vessel();
    found = ask_page("small");
    return 0;
}

static int put_away(void **state)
{
    json_decref(found);
    return close_workplace(state);
}

static void it_opens_without_requests_or_messages(void **state)
{
    (void)state;
    skip_unless_evaluating(found);
    assert_opened(found);
}

static void its_water_is_reported(void **state)
{
    (void)state;
    skip_unless_evaluating(found);
    const json_t *rows = json_object_get(found, "rows");
    size_t told = 0;
    for (size_t i = 0; i < json_array_size(rows); i++) {
        const json_t *row = json_array_get(rows, i);
        if (strcmp(json_string_value(json_array_get(row, 0)), "Water") != 0)
            continue;
        for (size_t k = 1; k < 3; k++, told++)
            assert_string_equal(json_string_value(json_array_get(row, k)), "0.0400 L/min");
    }
    assert_int_equal(told, 2);
    assert_non_null(strstr(json_string_value(json_object_get(found, "said")), " with 0.0400 L/min,"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_opens_without_requests_or_messages),
        cmocka_unit_test(its_water_is_reported),
    };
    return cmocka_run_group_tests(tests, ask_the_page, put_away);
}
