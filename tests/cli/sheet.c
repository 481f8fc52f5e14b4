/* What a fitter takes to the workshop, through the program: settings in short numbers, the same sheet of the layout
 * that was written, and nozzles that do not pass their port. */
#include "results.h"

#include <math.h>

static const char set_catalogue[] =
    "nozzles:\n"
    "  - {name: cone, pattern: full_cone, angle: 90 deg, flow: 12 L/min, at: 2 bar, angle_range: [60 deg, 130 deg],\n"
    "     flow_range: [8 L/min, 16 L/min], step: {angle: 5 deg, flow: 0.2 L/min, pressure: 0.3 bar}, body: 48 mm,\n"
    "     order_code: C-12, thread: G 1/2, insert: no. 7}\n"
    "  - {name: ball, pattern: full_cone, angle: 360 deg, flow: 20 L/min, at: 2 bar, body: 60 mm}\n";

static const char set_room[] =
    "geometry:\n"
    "  - file: room.obj\n"
    "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
    "criterion: {flux: 1 L/min/m2}\n"
    "datum: {name: <the lid>, origin: [0.5 m, 0.5 m, 1 m]}\n"
    "catalogue: set.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: cone, position: [0.3 m, 0.3 m, 0.9 m], axis: [0, 0, -1], pressure: 2 bar}\n"
    "simulate: {texel: 200 mm}\n"
    "place:\n"
    "  coverage: 80 %\n"
    "  max_nozzles: 2\n"
    "  pressure: 2 bar\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [0.3 m, 0.3 m, 1 m], tilt: 30 deg, depth: {from: 100 mm, to: 500 mm, spacing: "
    "200 "
    "mm}, bore: 50 mm, step: {depth: 15 mm, tilt: 10 deg}}\n"
    "    - port: {name: P2, position: [0.7 m, 0.7 m, 1 m], tilt: 30 deg, depth: {from: 100 mm, to: 500 mm, spacing: "
    "200 "
    "mm}, bore: 50 mm, step: {depth: 15 mm, tilt: 10 deg}}\n";

/* On a surface and on a line that have names, and on a surface that has none. */
static const char mounted_room[] =
    "geometry:\n"
    "  - file: room.obj\n"
    "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
    "criterion: {flux: 1 L/min/m2}\n"
    "catalogue: catalogue.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: cone, position: [0.5 m, 0.5 m, 0.94 m], axis: [0, 0, -1], pressure: 2 bar%s}\n"
    "  - {name: N2, type: cone, position: [0.4 m, 0.2 m, 0.7 m], axis: [0, 0, -1], pressure: 2 bar%s}\n"
    "  - {name: N3, type: cone, position: [0.05 m, 0.5 m, 0.5 m], axis: [1, 0, 0], pressure: 2 bar}\n"
    "simulate: {texel: 200 mm}\n"
    "place:\n"
    "  coverage: 90 %%\n"
    "  max_nozzles: 3\n"
    "  pressure: 2 bar\n"
    "  types: [cone]\n"
    "  refine: none\n"
    "  mounts:\n"
    "    - surface: {name: the <lid>, geometry: 0, part: ceiling, spacing: 500 mm, standoff: 60 mm}\n"
    "    - line: {name: bar, from: [0.2 m, 0.2 m, 0.7 m], to: [0.8 m, 0.2 m, 0.7 m], spacing: 300 mm, axis: [0, 0, "
    "-1]}\n"
    "    - surface: {geometry: 0, part: walls, spacing: 500 mm, standoff: 50 mm}\n"
    "%s";

static const char fine_room[] =
    "geometry:\n"
    "  - file: room.obj\n"
    "criterion: {flux: 1 L/min/m2}\n"
    "catalogue: catalogue.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: cone, position: [0.3 m, 0.3 m, 0.8975 m], axis: [0, 0.378649, -0.925540], pressure: 2 bar}\n"
    "simulate: {texel: 200 mm}\n"
    "place:\n"
    "  max_nozzles: 1\n"
    "  pressure: 2 bar\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [0.3 m, 0.3 m, 1 m], tilt: 30 deg, depth: {from: 100 mm, to: 500 mm, spacing: "
    "200 mm}, step: {depth: 2.5 mm, tilt: 0.25 deg}}\n";

