/* place with mounts that cost something: prices in figures, report and result, and the same of the layout written. */
#include "results.h"

#include <math.h>

static const char room_with[] = "geometry:\n"
                                "  - file: room.obj\n"
                                "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
                                "criterion: {flux: 1 L/min/m2}\n"
                                "catalogue: catalogue.yaml\n"
                                "nozzles:\n"
                                "  - {name: N1, type: cone, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 0, -1], "
                                "pressure: 2 bar}\n"
                                "simulate: {texel: 200 mm, accuracy: 20 %%, trajectory: line}\n"
                                "place:\n"
                                "  objective: max_coverage\n"
                                "  coverage: 60 %%\n"
                                "  max_nozzles: 2\n"
                                "  pressure: 2 bar\n"
                                "  types: [cone]\n"
                                "  refine: none\n"
                                "  water_cost: 40 EUR per L/min\n"
                                "  mounts:\n"
                                "    - port: {name: P1, position: [0.3 m, 0.3 m, 0.9 m], axis: [0, 0, -1]}\n"
                                "    - surface: {name: walls, geometry: 0, part: walls, spacing: 500 mm, standoff: 40 "
                                "mm, cost: 300 EUR}\n"
                                "%s";

static json_t *found;

static int run_once(void **state)
{
    char text[2048];
    if (open_workplace(state) != 0)
        return -1;
    snprintf(text, sizeof text, room_with, "  alternatives: [{name: ports, mounts: [P1]}, {name: welds}]\n");
    write_file("room.yaml", text);
    found = expect_json("place room.yaml --json --threads 1 --no-live -o out", 0);
    return 0;
}

static int forget_run(void **state)
{
    json_decref(found);
    return close_workplace(state);
}

/* 300 EUR at 40 EUR per L/min are as much as 7.5 L/min. */
static void check_price(json_t *layout, double welds)
{
    json_t *price = json_object_get(layout, "price");
    double total = number(layout, "water_l_min") + 7.5 * welds;
    assert_true(fabs(number(price, "mounts_l_min") - 7.5 * welds) < 1e-9);
    assert_true(fabs(number(price, "total_l_min") - total) < 1e-9);
    assert_true(fabs(number(price, "money") - 40 * total) < 1e-6);
    assert_string_equal(json_string_value(json_object_get(price, "currency")), "EUR");
}

static void every_layout_has_its_price(void **state)
{
    (void)state;
    json_t *welds = named(found, "layouts", "welds"), *nozzle;
    size_t i;
    double fittings = 0;
    check_price(named(found, "layouts", "manual"), 0);
    check_price(named(found, "layouts", "ports"), 0);
    check_price(welds, number(welds, "new_fittings"));
    json_array_foreach(json_object_get(welds, "nozzles"), i, nozzle)
    {
        bool fitting = json_is_true(json_object_get(nozzle, "new_fitting"));
        assert_true(fabs(number(nozzle, "cost_l_min") - (fitting ? 7.5 : 0)) < 1e-9);
        fittings += fitting;
    }
    assert_true(fittings > 0 && fittings == number(welds, "new_fittings"));
}

/* Points and bounds are of prices; where no mount costs anything they are of water, as ever. */
static void fronts_and_bounds_are_of_prices(void **state)
{
    (void)state;
    json_t *welds = named(found, "alternatives", "welds"), *ports = named(found, "alternatives", "ports"), *point;
    json_t *certificate = json_object_get(welds, "certificate");
    size_t i;
    double before = 0;
    json_array_foreach(json_object_get(welds, "front"), i, point)
    {
        double price = number(point, "price_l_min");
        assert_true(price > before);
        assert_true(fabs(price - number(point, "water_l_min") - 7.5 * number(point, "new_fittings")) < 1e-9);
        before = price;
    }
    assert_true(number(certificate, "price_bound_same_coverage_l_min") <= before * (1 + 1e-9));
    assert_true(number(certificate, "coverage_bound_same_price") >= number(certificate, "coverage"));
    assert_null(json_object_get(certificate, "water_bound_same_coverage_l_min"));
    certificate = json_object_get(ports, "certificate");
    assert_non_null(json_object_get(certificate, "water_bound_same_coverage_l_min"));
    assert_null(json_object_get(certificate, "price_bound_same_coverage_l_min"));
}

