/* A nozzle is drawn to its place and turned by the mouse, within its mount, and sliders and figures follow. */
#include "devtools.h"

#include <math.h>

static const char scene_yaml[] =
    "datum: {zero: [0, 1, 0]}\n" ROOM_WITH_A_NOZZLE "  pressure: 2 bar\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [0.3 m, 0.3 m, 1 m], axis: [0, 0, -1], tilt: 30 deg, depth: {from: 100 mm, to: "
    "500 mm, spacing: 200 mm}}\n"
    "    - port: {name: P2, position: [0 m, 0.5 m, 0.7 m], axis: [1, 0, 0.2], tilt: 30 deg, depth: {from: 100 mm, to: "
    "500 mm, spacing: 200 mm}}\n"
    "    - line: {name: rail, from: [0.2 m, 0.5 m, 0.7 m], to: [0.8 m, 0.5 m, 0.7 m], spacing: 100 mm, tilt: 45 deg}\n"
    "    - box: {name: frame, min: [0.3 m, 0.3 m, 0.6 m], max: [0.7 m, 0.7 m, 0.6 m], spacing: 100 mm, tilt: 45 deg}\n"
    "    - surface: {name: floor, geometry: 0, part: floor, spacing: 100 mm, standoff: 50 mm, tilt: 45 deg}\n";

static devtools page;
static bool opened;

static int open_the_page(void **state)
{
    if (open_workplace(state) != 0)
        return -1;
    write_file("rails.yaml", scene_yaml);
    outcome result = run_program("simulate rails.yaml -o rails --quiet");
    forget(&result);
    opened = can_evaluate("rails/report.html");
    if (!opened)
        return 0;
    write_page_with_reader("rails/report.html", "", "drag.js");
    devtools_open(&page, "read.html");
    devtools_wait(&page, "dragged");
    json_t *ready = devtools_evaluate(&page, "dragged.start()");
    int status = strcmp(json_string_value(ready), "true") == 0 ? 0 : -1;
    json_decref(ready);
    return status;
}

static int close_the_page(void **state)
{
    if (opened)
        devtools_close(&page);
    return close_workplace(state);
}

static json_t *look(void)
{
    return devtools_evaluate(&page, "dragged.look()");
}

static double slider(const json_t *seen, const char *name)
{
    const json_t *value = json_object_get(json_object_get(seen, "sliders"), name);
    if (!value)
        fail_msg("no slider %s", name);
    return json_number_value(value);
}

static void put_on(const char *mount)
{
    char line[256];
    snprintf(line, sizeof line, "dragged.mount('%s')", mount);
    json_t *index = devtools_evaluate(&page, line);
    assert_true(json_integer_value(index) >= 0);
    json_decref(index);
}

/* So many pixels from where the handle is; what comes of it, the caller's. */
static json_t *drag(const char *handle, double x, double y)
{
    char line[256];
    snprintf(line, sizeof line, "dragged.handle('%s')", handle);
    json_t *at = devtools_evaluate(&page, line);
    double from[2] = {json_number_value(json_array_get(at, 0)), json_number_value(json_array_get(at, 1))};
    json_decref(at);
    devtools_drag(&page, from, (double[]){from[0] + x, from[1] + y});
    return look();
}

/* Of the only nozzle of changed/nozzles.csv. */
static double in_the_table(const char *column)
{
    char *rows = read_file("changed/nozzles.csv", NULL), *field = strchr(rows, '\n') + 1;
    for (const char *head = rows; strncmp(head, column, strlen(column)) != 0; head = strchr(head, ',') + 1)
        field = strchr(field, ',') + 1;
    double value = strtod(field, NULL);
    free(rows);
    return value;
}

/* Sliders that count as the sheet does, or a line beside those that do not, say where the nozzle points. */
static void expect_pose_of_the_sheet(const json_t *seen)
{
    const char *line = json_string_value(json_object_get(seen, "pose"));
    double tilt, towards;
    if (sscanf(line, "On the sheet: tilt %lf°, towards %lf°.", &tilt, &towards) != 2)
        fail_msg("found %s", line);
    assert_float_equal(tilt, in_the_table("tilt_deg"), 0.0501);
    assert_float_equal(towards, in_the_table("towards_deg"), 0.0501);
}

/* What the page says of the layout is what the program says of the scene that it saves. */
static void expect_program_agrees(const json_t *seen)
{
    write_file("rails/changed.yaml", json_string_value(json_object_get(seen, "scene")));
    outcome result = run_program("simulate rails/changed.yaml -o changed --quiet");
    assert_int_equal(result.status, 0);
    forget(&result);
    char path[1024], percent[32];
    snprintf(path, sizeof path, "%s/changed/result.json", workplace);
    json_t *told = json_load_file(path, 0, NULL);
    double coverage =
        json_number_value(json_object_get(json_array_get(json_object_get(told, "layouts"), 0), "coverage"));
    json_decref(told);
    assert_float_equal(json_number_value(json_object_get(seen, "coverage")), coverage, 1e-9);
    snprintf(percent, sizeof percent, "%.2f", 100 * coverage);
    const char *row = json_string_value(json_object_get(seen, "row"));
    if (!strstr(row, percent))
        fail_msg("found %s, expected %s", row, percent);
    expect_pose_of_the_sheet(seen);
}

