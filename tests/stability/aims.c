/* What a placement is asked for at its limits: criteria that nothing or everything meets, all of the surface, no water,
 * one candidate. An answer, or an error that names the key. */
#include "../cli/workplace.h"

#define PLACE "place scene.yaml --quiet --set place.refine=none "
#define ONE_PORT                                                                                                       \
    "--set 'place.mounts=[{port: {name: P, position: [0.3 m, 0.3 m, 1 m], axis: [0, 0, -1], depth: {from: 300 mm, "    \
    "to: 300 mm, spacing: 200 mm}, types: [cone]}}]' "

/* The room's scene with one line changed. */
static void write_scene(const char *find, const char *replace)
{
    char text[4096];
    const char *at = strstr(room_yaml, find);
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - room_yaml), room_yaml, replace, at + strlen(find));
    write_file("scene.yaml", text);
}

#define CRITERION "criterion: {flux: 1 L/min/m2}\n"

/* The proposal's figure of that name; fails the test where there is none. */
static double proposed(json_t *object, const char *key)
{
    json_t *layouts = json_object_get(object, "layouts");
    json_t *layout = json_array_get(layouts, json_array_size(layouts) - 1);
    assert_string_equal(json_string_value(json_object_get(layout, "name")), "proposed");
    json_t *figure = json_object_get(layout, key);
    assert_non_null(figure);
    return json_number_value(figure);
}

static void everything_meets_it(void **state)
{
    (void)state;
    write_scene(CRITERION, "");
    json_t *object = expect_json(PLACE "--json --set 'place.coverage=100 %'", 0);
    assert_true(proposed(object, "coverage") > 1 - 1e-9);
    json_decref(object);
}

/* Aims at all that is attainable, which here is all but what is too slanted; and says that it is less. */
static void all_of_the_surface(void **state)
{
    (void)state;
    write_scene(CRITERION, "criterion: {flux: 1 L/min/m2, incidence: 60 deg}\n");
    /* the points of longer texels all lie where liquid is less slanted */
    json_t *object = expect_json(PLACE "--json --set 'place.coverage=100 %' --set 'simulate.texel=40 mm'", 4);
    double covered = proposed(object, "coverage");
    assert_true(covered > 0.3 && covered < 1);
    json_decref(object);
}

static void nothing_meets_it(void **state)
{
    (void)state;
    static const char *const criteria[] = {"{flux: 1e9 L/min/m2}", "{impact_speed: 1000 m/s}", "{incidence: 1e-9 deg}"};
    for (int i = 0; i < 3; i++) {
        char line[128];
        snprintf(line, sizeof line, "criterion: %s\n", criteria[i]);
        write_scene(CRITERION, line);
        outcome result = run_program(PLACE);
        print_message("%s: status %d, %s\n", criteria[i], result.status, result.err);
        assert_int_equal(result.status, 4);
        forget(&result);
    }
}

static void one_candidate(void **state)
{
    (void)state;
    write_scene(CRITERION, CRITERION);
    json_t *object = expect_json(PLACE ONE_PORT "--json --set 'place.coverage=10 %'", 0);
    assert_true(proposed(object, "water_l_min") > 11.9 && proposed(object, "water_l_min") < 12.1);
    assert_int_equal(json_integer_value(json_object_get(json_object_get(object, "certificate"), "candidates")), 1);
    json_decref(object);
}

static void no_water(void **state)
{
    (void)state;
    static const struct {
        const char *arguments, *names;
    } cases[] = {{PLACE "--set 'place.max_water=0 L/min'", "max_water"},
                 {PLACE "--set place.max_nozzles=0", "max_nozzles"},
                 {"simulate none.yaml", "nozzles: found none"}};
    write_file("none.yaml", "geometry: [{file: room.obj}]\ncatalogue: catalogue.yaml\nnozzles: []\n");
    write_scene(CRITERION, CRITERION);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        outcome result = run_program(cases[i].arguments);
        print_message("%s", result.err);
        assert_int_equal(result.status, 3);
        assert_non_null(strstr(result.err, cases[i].names));
        forget(&result);
    }
    write_file("dry.yaml",
               "nozzles:\n  - {name: cone, pattern: full_cone, angle: 120 deg, flow: 0 L/min, at: 2 bar}\n");
    write_scene("catalogue: catalogue.yaml", "catalogue: dry.yaml");
    outcome result = run_program("simulate scene.yaml");
    assert_int_equal(result.status, 3);
    assert_non_null(strstr(result.err, "dry.yaml:2:"));
    assert_non_null(strstr(result.err, "flow: found '0 L/min'"));
    forget(&result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_meets_it), cmocka_unit_test(all_of_the_surface), cmocka_unit_test(nothing_meets_it),
        cmocka_unit_test(one_candidate),       cmocka_unit_test(no_water),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
