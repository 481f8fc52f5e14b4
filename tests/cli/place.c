/* sprayplan place on a small room: figures, files, exit status, and the same bytes for any number of threads. */
#include "results.h"

#include <math.h>

static void kept_nozzles_beyond_the_limits_are_named_as_the_cause(void **state)
{
    (void)state;
    char scene[sizeof room_yaml + 64];
    const char *at = strstr(room_yaml, "pressure: 2 bar}");
    snprintf(scene, sizeof scene, "%.*skeep: true, %s", (int)(at - room_yaml), room_yaml, at);
    write_file("kept.yaml", scene);
    outcome result = run_program("place kept.yaml --set 'place.max_water=5 L/min' --set 'place.coverage=100 %'");
    assert_int_equal(result.status, 4);
    assert_non_null(strstr(result.err, "the nozzles to keep"));
    assert_non_null(strstr(result.err, "max_water allows no nozzle besides those to keep: with these the least of "
                                       "those that are allowed takes 19 L/min more\n"));
    forget(&result);
    result = run_program("place kept.yaml --set 'place.max_water=5 L/min' --set 'place.coverage=1 %' -o kept");
    assert_int_equal(result.status, 4);
    assert_non_null(strstr(result.err, "the nozzles to keep"));
    forget(&result);
    char *report = read_file("kept/report.html", NULL);
    assert_non_null(strstr(report, "The nozzles to keep are more"));
    assert_null(strstr(report, "is not reached"));
    free(report);
}

/* 12 L/min are kept, and the least further nozzle takes as much. */
static void what_kept_nozzles_leave_may_be_too_little(void **state)
{
    (void)state;
    char scene[sizeof room_yaml + 64];
    const char *at = strstr(room_yaml, "pressure: 2 bar}");
    snprintf(scene, sizeof scene, "%.*skeep: true, %s", (int)(at - room_yaml), room_yaml, at);
    write_file("kept.yaml", scene);
    outcome result = run_program("place kept.yaml --set 'place.max_water=20 L/min' -o little " COARSE);
    assert_int_equal(result.status, 4);
    assert_null(strstr(result.err, "the nozzles to keep are more"));
    assert_non_null(strstr(result.err, "with these the least of those that are allowed takes 4 L/min more\n"));
    assert_non_null(strstr(result.err, "% of the surface"));
    forget(&result);
    char *report = read_file("little/report.html", NULL);
    assert_non_null(strstr(report, "No further nozzle is allowed.</strong> max_water is less than the nozzles to keep "
                                   "and any further one take together, by 4.00&nbsp;L/min."));
    free(report);
}

/* What simulate tells of how far the layout that was written is off, place has told of it: also what is proved of
 * lines.
 */
static void the_error_is_that_of_the_layout_written(void **state)
{
    (void)state;
    ensure("lines", "place room.yaml --set simulate.trajectory=line --set place.refine=none " COARSE);
    json_t *placed = json_file("lines/result.json"), *proposed = layout_named(placed, "proposed");
    json_t *again = expect_json("simulate lines/layout.yaml --json", 0), *one = layout_named(again, "manual");
    static const char *const told[] = {"error_estimate", "misjudged", "error_bound", "borderline_m2"};
    for (size_t i = 0; i < sizeof told / sizeof *told; i++)
        assert_true(number(proposed, told[i]) == number(one, told[i]));
    assert_true(number(json_object_get(placed, "fidelity"), "error_bound") >= number(one, "error_bound"));
    json_decref(placed);
    json_decref(again);
}

static void where_nothing_can_be_covered_place_says_so(void **state)
{
    (void)state;
    char scene[sizeof room_yaml + 64];
    const char *at = strstr(room_yaml, "flux: 1 L/min/m2");
    snprintf(scene, sizeof scene, "%.*sflux: 1e6 L/min/m2%s", (int)(at - room_yaml), room_yaml,
             at + strlen("flux: 1 L/min/m2"));
    write_file("dry.yaml", scene);
    outcome result = run_program("place dry.yaml -o dry --quiet");
    assert_int_equal(result.status, 4);
    assert_non_null(strstr(result.err, "covers anything"));
    forget(&result);
    char *report = read_file("dry/report.html", NULL);
    assert_non_null(strstr(report, "Nothing can be covered"));
    free(report);
    outcome again = run_program("check dry/layout.yaml --quiet");
    assert_int_equal(again.status, 0);
    forget(&again);
    json_t *placed = json_file("dry/result.json"), *proposed = layout_named(placed, "proposed"),
           *simulated = expect_json("simulate dry/layout.yaml -o dry-again --json", 0),
           *none = layout_named(simulated, "manual");
    static const char *const same[] = {"coverage", "water_l_min", "error_estimate"};
    assert_true(number(proposed, "coverage") == 0);
    for (size_t i = 0; i < sizeof same / sizeof *same; i++)
        assert_true(number(proposed, same[i]) == number(none, same[i]));
    json_decref(simulated);
    json_decref(placed);
}

