/* A vessel of 80 mm, washed by nozzles of hundredths of a litre a minute: page and terminal tell of it as well as of a
 * large one. */
#include "results.h"
#include "small_vessel.h"

#include <math.h>

static char *terminal, *page;
static json_t *result;

static int place_once(void **state)
{
    if (open_workplace(state) != 0)
        return -1;
    write_small_vessel();
    outcome done = run_program("place small.yaml -o small");
    terminal = done.out;
    free(done.err);
    page = read_file("small/report.html", NULL);
    result = json_file("small/result.json");
    return page ? 0 : -1;
}

static int put_away(void **state)
{
    json_decref(result);
    free(terminal);
    free(page);
    return close_workplace(state);
}

static void expect_text(const char *text, const char *expected)
{
    if (!strstr(text, expected))
        fail_msg("nowhere: %s", expected);
}

/* What is told of a layout's water, wherever it is told. */
static void no_water_is_reported_as_nothing(void **state)
{
    (void)state;
    double water = number(layout_named(result, "proposed"), "water_l_min");
    char text[512];
    assert_true(fabs(water - 0.1) < 0.03);
    assert_null(strstr(page, "0.0&nbsp;L/min"));
    assert_null(strstr(page, "0.1&nbsp;L/min"));
    assert_null(strstr(page, "with 0.0 L/min"));
    expect_text(page, "with <strong>0.0400&nbsp;L/min</strong>");
    expect_text(page, "<div class=\"against\">manual 0.0400 L/min (");
    expect_text(page, "\"quote\":\"");
    snprintf(text, sizeof text, " %% with %.*f L/min\"", water < 0.09995 ? 4 : 3, water);
    expect_text(page, text);
    row_of("small", "<th scope=\"row\">N1</th><td>", text);
    expect_text(text, "N1</th><td>0.0400</td>");
    expect_text(terminal, "       0.0400 ");
    snprintf(text, sizeof text, " %12.*f ", water < 0.09995 ? 4 : 3, water);
    expect_text(terminal, text);
    expect_text(terminal, "0.0400 100.0 %       0.0000   0.0 %");
}

/* The bound is told on page and terminal, rounded down by less than a hundredth of it. */
static void what_is_proved_is_reported(void **state)
{
    (void)state;
    double bound = number(json_object_get(result, "certificate"), "water_bound_same_coverage_l_min"), told;
    const char *at = strstr(page, "<section id=\"certificate\">");
    assert_true(bound > 0.01 && bound < 0.1);
    assert_non_null(at = strstr(at, " with less than "));
    assert_int_equal(sscanf(at, " with less than %lf", &told), 1);
    assert_true(told <= bound + 1e-9 && told > 0.98 * bound);
    assert_non_null(at = strstr(terminal, " with less than "));
    assert_int_equal(sscanf(at, " with less than %lf", &told), 1);
    assert_true(told <= bound + 1e-9 && told > 0.98 * bound);
}

/* The text of the `column`th cell behind a row's head, of a row of the section `id` that begins with `head`. */
static void cell_of(const char *id, const char *head, int column, char text[100])
{
    char section[64];
    snprintf(section, sizeof section, "<section id=\"%s\">", id);
    const char *at = strstr(page, section);
    at = at ? strstr(at, head) : NULL;
    for (int i = 0; at && i < column; i++) {
        at = strstr(at, "<td");
        at = at ? strchr(at, '>') + 1 : NULL;
    }
    if (!at)
        fail_msg("no cell %d of %s in %s", column, head, id);
    snprintf(text, 100, "%.*s", (int)strcspn(at, "<"), at);
}

static void expect_digits(const char *id, const char *head, int column, double value, int decimals)
{
    char found[100], expected[100];
    cell_of(id, head, column, found);
    snprintf(expected, sizeof expected, "%s%.*f", value < 0 ? "\xe2\x88\x92" : "", decimals, fabs(value));
    assert_string_equal(found, expected);
}

