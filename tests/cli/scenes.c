/* sprayplan check, simulate, place and compare on a small room: figures, files, exit status, and the same bytes for any
 * number of threads. */
#include "workplace.h"

#include <sprayplan/sprayplan.h>

#include <math.h>
#include <signal.h>
#include <time.h>

/* Where what is asserted holds of any texels, and finer ones take long. */
#define COARSE "--set simulate.texel=100mm"

static json_t *layout_named(json_t *result, const char *name)
{
    size_t i;
    json_t *layout;
    json_array_foreach(json_object_get(result, "layouts"), i,
                       layout) if (strcmp(json_string_value(json_object_get(layout, "name")), name) == 0) return layout;
    fail_msg("no layout %s", name);
    return NULL;
}

static double number(json_t *object, const char *key)
{
    assert_true(json_is_number(json_object_get(object, key)));
    return json_number_value(json_object_get(object, key));
}

static json_t *json_file(const char *name)
{
    char *text = read_file(name, NULL);
    assert_non_null(text);
    json_t *object = json_loads(text, 0, NULL);
    assert_non_null(object);
    free(text);
    return object;
}

static void check_measures_the_room(void **state)
{
    (void)state;
    json_t *object = expect_json("check room.yaml --json", 0);
    assert_int_equal(number(json_object_get(object, "mesh"), "triangles"), 12);
    assert_int_equal(json_array_size(json_object_get(object, "parts")), 3);
    assert_true(fabs(number(object, "clean_area_m2") - 6) < 1e-9);
    assert_int_equal(json_array_size(json_object_get(object, "warnings")), 0);
    json_decref(object);
}

/* The box of each part, and a warning where the file's unit can hardly be meant. */
static void check_tells_how_large_everything_is(void **state)
{
    (void)state;
    static const struct {
        const char *unit;
        double metres;
        int warnings;
    } units[] = {{"m", 1, 0}, {"mm", 1e-3, 1}, {"km", 1e3, 1}};
    for (size_t i = 0; i < 3; i++) {
        char scene[256];
        snprintf(scene, sizeof scene, "geometry:\n  - {file: room.obj, unit: %s}\ncavity: [%g, %g, %g]\n",
                 units[i].unit, 0.5 * units[i].metres, 0.5 * units[i].metres, 0.5 * units[i].metres);
        write_file("sized.yaml", scene);
        json_t *object = expect_json("check sized.yaml --json", 0), *warnings = json_object_get(object, "warnings");
        json_t *ceiling = json_array_get(json_object_get(object, "parts"), 1);
        const double low[] = {0, 0, 1}, high[] = {1, 1, 1};
        for (size_t k = 0; k < 3; k++) {
            double a = json_number_value(json_array_get(json_object_get(ceiling, "minimum_m"), k));
            double b = json_number_value(json_array_get(json_object_get(ceiling, "maximum_m"), k));
            assert_true(fabs(a - low[k] * units[i].metres) < 1e-9 * units[i].metres);
            assert_true(fabs(b - high[k] * units[i].metres) < 1e-9 * units[i].metres);
        }
        assert_int_equal(json_array_size(warnings), units[i].warnings);
        assert_true(!units[i].warnings || strstr(json_string_value(json_array_get(warnings, 0)), "unit"));
        json_decref(object);
    }
    outcome result = run_program("check room.yaml");
    assert_non_null(
        strstr(result.out, "0        ceiling                  0, 0, 1                              1, 1, 1\n"));
    forget(&result);
}

static void check_warns_where_bodies_are_closed_and_no_cavity_is_named(void **state)
{
    (void)state;
    write_file("open.yaml", "geometry:\n  - file: room.obj\ncatalogue: catalogue.yaml\n");
    json_t *object = expect_json("check open.yaml --json", 0);
    assert_int_equal(json_array_size(json_object_get(object, "warnings")), 1);
    assert_non_null(strstr(json_string_value(json_array_get(json_object_get(object, "warnings"), 0)), "cavity"));
    json_decref(object);
}

static void check_reports_the_cavity(void **state)
{
    (void)state;
    json_t *object = expect_json("check room.yaml --json", 0);
    assert_true(fabs(json_number_value(json_array_get(json_object_get(object, "cavity_m"), 2)) - 0.5) < 1e-12);
    json_decref(object);
    write_file("astray.yaml", "geometry:\n  - file: room.obj\ncavity: [0.5 m, 0.5 m, 5 m]\n");
    object = expect_json("check astray.yaml --json", 0);
    assert_non_null(strstr(json_string_value(json_array_get(json_object_get(object, "warnings"), 0)), "box"));
    json_decref(object);
}

