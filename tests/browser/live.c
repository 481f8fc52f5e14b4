/* The report's page evaluates layouts as the program does, and says so to who listens. */
#include "browser.h"

#include <sprayplan/sprayplan.h>

#include <math.h>

#define TOLERANCE 1e-9
#define BUDGET "--window-size=1200,900 --virtual-time-budget=600000 --dump-dom"

static json_t *found;
static bool carried; /* this build makes pages that evaluate */

static int use_the_page(void **state)
{
    if (place_once(state) != 0)
        return -1;
    carried = can_evaluate("placed/report.html");
    if (!carried)
        return 0;
    found = read_with("live.js", "placed/report.html", BUDGET);
    return found ? 0 : -1;
}

static int put_away(void **state)
{
    json_decref(found);
    return close_workplace(state);
}

static const json_t *step(const char *name)
{
    const json_t *step = json_object_get(json_object_get(found, "steps"), name);
    assert_non_null(step);
    return step;
}

static double coverage_of(const char *name)
{
    return json_number_value(json_object_get(step(name), "coverage"));
}

static void it_opens_without_requests_or_messages(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    assert_opened(found);
}

/* Of the layout at `index` of a result, which it takes. */
static double coverage_in(json_t *result, size_t index)
{
    const json_t *layout = json_array_get(json_object_get(result, "layouts"), index);
    double coverage = json_number_value(json_object_get(layout, "coverage"));
    json_decref(result);
    return coverage;
}

static void the_reports_layout_covers_what_it_says(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    char path[1024];
    snprintf(path, sizeof path, "%s/placed/result.json", workplace);
    double coverage = coverage_in(json_load_file(path, 0, NULL), 2);
    assert_true(coverage > 0.5);
    assert_float_equal(coverage_of("start"), coverage, TOLERANCE);
}

static void a_changed_layout_covers_what_the_program_finds(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    static const char *const changes[] = {"moved", "turned", "pressed", "added", "typed", "placed"};
    const char *before = json_string_value(json_object_get(step("start"), "scene"));
    assert_float_equal(coverage_of("off"), 0, 0); /* the only one */
    assert_true(coverage_of("moved") != coverage_of("start") && coverage_of("typed") != coverage_of("added"));
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        const char *scene = json_string_value(json_object_get(step(changes[i]), "scene"));
        assert_string_not_equal(scene, before);
        before = scene;
        write_file("placed/changed.yaml", scene);
        json_t *result = expect_json("simulate placed/changed.yaml --json", 0);
        assert_float_equal(coverage_of(changes[i]), coverage_in(result, 0), TOLERANCE);
    }
}

static void the_saved_scene_can_be_placed_on(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    write_file("placed/changed.yaml", json_string_value(json_object_get(step("placed"), "scene")));
    json_decref(expect_json("place placed/changed.yaml --json --time-limit 20", 0));
}