static void page_shows_prices(void **state)
{
    (void)state;
    static const char *const texts[] = {"Price: water and mounts",
                                        "Cost of its mount, L/min",
                                        "Coverage against price",
                                        "At the engineer&#39;s price",
                                        "of water and cost of mounts together",
                                        "For no higher price than"};
    char *page = read_file("out/report.html", NULL);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (!strstr(page, texts[i]))
            fail_msg("the page lacks '%s'", texts[i]);
    free(page);
}

/* The layout written says what it costs; compare reads it from the result. */
static void the_layout_written_has_the_same_price(void **state)
{
    (void)state;
    json_t *again = expect_json("simulate out/layout.yaml --json", 0);
    json_t *proposed = named(found, "layouts", json_string_value(json_object_get(found, "proposed")));
    json_t *layout = json_array_get(json_object_get(again, "layouts"), 0);
    assert_true(json_equal(json_object_get(layout, "price"), json_object_get(proposed, "price")));
    json_decref(again);
    again = expect_json("compare out/result.json out/layout.yaml --json", 0);
    layout = json_array_get(json_object_get(again, "layouts"), 0);
    check_price(layout, 0);
    json_decref(again);
}

static void assert_page(const char *path, const char *says, const char *not_that)
{
    char *page = read_file(path, NULL);
    assert_non_null(strstr(page, says));
    assert_null(strstr(page, not_that));
    free(page);
}

/* What mounts cost is on the axis only where each of the layouts compared tells it. */
static void layouts_compared_stand_at_their_prices(void **state)
{
    (void)state;
    char text[2048];
    json_decref(expect_json("compare out/result.json out/layout.yaml -o prices --json", 0));
    assert_page("prices/report.html", "Coverage against price", "Coverage against water");
    assert_page("prices/report.html", ">Price: water and mounts, L/min<", ">Water, L/min<");
    snprintf(text, sizeof text, room_with, "");
    *strstr(text, "place:") = '\0';
    write_file("unpriced.yaml", text);
    json_decref(expect_json("compare out/result.json unpriced.yaml -o waters --json", 0));
    assert_page("waters/report.html", ">Water, L/min<", "Coverage against price");
}

/* What costs nothing is not spoken of. */
static void no_prices_without_costs(void **state)
{
    (void)state;
    char text[2048];
    snprintf(text, sizeof text, room_with, "");
    char *cost = strstr(text, ", cost: 300 EUR"), *water = strstr(text, "  water_cost: 40 EUR per L/min\n");
    memset(cost, ' ', strlen(", cost: 300 EUR"));
    memset(water, ' ', strlen("  water_cost: 40 EUR per L/min"));
    write_file("free.yaml", text);
    json_t *plain = expect_json("place free.yaml --json --threads 1", 0);
    assert_null(json_object_get(json_array_get(json_object_get(plain, "layouts"), 0), "price"));
    assert_null(json_object_get(json_array_get(json_object_get(plain, "front"), 0), "price_l_min"));
    json_decref(plain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_layout_has_its_price),
        cmocka_unit_test(fronts_and_bounds_are_of_prices),
        cmocka_unit_test(page_shows_prices),
        cmocka_unit_test(the_layout_written_has_the_same_price),
        cmocka_unit_test(layouts_compared_stand_at_their_prices),
        cmocka_unit_test(no_prices_without_costs),
    };
    return cmocka_run_group_tests_name("costs of mounts", tests, run_once, forget_run);
}
