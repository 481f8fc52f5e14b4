/* The page says where a changed layout is none that the scene allows: types that do not fit, too many nozzles. */
#include "browser.h"

static const char types_yaml[] =
    "nozzles:\n"
    "  - {name: wide, pattern: full_cone, angle: 120 deg, flow: 12 L/min, at: 2 bar, body: 30 mm}\n"
    "  - {name: slim, pattern: full_cone, angle: 120 deg, flow: 12 L/min, at: 2 bar, body: 20 mm}\n";

static const char scene_yaml[] =
    "geometry:\n"
    "  - file: room.obj\n"
    "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
    "criterion: {flux: 1 L/min/m2}\n"
    "catalogue: types.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: wide, position: [0.7 m, 0.7 m, 0.8 m], axis: [0, 0, -1], pressure: 2 bar}\n"
    "  - {name: N2, type: wide, position: [0.5 m, 0.2 m, 0.7 m], axis: [0, 0, -1], pressure: 2 bar, keep: true}\n"
    "simulate: {texel: " ROOM_TEXEL "}\n"
    "place:\n"
    "  max_nozzles: 4\n"
    "  pressure: 2 bar\n"
    "  mounts:\n"
    "    - port: {name: narrow, position: [0.3 m, 0.3 m, 1 m], axis: [0, 0, -1], bore: 25 mm, depth: {from: 100 mm, "
    "to: 500 mm, spacing: 200 mm}}\n"
    "    - port: {name: narrower, position: [0.3 m, 0.7 m, 1 m], axis: [0, 0, -1], bore: 15 mm, depth: {from: 100 mm, "
    "to: 500 mm, spacing: 200 mm}}\n"
    "    - port: {name: open, position: [0.7 m, 0.7 m, 1 m], axis: [0, 0, -1], depth: {from: 100 mm, to: 500 mm, "
    "spacing: 200 mm}}\n"
    "    - line: {name: rail, from: [0.2 m, 0.2 m, 0.7 m], to: [0.8 m, 0.2 m, 0.7 m], spacing: 100 mm, max_nozzles: "
    "1}\n";

static json_t *found;

static int ask_the_page(void **state)
{
    if (open_workplace(state) != 0)
        return -1;
    write_file("types.yaml", types_yaml);
    write_file("limits.yaml", scene_yaml);
    found = ask_page("limits");
    return 0;
}

static int put_away(void **state)
{
    json_decref(found);
    return close_workplace(state);
}

static const char *text_of(const char *step, const char *key)
{
    const char *text = json_string_value(json_object_get(json_object_get(json_object_get(found, "steps"), step), key));
    assert_non_null(text);
    return text;
}

static void expect_said(const char *step, const char *words)
{
    if (!strstr(text_of(step, "said"), words))
        fail_msg("%s: said %s, expected %s", step, text_of(step, "said"), words);
}

static void expect_not_said(const char *step, const char *words)
{
    if (strstr(text_of(step, "said"), words))
        fail_msg("%s: said %s, expected no %s", step, text_of(step, "said"), words);
}

/* As the program does of the scene that is saved then. */
static void expect_refused(const char *step, bool refused)
{
    write_file("limits/changed.yaml", text_of(step, "scene"));
    outcome result = run_program("simulate limits/changed.yaml --quiet");
    assert_int_equal(result.status != 0, refused);
    assert_true(!refused || strstr(result.err, "is 30 mm wide, expected no more than the bore of port narrow"));
    forget(&result);
}

static void it_opens_without_requests_or_messages(void **state)
{
    (void)state;
    skip_unless_evaluating(found);
    assert_opened(found);
}

/* The only type that passes is taken, and no other is offered. */
static void a_type_that_passes_is_taken_in_a_narrow_port(void **state)
{
    (void)state;
    skip_unless_evaluating(found);
    const json_t *narrow = json_object_get(json_object_get(found, "steps"), "narrow");
    assert_string_equal(text_of("start", "type"), "wide");
    assert_string_equal(text_of("narrow", "type"), "slim");
    assert_int_equal(json_array_size(json_object_get(narrow, "types")), 1);
    expect_not_said("narrow", "does not fit");
    expect_refused("narrow", false);
}

/* Where no type passes, or one is left in the port as if it were anywhere. */
static void a_type_that_does_not_pass_is_reported(void **state)
{
    (void)state;
    skip_unless_evaluating(found);
    expect_not_said("leftThere", "does not fit");
    expect_said("wide", "N1, of type wide, does not fit port narrow.");
    expect_refused("wide", true);
    expect_said("narrower", "N1, of type wide, does not fit port narrower.");
    expect_refused("narrower", true);
    expect_not_said("open", "does not fit");
    expect_refused("open", false);
}

/* N2 is kept and does not count on the rail, as it does among all. */
static void too_many_nozzles_are_reported(void **state)
{
    (void)state;
    skip_unless_evaluating(found);
    expect_not_said("open", "holds");
    expect_said("two", "Port open holds 2 nozzles, and takes 1.");
    expect_not_said("rail", "Line rail holds");
    expect_not_said("rail", "max_nozzles");
    expect_said("crowd", "Line rail holds 2 nozzles besides kept ones, and takes 1.");
    expect_said("crowd", "These are 5 nozzles, and max_nozzles allows 4.");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_opens_without_requests_or_messages),
        cmocka_unit_test(a_type_that_passes_is_taken_in_a_narrow_port),
        cmocka_unit_test(a_type_that_does_not_pass_is_reported),
        cmocka_unit_test(too_many_nozzles_are_reported),
    };
    return cmocka_run_group_tests(tests, ask_the_page, put_away);
}