/* Its surface is 384 cm²: tenths of millimetres and of square centimetres tell what is on it. */
static void small_places_and_areas_are_reported(void **state)
{
    (void)state;
    const json_t *manual = layout_named(result, "manual"),
                 *nozzle = json_array_get(json_object_get(manual, "nozzles"), 0),
                 *shadow = json_array_get(json_object_get(manual, "shadows"), 0),
                 *centroid = json_object_get(shadow, "centroid_m");
    char text[100];
    expect_digits("nozzles", ">N1</th>", 2, 0.04, 4);
    expect_digits("nozzles", ">N1</th>", 4, 0.072, 4);
    expect_digits("shadows", ">1</th>", 2, 1e4 * number(shadow, "area_m2"), 1);
    for (int k = 0; k < 3; k++)
        expect_digits("shadows", ">1</th>", 4 + k, json_number_value(json_array_get(centroid, (size_t)k)), 3);
    expect_digits("contributions", ">N1</th>", 2, number(nozzle, "alone_m2"), 5);
    expect_digits("contributions", ">N1</th>", 4, number(nozzle, "lost_without_m2"), 5);
    cell_of("swabs", ">1</th>", 2, text);
    assert_int_equal(strlen(strchr(text, '.')), 5);
    /* the remedy's place stands in a sentence, at the mounting points' 24 or 56 mm */
    assert_true(strstr(page, " at 0.024, 0.024, 0.076&nbsp;m: ") || strstr(page, " at 0.056, 0.056, 0.076&nbsp;m: "));
    snprintf(text, sizeof text, " %13.5f ", number(manual, "covered_area_m2"));
    expect_text(terminal, text);
}

/* By a nozzle that takes 12 L/min, area per water is millionths: the card says what the table does. */
static void little_area_per_water_is_reported(void **state)
{
    (void)state;
    write_file("much.yaml", "nozzles:\n"
                            "  - {name: drop, pattern: full_cone, angle: 120 deg, flow: 12 L/min, at: 2 bar}\n");
    char scene[2 * sizeof small_yaml];
    const char *at = strstr(small_yaml, "drops");
    snprintf(scene, sizeof scene, "%.*smuch%s", (int)(at - small_yaml), small_yaml, at + strlen("drops"));
    write_file("much_water.yaml", scene);
    outcome done = run_program("simulate much_water.yaml -o much");
    forget(&done);
    json_t *much = json_file("much/result.json");
    double ratio = number(layout_named(much, "manual"), "area_per_water");
    char *html = read_file("much/report.html", NULL), text[100];
    assert_true(ratio > 0.001 && ratio < 0.01);
    snprintf(text, sizeof text, "Area per water</div><div class=\"value\">%.5f ", ratio);
    expect_text(html, text);
    free(html);
    json_decref(much);
}

/* One port without tilt, one type that looks alike at any roll: what there is one of is told so. */
static void one_is_no_plural(void **state)
{
    (void)state;
    char scene[sizeof small_yaml];
    snprintf(scene, sizeof scene, "%.*s", (int)(strstr(small_yaml, "    - port: {name: P2") - small_yaml), small_yaml);
    char *tilt = strstr(scene, ", tilt: 30 deg}");
    memcpy(tilt, "}              ", strlen(", tilt: 30 deg}"));
    write_file("one.yaml", scene);
    outcome done = run_program("place one.yaml --set 'place.types=[drop]' -o one --no-live");
    expect_text(done.out, "\nAmong this 1 candidate pose and the proposal's own");
    expect_text(done.out, "  at the 1 mounting point looked at; places beside it");
    forget(&done);
    char *html = read_file("one/report.html", NULL);
    expect_text(html, "<p>Among this 1 candidate pose and the proposal&#39;s own");
    expect_text(html, "1 pose at 1 mounting point; greedy choice");
    expect_text(html, "in false colour with 1 nozzle\"");
    free(html);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_water_is_reported_as_nothing),   cmocka_unit_test(one_is_no_plural),
        cmocka_unit_test(what_is_proved_is_reported),        cmocka_unit_test(small_places_and_areas_are_reported),
        cmocka_unit_test(little_area_per_water_is_reported),
    };
    return cmocka_run_group_tests(tests, place_once, put_away);
}