/* Parabolas lie within what is proved of lines, which is told of lines alone. */
static void lines_are_bounded(void **state)
{
    (void)state;
    static const char *const trajectories[] = {"line", "parabola"};
    double coverage[2];
    for (size_t i = 0; i < 2; i++) {
        char command[200];
        snprintf(command, sizeof command,
                 "simulate room.yaml --json --set simulate.texel=30mm --set simulate.trajectory=%s", trajectories[i]);
        json_t *object = expect_json(command, 0), *manual = layout_named(object, "manual");
        coverage[i] = number(manual, "coverage");
        if (i == 0) {
            double bound = number(manual, "error_bound");
            assert_true(bound > 0 && bound < 0.5);
            assert_true(bound == number(json_object_get(object, "fidelity"), "error_bound"));
            coverage[0] -= bound;
        } else {
            assert_null(json_object_get(manual, "error_bound"));
        }
        json_decref(object);
    }
    assert_true(coverage[1] >= coverage[0]);
}

/* The cone of 120 deg, 0.4 m under the ceiling's height above a floor of 1 m²: 12 L/min over pi sr. On the floor the
 * flux is Q cos^3(a) / (pi h²), above 1 L/min/m² all over it. */
static void simulate_gives_the_figures(void **state)
{
    (void)state;
    json_t *object = expect_json("simulate room.yaml --json --set simulate.trajectory=line", 0);
    json_t *manual = layout_named(object, "manual");
    assert_true(fabs(number(manual, "water_l_min") - 12) < 1e-9);
    assert_true(number(manual, "covered_area_m2") > 1);
    assert_true(fabs(number(manual, "coverage") - number(manual, "covered_area_m2") / 6) < 1e-9);
    assert_true(fabs(number(manual, "area_per_water") - number(manual, "covered_area_m2") / 12) < 1e-9);
    json_t *fidelity = json_object_get(object, "fidelity");
    assert_string_equal(json_string_value(json_object_get(fidelity, "trajectory")), "line");
    /* the coverage is of texels, the estimate says how far off that may be; here as far as the floor's edge lets it */
    assert_true(number(fidelity, "error_estimate") > 0 && number(fidelity, "error_estimate") < 0.01);
    assert_true(number(fidelity, "error_estimate") == number(manual, "error_estimate"));
    assert_true(number(fidelity, "misjudged") >= 0 && number(fidelity, "misjudged") < 0.05);
    assert_true(number(manual, "borderline_m2") >= 0 && number(manual, "borderline_m2") < 6e-6);
    json_decref(object);
    object = expect_json("simulate room.yaml --json --set simulate.evaluator=forward --set simulate.reflections=2", 0);
    assert_null(json_object_get(json_object_get(object, "fidelity"), "error_estimate"));
    assert_null(json_object_get(layout_named(object, "manual"), "misjudged"));
    assert_null(json_object_get(layout_named(object, "manual"), "borderline_m2"));
    json_decref(object);
}

static void without_output_nothing_is_written(void **state)
{
    (void)state;
    char *before = list_folder(".");
    outcome result = run_program("simulate room.yaml");
    assert_int_equal(result.status, 0);
    assert_string_equal(result.err, "");
    assert_non_null(strstr(result.out, "manual"));
    forget(&result);
    expect("simulate room.yaml --quiet", 0, "", "");
    expect("check room.yaml --quiet", 0, "", "");
    char *after = list_folder(".");
    assert_string_equal(before, after);
    free(before);
    free(after);
}

/* Of the whole set of files one run serves several tests. */
static void ensure(const char *folder, const char *arguments)
{
    char text[256];
    snprintf(text, sizeof text, "%s/result.json", folder);
    char *there = read_file(text, NULL);
    free(there);
    if (there)
        return;
    snprintf(text, sizeof text, "%s -o %s --quiet", arguments, folder);
    outcome result = run_program(text);
    assert_true(result.status == 0 || result.status == 4);
    assert_string_equal(result.out, "");
    forget(&result);
}

static void simulate_writes_its_files(void **state)
{
    (void)state;
    outcome result = run_program("simulate room.yaml -o simulated --json");
    assert_int_equal(result.status, 0);
    char *written = read_file("simulated/result.json", NULL);
    assert_string_equal(written, result.out);
    free(written);
    forget(&result);
    char *names = list_folder("simulated");
    assert_string_equal(names,
                        "coverage.png\ndeposits.exr\nlayout.yaml\nmodel.glb\nnozzles.csv\nnozzles.stl\nreport.html\n"
                        "result.json\nsurface.vtp\nswabs.csv\ntexels.vtp\n");
    free(names);
}

