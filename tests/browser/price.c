/* Where mounts cost something the page tells prices of changed layouts, as the program does. */
#include "browser.h"

#include <math.h>

static const char costly_yaml[] = ROOM_WITH_A_NOZZLE
    "  max_nozzles: 4\n"
    "  pressure: 2 bar\n"
    "  water_cost: 30 EUR per L/min\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [0.3 m, 0.3 m, 1 m], axis: [0, 0, -1], tilt: 30 deg, depth: {from: 100 mm, to: "
    "500 mm, spacing: 200 mm}, cost: 3 L/min}\n"
    "    - port: {name: P2, position: [0.7 m, 0.7 m, 1 m], axis: [0, 0, -1], tilt: 30 deg, depth: {from: 100 mm, to: "
    "500 mm, spacing: 200 mm}, cost: 600 EUR}\n";

static json_t *found;

static int ask_the_page(void **state)
{
    if (open_workplace(state) != 0)
        return -1;
    write_file("price.yaml", costly_yaml);
    found = ask_page("price");
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

/* Of a step, as "15.0 L/min, 450 EUR" in a column of the row of prices: 0 what was started from, 1 the reader's own. */
static void read_price(const char *step, size_t column, double price[2])
{
    const json_t *rows = json_object_get(json_object_get(found, step), "rows");
    for (size_t i = 0; i < json_array_size(rows); i++) {
        const char *head = json_string_value(json_array_get(json_array_get(rows, i), 0));
        if (strncmp(head, "Price", 5) != 0)
            continue;
        const char *text = json_string_value(json_array_get(json_array_get(rows, i), 1 + column));
        if (sscanf(text, "%lf L/min, %lf EUR", &price[0], &price[1]) != 2)
            fail_msg("found %s", text);
        return;
    }
    fail_msg("no price");
}

/* What the program says of a scene, within what the page rounds to. */
static void expect_price(json_t *result, const double price[2])
{
    const json_t *layout = json_array_get(json_object_get(result, "layouts"), 0),
                 *told = json_object_get(layout, "price");
    assert_non_null(told);
    assert_float_equal(price[0], json_number_value(json_object_get(told, "total_l_min")), 0.051);
    assert_float_equal(price[1], json_number_value(json_object_get(told, "money")), 0.51);
    json_decref(result);
}

static void the_reports_layout_costs_what_it_says(void **state)
{
    (void)state;
    skip_unless_evaluating(found);
    double price[2], own[2];
    char path[1024];
    read_price("start", 0, price);
    read_price("start", 1, own);
    snprintf(path, sizeof path, "%s/price/result.json", workplace);
    expect_price(json_load_file(path, 0, NULL), price);
    assert_memory_equal(price, own, sizeof own);
}

static void a_nozzle_more_costs_its_water_and_its_mount(void **state)
{
    (void)state;
    skip_unless_evaluating(found);
    double start[2], price[2];
    read_price("start", 0, start);
    read_price("added", 1, price);
    assert_float_equal(price[1] - start[1], 30 * (start[0] - 3) + 600, 4); /* the same type at the same pressure */
    const json_t *added = json_object_get(found, "added");
    write_file("price/changed.yaml", json_string_value(json_object_get(added, "scene")));
    expect_price(expect_json("simulate price/changed.yaml --json", 0), price);
    assert_non_null(strstr(json_string_value(json_object_get(added, "said")), "Water and mounts cost"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_opens_without_requests_or_messages),
        cmocka_unit_test(the_reports_layout_costs_what_it_says),
        cmocka_unit_test(a_nozzle_more_costs_its_water_and_its_mount),
    };
    return cmocka_run_group_tests(tests, ask_the_page, put_away);
}
