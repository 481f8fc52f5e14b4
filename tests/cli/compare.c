/* compare of results that different runs left: one figure for one layout, and a page that fits however many there are.
 */
#include "workplace.h"

static double coverage_of(json_t *object, const char *name, double *error)
{
    size_t i;
    json_t *layout;
    json_array_foreach(json_object_get(object, "layouts"), i, layout)
    {
        if (strcmp(json_string_value(json_object_get(layout, "name")), name) != 0)
            continue;
        if (error)
            *error = json_number_value(json_object_get(layout, "error_estimate"));
        return json_number_value(json_object_get(layout, "coverage"));
    }
    fail_msg("no layout %s", name);
    return 0;
}

static void run_quietly(const char *arguments)
{
    outcome done = run_program(arguments);
    assert_string_equal(done.err, "");
    assert_int_equal(done.status, 0);
    forget(&done);
}

static double figure_in(const char *file, double *error)
{
    char *text = read_file(file, NULL);
    assert_non_null(text);
    json_t *object = json_loads(text, 0, NULL);
    double coverage = coverage_of(object, "manual", error);
    json_decref(object);
    free(text);
    return coverage;
}

/* The same nozzles on texels of two lengths: that of the lesser error, for both. */
static void one_layout_has_one_figure(void **state)
{
    (void)state;
    double errors[2], coverages[2];
    coverages[0] = figure_in("long/result.json", &errors[0]);
    coverages[1] = figure_in("short/result.json", &errors[1]);
    assert_true(coverages[0] != coverages[1] && errors[0] != errors[1]);
    json_t *both = expect_json("compare long/result.json short/result.json -o both --json", 0);
    double better = coverages[errors[1] < errors[0]];
    assert_true(coverage_of(both, "long/result.json", NULL) == better);
    assert_true(coverage_of(both, "short/result.json", NULL) == better);
    json_decref(both);
    char *page = read_file("both/report.html", NULL);
    assert_non_null(strstr(page, "The same nozzles: long/<wbr>result.json, short/<wbr>result.json."));
    free(page);
}

/* More liquid is asked for: what these nozzles cover then is another figure. */
static void what_differs_otherwise_keeps_its_own(void **state)
{
    (void)state;
    double coverage = figure_in("strict/result.json", NULL);
    json_t *both = expect_json("compare long/result.json strict/result.json -o apart --json", 0);
    assert_true(coverage_of(both, "strict/result.json", NULL) == coverage);
    assert_true(coverage_of(both, "long/result.json", NULL) == figure_in("long/result.json", NULL));
    json_decref(both);
    char *page = read_file("apart/report.html", NULL);
    assert_null(strstr(page, "The same nozzles"));
    free(page);
}

/* What the page says, and what not. */
static void assert_page(const char *path, const char *says, const char *not_that)
{
    char *page = read_file(path, NULL);
    assert_non_null(strstr(page, says));
    assert_null(strstr(page, not_that));
    free(page);
}

/* What is asked for differs by less than what is covered is off. */
static void criteria_are_reported(void **state)
{
    (void)state;
    outcome done = run_program("compare long/result.json near/result.json -o near2");
    assert_string_equal(done.err, "");
    assert_int_equal(done.status, 0);
    assert_non_null(strstr(done.out, "the criteria differ in what covered means: long/result.json at least 1 L/min/m2; "
                                     "near/result.json at least 1.001 L/min/m2 by one nozzle alone\n"));
    forget(&done);
    assert_page("near2/report.html", "<strong>The criteria differ.</strong>", "<dt>Covered means</dt>");
    done = run_program("compare long/result.json short/result.json -o both");
    assert_null(strstr(done.out, "criteria"));
    forget(&done);
    assert_page("both/report.html", "<dt>Covered means</dt><dd>at least 1 L/min/m2</dd>", "The criteria differ");
}