static void write_mounted(const char *name, const char *keep, const char *alternatives)
{
    char scene[sizeof mounted_room + 200];
    snprintf(scene, sizeof scene, mounted_room, keep, keep, alternatives);
    write_file(name, scene);
}

static int open_with_settings(void **state)
{
    if (open_workplace(state))
        return -1;
    write_file("set.yaml", set_catalogue);
    write_file("set-room.yaml", set_room);
    return 0;
}

/* Digits of what follows each `key` of the text; all that is written there is as short. */
static size_t longest_after(const char *text, const char *key)
{
    size_t longest = 0;
    for (const char *at = strstr(text, key); at; at = strstr(at, key)) {
        at += strlen(key);
        size_t size = strspn(at, "-.0123456789e");
        longest = size > longest ? size : longest;
    }
    return longest;
}

static void what_is_placed_is_what_can_be_set(void **state)
{
    (void)state;
    outcome placed = run_program("place set-room.yaml -o placed");
    assert_true(placed.status == 0 || placed.status == 4);
    forget(&placed);
    char *layout = read_file("placed/layout.yaml", NULL), *nozzles = strstr(layout, "\nnozzles:");
    *strstr(nozzles, "\nplace:") = 0;
    /* the setting nearest to 2 bar */
    assert_non_null(strstr(nozzles, "pressure: 2.1 bar"));
    assert_true(longest_after(nozzles, "pressure: ") <= 3);
    assert_true(longest_after(nozzles, "angle: ") <= 3 && longest_after(nozzles, "angle: ") > 0);
    assert_true(longest_after(nozzles, "position: [") <= 3);
    free(layout);
    char *result = read_file("placed/result.json", NULL);
    json_t *before = json_loads(result, 0, NULL);
    free(result);
    json_t *again = expect_json("simulate placed/layout.yaml -o again --json", 0);
    json_t *proposed = NULL, *one = json_array_get(json_object_get(again, "layouts"), 0), *each;
    size_t i;
    json_array_foreach(json_object_get(before, "layouts"), i, each)
    {
        if (strcmp(json_string_value(json_object_get(each, "name")), "proposed") == 0)
            proposed = each;
    }
    static const char *const same[] = {"water_l_min", "covered_area_m2", "coverage", "nozzles", "flux_l_min_m2"};
    for (i = 0; i < sizeof same / sizeof *same; i++)
        assert_true(json_equal(json_object_get(proposed, same[i]), json_object_get(one, same[i])));
    json_decref(before);
    json_decref(again);
    char *first = read_file("placed/nozzles.csv", NULL), *second = read_file("again/nozzles.csv", NULL);
    assert_string_equal(first, second);
    assert_non_null(strstr(first, ",C-12,,G 1/2,no. 7,port,P"));
    free(first);
    free(second);
}

/* The page of what was simulated there has the sheet, names its datum, and says where things are from there. */
static void the_page_has_the_sheet(void **state)
{
    (void)state;
    char *page = read_file("again/report.html", NULL),
         *section = strstr(page, "<section id=\"sheet\" class=\"sheet\">");
    assert_non_null(section);
    *strstr(section, "</section>") = 0;
    static const char *const told[] = {"Measured from &lt;the lid&gt;: heights along z from (0.5, 0.5, 1)&nbsp;m",
                                       "<td class=\"text\">port P",
                                       ">C-12</td>",
                                       ">no. 7</td>",
                                       ">G 1/2</td>",
                                       "What each circuit has to supply"};
    for (size_t i = 0; i < sizeof told / sizeof *told; i++)
        if (!strstr(section, told[i]))
            fail_msg("no %s in %s", told[i], section);
    free(page);
}

