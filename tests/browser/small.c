/* The page tells the little water of a small vessel, where it evaluates layouts itself, as its tables do. */
#include "browser.h"

static const char small_yaml[] =
    "geometry:\n"
    "  - {file: room.obj, scale: 0.08}\n"
    "cavity: [40 mm, 40 mm, 40 mm]\n"
    "criterion: {flux: 1 L/min/m2}\n"
    "catalogue: drops.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: drop, position: [40 mm, 40 mm, 72 mm], axis: [0, 0, -1], pressure: 2 bar}\n"
    "simulate: {texel: 4 mm}\n"
    "place:\n"
    "  max_nozzles: 2\n"
    "  pressure: 2 bar\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [24 mm, 24 mm, 76 mm], axis: [0, 0, -1], tilt: 30 deg}\n";

static json_t *found;

static int ask_the_page(void **state)
{
    if (open_workplace(state) != 0)
        return -1;
    write_file("drops.yaml", "nozzles:\n"
                             "  - {name: drop, pattern: full_cone, angle: 120 deg, flow: 0.04 L/min, at: 2 bar}\n");
    write_file("small.yaml", small_yaml);
    outcome result = run_program("simulate small.yaml -o small --quiet");
    forget(&result);
    if (can_evaluate("small/report.html"))
        found = read_with("small.js", "small/report.html",
                          "--window-size=1200,900 --virtual-time-budget=600000 --dump-dom");
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

static void its_water_is_told(void **state)
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
        cmocka_unit_test(its_water_is_told),
    };
    return cmocka_run_group_tests(tests, ask_the_page, put_away);
}
