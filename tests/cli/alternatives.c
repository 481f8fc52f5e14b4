/* place with alternatives: each is worked out as if it were the scene's only placement, one of them is proposed, and
 * all stand in one result, one report and scenes of their own. */
#include "results.h"

static const char room_with[] = "geometry:\n"
                                "  - file: room.obj\n"
                                "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
                                "criterion: {flux: 1 L/min/m2}\n"
                                "catalogue: catalogue.yaml\n"
                                "%s"
                                "simulate: {texel: 100 mm}\n"
                                "place:\n"
                                "  objective: %s\n"
                                "  coverage: 75 %%\n"
                                "  max_nozzles: 3\n"
                                "  pressure: 2 bar\n"
                                "  types: [cone]\n"
                                "  refine: none\n"
                                "  mounts:\n"
                                "    - port: {name: P1, position: [0.3 m, 0.3 m, 0.9 m], axis: [0, 0, -1]}\n"
                                "    - port: {name: P2, position: [0.7 m, 0.7 m, 0.9 m], axis: [0, 0, -1]}\n"
                                "    - surface: {name: walls, geometry: 0, part: walls, spacing: 500 mm, standoff: 40 "
                                "mm%s}\n"
                                "%s";
static const char own_nozzle[] =
    "nozzles:\n"
    "  - {name: N1, type: cone, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 0, -1], pressure: 2 bar}\n";
static const char alternatives[] = "  alternatives:\n"
                                   "    - {name: ports alone, mounts: [P2, P1]}\n"
                                   "    - {name: a weld at most, mounts: [P1, {mount: walls, max_nozzles: 1}, P2]}\n"
                                   "    - {name: free & easy}\n";

static void write_room(const char *name, const char *own, const char *objective, const char *limit, const char *rest)
{
    char text[4096];
    snprintf(text, sizeof text, room_with, own, objective, limit, rest);
    write_file(name, text);
}

static void same(json_t *a, json_t *b, const char *key)
{
    if (!json_equal(json_object_get(a, key), json_object_get(b, key)))
        fail_msg("%s differ", key);
}

static const char *text_of(json_t *object, const char *key)
{
    assert_true(json_is_string(json_object_get(object, key)));
    return json_string_value(json_object_get(object, key));
}

static void drop_seconds(json_t *object)
{
    size_t i;
    json_t *entry;
    json_object_del(object, "stages");
    json_array_foreach(json_object_get(object, "alternatives"), i, entry) json_object_del(entry, "stages");
}

static const char *const names[] = {"ports alone", "a weld at most", "free & easy"};

/* The run that most of what follows is about, and the files that it left in out/. */
static json_t *all;

static int run_once(void **state)
{
    if (open_workplace(state) != 0)
        return -1;
    write_room("room.yaml", own_nozzle, "max_coverage", "", alternatives);
    all = expect_json("place room.yaml --json --threads 1 -o out", 0);
    return 0;
}

static int forget_run(void **state)
{
    json_decref(all);
    return close_workplace(state);
}

/* The derived problem, written out by hand, gives the same layout, front and proof. */
static void each_is_a_placement_of_its_own(void **state)
{
    (void)state;
    write_room("weld.yaml", own_nozzle, "max_coverage", ", max_nozzles: 1", "");
    json_t *alone = expect_json("place weld.yaml --json", 0);
    json_t *layout = named(all, "layouts", "a weld at most"), *found = named(all, "alternatives", "a weld at most");
    json_t *proposed = named(alone, "layouts", "proposed");
    same(layout, proposed, "coverage");
    same(layout, proposed, "water_l_min");
    assert_int_equal(json_array_size(json_object_get(layout, "nozzles")),
                     json_array_size(json_object_get(proposed, "nozzles")));
    same(found, alone, "certificate");
    same(found, alone, "target");
    same(found, alone, "forward_check");
    /* of the first alternative that has all mounts, whichever is proposed */
    same(named(all, "layouts", "manual"), named(alone, "layouts", "manual"), "shadows");
    for (size_t i = 0; i < json_array_size(json_object_get(alone, "front")); i++) {
        json_t *a = json_array_get(json_object_get(found, "front"), i);
        json_t *b = json_array_get(json_object_get(alone, "front"), i);
        same(a, b, "coverage");
        same(a, b, "coverage_bound");
        assert_true(number(a, "new_fittings") <= number(a, "nozzles"));
        assert_null(json_object_get(b, "new_fittings"));
    }
    json_decref(alone);
}