static void along_the_axis_of_a_port(void **state)
{
    (void)state;
    skip_unless_evaluating(opened);
    put_on("P1");
    json_t *before = look(), *after = drag("place", 60, 80);
    assert_float_equal(slider(before, "Depth, mm"), 100, 1e-6);
    assert_true(slider(after, "Depth, mm") > 150 && slider(after, "Depth, mm") <= 500);
    assert_true(json_number_value(json_object_get(before, "coverage")) !=
                json_number_value(json_object_get(after, "coverage")));
    expect_program_agrees(after);
    json_decref(before);
    json_decref(after);
    after = drag("place", 0, 2000 / 4.0);
    assert_float_equal(slider(after, "Depth, mm"), 500, 1e-6);
    json_decref(after);
}

static void the_axis_within_its_tilt(void **state)
{
    (void)state;
    skip_unless_evaluating(opened);
    put_on("P1");
    json_t *before = look(), *after = drag("axis", 12, 0);
    assert_float_equal(slider(before, "Tilt, deg"), 0, 1e-6);
    assert_true(slider(after, "Tilt, deg") > 2 && slider(after, "Tilt, deg") < 30);
    expect_program_agrees(after);
    json_decref(before);
    json_decref(after);
    after = drag("axis", 150, 0);
    assert_float_equal(slider(after, "Tilt, deg"), 30, 1e-6);
    assert_non_null(strstr(json_string_value(json_object_get(after, "scene")), "axis: ["));
    json_decref(after);
    after = drag("axis", -150, -40);
    assert_float_equal(slider(after, "Tilt, deg"), 30, 1e-6);
    json_decref(after);
}

/* The sliders of a mount that does not point straight down say what they count from. */
static void the_axis_of_a_slanted_port(void **state)
{
    (void)state;
    skip_unless_evaluating(opened);
    put_on("P2");
    json_t *after = drag("axis", 30, 20);
    assert_true(slider(after, "Tilt from the mount's axis, deg") > 2);
    assert_true(slider(after, "Round the mount's axis, deg") >= 0);
    expect_program_agrees(after);
    json_decref(after);
}

static void along_a_line(void **state)
{
    (void)state;
    skip_unless_evaluating(opened);
    put_on("rail");
    json_t *before = look(), *after = drag("place", 70, 10);
    assert_float_equal(slider(before, "Along the line, mm"), 300, 1e-6);
    assert_true(slider(after, "Along the line, mm") > 330);
    expect_program_agrees(after);
    json_decref(before);
    json_decref(after);
}

static void in_a_flat_box(void **state)
{
    (void)state;
    skip_unless_evaluating(opened);
    put_on("frame");
    json_t *before = look(), *after = drag("place", 40, 10);
    assert_true(hypot(slider(after, "x, m") - slider(before, "x, m"), slider(after, "y, m") - slider(before, "y, m")) >
                0.02);
    assert_non_null(strstr(json_string_value(json_object_get(after, "scene")), "0.6"));
    json_decref(after);
    after = drag("place", 600, 0);
    assert_true(slider(after, "x, m") <= 0.7 + 1e-9 && slider(after, "y, m") <= 0.7 + 1e-9);
    assert_true(slider(after, "x, m") > 0.7 - 1e-9 || slider(after, "y, m") > 0.7 - 1e-9 ||
                slider(after, "y, m") < 0.3 + 1e-9);
    expect_program_agrees(after);
    json_decref(before);
    json_decref(after);
}

static void on_a_surface_and_anywhere(void **state)
{
    (void)state;
    skip_unless_evaluating(opened);
    put_on("floor");
    json_t *before = look(), *after = drag("place", 30, 5);
    assert_float_equal(slider(after, "z, m"), 0.05, 1e-6);
    assert_true(hypot(slider(after, "x, m") - slider(before, "x, m"), slider(after, "y, m") - slider(before, "y, m")) >
                0.02);
    expect_program_agrees(after);
    json_decref(before);
    before = drag("axis", 20, 10);
    assert_true(slider(before, "Tilt from the wall's normal, deg") > 2);
    expect_program_agrees(before);
    json_decref(before);
    put_on("anywhere");
    before = drag("place", 0, -60);
    assert_true(slider(before, "z, m") > slider(after, "z, m") + 0.02);
    expect_program_agrees(before);
    assert_int_equal(json_array_size(json_object_get(before, "errors")), 0);
    assert_int_equal(json_array_size(json_object_get(before, "requests")), 0);
    json_decref(before);
    json_decref(after);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(along_the_axis_of_a_port),
        cmocka_unit_test(the_axis_within_its_tilt),
        cmocka_unit_test(the_axis_of_a_slanted_port),
        cmocka_unit_test(along_a_line),
        cmocka_unit_test(in_a_flat_box),
        cmocka_unit_test(on_a_surface_and_anywhere),
    };
    return cmocka_run_group_tests(tests, open_the_page, close_the_page);
}