/* What can be set to 2.5 mm and 0.25 deg is told so, in the page as in the table. */
static void the_page_shows_settings(void **state)
{
    (void)state;
    write_file("fine.yaml", fine_room);
    ensure("fine", "simulate fine.yaml");
    char *page = read_file("fine/report.html", NULL), *rows = read_file("fine/nozzles.csv", NULL);
    assert_non_null(strstr(page,
                           "<td class=\"text\">port P1</td><td>300.0</td><td>300.0</td><td>1000.0</td>"
                           "<td>102.5</td><td>300.0</td><td>300.0</td><td>897.5</td><td>22.25</td><td>90.00</td>"));
    assert_non_null(strstr(rows, ",port,P1,102.5,,300,300,1000,424.3,45,300,300,897.5,424.3,45,22.25,90,"));
    free(page);
    free(rows);
}

static void the_sheet_calls_mounts_by_their_names(void **state)
{
    (void)state;
    write_mounted("mounted.yaml", "", "");
    ensure("mounted", "simulate mounted.yaml");
    char *page = read_file("mounted/report.html", NULL), *rows = read_file("mounted/nozzles.csv", NULL);
    static const char *const cells[] = {"N1</th><td class=\"text\">the &lt;lid&gt;: new weld on ceiling</td>",
                                        "N2</th><td class=\"text\">bar: new, on a line</td>",
                                        "N3</th><td class=\"text\">new weld on walls</td>"};
    static const char *const fields[] = {",weld,the <lid>,", ",line,bar,", ",weld,walls,"};
    for (size_t i = 0; i < sizeof cells / sizeof *cells; i++)
        if (!strstr(page, cells[i]) || !strstr(rows, fields[i]))
            fail_msg("no %s in the page, or no %s in %s", cells[i], fields[i], rows);
    free(page);
    free(rows);
}

/* The text of the fitting's cell of a nozzle, in the sheet of that id. */
static const char *cell_of(const char *page, const char *id, const char *nozzle)
{
    char section[100], cell[100];
    snprintf(section, sizeof section, "<section id=\"%s\" class=\"sheet\">", id);
    snprintf(cell, sizeof cell, "%s</th><td class=\"text\">", nozzle);
    const char *at = strstr(page, section);
    at = at ? strstr(at, cell) : NULL;
    assert_non_null(at);
    return at + strlen(cell);
}

static bool starts(const char *text, const char *start)
{
    return !strncmp(text, start, strlen(start));
}

/* Neither in the proposal's sheet nor in the engineer's own, while those that are new are so in the figures, too. */
static void what_is_kept_is_not_called_new(void **state)
{
    (void)state;
    write_mounted("keeping.yaml", ", keep: true", "  alternatives:\n    - {name: all}\n");
    ensure("keeping", "place keeping.yaml");
    char *page = read_file("keeping/report.html", NULL);
    static const char *const ids[] = {"sheet", "sheet-1"};
    for (size_t i = 0; i < 2; i++) {
        assert_true(starts(cell_of(page, ids[i], "N1"), "the &lt;lid&gt;: kept, welded to ceiling</td>"));
        assert_true(starts(cell_of(page, ids[i], "N2"), "bar: kept, on a line</td>"));
    }
    json_t *placed = json_file("keeping/result.json"), *nozzle;
    json_t *proposed = layout_named(placed, "all");
    size_t i, fresh = 0;
    json_array_foreach(json_object_get(proposed, "nozzles"), i, nozzle)
    {
        const char *cell = cell_of(page, "sheet", json_string_value(json_object_get(nozzle, "name")));
        const char *end = strstr(cell, "</td>"), *new = strstr(cell, "new");
        bool said = new &&new < end;
        assert_int_equal(said, json_is_true(json_object_get(nozzle, "new_fitting")));
        fresh += said;
    }
    assert_true(fresh > 0 && fresh == (size_t)number(proposed, "new_fittings"));
    json_decref(placed);
    free(page);
}

