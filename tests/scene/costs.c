/* cost of mounts and water_cost: what they come to, and what can be wrong with them, and where. */
#include "scratch.h"
#include "written.h"

#include <sprayplan/scene.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#define L_MIN (1e-3 / 60)

static sp_scene *load(const char *water_cost, const char *cost, sp_error *error)
{
    char text[2048];
    snprintf(text, sizeof text,
             "geometry: [{file: tank.obj}]\n"
             "catalogue: catalogue.yaml\n"
             "place:\n"
             "  pressure: 2 bar\n"
             "%s"
             "  mounts:\n"
             "    - port: {name: P1, position: [0, 0, 1]}\n"
             "    - surface: {name: lid, geometry: 0, part: lid, spacing: 10 mm, cost: %s}\n"
             "    - line: {from: [0, 0, 0], to: [0, 0, 0], cost: 1.5 L/min}\n"
             "    - box: {min: [0, 0, 0], max: [0, 0, 0], cost: 0 gpm}\n"
             "    - port: {name: P2, position: [0, 0, 1], cost: 1e6 L/min}\n"
             "  alternatives: [{name: welds, mounts: [{mount: lid, max_nozzles: 2}]}]\n",
             water_cost, cost);
    scratch_write("scene.yaml", text);
    return sp_scene_load("scene.yaml", error);
}

static void expect_cost(const sp_scene *scene, double lid)
{
    sp_place_options place = sp_scene_place_options(scene), welds = sp_scene_alternative_options(scene, 0);
    const double expected[] = {0, lid, 1.5, 0, 1e6};
    assert_int_equal(place.mount_count, 5);
    for (size_t i = 0; i < 5; i++)
        assert_true(fabs(place.mounts[i].cost - expected[i] * L_MIN) <= 1e-12 * expected[i]);
    assert_true(welds.mounts[0].cost == place.mounts[1].cost);
}

static void water_and_money_come_to_water(void **state)
{
    (void)state;
    static const struct {
        const char *water_cost, *cost;
        double lid; /* L/min */
        double money;
    } cases[] = {
        {"", "3 L/min", 3, 0},
        {"", "0.18 m3/h", 3, 0},
        {"  water_cost: 30 EUR per L/min\n", "900 EUR", 30, 30},
        {"  water_cost: 500 USD per m3/h\n", "1.5e2 USD", 5, 30},
        {"  water_cost: 30 EUR per L/min\n", "2 L/min", 2, 30},
        {"  water_cost: .5 CHF per L/min\n", "0CHF", 0, 0.5},
        {"  water_cost: 2EUR per L/min\n", "9EUR", 4.5, 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sp_error error = {0};
        sp_scene *scene = load(cases[i].water_cost, cases[i].cost, &error);
        assert_string_equal(error.message, "");
        expect_cost(scene, cases[i].lid);
        sp_water_cost water = sp_scene_water_cost(scene);
        assert_true(fabs(water.money * L_MIN - cases[i].money) <= 1e-12 * cases[i].money);
        assert_true(cases[i].money > 0 ? strstr(cases[i].water_cost, water.currency) != NULL : !water.currency[0]);
        sp_scene_destroy(scene);
    }
    assert_true(sp_scene_water_cost(NULL).money == 0);
}

/* A layout written as a scene has the same costs. */
static void written_and_read_again(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_scene *scene = load("  water_cost: 30 EUR per L/min\n", "900 EUR", &error);
    assert_non_null(scene);
    char *text = written_text(scene, ".", &error);
    assert_non_null(text);
    scratch_write("again.yaml", text);
    sp_scene *again = sp_scene_load("again.yaml", &error);
    assert_non_null(again);
    expect_cost(again, 30);
    assert_true(sp_scene_water_cost(again).money == sp_scene_water_cost(scene).money);
    assert_string_equal(sp_scene_water_cost(again).currency, "EUR");
    sp_scene_destroy(again);
    free(text);
    sp_scene_destroy(scene);
}

static void faults_are_reported_where_they_are(void **state)
{
    (void)state;
    static const char told[] = "  water_cost: 30 EUR per L/min\n";
    static const char of_water[] = ", expected money per water above 0 such as 30 EUR per L/min";
    static const char of_mount[] =
        ", expected water such as 3 L/min, up to 1e6 L/min, or beside place's `water_cost` money such as 900 EUR";
    static const struct {
        const char *water_cost, *cost, *found, *expected;
    } faults[] = {
        {"", "900 EUR", "scene.yaml:7:74: cost: found money, '900 EUR'",
         ", expected place's `water_cost` with it, such as 30 EUR per L/min, or water such as 3 L/min"},
        {told, "900 USD", "scene.yaml:8:74: cost: found '900 USD'", ", expected an amount of EUR, as in `water_cost`"},
        {told, "900", "scene.yaml:8:74: cost: found '900'", of_mount},
        {told, "900 eur", "scene.yaml:8:74: cost: found '900 eur'", of_mount},
        {told, "900 EUR per L/min", "scene.yaml:8:74: cost: found '900 EUR per L/min'", of_mount},
        {told, "3 L", "scene.yaml:8:74: cost: found '3 L'", of_mount},
        {told, "-1 L/min", "scene.yaml:8:74: cost: found '-1 L/min'", of_mount},
        {told, "-1 EUR", "scene.yaml:8:74: cost: found '-1 EUR'", of_mount},
        {told, "1e9 EUR", "scene.yaml:8:74: cost: found '1e9 EUR'", of_mount},
        {told, "2e6 L/min", "scene.yaml:8:74: cost: found '2e6 L/min'", of_mount},
        {told, "[3 L/min]", "scene.yaml:8:74: cost: found a list of 1", of_mount},
        {"  water_cost: 30 EUR\n", "0 L/min", "scene.yaml:5:15: water_cost: found '30 EUR'", of_water},
        {"  water_cost: 30 L/min\n", "0 L/min", "scene.yaml:5:15: water_cost: found '30 L/min'", of_water},
        {"  water_cost: 30 EUR per kg\n", "0 L/min", "scene.yaml:5:15: water_cost: found '30 EUR per kg'", of_water},
        {"  water_cost: 0 EUR per L/min\n", "0 L/min", "scene.yaml:5:15: water_cost: found '0 EUR per L/min'",
         of_water},
        {"  water_cost: -3 EUR per L/min\n", "0 L/min", "scene.yaml:5:15: water_cost: found '-3 EUR per L/min'",
         of_water},
        {"  water_cost: {EUR: 3}\n", "0 L/min", "scene.yaml:5:15: water_cost: found a block of keys", of_water},
    };
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        sp_error error = {0};
        char text[1400], expected[400];
        assert_null(load(faults[i].water_cost, faults[i].cost, &error));
        snprintf(text, sizeof text, "%s:%d:%d: %s", error.file, error.line, error.column, error.message);
        snprintf(expected, sizeof expected, "%s%s", faults[i].found, faults[i].expected);
        assert_string_equal(text, expected);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(water_and_money_come_to_water),
        cmocka_unit_test(written_and_read_again),
        cmocka_unit_test(faults_are_reported_where_they_are),
    };
    return cmocka_run_group_tests_name("costs", tests, scratch_make, scratch_remove);
}