/* Each has its own share that is attainable, of one surface. */
static void they_share_a_geometry(void **state)
{
    (void)state;
    json_t *common = json_object_get(all, "geometry");
    assert_true(number(common, "clean_area_m2") > 0);
    assert_null(json_object_get(common, "attainable_area_m2"));
    for (size_t k = 0; k < 3; k++) {
        json_t *own = json_object_get(named(all, "layouts", names[k]), "geometry");
        same(own, common, "triangles");
        same(own, common, "area_m2");
        same(own, common, "clean_area_m2");
        assert_true(number(own, "attainable_area_m2") > 0);
    }
}

/* A nozzle is of its port's name or wants a fitting, and there are no more of these than an alternative allows. */
static void fittings_are_counted_and_limited(void **state)
{
    (void)state;
    const double most[] = {0, 1, 3};
    double before = 0;
    for (size_t k = 0; k < 3; k++) {
        json_t *layout = named(all, "layouts", names[k]), *nozzles = json_object_get(layout, "nozzles"), *nozzle;
        size_t i;
        double fittings = 0;
        json_array_foreach(nozzles, i, nozzle)
        {
            const char *name = text_of(nozzle, "name");
            bool fitting = json_is_true(json_object_get(nozzle, "new_fitting"));
            assert_true(fitting == (strcmp(name, "P1") != 0 && strcmp(name, "P2") != 0));
            fittings += fitting;
        }
        assert_true(number(layout, "new_fittings") == fittings);
        assert_true(fittings <= most[k]);
        /* each allows all that the one before does; the search is exact enough for that on so small a room */
        assert_true(number(layout, "coverage") >= before);
        assert_true(number(layout, "coverage_of_attainable") <= 1);
        before = number(layout, "coverage");
        json_t *certificate = json_object_get(named(all, "alternatives", names[k]), "certificate");
        assert_true(number(certificate, "coverage") <= number(certificate, "coverage_bound_same_water"));
    }
}

/* The proposed one's figures stand where those of any proposal do. */
static void one_is_proposed(void **state)
{
    (void)state;
    assert_int_equal(json_array_size(json_object_get(all, "layouts")), 4);
    json_t *proposed = named(all, "layouts", text_of(all, "proposed")), *layout;
    json_t *found = named(all, "alternatives", text_of(all, "proposed"));
    size_t i;
    json_array_foreach(json_object_get(all, "layouts"), i, layout)
        assert_true(number(layout, "coverage") <= number(proposed, "coverage") + 1e-9);
    same(all, found, "target");
    same(all, found, "front");
    same(all, found, "certificate");
    assert_string_equal(text_of(all, "proposed_for"), "of those that cover the 75 % asked for, it covers most");
}

/* Where none reaches what is asked for, the status tells; without nozzles of its own a scene has nothing to compare. */
static void none_may_reach_what_is_asked_for(void **state)
{
    (void)state;
    write_room("short.yaml", "", "min_water", "", "  alternatives: [{name: ports alone, mounts: [P1, P2]}]\n");
    json_t *one = expect_json("place short.yaml --json --set place.coverage=1", 4);
    assert_int_equal(json_array_size(json_object_get(one, "layouts")), 1);
    assert_string_equal(text_of(one, "proposed"), "ports alone");
    assert_string_equal(text_of(one, "proposed_for"), "none covers the 100 % asked for, and of all it covers most");
    json_decref(one);
}

static size_t count_of(const char *text, const char *part)
{
    size_t count = 0;
    for (; (text = strstr(text, part)); text++)
        count++;
    return count;
}

static void the_page_has_every_alternative(void **state)
{
    (void)state;
    char *page = read_file("out/report.html", NULL);
    assert_non_null(page);
    assert_int_equal(count_of(page, "<section id=\"alternatives\">"), 1);
    assert_non_null(strstr(page, "<th scope=\"col\" class=\"decided\">free &amp; easy (proposed)</th>"));
    assert_null(strstr(page, "free & easy</"));
    assert_int_equal(count_of(page, "What each new fitting buys"), 1);
    const char *limits = strstr(page, "<th scope=\"row\">Allowed at most</th>");
    assert_non_null(limits);
    char row[1024];
    snprintf(row, sizeof row, "%.*s", (int)strcspn(limits, "\n"), limits);
    assert_int_equal(count_of(row, ">3 nozzles (max_nozzles)</td>"), 3);
    assert_int_equal(count_of(page, "<path class=\"front\" style="), 3);
    assert_int_equal(count_of(page, "<path class=\"bound\" style="), 3);
    assert_int_equal(count_of(page, "Among these "), 3);
    /* three views of four designs */
    assert_int_equal(count_of(page, "<figure>"), 12);
    assert_int_equal(count_of(page, "for a test on the vessel to show"), 1);
    assert_non_null(strstr(page, "; or its layout or the engineer&#39;s own covers them"));
    free(page);
}