/* When it was made stands in the page alone; what was read, in both. */
static void what_was_read_is_told(void **state)
{
    (void)state;
    assert_int_equal(setenv("SOURCE_DATE_EPOCH", "86400", 1), 0);
    outcome result = run_program("simulate room.yaml -o 'made here' --quiet");
    assert_int_equal(unsetenv("SOURCE_DATE_EPOCH"), 0);
    assert_int_equal(result.status, 0);
    forget(&result);
    json_t *object = json_file("made here/result.json"), *inputs = json_object_get(object, "inputs");
    assert_string_equal(json_string_value(json_object_get(json_array_get(inputs, 0), "file")), "room.yaml");
    char *page = read_file("made here/report.html", NULL), digest[SP_SHA256], path[4096];
    assert_non_null(strstr(page, ", 1970-01-02 00:00 UTC, by <code>sprayplan simulate "));
    assert_non_null(strstr(page, "&#39;made here&#39;"));
    size_t i;
    json_t *input;
    sp_error error = {0};
    assert_true(json_array_size(inputs) >= 2);
    json_array_foreach(inputs, i, input)
    {
        const char *told = json_string_value(json_object_get(input, "sha256"));
        snprintf(path, sizeof path, "%s/%s", workplace, json_string_value(json_object_get(input, "file")));
        assert_true(sp_file_sha256(path, digest, &error));
        assert_string_equal(told, digest);
        assert_non_null(strstr(page, digest));
    }
    json_decref(object);
    free(page);
}

/* It cannot be read twice: an empty file's digest would be told. */
static void what_came_through_a_pipe_has_no_digest(void **state)
{
    (void)state;
    char line[4096];
    snprintf(line, sizeof line, "cd '%s' && mkfifo pipe.yaml && (timeout 60 cat room.yaml >pipe.yaml &)", workplace);
    assert_int_equal(system(line), 0);
    json_t *object = expect_json("simulate pipe.yaml " COARSE " --json", 0),
           *inputs = json_object_get(object, "inputs");
    assert_int_equal(json_array_size(inputs), 2);
    assert_string_equal(json_string_value(json_object_get(json_array_get(inputs, 0), "file")), "room.obj");
    json_decref(object);
}

/* Standard output and the folder tell the same, and no less without a folder; times aside. */
static void json_is_the_same_with_files_and_without(void **state)
{
    (void)state;
    json_t *told[] = {expect_json("simulate room.yaml " COARSE " --json", 0),
                      expect_json("simulate room.yaml " COARSE " -o told --json", 0), json_file("told/result.json")};
    const json_t *nozzle = json_array_get(json_object_get(layout_named(told[0], "manual"), "nozzles"), 0);
    assert_true(json_is_real(json_object_get(nozzle, "alone_m2")) &&
                json_is_real(json_object_get(nozzle, "lost_without_m2")));
    for (int i = 0; i < 3; i++)
        json_object_del(told[i], "stages");
    assert_true(json_equal(told[0], told[1]) && json_equal(told[1], told[2]));
    for (int i = 0; i < 3; i++)
        json_decref(told[i]);
}

static void no_input_is_overwritten(void **state)
{
    (void)state;
    ensure("simulated", "simulate room.yaml");
    char *before = read_file("simulated/layout.yaml", NULL);
    outcome result = run_program("simulate simulated/layout.yaml -o simulated");
    assert_int_equal(result.status, 1);
    assert_non_null(strstr(result.err, "would replace a file that was read"));
    char *after = read_file("simulated/layout.yaml", NULL);
    assert_string_equal(before, after);
    free(before);
    free(after);
    forget(&result);
}

/* A catalogue may bear the name of a file that is about to be written. */
static void nor_is_what_the_scene_names(void **state)
{
    (void)state;
    char scene[sizeof room_yaml + 64];
    const char *at = strstr(room_yaml, "catalogue.yaml");
    snprintf(scene, sizeof scene, "%.*slayout.yaml%s", (int)(at - room_yaml), room_yaml, at + strlen("catalogue.yaml"));
    write_file("named.yaml", scene);
    write_file("layout.yaml", catalogue_yaml);
    expect("simulate named.yaml -o .", 1, "",
           "./layout.yaml: would replace a file that was read, expected another folder "
           "to write to\n");
    char *after = read_file("layout.yaml", NULL);
    assert_string_equal(after, catalogue_yaml);
    free(after);
}

/* Not after the minutes that a search may take: this one would find no mounting point. */
static void where_nothing_can_be_written_is_said_first(void **state)
{
    (void)state;
    expect("place room.yaml -o room.obj/folder --set place.clearance=9", 1, "",
           "room.obj/folder: cannot make this folder: Not a directory\n");
    expect("compare room.yaml nothing.yaml -o room.obj", 1, "", "room.obj: is a file, expected a folder to write to\n");
    outcome result = run_program("place room.yaml -o unmade --set place.clearance=9");
    assert_int_equal(result.status, 3);
    forget(&result);
    char *names = list_folder(".");
    assert_null(strstr(names, "unmade"));
    free(names);
}