/* What is asked for differs, so that each keeps its own figures; of a scene as of a result. */
static void texels_are_reported(void **state)
{
    (void)state;
    outcome done = run_program("compare long/result.json strict/result.json -o lengths");
    assert_non_null(strstr(done.out, "long/result.json 90 mm; strict/result.json 60 mm\n"));
    forget(&done);
    assert_page("lengths/report.html",
                "<strong>The texels differ.</strong> Nozzles then have other figures, by about as much as "
                "these are off: "
                "long/<wbr>result.json 90&nbsp;mm; strict/<wbr>result.json 60&nbsp;mm.",
                "not told");
    run_quietly("compare strict.yaml strict/result.json --set simulate.texel=100mm -o lengths --quiet");
    assert_page("lengths/report.html", "strict.yaml 100&nbsp;mm; strict/<wbr>result.json 60&nbsp;mm.", "not told");
    run_quietly("compare strict/result.json near/result.json -o lengths --quiet");
    assert_page("lengths/report.html", "The criteria differ", "The texels differ");
}

/* As results were that older versions or others left: `key` of the whole, or of its first layout, is gone. */
static void write_without(const char *key, const char *from, const char *to)
{
    char *text = read_file(from, NULL);
    json_t *object = json_loads(text, 0, NULL), *layout = json_array_get(json_object_get(object, "layouts"), 0);
    free(text);
    assert_int_equal(json_object_del(json_object_get(object, key) ? object : layout, key), 0);
    text = json_dumps(object, 0);
    write_file(to, text);
    free(text);
    json_decref(object);
}

static void what_is_not_known_is_reported(void **state)
{
    (void)state;
    write_without("criterion", "long/result.json", "older.json");
    write_without("criterion", "short/result.json", "oldest.json");
    run_quietly("compare short/result.json older.json -o ages --quiet");
    assert_page("ages/report.html", "<strong>The criteria differ.</strong>", "The same nozzles");
    assert_page("ages/report.html", "older.json not told.</p>", "The same nozzles");
    outcome done = run_program("compare older.json oldest.json -o ages");
    assert_non_null(strstr(done.out, "do not tell what covered means"));
    forget(&done);
    assert_page("ages/report.html", "<strong>What covered means is not known.</strong>", "The same nozzles");
}

static void shadows_that_are_not_reported_are_not_nothing(void **state)
{
    (void)state;
    write_without("shadows", "long/result.json", "shadowless.json");
    json_t *both = expect_json("compare shadowless.json strict/result.json -o dark --json", 0);
    assert_null(json_object_get(json_array_get(json_object_get(both, "layouts"), 0), "shadows"));
    json_decref(both);
    char *page = read_file("dark/report.html", NULL);
    const char *row = strstr(page, "Largest uncovered region"), *cell = strstr(row, "<td");
    assert_memory_equal(strchr(cell, '>'), ">\xe2\x80\x93</td>", strlen(">\xe2\x80\x93</td>"));
    assert_non_null(strstr(page, ": uncovered regions are not told</caption>"));
    free(page);
    run_quietly("compare shadowless.json shadowless.json -o dark --quiet");
    page = read_file("dark/report.html", NULL);
    assert_null(strstr(page, "Largest uncovered region"));
    free(page);
}

/* Each share is of its own surface, and each column of the areas that stand before it. */
static void another_geometry_is_reported(void **state)
{
    (void)state;
    outcome done = run_program("compare long/result.json wide/result.json -o sizes");
    assert_string_equal(done.err, "");
    assert_int_equal(done.status, 0);
    assert_non_null(strstr(done.out, "the geometries differ in what is to be cleaned: long/result.json 6 m2, 12 "
                                     "triangles; wide/result.json 8.64 m2, 12 triangles"));
    forget(&done);
    char *page = read_file("sizes/report.html", NULL);
    assert_non_null(strstr(page, "<strong>The geometries differ.</strong>"));
    assert_null(strstr(page, "12 triangles, 6.000&nbsp;m"));
    const char *parts = strstr(page, "<section id=\"parts\">");
    const char *first = strstr(parts, "rowspan=\"2\">Part</th>"),
               *second = strstr(first + 1, "rowspan=\"2\">Part</th>");
    assert_non_null(second);
    assert_non_null(strstr(second, "<th scope=\"row\">together</th><td>8.64</td>"));
    free(page);
    run_quietly("compare long/result.json short/result.json -o sizes --quiet");
    page = read_file("sizes/report.html", NULL);
    assert_null(strstr(page, "The geometries differ"));
    free(page);
}