static void same_file(const char *a, const char *b, const char *name)
{
    char path[2][256];
    size_t size[2];
    snprintf(path[0], sizeof path[0], "%s/%s", a, name);
    snprintf(path[1], sizeof path[1], "%s/%s", b, name);
    char *first = read_file(path[0], &size[0]), *second = read_file(path[1], &size[1]);
    assert_non_null(first);
    assert_non_null(second);
    if (size[0] != size[1] || memcmp(first, second, size[0]) != 0)
        fail_msg("%s and %s differ", path[0], path[1]);
    free(first);
    free(second);
}

/* All that place writes, for one thread and for three: the same bytes, measured times aside. */
static void place_gives_the_same_bytes_for_any_number_of_threads(void **state)
{
    (void)state;
    if (!COMPARES_THREADS)
        skip();
    ensure("one", "place room.yaml --threads 1");
    ensure("three", "place room.yaml --threads 3");
    static const char *const files[] = {
        "layout.yaml",         "nozzles.csv",         "coverage.png",     "deposits.exr",        "model.glb",
        "coverage-manual.png", "deposits-manual.exr", "model-manual.glb", "coverage-greedy.png", "deposits-greedy.exr",
        "model-greedy.glb",    "surface.vtp",         "texels.vtp",       "nozzles.stl",         "swabs.csv",
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i)
        same_file("one", "three", files[i]);
    json_t *a = json_file("one/result.json"), *b = json_file("three/result.json");
    assert_int_equal(json_object_del(a, "stages"), 0);
    assert_int_equal(json_object_del(b, "stages"), 0);
    assert_true(json_equal(a, b));
    json_decref(a);
    json_decref(b);
}

/* The proposal is at least as good as what it was made from, and simulating the layout.yaml that was written, from
 * another folder, gives its figures back. */
static void the_written_layout_gives_the_same_figures(void **state)
{
    (void)state;
    ensure("one", "place room.yaml --threads 1");
    json_t *placed = json_file("one/result.json");
    json_t *again = expect_json("simulate one/layout.yaml --json", 0);
    json_t *proposed = layout_named(placed, "proposed"), *manual = layout_named(again, "manual");
    static const char *const same[] = {"water_l_min",    "covered_area_m2", "coverage",     "area_per_water",
                                       "error_estimate", "misjudged",       "borderline_m2"};
    for (size_t i = 0; i < sizeof same / sizeof *same; ++i)
        assert_true(number(proposed, same[i]) == number(manual, same[i]));
    assert_true(json_equal(json_object_get(proposed, "flux_l_min_m2"), json_object_get(manual, "flux_l_min_m2")));
    assert_true(json_equal(json_object_get(proposed, "nozzles"), json_object_get(manual, "nozzles")));
    json_t *fidelity[2] = {json_object_get(placed, "fidelity"), json_object_get(again, "fidelity")};
    assert_int_equal(json_object_del(fidelity[0], "auto"), 0); /* of which the layout leaves nothing */
    for (int i = 0; i < 2; i++) {                              /* these are of the worst of all layouts reported */
        assert_true(number(fidelity[i], "error_estimate") >= number(proposed, "error_estimate"));
        assert_int_equal(json_object_del(fidelity[i], "error_estimate"), 0);
        assert_int_equal(json_object_del(fidelity[i], "misjudged"), 0);
    }
    assert_true(json_equal(fidelity[0], fidelity[1]));
    json_decref(placed);
    json_decref(again);
}