/* Errors that only show once the scene is put to work stand in the scene too. */
static void late_errors_are_located(void **state)
{
    (void)state;
    static const char wrong_reflections[] = "geometry:\n  - file: room.obj\n"
                                            "simulate: {evaluator: inverse,\n           reflections: 2}\n";
    write_file("late.yaml", wrong_reflections);
    outcome result = run_program("simulate late.yaml");
    assert_int_equal(result.status, 3);
    assert_ptr_equal(strstr(result.err, "late.yaml:4:25: reflections: "), result.err);
    forget(&result);
    result = run_program("place room.yaml --set place.clearance=9");
    assert_int_equal(result.status, 3);
    assert_ptr_equal(strstr(result.err, "room.yaml:10:3: place: none of "), result.err);
    forget(&result);
    write_file("bare.yaml", "geometry:\n  - file: room.obj\nsimulate: {texel: 100 mm}\n");
    expect("simulate bare.yaml", 3, "", "bare.yaml:1:1: nozzles: found none, expected at least one to simulate\n");
    expect("simulate bare.yaml --set simulate.texel=1um", 3, "",
           "simulate.texel=1um: texel: 1e-06 m found, too small for a surface of 6 m2; expected at least 7.75e-05 m\n");
}

static void kept_nozzles_beyond_the_limits_are_named_as_the_cause(void **state)
{
    (void)state;
    char scene[sizeof room_yaml + 64];
    const char *at = strstr(room_yaml, "pressure: 2 bar}");
    snprintf(scene, sizeof scene, "%.*skeep: true, %s", (int)(at - room_yaml), room_yaml, at);
    write_file("kept.yaml", scene);
    outcome result = run_program("place kept.yaml --set 'place.max_water=5 L/min' --set 'place.coverage=1 %' -o kept");
    assert_int_equal(result.status, 4);
    assert_non_null(strstr(result.err, "the nozzles to keep"));
    forget(&result);
    char *report = read_file("kept/report.html", NULL);
    assert_non_null(strstr(report, "The nozzles to keep are more"));
    assert_null(strstr(report, "is not reached"));
    free(report);
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

static void compare_sets_scenes_side_by_side(void **state)
{
    (void)state;
    write_file("other.yaml", room_yaml);
    json_t *object = expect_json("compare room.yaml other.yaml --json", 0);
    assert_int_equal(json_array_size(json_object_get(object, "layouts")), 2);
    assert_true(number(json_array_get(json_object_get(object, "layouts"), 0), "coverage") ==
                number(json_array_get(json_object_get(object, "layouts"), 1), "coverage"));
    json_decref(object);
    object = expect_json("compare room.yaml other.yaml room.yaml other.yaml --json", 0);
    assert_int_equal(json_array_size(json_object_get(object, "stages")), 4);
    json_decref(object);
}

/* The room with another text in place of a part of its scene. */
static void write_room_with(const char *name, const char *part, const char *instead)
{
    char scene[sizeof room_yaml + 256];
    const char *at = strstr(room_yaml, part);
    assert_non_null(at);
    snprintf(scene, sizeof scene, "%.*s%s%s", (int)(at - room_yaml), room_yaml, instead, at + strlen(part));
    write_file(name, scene);
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

/* The line of a folder's report that begins with `title`. */
static void row_of(const char *folder, const char *title, char row[512])
{
    char path[128];
    snprintf(path, sizeof path, "%s/report.html", folder);
    char *page = read_file(path, NULL);
    const char *at = page ? strstr(page, title) : NULL;
    assert_non_null(at);
    snprintf(row, 512, "%.*s", (int)strcspn(at, "\n"), at);
    free(page);
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
    snprintf(percent, sizeof percent, "<td>%.1f&nbsp;\xc2\xb1", 100 * coverage);
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

/* In the ceiling, and above it. */
static void a_nozzle_must_stand_in_the_liquid(void **state)
{
    (void)state;
    static const struct {
        const char *position, *complaint;
    } wrong[] = {{"[0.5 m, 0.5 m, 1 m]", "N1 at [0.5 m, 0.5 m, 1 m] is in a wall, part \"ceiling\""},
                 {"[0.5 m, 0.5 m, 1.9 m]", "N1 at [0.5 m, 0.5 m, 1.9 m] is not inside the cavity"}};
    for (size_t i = 0; i < 2; i++) {
        write_room_with("astray.yaml", "[0.5 m, 0.5 m, 0.9 m]", wrong[i].position);
        static const char *const commands[] = {"simulate astray.yaml", "compare room.yaml astray.yaml"};
        for (size_t c = 0; c < 2; c++) {
            outcome result = run_program(commands[c]);
            assert_int_equal(result.status, 3);
            assert_ptr_equal(strstr(result.err, "astray.yaml:7:5: nozzles: "), result.err);
            assert_non_null(strstr(result.err, wrong[i].complaint));
            forget(&result);
        }
        json_t *object = expect_json("check astray.yaml --json", 0), *warning;
        size_t w, told = 0;
        json_array_foreach(json_object_get(object, "warnings"), w, warning) told +=
            strstr(json_string_value(warning), wrong[i].complaint) != NULL;
        assert_int_equal(told, 1);
        json_decref(object);
    }
    outcome result = run_program("place astray.yaml --set 'place.coverage=10 %' --time-limit 1");
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(result.err, "the layout compared with is in doubt: nozzles: N1 at "));
    forget(&result);
    write_room_with("astray.yaml", "[0.5 m, 0.5 m, 0.9 m]", "[0.5 m, 0.5 m, 1.9 m], keep: true");
    result = run_program("place astray.yaml");
    assert_int_equal(result.status, 3);
    forget(&result);
}

/* In a closed room nothing gets lost; through an open ceiling it does. */
static void simulate_says_where_the_liquid_goes(void **state)
{
    (void)state;
    json_t *object = expect_json("simulate room.yaml --json", 0);
    json_t *liquid = json_object_get(layout_named(object, "manual"), "liquid_l_min");
    assert_true(fabs(number(liquid, "on_clean_surface") - 12) < 1e-9);
    assert_true(number(liquid, "left") == 0 && number(liquid, "not_followed") == 0);
    json_decref(object);
    const char *ceiling = strstr(room_obj, "g ceiling\n"), *walls = strstr(room_obj, "g walls\n");
    char open_obj[sizeof room_obj], scene[1024];
    snprintf(open_obj, sizeof open_obj, "%.*s%s", (int)(ceiling - room_obj), room_obj, walls);
    write_file("open.obj", open_obj);
    snprintf(scene, sizeof scene,
             "geometry:\n  - file: open.obj\n    clean_parts: [floor]\ncatalogue: catalogue.yaml\n"
             "nozzles:\n  - {name: N1, type: ball, position: [0.5 m, 0.5 m, 0.5 m], axis: [0, 0, 1], "
             "pressure: 2 bar}\nsimulate: {texel: 100 mm, trajectory: line}\n");
    write_file("open.yaml", scene);
    outcome result = run_program("simulate open.yaml -o opened");
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(
        result.out, "L/min   on surface to clean     on other surface            flies out         not followed\n"
                    "manual          3.3  16.7 %         13.3  66.6 %          3.3  16.7 %          "
                    "0.0   0.0 %\n"));
    forget(&result);
    char row[512];
    row_of("opened", "Flies out of the geometry", row);
    assert_non_null(strstr(row, "<td>3.3 <span class=\"unit\">(16.7&nbsp;%)"));
}

/* A closed room keeps all that runs down its walls; film covers more than impact alone, and is read back. */
static void film_runs_down_the_walls(void **state)
{
    (void)state;
    write_room_with("film.yaml", "flux: 1 L/min/m2", "flux: 20 L/min/m2, film: 2 L/min/m");
    write_room_with("impact.yaml", "flux: 1 L/min/m2", "flux: 20 L/min/m2");
    json_t *object = expect_json("simulate film.yaml --json", 0), *layout = layout_named(object, "manual");
    json_t *film = json_object_get(layout, "film"), *impact = expect_json("simulate impact.yaml --json", 0);
    double arriving = number(film, "arriving_l_min"), held = number(film, "held_l_min");
    assert_true(fabs(arriving - 12) < 0.02 * 12); /* as far as patches tell how much falls on them */
    assert_true(fabs(number(film, "left_l_min") + number(film, "astray_l_min") + held - arriving) < 1e-9);
    assert_true(held > 0.999 * arriving);
    assert_true(fabs(number(film, "per_girth_l_min_m") - arriving / 4) < 0.05 * arriving);
    double alone = number(film, "covered_area_m2"), covered = number(layout, "covered_area_m2");
    assert_true(alone > 0.1);
    assert_true(fabs(number(layout_named(impact, "manual"), "covered_area_m2") + alone - covered) < 1e-9);
    char *text = json_dumps(object, 0);
    write_file("film.json", text);
    free(text);
    json_t *read = expect_json("compare film.json impact.yaml --json", 0);
    json_t *again = json_object_get(json_array_get(json_object_get(read, "layouts"), 0), "film");
    assert_true(fabs(number(again, "covered_area_m2") - alone) < 1e-12);
    json_decref(object);
    json_decref(impact);
    json_decref(read);
}

/* The room's floor has no drain. */
static void check_says_where_liquid_stands(void **state)
{
    (void)state;
    write_room_with("film.yaml", "flux: 1 L/min/m2", "film: 2 L/min/m");
    json_t *object = expect_json("check film.yaml --json", 0), *hollows = json_object_get(object, "hollows");
    assert_int_equal(json_array_size(hollows), 1);
    json_t *floor = json_array_get(hollows, 0);
    assert_true(fabs(number(floor, "area_m2") - 1) < 1e-9);
    assert_true(json_is_false(json_object_get(floor, "drains")));
    assert_true(json_number_value(json_array_get(json_object_get(floor, "place_m"), 2)) == 0);
    assert_non_null(strstr(json_string_value(json_array_get(json_object_get(object, "warnings"), 0)), "stands there"));
    json_decref(object);
    outcome result = run_program("check film.yaml");
    assert_non_null(strstr(result.out, "not at all\n"));
    forget(&result);
    object = expect_json("check room.yaml --json", 0);
    assert_int_equal(json_array_size(json_object_get(object, "hollows")), 0);
    json_decref(object);
    result = run_program("compare film.yaml room.yaml -o standing --quiet");
    assert_int_equal(result.status, 0);
    forget(&result);
    char *page = read_file("standing/report.html", NULL);
    assert_non_null(strstr(page, "<td>1.0000</td><td>not at all</td>"));
    free(page);
}

static void refused(const char *arguments, const char *complaint)
{
    outcome result = run_program(arguments);
    assert_int_equal(result.status, 3);
    assert_non_null(strstr(result.err, complaint));
    forget(&result);
}

/* A proposal counts film as simulate does, with fewer nozzles or more coverage than without, and the same bytes for any
 * number of threads; its bound holds. */
static void film_is_placed_for(void **state)
{
    (void)state;
    write_room_with("film.yaml", "{flux: 1 L/min/m2}", "{flux: 20 L/min/m2, film: 3 L/min/m}");
    json_t *one = expect_json("place film.yaml " COARSE " -o proposed --json --threads 1", 4);
    json_t *three = expect_again(one, "place film.yaml " COARSE " --json --threads 3", 4);
    json_t *layout = layout_named(one, "proposed"), *certificate = json_object_get(one, "certificate");
    assert_true(number(json_object_get(layout, "film"), "covered_area_m2") > 0);
    assert_true(number(certificate, "coverage_bound_same_water") >= number(certificate, "coverage"));
    assert_true(json_equal(json_object_get(one, "layouts"), json_object_get(three, "layouts")));
    assert_true(json_equal(json_object_get(one, "front"), json_object_get(three, "front")));
    json_t *again = expect_json("simulate proposed/layout.yaml --json", 0);
    assert_true(number(layout_named(again, "manual"), "coverage") == number(layout, "coverage"));
    json_decref(one);
    json_decref(three);
    json_decref(again);
}

/* Where film cannot be counted, it is refused. */
static void film_is_refused_where_it_cannot_be_counted(void **state)
{
    (void)state;
    write_file("nowhere.yaml", "geometry:\n  - file: room.obj\ncriterion: {film: 2 L/min/m}\n");
    refused("check nowhere.yaml", "nowhere.yaml:3:19: film: found without a cavity");
    write_file("wrong.yaml", "geometry:\n  - file: room.obj\ncriterion: {film: 2 L/min}\n");
    refused("check wrong.yaml", "wrong.yaml:3:19: film: found '2 L/min', expected a flow per width");
}

/* Drops are placed, the same for any number of threads, and the proposal simulated is what was proposed. */
static void drag_is_placed(void **state)
{
    (void)state;
    write_room_with("mist.yaml", "simulate: {", "simulate: {trajectory: drag, accuracy: 5%, ");
    json_t *one = expect_json("place mist.yaml --set simulate.texel=160mm -o mist --threads 1 --json", 0);
    json_t *three = expect_again(one, "place mist.yaml --set simulate.texel=160mm --threads 3 --json", 0);
    json_t *again = expect_json("simulate mist/layout.yaml --json", 0);
    const char *same[] = {"layouts", "front", "certificate", "fidelity"};
    for (size_t i = 0; i < sizeof same / sizeof *same; i++)
        assert_true(json_equal(json_object_get(one, same[i]), json_object_get(three, same[i])));
    assert_string_equal(json_string_value(json_object_get(json_object_get(one, "fidelity"), "trajectory")), "drag");
    assert_true(json_equal(json_object_get(layout_named(one, "proposed"), "coverage"),
                           json_object_get(layout_named(again, "manual"), "coverage")));
    assert_true(number(json_object_get(one, "certificate"), "coverage_bound_same_water") >=
                number(layout_named(one, "proposed"), "coverage"));
    json_decref(one);
    json_decref(three);
    json_decref(again);
}

/* What drops that air holds back do is simulated, compared and told, and written back. */
static void drag_is_simulated(void **state)
{
    (void)state;
    write_room_with("drag.yaml", "simulate: {texel: " ROOM_TEXEL, "simulate: {trajectory: drag, texel: 100 mm");
    json_t *drops = expect_json("simulate drag.yaml -o drops --json", 0);
    assert_string_equal(json_string_value(json_object_get(json_object_get(drops, "fidelity"), "trajectory")), "drag");
    json_t *again = expect_json("simulate drops/layout.yaml --json", 0);
    json_t *set = expect_json("simulate room.yaml " COARSE " --set simulate.trajectory=drag --json", 0);
    assert_true(json_equal(json_object_get(layout_named(drops, "manual"), "coverage"),
                           json_object_get(layout_named(again, "manual"), "coverage")));
    assert_true(json_equal(json_object_get(drops, "layouts"), json_object_get(set, "layouts")));
    json_decref(drops);
    json_decref(again);
    json_decref(set);
    json_decref(expect_json("compare drops/result.json drag.yaml room.yaml --json", 0));
    char *page = read_file("drops/report.html", NULL);
    assert_non_null(strstr(page, "far end of a bracket"));
    free(page);
}

static void atlas_keeps_every_triangle(void **state)
{
    (void)state;
    json_t *object = expect_json("atlas room.obj -o unfolded.obj --texel 10mm --json", 0);
    assert_int_equal(number(object, "triangles"), 12);
    assert_int_equal(number(object, "shared_texels"), 0);
    assert_int_equal(number(object, "overlaps"), 0);
    json_decref(object);
    char *obj = read_file("unfolded.obj", NULL), *faces = obj;
    int count = 0;
    assert_non_null(obj);
    while ((faces = strstr(faces, "\nf ")))
        ++count, ++faces;
    assert_int_equal(count, 12);
    assert_non_null(strstr(obj, "usemtl page_0\n"));
    free(obj);
}

/* Whether the process has a handler of its own for this signal. */
static bool catches(pid_t process, int signal)
{
    char path[64], line[256];
    unsigned long long caught = 0;
    snprintf(path, sizeof path, "/proc/%d/status", (int)process);
    FILE *file = fopen(path, "r");
    while (file && fgets(line, sizeof line, file))
        sscanf(line, "SigCgt: %llx", &caught);
    if (file)
        fclose(file);
    return caught >> (signal - 1) & 1;
}

static pid_t begin_long_place(const char *folder)
{
    pid_t child = fork();
    if (child == 0) {
        if (chdir(workplace) != 0 || !freopen(".out", "w", stdout) || !freopen(".err", "w", stderr))
            _exit(127);
        /* Thousands of mounting points on fine texels: far longer than the test lets it run. */
        execl(BINARY_DIR "/sprayplan", "sprayplan", "place", "long.yaml", "-o", folder, (char *)NULL);
        _exit(127);
    }
    return child;
}

static void write_long_scene(void)
{
    char *long_yaml = malloc(sizeof room_yaml + 512);
    sprintf(long_yaml, "%s    - box: {min: [0.1, 0.1, 0.1], max: [0.9, 0.9, 0.9], spacing: 40 mm, tilt: 180 deg}\n",
            room_yaml);
    write_file("long.yaml", long_yaml);
    free(long_yaml);
}

/* check accepts what was written in `folder`, and simulate gives its figures; of a proposal without nozzles, where that
 * may be, there is nothing to simulate. */
static void proposal_is_whole(const char *folder, bool may_be_empty)
{
    char text[256];
    snprintf(text, sizeof text, "%s/result.json", folder);
    json_t *placed = json_file(text), *proposed = layout_named(placed, "proposed");
    if (may_be_empty && number(proposed, "water_l_min") == 0) {
        assert_true(number(proposed, "covered_area_m2") == 0);
        json_decref(placed);
        return;
    }
    snprintf(text, sizeof text, "check %s/layout.yaml --quiet", folder);
    outcome result = run_program(text);
    assert_int_equal(result.status, 0);
    forget(&result);
    snprintf(text, sizeof text, "simulate %s/layout.yaml --json", folder);
    json_t *again = expect_json(text, 0), *manual = layout_named(again, "manual");
    assert_true(number(proposed, "covered_area_m2") == number(manual, "covered_area_m2"));
    assert_true(number(proposed, "water_l_min") == number(manual, "water_l_min"));
    json_decref(placed);
    json_decref(again);
}

static void out_of_time_place_writes_the_best_so_far(void **state)
{
    (void)state;
    write_long_scene();
    static const char *const limits[] = {"0.1", "2"};
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        char text[128];
        snprintf(text, sizeof text, "place long.yaml -o limited%zu --time-limit %s", i, limits[i]);
        outcome result = run_program(text);
        assert_true(result.status == 0 || result.status == 4);
        /* either what is proved of the best possible, or that nothing is */
        assert_true(!strstr(result.out, "candidate poses") == !!strstr(result.out, "before anything was proved"));
        forget(&result);
        snprintf(text, sizeof text, "limited%zu", i);
        proposal_is_whole(text, false);
    }
}