/* The rest of a line behind the layout's name, for every line of that layout; without a name, of all but the first. */
static void rows_of(const char *csv, const char *layout, char *rows)
{
    size_t length = layout ? strlen(layout) : 0;
    *rows = 0;
    for (const char *line = strchr(csv, '\n') + 1; *line; line = strchr(line, '\n') + 1)
        if (!layout || (strncmp(line, layout, length) == 0 && line[length] == ','))
            strncat(rows, line + length + (layout != NULL), strcspn(line, "\n") + 1 - length - (layout != NULL));
}

/* In the page and as CSV, the rows of each are those of the nozzles.csv of its own scene. */
static void every_layout_has_its_sheet(void **state)
{
    (void)state;
    static const char *const layouts[] = {"manual", "ports alone", "a weld at most", "free & easy"};
    static const char *const scenes[] = {"room.yaml", "out/layout-1.yaml", "out/layout-2.yaml", "out/layout.yaml"};
    static const char *const ids[] = {"sheet-1", "sheet-2", "sheet-3", "sheet"};
    char *page = read_file("out/report.html", NULL), *csv = read_file("out/nozzles-all.csv", NULL);
    assert_non_null(csv);
    assert_int_equal(count_of(page, "class=\"sheet\""), 4);
    for (size_t k = 0; k < 4; k++) {
        char command[100], section[100], expected[8192], told[8192];
        snprintf(command, sizeof command, "simulate %s -o alone --quiet", scenes[k]);
        outcome done = run_program(command);
        assert_int_equal(done.status, 0);
        forget(&done);
        char *own = read_file("alone/nozzles.csv", NULL);
        rows_of(own, NULL, expected);
        rows_of(csv, layouts[k], told);
        assert_string_equal(told, expected);
        assert_true(*told);
        free(own);
        snprintf(section, sizeof section, "<section id=\"%s\" class=\"sheet\">", ids[k]);
        char *from = strstr(page, section), *to = from ? strstr(from, "</section>") : NULL;
        assert_non_null(to);
        *to = 0;
        assert_int_equal(count_of(from, "where to drill, weld and point"), 1);
        assert_int_equal(count_of(from, "<a href=\"#sheet"), 4);
        *to = '<';
        if (k > 0) {
            snprintf(section, sizeof section, "<a href=\"#%s\">sheet</a>", ids[k]);
            assert_int_equal(count_of(page, section), 1);
        }
    }
    free(page);
    free(csv);
}

/* Of what is compared, scenes have sheets, figures that were read have none. */
static void so_has_what_is_compared(void **state)
{
    (void)state;
    outcome done = run_program("compare out/result.json out/layout-2.yaml room.yaml -o compared --quiet");
    assert_int_equal(done.status, 0);
    forget(&done);
    char *page = read_file("compared/report.html", NULL), *csv = read_file("compared/nozzles-all.csv", NULL);
    char *all_rows = read_file("out/nozzles-all.csv", NULL), expected[8192], told[8192];
    assert_int_equal(count_of(page, "class=\"sheet\""), 2);
    rows_of(all_rows, "a weld at most", expected);
    rows_of(csv, "out/layout-2.yaml", told);
    assert_string_equal(told, expected);
    rows_of(all_rows, "manual", expected);
    rows_of(csv, "room.yaml", told);
    assert_string_equal(told, expected);
    free(all_rows);
    free(page);
    free(csv);
    char *folder = list_folder("compared");
    assert_string_equal(folder, "nozzles-all.csv\nreport.html\nresult.json\n");
    free(folder);
}

/* The layout there is has them as well, of all places that some alternative allows. */
static void shadows_of_the_manual_layout_have_remedies(void **state)
{
    (void)state;
    json_t *shadows = json_object_get(named(all, "layouts", "manual"), "shadows");
    assert_true(json_array_size(shadows) > 0);
    json_t *remedy = json_object_get(json_array_get(shadows, 0), "remedy");
    assert_true(number(remedy, "covers_m2") > 0);
    assert_string_equal(text_of(remedy, "type"), "cone");
    assert_string_equal(text_of(all, "proposed"), "free & easy"); /* whose remedies these are not */
}

static void scenes_hold_every_alternative(void **state)
{
    (void)state;
    static const char *const files[] = {"layout-1.yaml", "layout-2.yaml", "layout.yaml"};
    char *folder = list_folder("out");
    assert_string_equal(folder,
                        "coverage-manual.png\ncoverage.png\ndeposits-manual.exr\ndeposits.exr\nlayout-1.yaml\n"
                        "layout-2.yaml\nlayout.yaml\nmodel-manual.glb\nmodel.glb\nnozzles-all.csv\nnozzles.csv\n"
                        "nozzles.stl\n"
                        "report.html\nresult.json\nsurface.vtp\nswabs.csv\ntexels.vtp\n");
    free(folder);
    for (size_t k = 0; k < 3; k++) {
        char command[100];
        snprintf(command, sizeof command, "simulate out/%s --json", files[k]);
        json_t *again = expect_json(command, 0);
        same(named(again, "layouts", "manual"), named(all, "layouts", names[k]), "coverage");
        json_decref(again);
    }
    json_t *compared = expect_json("compare out/result.json room.yaml --json", 0);
    json_t *read = named(compared, "layouts", "out/result.json (a weld at most)");
    same(read, named(all, "layouts", "a weld at most"), "new_fittings");
    same(read, named(all, "layouts", "a weld at most"), "coverage");
    json_decref(compared);
}

