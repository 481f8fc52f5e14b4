/* sprayplan check on a small room. */
#include "results.h"

#include <math.h>

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
static void check_reports_how_large_everything_is(void **state)
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

/* Without its unit, so that it is in m; as long as a tenth of the diagonal it is not too long. */
static void texels_that_are_too_long_are_warned_of(void **state)
{
    (void)state;
    static const char said[] =
        "texel: 60 m is more than a tenth of the geometry's diagonal of 1.732 m, so that patches "
        "cannot follow its surface: 60 alone is 60 m; did you mean 60 mm?";
    json_t *object = expect_json("check room.yaml --set simulate.texel=60 --json", 0);
    json_t *warnings = json_object_get(object, "warnings");
    assert_int_equal(json_array_size(warnings), 1);
    assert_string_equal(json_string_value(json_array_get(warnings, 0)), said);
    json_decref(object);
    outcome result = run_program("simulate room.yaml --set simulate.texel=60");
    assert_non_null(strstr(result.out, said));
    forget(&result);
    object = expect_json("check room.yaml --set simulate.texel=173mm --json", 0);
    assert_int_equal(json_array_size(json_object_get(object, "warnings")), 0);
    json_decref(object);
}

/* With a texel that is meant for another unit there is nothing to check, but the question stays. */
static void the_unit_is_asked_for_behind_an_error_of_the_texel(void **state)
{
    (void)state;
    write_room_with("kilo.yaml", "file: room.obj", "{file: room.obj, unit: km}");
    outcome result = run_program("check kilo.yaml --set simulate.texel=25mm");
    assert_int_equal(result.status, 3);
    assert_non_null(strstr(result.err, "texel: 0.025 m found, too small for a surface of"));
    assert_non_null(
        strstr(result.err, "; geometry: file 0 is 1000 m x 1000 m x 1000 m: is the unit m (1 m x 1 m x 1 m)"));
    forget(&result);
    result = run_program("check room.yaml --set simulate.texel=1um");
    assert_int_equal(result.status, 3);
    assert_null(strstr(result.err, "is the unit"));
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

/* Of a port above the ceiling, and not of one in it. */
static void check_warns_of_mounts_that_take_no_nozzle(void **state)
{
    (void)state;
    write_file("mounted.yaml", "geometry:\n  - file: room.obj\ncavity: [0.5 m, 0.5 m, 0.5 m]\n"
                               "catalogue: catalogue.yaml\nplace:\n  pressure: 2 bar\n  mounts:\n"
                               "    - port: {name: above, position: [0.5 m, 0.5 m, 2 m], axis: [0, 0, -1]}\n"
                               "    - port: {name: within, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 0, -1]}\n");
    json_t *object = expect_json("check mounted.yaml --json", 0), *warnings = json_object_get(object, "warnings");
    assert_int_equal(json_array_size(warnings), 1);
    assert_non_null(strstr(json_string_value(json_array_get(warnings, 0)), "'above'"));
    json_decref(object);
}

static const char ported_yaml[] =
    "geometry:\n"
    "  - file: room.obj\n"
    "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
    "catalogue: catalogue.yaml\n"
    "nozzles:\n"
    "  - {name: fits, type: cone, position: [0.3 m, 0.3 m, 0.8 m], axis: [0, 0.36, -1], pressure: 2 bar}\n"
    "  - {name: leans, type: cone, position: [0.7 m, 0.3 m, 0.8 m], axis: [0, 0.5, -1], pressure: 2 bar, keep: true}\n"
    "  - {name: other, type: ball, position: [0.7 m, 0.7 m, 0.8 m], axis: [0, 0, -1], pressure: 2 bar}\n"
    "  - {name: second, type: cone, position: [0.3 m, 0.3 m, 0.7 m], axis: [0, 0, -1], pressure: 2 bar}\n"
    "  - {name: deep, type: cone, position: [0.3 m, 0.7 m, 0.4 m], axis: [0, 0, -1], pressure: 2 bar}\n"
    "  - {name: off, type: cone, position: [0.3 m, 0.75 m, 0.4 m], axis: [0, 0, -1], pressure: 2 bar}\n"
    "place:\n"
    "  pressure: 2 bar\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [0.3 m, 0.3 m, 1 m], axis: [0, 0, -1], tilt: 20 deg, depth: {from: 100 mm, to: "
    "500 mm, spacing: 200 mm}}\n"
    "    - port: {name: P2, position: [0.7 m, 0.3 m, 1 m], axis: [0, 0, -1], tilt: 20 deg, depth: {from: 100 mm, to: "
    "500 mm, spacing: 200 mm}}\n"
    "    - port: {name: P3, position: [0.7 m, 0.7 m, 1 m], axis: [0, 0, -1], types: [cone], depth: {from: 100 mm, to: "
    "500 mm, spacing: 200 mm}}\n"
    "    - port: {name: P4, position: [0.3 m, 0.7 m, 1 m], axis: [0, 0, -1], depth: {from: 100 mm, to: "
    "500 mm, spacing: 200 mm}}\n"
    "    - port: {name: P5, position: [0.3 m, 0.7 m, 1 m], axis: [0, 0, -1], depth: {from: 100 mm, to: "
    "300 mm, spacing: 200 mm}}\n";

/* Types, tilt, depths and number; and a port that is there twice. */
static void check_warns_of_nozzles_against_their_ports(void **state)
{
    (void)state;
    static const char *const expected[] = {
        "nozzle \"leans\": in port P2, tilted by 26.6 deg from its axis, expected no more than 20.0 deg",
        "nozzle \"other\": in port P3, of type 'ball', expected one of the port's types: cone",
        "nozzle \"second\": in port P1, as \"fits\" is, expected one nozzle in a port",
        "nozzle \"deep\": on the axis of port P4, 600 mm deep, expected 100 mm to 500 mm; it is not taken to be in the "
        "port",
        "mounts: port P5 has the mouth and the axis of port P4, so that a layout may have a nozzle in each",
    };
    const size_t count = sizeof expected / sizeof *expected;
    write_file("ported.yaml", ported_yaml);
    json_t *object = expect_json("check ported.yaml --json", 0), *warnings = json_object_get(object, "warnings");
    assert_int_equal(json_array_size(warnings), count);
    for (size_t i = 0; i < count; i++)
        assert_string_equal(json_string_value(json_array_get(warnings, i)), expected[i]);
    json_decref(object);
}

/* Between the settings of a port; not where a setting is written with few digits, nor where there are no steps. */
static void check_warns_of_nozzles_between_settings_of_their_ports(void **state)
{
    (void)state;
    static const char *const expected[] = {
        "nozzle \"between\": in port P1, at a depth of 237 mm, expected a step of 50 mm: it can be mounted at 250 mm",
        "nozzle \"between\": in port P1, tilted by 21.801 deg, expected a step of 15 deg: it can be mounted at 15 deg",
    };
    const size_t count = sizeof expected / sizeof *expected;
    write_file(
        "stepped.yaml",
        "geometry:\n"
        "  - file: room.obj\n"
        "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
        "catalogue: catalogue.yaml\n"
        "nozzles:\n"
        "  - {name: between, type: cone, position: [0.3 m, 0.3 m, 0.763 m], axis: [0, 0.4, -1], pressure: 2 bar}\n"
        "  - {name: set, type: cone, position: [0.7 m, 0.3 m, 0.7501 m], axis: [0, 0.26, -0.97], "
        "pressure: 2 bar}\n"
        "  - {name: free, type: cone, position: [0.7 m, 0.7 m, 0.763 m], axis: [0, 0.4, -1], pressure: 2 bar}\n"
        "place:\n"
        "  pressure: 2 bar\n"
        "  mounts:\n"
        "    - port: {name: P1, position: [0.3 m, 0.3 m, 1 m], tilt: 30 deg, step: {depth: 50 mm, tilt: 15 deg}, "
        "depth: {from: 100 mm, to: 500 mm, spacing: 200 mm}}\n"
        "    - port: {name: P2, position: [0.7 m, 0.3 m, 1 m], tilt: 30 deg, step: {depth: 50 mm, tilt: 15 deg}, "
        "depth: {from: 100 mm, to: 500 mm, spacing: 200 mm}}\n"
        "    - port: {name: P3, position: [0.7 m, 0.7 m, 1 m], tilt: 30 deg, depth: {from: 100 mm, to: "
        "500 mm, spacing: 200 mm}}\n");
    json_t *object = expect_json("check stepped.yaml --json", 0), *warnings = json_object_get(object, "warnings");
    assert_int_equal(json_array_size(warnings), count);
    for (size_t i = 0; i < count; i++)
        assert_string_equal(json_string_value(json_array_get(warnings, i)), expected[i]);
    json_decref(object);
}

/* Of `place` and of an alternative's own; not where the kept nozzles are within, whatever others take. */
static void check_warns_of_limits_below_what_is_kept(void **state)
{
    (void)state;
    static const char *const expected[] = {
        "place: max_water of 20 L/min is less than the 24 L/min that the 2 nozzles to keep take",
        "alternative \"one\": max_nozzles of 1 is less than the 2 nozzles to keep",
    };
    const size_t count = sizeof expected / sizeof *expected;
    write_file(
        "kept.yaml",
        "geometry:\n  - file: room.obj\ncavity: [0.5 m, 0.5 m, 0.5 m]\ncatalogue: catalogue.yaml\nnozzles:\n"
        "  - {name: a, type: cone, position: [0.3 m, 0.3 m, 0.7 m], axis: [0, 0, -1], pressure: 2 bar, keep: true}\n"
        "  - {name: b, type: cone, position: [0.7 m, 0.3 m, 0.7 m], axis: [0, 0, -1], pressure: 2 bar, keep: true}\n"
        "  - {name: c, type: cone, position: [0.7 m, 0.7 m, 0.7 m], axis: [0, 0, -1], pressure: 2 bar}\n"
        "place:\n  pressure: 2 bar\n  max_water: 20 L/min\n  mounts:\n"
        "    - port: {name: P, position: [0.5 m, 0.5 m, 0.9 m]}\n"
        "  alternatives:\n"
        "    - {name: as it is}\n"
        "    - {name: enough, max_water: 24 L/min}\n"
        "    - {name: one, max_nozzles: 1}\n");
    json_t *object = expect_json("check kept.yaml --json", 0), *warnings = json_object_get(object, "warnings");
    assert_int_equal(json_array_size(warnings), count);
    for (size_t i = 0; i < count; i++)
        assert_string_equal(json_string_value(json_array_get(warnings, i)), expected[i]);
    json_decref(object);
}

/* 1 m/s is a flux, of m3/s per m2, and 1 m a dose: they are read, and doubted. */
static void check_doubts_thresholds_of_another_unit(void **state)
{
    (void)state;
    static const char goods[] = "\n    sweep: {from: [0 m, 0 m, 0 m], to: [1 m, 0 m, 0 m], speed: 1 m/s}";
    static const struct {
        const char *criterion;
        const char *sweep, *expected;
    } thresholds[] = {
        {"flux: 1 m/s", "",
         "criterion: flux is 60000 L/min/m2, more than nozzles bring to a wall; is another unit meant?"},
        {"flux: 1 mm/s", "", NULL},
        {"film: 1 m2/s", "",
         "criterion: film is 60000 L/min/m, more than nozzles bring to a wall; is another unit meant?"},
        {"dose: 1 m", goods, "criterion: dose is 1000 L/m2, more than nozzles bring to a wall; is another unit meant?"},
        {"dose: 2 L/m2", goods, NULL},
    };
    for (size_t i = 0; i < sizeof thresholds / sizeof *thresholds; i++) {
        char scene[512];
        snprintf(scene, sizeof scene, "geometry:\n  - file: room.obj%s\ncavity: %s\ncriterion: {%s}\n",
                 thresholds[i].sweep, "[0.5 m, 0.5 m, 0.5 m]", thresholds[i].criterion);
        write_file("threshold.yaml", scene);
        json_t *object = expect_json("check threshold.yaml --json", 0), *warnings = json_object_get(object, "warnings");
        const char *told = json_string_value(json_array_get(warnings, 0));
        if (thresholds[i].expected)
            assert_string_equal(told, thresholds[i].expected);
        else
            assert_null(told);
        json_decref(object);
    }
    /* also where layouts are counted by it */
    write_room_with("absurd.yaml", "flux: 1 L/min/m2", "flux: 1 m/s");
    outcome counted = run_program("simulate absurd.yaml " COARSE);
    assert_non_null(strstr(counted.out, "warning: criterion: flux is 60000 L/min/m2, more than nozzles bring"));
    forget(&counted);
}

/* In one place, nearer than their bodies allow, and as near as these allow. */
static void bodies_that_overlap_are_reported(void **state)
{
    (void)state;
    static const char *const expected[] = {"N1 and beside stand in one place: their bodies overlap",
                                           "wide and near stand 49 mm apart: their bodies of 60 mm and 40 mm overlap"};
    write_file("bodies.yaml",
               "nozzles:\n"
               "  - {name: cone, pattern: full_cone, angle: 120 deg, flow: 12 L/min, at: 2 bar}\n"
               "  - {name: thin, pattern: full_cone, angle: 90 deg, flow: 6 L/min, at: 2 bar, body: 40 mm}\n"
               "  - {name: thick, pattern: full_cone, angle: 90 deg, flow: 6 L/min, at: 2 bar, body: 60 mm}\n");
    write_file("crowded.yaml",
               "geometry:\n"
               "  - file: room.obj\n"
               "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
               "catalogue: bodies.yaml\n"
               "nozzles:\n"
               "  - {name: N1, type: cone, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 0, -1], pressure: 2 bar}\n"
               "  - {name: beside, type: thin, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 1, 0], pressure: 2 bar}\n"
               "  - {name: wide, type: thick, position: [0.2 m, 0.5 m, 0.9 m], axis: [0, 1, 0], pressure: 2 bar}\n"
               "  - {name: near, type: thin, position: [0.249 m, 0.5 m, 0.9 m], axis: [0, 1, 0], pressure: 2 bar}\n"
               "  - {name: clear, type: thin, position: [0.15 m, 0.5 m, 0.9 m], axis: [0, 1, 0], pressure: 2 bar}\n");
    json_t *object = expect_json("check crowded.yaml --json", 0);
    json_t *warnings = json_object_get(object, "warnings");
    assert_int_equal(json_array_size(warnings), 2);
    outcome done = run_program("simulate crowded.yaml -o crowded " COARSE);
    char told[512];
    assert_int_equal(done.status, 0);
    snprintf(told, sizeof told, "\nwarning: manual: %s\nwarning: manual: %s\n", expected[0], expected[1]);
    assert_non_null(strstr(done.out, told));
    forget(&done);
    char *page = read_file("crowded/report.html", NULL);
    for (size_t i = 0; i < 2; i++)
        assert_non_null(strstr(json_string_value(json_array_get(warnings, i)), expected[i]));
    snprintf(told, sizeof told, "</table></div>\n<p class=\"warning\">%s; %s.</p>", expected[0], expected[1]);
    assert_non_null(strstr(page, told));
    free(page);
    /* also where all that is left is result.json */
    done = run_program("compare crowded/result.json room.yaml -o compared --quiet " COARSE);
    assert_int_equal(done.status, 0);
    forget(&done);
    page = read_file("compared/report.html", NULL);
    assert_non_null(strstr(page, told));
    free(page);
    json_decref(object);
}

/* The second of three is the first again, the third is turned. */
static void check_warns_of_nozzles_that_are_there_twice(void **state)
{
    (void)state;
    write_room_with(
        "twice.yaml", "axis: [0, 0, -1], pressure: 2 bar}\n",
        "axis: [0, 0, -1], pressure: 2 bar}\n"
        "  - {name: again, type: cone, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 0, -2], pressure: 2 bar}\n"
        "  - {name: other, type: cone, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 0, -1], roll: 5 deg, "
        "pressure: 2 bar}\n");
    json_t *object = expect_json("check twice.yaml --json", 0), *warnings = json_object_get(object, "warnings");
    assert_int_equal(json_array_size(warnings), 2);
    assert_non_null(strstr(json_string_value(json_array_get(warnings, 0)), "nozzle \"again\""));
    assert_string_equal(json_string_value(json_array_get(warnings, 1)),
                        "nozzles: N1 and other stand in one place: their bodies overlap");
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

/* A bow-tie beside a U, which is no matter. */
static void tangled_polygons_are_warned_of(void **state)
{
    (void)state;
    write_file("bow.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv .65 1 1\n"
                          "v .65 .3 1\nv .35 .3 1\nv .35 1 1\nv 0 1 1\nf 7 8 9 10 11 12 5 6\n");
    write_file("bow.yaml", "geometry:\n  - {file: bow.obj}\n");
    json_t *check = expect_json("check bow.yaml --json", 0);
    assert_true(number(json_object_get(check, "mesh"), "tangled_polygons") == 1);
    json_decref(check);
    outcome result = run_program("check bow.yaml");
    assert_non_null(strstr(result.out, "warning: geometry: 1 polygons cross their own outline"));
    forget(&result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangled_polygons_are_warned_of),
        cmocka_unit_test(check_measures_the_room),
        cmocka_unit_test(check_warns_of_nozzles_against_their_ports),
        cmocka_unit_test(check_warns_of_nozzles_between_settings_of_their_ports),
        cmocka_unit_test(check_warns_of_limits_below_what_is_kept),
        cmocka_unit_test(check_doubts_thresholds_of_another_unit),
        cmocka_unit_test(check_reports_how_large_everything_is),
        cmocka_unit_test(check_warns_where_bodies_are_closed_and_no_cavity_is_named),
        cmocka_unit_test(check_warns_of_mounts_that_take_no_nozzle),
        cmocka_unit_test(bodies_that_overlap_are_reported),
        cmocka_unit_test(texels_that_are_too_long_are_warned_of),
        cmocka_unit_test(the_unit_is_asked_for_behind_an_error_of_the_texel),
        cmocka_unit_test(check_warns_of_nozzles_that_are_there_twice),
        cmocka_unit_test(check_reports_the_cavity),
        cmocka_unit_test(check_says_where_liquid_stands),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
