/* Goods that pass a few nozzles, as their user runs them: check, place for any number of threads, and what it wrote. */
#include "results.h"

static const char crate_obj[] = "v -0.2 -0.2 0\nv 0.2 -0.2 0\nv 0.2 0.2 0\nv -0.2 0.2 0\n"
                                "v -0.2 -0.2 0.3\nv 0.2 -0.2 0.3\nv 0.2 0.2 0.3\nv -0.2 0.2 0.3\n"
                                "g bottom\nf 4 3 2 1\ng top\nf 5 6 7 8\n"
                                "g sides\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

static const char belt_yaml[] =
    "geometry:\n"
    "  - file: crate.obj\n"
    "    clean_parts: [top, sides]\n"
    "    sweep: {from: [-0.6 m, 0 m, 0 m], to: [0.6 m, 0 m, 0 m], speed: 6 m/min}\n"
    "cavity: outside\n"
    "criterion: {dose: 1 L/m2, incidence: 80 deg}\n"
    "catalogue: catalogue.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: cone, position: [0 m, 0 m, 0.7 m], axis: [0, 0, -1], pressure: 2 bar}\n"
    "simulate: {texel: 90 mm}\n"
    "place:\n"
    "  objective: max_coverage\n"
    "  max_water: 36 L/min\n"
    "  coverage: 30 %\n"
    "  types: [cone]\n"
    "  pressure: 2 bar\n"
    "  mounts:\n"
    "    - line: {from: [0 m, -0.6 m, 0.7 m], to: [0 m, 0.6 m, 0.7 m], spacing: 400 mm, axis: [0, 0, -1], tilt: 40 "
    "deg}\n";

static int open_belt(void **state)
{
    if (open_workplace(state))
        return -1;
    write_file("crate.obj", crate_obj);
    write_file("belt.yaml", belt_yaml);
    return 0;
}

/* The pass takes 1.2 m at 0.1 m/s; liquid that lands on what is cleaned is the mean dose on all of it. */
static void doses_are_reported(void **state)
{
    (void)state;
    json_t *object = expect_json("simulate belt.yaml --set simulate.texel=40mm -o belt --json", 0),
           *own = layout_named(object, "manual");
    double area = number(json_object_get(object, "geometry"), "clean_area_m2"), pass = number(own, "pass_s");
    double landed = number(json_object_get(own, "liquid_l_min"), "on_clean_surface") / 60;
    double dose = number(json_object_get(own, "dose_l_m2"), "mean");
    assert_true(pass > 11.999 && pass < 12.001);
    if (!(dose > 0 && dose * area < 1.03 * landed * pass && dose * area > 0.97 * landed * pass))
        fail_msg("%g L/m2 on %g m2, of %g L/s in %g s", dose, area, landed, pass);
    char *report = read_file("belt/report.html", NULL);
    assert_non_null(strstr(report, "a dose of at least 1&nbsp;L per m"));
    assert_non_null(strstr(report, "move 1.2&nbsp;m past the nozzles at 0.1&nbsp;m/s"));
    assert_non_null(strstr(report, "for a test on the goods to show"));
    free(report);
    json_decref(object);
}

/* The same crate that stands is no goods. */
static void what_stands_is_called_a_machine(void **state)
{
    (void)state;
    write_file("stands.yaml", "geometry: [{file: crate.obj}]\ncavity: outside\ncriterion: {flux: 1 L/min/m2}\n"
                              "catalogue: catalogue.yaml\nnozzles:\n  - {name: N1, type: cone, position: [0 m, 0 m, "
                              "0.7 m], axis: [0, 0, -1], pressure: 2 bar}\nsimulate: {texel: 90 mm}\n");
    outcome done = run_program("simulate stands.yaml -o stands --quiet --no-live");
    assert_int_equal(done.status, 0);
    forget(&done);
    char *report = read_file("stands/report.html", NULL);
    assert_non_null(strstr(report, "for a test on the machine to show"));
    free(report);
}

static void goods_are_placed_for_whatever_the_threads(void **state)
{
    (void)state;
    json_t *object = expect_json("place belt.yaml --threads 1 -o one --json", 0),
           *proposed = layout_named(object, "proposed");
    assert_true(number(proposed, "coverage") > number(layout_named(object, "manual"), "coverage") + 0.1);
    json_t *again = expect_json("simulate one/layout.yaml --json", 0);
    assert_true(number(layout_named(again, "manual"), "coverage") == number(proposed, "coverage"));
    json_decref(again);
    json_t *more = expect_again(object, "place belt.yaml --threads 3 --json", 0);
    assert_true(json_equal(layout_named(more, "proposed"), proposed));
    assert_true(json_equal(json_object_get(more, "certificate"), json_object_get(object, "certificate")));
    json_decref(more);
    json_decref(object);
}

/* Out of time it is not known what is attainable, and no coverage is told as a share of it. */
static void what_was_not_looked_into_is_no_measure(void **state)
{
    (void)state;
    json_t *object = expect_json("place belt.yaml --time-limit 0.001 --json", 4),
           *proposed = layout_named(object, "proposed");
    assert_true(json_array_size(json_object_get(proposed, "nozzles")) == 1);
    assert_null(json_object_get(proposed, "coverage_of_attainable"));
    assert_null(json_object_get(json_object_get(object, "geometry"), "unattainable_m2"));
    assert_true(number(proposed, "coverage") > 0);
    json_decref(object);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(doses_are_reported),
        cmocka_unit_test(what_stands_is_called_a_machine),
        cmocka_unit_test(goods_are_placed_for_whatever_the_threads),
        cmocka_unit_test(what_was_not_looked_into_is_no_measure),
    };
    return cmocka_run_group_tests(tests, open_belt, close_workplace);
}