/* Its result is not written over, as that named itself is not. */
static void a_folder_stands_for_its_result(void **state)
{
    (void)state;
    json_t *both = expect_json("compare long strict/ --json", 0);
    assert_true(coverage_of(both, "long/result.json", NULL) == figure_in("long/result.json", NULL));
    assert_true(coverage_of(both, "strict/result.json", NULL) == figure_in("strict/result.json", NULL));
    json_decref(both);
    outcome done = run_program("compare long strict -o long");
    assert_int_equal(done.status, 1);
    assert_non_null(strstr(done.err, "result.json"));
    forget(&done);
    expect("compare long .", 3, "",
           ".: found a folder without a result.json, expected a scene, a result.json, or the folder of "
           "one\n");
}

static size_t count_of(const char *text, const char *part)
{
    size_t count = 0;
    for (; (text = strstr(text, part)); text++)
        count++;
    return count;
}

/* Tables of many designs follow one another, none wider than the page; the chart's legend stands below it. */
static void many_fold(void **state)
{
    (void)state;
    static const struct {
        const char *command;
        size_t tables;
        bool below;
    } cases[] = {
        {"compare long/result.json short/result.json -o many --quiet", 1, false},
        {"compare long/result.json short/result.json strict/result.json long/result.json short/result.json "
         "strict/result.json long/result.json -o many --quiet",
         2, true},
    };
    for (size_t i = 0; i < 2; i++) {
        run_quietly(cases[i].command);
        char *page = read_file("many/report.html", NULL);
        assert_int_equal(count_of(page, "<th scope=\"col\">Measure</th>"), cases[i].tables);
        assert_int_equal(count_of(page, "rowspan=\"2\">Part</th>"), cases[i].tables);
        assert_int_equal(count_of(page, "viewBox=\"0 0 760 380\""), !cases[i].below);
        free(page);
    }
}

/* The room's scene with another text in the place of one that it has, simulated. */
static void run_changed(const char *name, const char *what, const char *with, int texel)
{
    char text[4096], line[256];
    const char *at = strstr(room_yaml, what);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - room_yaml), room_yaml, with, at + strlen(what));
    snprintf(line, sizeof line, "%s.yaml", name);
    write_file(line, text);
    snprintf(line, sizeof line, "simulate %s.yaml -o %s --quiet --set simulate.texel=%dmm", name, name, texel);
    run_quietly(line);
}

static int make_results(void **state)
{
    if (open_workplace(state) != 0)
        return -1;
    run_changed("long", "", "", 90);
    run_changed("short", "", "", 60);
    run_changed("strict", "flux: 1 L", "flux: 4 L", 60);
    run_changed("near", "flux: 1 L/min/m2", "flux: 1.001 L/min/m2, combine: single", 60);
    run_changed("wide", "file: room.obj", "{file: room.obj, scale: 1.2}", 90);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_layout_has_one_figure),
        cmocka_unit_test(what_differs_otherwise_keeps_its_own),
        cmocka_unit_test(criteria_are_reported),
        cmocka_unit_test(texels_are_reported),
        cmocka_unit_test(what_is_not_known_is_reported),
        cmocka_unit_test(shadows_that_are_not_reported_are_not_nothing),
        cmocka_unit_test(another_geometry_is_reported),
        cmocka_unit_test(a_folder_stands_for_its_result),
        cmocka_unit_test(many_fold),
    };
    return cmocka_run_group_tests_name("compare", tests, make_results, close_workplace);
}