/* In a wall or in a bore that is too narrow: an error where it is simulated or kept, a doubt where it is compared. */
static void what_does_not_pass_is_refused(void **state)
{
    (void)state;
    static const char wide[] = "nozzles: N1, of type 'ball', is 60 mm wide, expected no more than the bore of port P1, "
                               "50 mm\n";
    char scene[sizeof set_room + 20], expected[400];
    const char *at = strstr(set_room, "type: cone");
    snprintf(scene, sizeof scene, "%.*stype: ball%s", (int)(at - set_room), set_room, at + strlen("type: cone"));
    write_file("wide.yaml", scene);
    snprintf(expected, sizeof expected, "wide.yaml:8:5: %s", wide);
    expect("simulate wide.yaml", 3, "", expected);
    outcome result = run_program("place wide.yaml --set place.refine=none --set place.max_nozzles=1");
    assert_non_null(strstr(result.err, "the layout compared with is in doubt: nozzles: N1, of type 'ball', is 60 mm"));
    forget(&result);
    result = run_program("check wide.yaml");
    assert_non_null(strstr(result.out, "is 60 mm wide"));
    forget(&result);
}

static const char turning_catalogue[] =
    "nozzles:\n"
    "  - {name: fan, pattern: rotating, flow: 40 L/min, at: 3 bar,\n"
    "     rotation: {jet: {pattern: flat_fan, angle: 120 deg, thickness: 6 deg, tilt: 60 deg}}}\n"
    "  - {name: head, pattern: rotating, flow: 60 L/min, at: 4 bar,\n"
    "     rotation: {jets: 4, gears: [3, 4], jet: {pattern: solid_stream, angle: 1 deg}}}\n";

static const char turning_room[] =
    "geometry: [{file: room.obj}]\n"
    "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
    "criterion: {flux: 1 L/min/m2}\n"
    "catalogue: turning.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: fan, position: [0.3 m, 0.3 m, 0.9 m], axis: [0, 0, -1], pressure: 3 bar}\n"
    "  - {name: N2, type: head, position: [0.6 m, 0.6 m, 0.7 m], axis: [0, 0, -1], pressure: 4 bar}\n"
    "simulate: {texel: 200 mm}\n";

/* Wherever its angle is told; and what is read back is the same nozzle. */
static void what_turns_is_reported_by_all_that_it_sprays(void **state)
{
    (void)state;
    static const struct {
        double degrees;
        const char *cells, *fields, *end;
    } told[] = {{240, "<td>240.0</td><td>3.00</td>", "N1,fan,0.3,0.3,0.9,0,0,-1,0,", "240.00\n"},
                {360, "<td>360.0</td><td>4.00</td>", "N2,head,0.6,0.6,0.7,0,0,-1,0,", "360.00\n"}};
    write_file("turning.yaml", turning_catalogue);
    write_file("turns.yaml", turning_room);
    ensure("turns", "simulate turns.yaml");
    ensure("turned", "simulate turns/layout.yaml");
    outcome check = run_program("check turns.yaml");
    char *page = read_file("turns/report.html", NULL), *rows = read_file("turns/nozzles.csv", NULL);
    json_t *result = json_file("turns/result.json"), *again = json_file("turned/result.json"),
           *nozzles = json_object_get(layout_named(result, "manual"), "nozzles");
    for (size_t i = 0; i < 2; i++) {
        const char *cell = strstr(page, told[i].cells), *row = strstr(rows, told[i].fields);
        if (!cell || !strstr(cell + 1, told[i].cells) || !strstr(check.out, told[i].end))
            fail_msg("not twice %s in the page, or no %s in %s", told[i].cells, told[i].end, check.out);
        assert_non_null(row);
        assert_true(fabs(strtod(row + strlen(told[i].fields), NULL) - told[i].degrees) < 1e-9);
        assert_true(fabs(number(json_array_get(nozzles, i), "angle_rad") * 180 / M_PI - told[i].degrees) < 1e-9);
    }
    assert_true(json_equal(nozzles, json_object_get(layout_named(again, "manual"), "nozzles")));
    json_decref(result);
    json_decref(again);
    free(page);
    free(rows);
    forget(&check);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_placed_is_what_can_be_set),
        cmocka_unit_test(the_page_has_the_sheet),
        cmocka_unit_test(what_turns_is_reported_by_all_that_it_sprays),
        cmocka_unit_test(the_sheet_calls_mounts_by_their_names),
        cmocka_unit_test(what_is_kept_is_not_called_new),
        cmocka_unit_test(what_does_not_pass_is_refused),
        cmocka_unit_test(the_page_shows_settings),
    };
    return cmocka_run_group_tests(tests, open_with_settings, close_workplace);
}