static void place_says_whether_the_coverage_asked_for_is_reached(void **state)
{
    (void)state;
    json_decref(expect_json("place room.yaml --json --set 'place.coverage=20 %'", 0));
    json_t *object = expect_json("place room.yaml --json --set place.max_nozzles=1 --set 'place.coverage=100 %' "
                                 "--set 'place.max_water=13 L/min'",
                                 4);
    json_t *proposed = layout_named(object, "proposed");
    assert_int_equal(json_array_size(json_object_get(proposed, "nozzles")), 1);
    assert_true(number(proposed, "water_l_min") <= 13);
    json_t *check = json_object_get(object, "forward_check");
    assert_true(json_is_true(json_object_get(check, "agrees")));
    assert_true(fabs(number(check, "coverage") - number(proposed, "coverage")) < 0.01);
    json_decref(object);
}

/* As much is asked for as one nozzle brings to little of the room. */
static void limits_are_named_where_they_bind(void **state)
{
    (void)state;
    write_room_with("thirsty.yaml", "{flux: 1 L/min/m2}", "{flux: 20 L/min/m2}");
    outcome result = run_program("place thirsty.yaml --set place.max_nozzles=1 --set place.refine=none");
    assert_non_null(strstr(result.out, "\n  too far for the flux: with no more than 1 nozzle (max_nozzles); more may "
                                       "reach more\n"));
    forget(&result);
    write_room_with("thirsty.yaml", "{flux: 1 L/min/m2}", "{impact_speed: 1 m/s}");
    result = run_program("place thirsty.yaml --set 'place.max_water=1 L/min' -o thirsty");
    assert_non_null(strstr(result.out, "\n  beyond the limits: with no more than 4 nozzles (max_nozzles) and 1 L/min "
                                       "(max_water); more may reach more\n"));
    assert_null(strstr(result.out, "flux"));
    forget(&result);
    char *report = read_file("thirsty/report.html", NULL);
    assert_non_null(strstr(report, "beyond the limits"));
    assert_null(strstr(report, "too far for the flux"));
    free(report);
}

/* What the page says of them where the coverage asked for is not reached. */
static void expect_limits(const char *settings, const char *expected)
{
    char line[256];
    snprintf(line, sizeof line, "place limited.yaml " COARSE " --set place.refine=none -o limited --quiet %s",
             settings);
    outcome done = run_program(line);
    assert_int_equal(done.status, 4);
    forget(&done);
    char *page = read_file("limited/report.html", NULL);
    const char *asked = strstr(page, ") were asked for");
    assert_non_null(asked);
    assert_memory_equal(asked, expected, strlen(expected));
    free(page);
}

static void limits_that_there_are_not_are_not_named(void **state)
{
    (void)state;
    char scene[sizeof room_yaml + 256];
    const char *limit = strstr(room_yaml, "  max_nozzles");
    snprintf(scene, sizeof scene,
             "%.*s  pressure: 2 bar\n  types: [cone]\n  mounts:\n    - box: {min: [0.5, 0.5, 0.8], max: [0.5, 0.5, "
             "0.8], spacing: 1 m}\n",
             (int)(limit - room_yaml), room_yaml);
    write_file("limited.yaml", scene);
    expect_limits("", ") were asked for; ");
    expect_limits("--set place.max_nozzles=2", ") were asked for with no more than 2 nozzles (max_nozzles); ");
    strcat(scene, "    - port: {name: P1, position: [0.3 m, 0.3 m, 0.9 m], axis: [0, 0, -1]}\n");
    write_file("limited.yaml", scene);
    expect_limits("", ") were asked for with one nozzle in a port at most; ");
    expect_limits("--set place.max_nozzles=2",
                  ") were asked for with no more than 2 nozzles (max_nozzles), and one nozzle in a port at most; ");
}

/* More is asked for than what arrives so steeply allows: what is out of reach comes first, the proposal aims at the
 * share asked for of the rest, and place exits 4. */