/* Said at once, not after minutes. */
static void what_is_read_is_not_replaced(void **state)
{
    (void)state;
    outcome done = run_program("place out/layout-2.yaml -o out");
    assert_int_equal(done.status, 1);
    assert_non_null(strstr(done.err, "layout-2.yaml: would replace a file that was read"));
    assert_string_equal(done.out, "");
    forget(&done);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    json_t *two = expect_again(all, "place room.yaml --json --threads 2", 0);
    drop_seconds(all);
    drop_seconds(two);
    assert_true(json_equal(all, two));
    json_decref(two);
}

/* Each has its share of the time, be it too little. */
static void time_is_shared(void **state)
{
    (void)state;
    outcome done = run_program("place room.yaml --json --time-limit 0.001");
    json_t *found = json_loads(done.out, 0, NULL);
    assert_true(done.status == 0 || done.status == 4);
    assert_int_equal(json_array_size(json_object_get(found, "alternatives")), 3);
    json_decref(found);
    forget(&done);
}

/* Whatever the scene names first: what is allowed there, too, is found there, too, and which is proposed is said to
 * hang on the time. Nothing is told of bounds that nobody worked out. */
static void nested_ones_are_never_worse(void **state)
{
    (void)state;
    write_room("nested.yaml", "", "max_coverage", ", cost: 1 L/min",
               "  alternatives:\n"
               "    - {name: all of it}\n"
               "    - {name: walls, mounts: [walls]}\n"
               "    - {name: walls and P2, mounts: [P2, walls]}\n"
               "    - {name: one on walls, mounts: [{mount: walls, max_nozzles: 1}]}\n");
    json_t *found = expect_json("place nested.yaml --json -o nested --time-limit 0.001", 4), *layout;
    static const char *const rising[] = {"one on walls", "walls", "walls and P2", "all of it"};
    double before = 0;
    for (size_t k = 0; k < 4; k++) {
        layout = named(found, "layouts", rising[k]);
        assert_true(number(layout, "coverage") >= before);
        before = number(layout, "coverage");
    }
    assert_string_equal(text_of(json_array_get(json_object_get(found, "layouts"), 0), "name"), "all of it");
    assert_non_null(strstr(text_of(found, "proposed_for"), "covers most, of what the time allowed to find"));
    char *page = read_file("nested/report.html", NULL);
    assert_non_null(strstr(page, "covers most, of what the time allowed to find. It "));
    assert_non_null(strstr(page, "; or its layout covers them"));
    assert_non_null(
        strstr(page, "what is found after that is not handed back to them, so that they may do better than is told "
                     "of them. What was found need not be the best.</p>"));
    free(page);
    json_decref(found);
}

/* A fault of one alternative names it. */
static void a_fault_names_its_alternative(void **state)
{
    (void)state;
    write_room("room.yaml", "", "max_coverage", "",
               "    - box: {name: outside, min: [2 m, 2 m, 2 m], max: [2 m, 2 m, 2 m]}\n"
               "  alternatives: [{name: inside, mounts: [P1]}, {name: too far, mounts: [outside]}]\n");
    outcome done = run_program("place room.yaml");
    assert_int_equal(done.status, 3);
    assert_non_null(strstr(done.err, "(alternative 'too far')"));
    forget(&done);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_is_a_placement_of_its_own),
        cmocka_unit_test(they_share_a_geometry),
        cmocka_unit_test(fittings_are_counted_and_limited),
        cmocka_unit_test(one_is_proposed),
        cmocka_unit_test(none_may_reach_what_is_asked_for),
        cmocka_unit_test(the_page_has_every_alternative),
        cmocka_unit_test(scenes_hold_every_alternative),
        cmocka_unit_test(every_layout_has_its_sheet),
        cmocka_unit_test(so_has_what_is_compared),
        cmocka_unit_test(shadows_of_the_manual_layout_have_remedies),
        cmocka_unit_test(what_is_read_is_not_replaced),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(time_is_shared),
        cmocka_unit_test(nested_ones_are_never_worse),
        cmocka_unit_test(a_fault_names_its_alternative),
    };
    return cmocka_run_group_tests_name("alternatives of place", tests, run_once, forget_run);
}