static void place_survives(int signal, const char *folder)
{
    write_long_scene();
    pid_t child = begin_long_place(folder);
    assert_true(child > 0);
    struct timespec pause = {0, 10000000}, worked = {0};
    clockid_t clock;
    int status;
    assert_int_equal(clock_getcpuclockid(child, &clock), 0);
    /* The evaluator of twelve triangles takes a few milliseconds of two seconds. */
    while (!catches(child, signal) || worked.tv_sec < 2) {
        assert_int_equal(waitpid(child, &status, WNOHANG), 0); /* it must not have ended by itself */
        nanosleep(&pause, NULL);
        assert_int_equal(clock_gettime(clock, &worked), 0);
    }
    assert_int_equal(kill(child, signal), 0);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 130);
    char *complaint = read_file(".err", NULL);
    assert_non_null(strstr(complaint, "interrupted"));
    free(complaint);
    proposal_is_whole(folder, true); /* the signal may come before the first nozzle is found */
}

static void interrupting_place_writes_the_best_so_far(void **state)
{
    (void)state;
    place_survives(SIGINT, "interrupted");
}

/* As timeout(1) and schedulers do. */
static void so_does_asking_it_to_end(void **state)
{
    (void)state;
    place_survives(SIGTERM, "terminated");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_measures_the_room),
        cmocka_unit_test(check_tells_how_large_everything_is),
        cmocka_unit_test(check_warns_where_bodies_are_closed_and_no_cavity_is_named),
        cmocka_unit_test(check_reports_the_cavity),
        cmocka_unit_test(simulate_gives_the_figures),
        cmocka_unit_test(lines_are_bounded),
        cmocka_unit_test(without_output_nothing_is_written),
        cmocka_unit_test(simulate_writes_its_files),
        cmocka_unit_test(what_was_read_is_told),
        cmocka_unit_test(what_came_through_a_pipe_has_no_digest),
        cmocka_unit_test(json_is_the_same_with_files_and_without),
        cmocka_unit_test(no_input_is_overwritten),
        cmocka_unit_test(nor_is_what_the_scene_names),
        cmocka_unit_test(where_nothing_can_be_written_is_said_first),
        cmocka_unit_test(late_errors_are_located),
        cmocka_unit_test(kept_nozzles_beyond_the_limits_are_named_as_the_cause),
        cmocka_unit_test(where_nothing_can_be_covered_place_says_so),
        cmocka_unit_test(place_gives_the_same_bytes_for_any_number_of_threads),
        cmocka_unit_test(the_written_layout_gives_the_same_figures),
        cmocka_unit_test(place_says_whether_the_coverage_asked_for_is_reached),
        cmocka_unit_test(compare_sets_scenes_side_by_side),
        cmocka_unit_test(what_cannot_be_reached_is_said_first),
        cmocka_unit_test(what_can_be_reached_is_the_target),
        cmocka_unit_test(a_layout_has_one_coverage_wherever_it_is_read),
        cmocka_unit_test(a_nozzle_must_stand_in_the_liquid),
        cmocka_unit_test(simulate_says_where_the_liquid_goes),
        cmocka_unit_test(film_runs_down_the_walls),
        cmocka_unit_test(check_says_where_liquid_stands),
        cmocka_unit_test(film_is_placed_for),
        cmocka_unit_test(film_is_refused_where_it_cannot_be_counted),
        cmocka_unit_test(drag_is_simulated),
        cmocka_unit_test(drag_is_placed),
        cmocka_unit_test(atlas_keeps_every_triangle),
        cmocka_unit_test(out_of_time_place_writes_the_best_so_far),
        cmocka_unit_test(interrupting_place_writes_the_best_so_far),
        cmocka_unit_test(so_does_asking_it_to_end),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