static void what_cannot_be_reached_is_said_first(void **state)
{
    (void)state;
    write_room_with("steep.yaml", "{flux: 1 L/min/m2}", "{flux: 1 L/min/m2, incidence: 40 deg}");
    outcome result = run_program("place steep.yaml -o steep");
    assert_int_equal(result.status, 4);
    assert_ptr_equal(strstr(result.out, "out of reach of every allowed nozzle: "), result.out);
    assert_non_null(strstr(result.out, "too slanted: walls "));
    assert_non_null(strstr(result.err, "90 % of the surface was asked for, of which no more than "));
    forget(&result);

    json_t *all = json_file("steep/result.json"), *geometry = json_object_get(all, "geometry");
    json_t *target = json_object_get(all, "target"), *part;
    double clean = number(geometry, "clean_area_m2"), attainable = number(geometry, "attainable_area_m2"), missing = 0;
    size_t i;
    json_array_foreach(json_object_get(geometry, "unattainable_by_part"), i, part) missing += number(part, "area_m2");
    assert_true(attainable < 0.9 * clean && fabs(clean - attainable - missing) < 1e-9);
    assert_true(fabs(number(target, "coverage") - 0.9) < 1e-12);
    assert_true(number(target, "coverage_aimed_at") <= 0.9 * attainable / clean + 1e-12);
    assert_true(json_is_false(json_object_get(target, "reached")));
    json_t *proposed = layout_named(all, "proposed");
    assert_true(fabs(number(proposed, "coverage") - number(proposed, "covered_area_m2") / clean) < 1e-12);
    assert_true(fabs(number(proposed, "coverage_of_attainable") - number(proposed, "covered_area_m2") / attainable) <
                1e-12);
    json_decref(all);
}

/* What is asked for is of the whole surface; with as much attainable it is the target, and reaching it exits 0. */
static void what_can_be_reached_is_the_target(void **state)
{
    (void)state;
    write_room_with("steep.yaml", "{flux: 1 L/min/m2}", "{flux: 1 L/min/m2, incidence: 40 deg}");
    json_t *all = expect_json("place steep.yaml --json --set 'place.coverage=20 %'", 0);
    json_t *target = json_object_get(all, "target");
    assert_true(number(target, "coverage_aimed_at") == number(target, "coverage"));
    assert_true(number(layout_named(all, "proposed"), "coverage") >= 0.2);
    assert_true(json_is_true(json_object_get(target, "reached")));
    json_decref(all);
}

/* By scene, by result, by report: a layout has one coverage. */
static void a_layout_has_one_coverage_wherever_it_is_read(void **state)
{
    (void)state;
    write_room_with("steep.yaml", "{flux: 1 L/min/m2}", "{flux: 1 L/min/m2, incidence: 40 deg}");
    ensure("steep", "place steep.yaml");
    json_t *placed = json_file("steep/result.json");
    double coverage = number(layout_named(placed, "proposed"), "coverage");
    json_t *all = expect_json("compare steep/layout.yaml steep/result.json --json", 0), *layout;
    size_t i, found = 0;
    json_array_foreach(json_object_get(all, "layouts"), i, layout)
    {
        const char *name = json_string_value(json_object_get(layout, "name"));
        if (!strstr(name, "layout.yaml") && !strstr(name, "proposed"))
            continue;
        assert_true(number(layout, "coverage") == coverage);
        found++;
    }
    assert_int_equal(found, 2);
    outcome result = run_program("compare steep/layout.yaml steep/result.json -o both --quiet");
    assert_int_equal(result.status, 0);
    forget(&result);
    char percent[64], row[512];
    snprintf(percent, sizeof percent, ">%.1f&nbsp;\xc2\xb1", 100 * coverage);
    row_of("steep", "Coverage of the surface to be cleaned", row);
    assert_non_null(strstr(row, percent));
    row_of("both", "Coverage of the surface to be cleaned", row);
    const char *first = strstr(row, percent);
    assert_true(first && strstr(first + 1, percent));
    snprintf(percent, sizeof percent, "covers <strong>%.1f&nbsp;%%", 100 * coverage);
    row_of("steep", "<p class=\"headline\">", row);
    assert_non_null(strstr(row, percent));
    json_decref(placed);
    json_decref(all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kept_nozzles_beyond_the_limits_are_named_as_the_cause),
        cmocka_unit_test(what_kept_nozzles_leave_may_be_too_little),
        cmocka_unit_test(the_error_is_that_of_the_layout_written),
        cmocka_unit_test(where_nothing_can_be_covered_place_says_so),
        cmocka_unit_test(place_gives_the_same_bytes_for_any_number_of_threads),
        cmocka_unit_test(the_written_layout_gives_the_same_figures),
        cmocka_unit_test(place_says_whether_the_coverage_asked_for_is_reached),
        cmocka_unit_test(limits_are_named_where_they_bind),
        cmocka_unit_test(limits_that_there_are_not_are_not_named),
        cmocka_unit_test(what_cannot_be_reached_is_said_first),
        cmocka_unit_test(what_can_be_reached_is_the_target),
        cmocka_unit_test(a_layout_has_one_coverage_wherever_it_is_read),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