static void only_what_moved_is_traced(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    static const struct {
        const char *change;
        int traced;
    } expected[] = {{"moved", 1}, {"turned", 0}, {"pressed", 1}, {"off", 0}, {"undone", 0}, {"added", 1}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        assert_int_equal(json_integer_value(json_object_get(step(expected[i].change), "traced")), expected[i].traced);
}

static void undo_brings_back_what_was(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    assert_float_equal(coverage_of("undone"), coverage_of("pressed"), 0);
    assert_string_equal(json_string_value(json_object_get(step("undone"), "scene")),
                        json_string_value(json_object_get(step("pressed"), "scene")));
}

static const char *text_of(const char *name, const char *key)
{
    return json_string_value(json_object_get(step(name), key));
}

/* What the table compares with, and what the list says, is part of what comes back. */
static void undo_brings_back_the_start(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    assert_string_equal(text_of("placed", "from"), "Proposed");
    assert_string_equal(text_of("placed", "head"), "LayoutProposedYours");
    assert_string_equal(text_of("anew", "from"), "Manual");
    assert_string_equal(text_of("anew", "head"), "LayoutManualYours");
    static const char *const keys[] = {"from", "head", "figures", "scene"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        assert_string_equal(text_of("returned", keys[i]), text_of("placed", keys[i]));
}

static json_int_t nozzles_after(const char *name)
{
    return json_integer_value(json_object_get(step(name), "nozzles"));
}

/* However soon one follows another; of a slider that is drawn alone all steps come back at once. */
static void each_action_is_undone_by_itself(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    assert_int_equal(nozzles_after("twice"), nozzles_after("returned") + 2);
    assert_non_null(strstr(json_string_value(json_object_get(step("twice"), "said")),
                           " stand in one place: their bodies overlap."));
    assert_int_equal(nozzles_after("once"), nozzles_after("returned") + 1);
    assert_true(json_is_true(json_object_get(found, "isOff")));
    assert_string_not_equal(text_of("drawn", "scene"), text_of("on", "scene"));
    assert_string_equal(text_of("undrawn", "scene"), text_of("on", "scene"));
}

static void it_says_what_comes_of_it(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    char percent[32];
    snprintf(percent, sizeof percent, "Coverage %.2f %%", 100 * coverage_of("moved"));
    const char *said = json_string_value(json_object_get(step("moved"), "said"));
    if (!strstr(said, percent))
        fail_msg("said %s, expected %s", said, percent);
    assert_true(json_is_true(json_object_get(found, "reachable")));
    assert_int_equal(json_integer_value(json_object_get(found, "shown")), 3);
}

static void boxes_come_and_go(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    const json_t *boxes = json_object_get(found, "boxes");
    assert_int_equal(json_array_size(boxes), 3);
    assert_false(json_equal(json_array_get(boxes, 0), json_array_get(boxes, 1)));
    assert_true(json_equal(json_array_get(boxes, 0), json_array_get(boxes, 2)));
    assert_non_null(strstr(json_string_value(json_object_get(found, "said")), "Boxes"));
}

static void the_changed_layout_has_jets(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    const json_t *jets = json_object_get(found, "jets");
    assert_int_equal(json_array_size(jets), 2);
    assert_false(json_equal(json_array_get(jets, 0), json_array_get(jets, 1)));
}

/* A layout without nozzles is evaluated, and is no scene. */
static void without_nozzles_nothing_is_saved(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    const char *figures = json_string_value(json_object_get(step("off"), "figures"));
    if (!figures || !strstr(figures, "0.00 %") || strstr(figures, "NaN"))
        fail_msg("found %s", figures);
    assert_non_null(strstr(json_string_value(json_object_get(found, "savedWithout")), "no layout to save"));
}

/* The viewer as ever, and nothing that was to be evaluated. */
static void without_webassembly_it_is_a_viewer(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    write_page_with_reader("placed/report.html", "<script>delete window.WebAssembly</script>", "viewer.js");
    char *page = browse("read.html", BUDGET);
    json_t *seen = what_was_told(page);
    assert_string_equal(json_string_value(json_object_get(seen, "ready")), "true");
    assert_int_equal(json_array_size(json_object_get(seen, "errors")), 0);
    assert_null(strstr(page, "id=\"live\""));
    json_decref(seen);
    free(page);
}

static void without_it_the_page_is_smaller(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    outcome result = run_program("simulate room.yaml -o plain --quiet --no-live");
    assert_int_equal(result.status, 0);
    forget(&result);
    char *page = read_file("plain/report.html", NULL);
    assert_non_null(strstr(page, "id=\"viewer-model\""));
    assert_null(strstr(page, "id=\"live-module\""));
    assert_null(strstr(page, "wasm-unsafe-eval"));
    assert_null(strstr(page, "not-live"));
    free(page);
}

/* It never evaluates by less than the program did. */
static void by_jets_it_says_that_it_does_not(void **state)
{
    (void)state;
    skip_unless_evaluating(carried);
    outcome result = run_program("simulate room.yaml -o jets --quiet --set simulate.evaluator=forward --set "
                                 "simulate.jets=2000");
    assert_int_equal(result.status, 0);
    forget(&result);
    char *page = read_file("jets/report.html", NULL);
    assert_non_null(strstr(page, "id=\"not-live\""));
    assert_null(strstr(page, "id=\"live-module\""));
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_opens_without_requests_or_messages),
        cmocka_unit_test(the_reports_layout_covers_what_it_says),
        cmocka_unit_test(a_changed_layout_covers_what_the_program_finds),
        cmocka_unit_test(the_saved_scene_can_be_placed_on),
        cmocka_unit_test(only_what_moved_is_traced),
        cmocka_unit_test(undo_brings_back_what_was),
        cmocka_unit_test(undo_brings_back_the_start),
        cmocka_unit_test(each_action_is_undone_by_itself),
        cmocka_unit_test(it_says_what_comes_of_it),
        cmocka_unit_test(boxes_come_and_go),
        cmocka_unit_test(the_changed_layout_has_jets),
        cmocka_unit_test(without_nozzles_nothing_is_saved),
        cmocka_unit_test(without_webassembly_it_is_a_viewer),
        cmocka_unit_test(without_it_the_page_is_smaller),
        cmocka_unit_test(by_jets_it_says_that_it_does_not),
    };
    return cmocka_run_group_tests(tests, use_the_page, put_away);
}
