/* place.alternatives: what each takes of place and what is its own; what can be wrong with them, and where. */
#include "scratch.h"
#include "written.h"

#include <sprayplan/scene.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static const char start[] =
    "geometry: [{file: tank.obj}]\n"
    "catalogue: catalogue.yaml\n"
    "nozzles: [{name: N, type: cone, position: [0, 0, 0.1], axis: [0, 0, 1], pressure: 1 bar}]\n"
    "place:\n"
    "  objective: min_water\n"
    "  coverage: 95 %\n"
    "  max_nozzles: 7\n"
    "  max_water: 100 L/min\n"
    "  types: [cone, fan]\n"
    "  pressure: [1 bar, 2 bar]\n"
    "  clearance: 20 mm\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [0, 0, 1]}\n"
    "    - surface: {name: lid, geometry: 0, part: lid, spacing: 10 mm, max_nozzles: 3}\n"
    "    - line: {from: [0, 0, 0], to: [0, 0, 0]}\n"
    "    - box: {name: inside, min: [0, 0, 0], max: [0, 0, 0]}\n"
    "    - port: {name: P2, position: [0, 0, 1], types: [jet]}\n";

static sp_scene *load(const char *rest, sp_error *error)
{
    char text[4096];
    snprintf(text, sizeof text, "%s%s", start, rest);
    scratch_write("scene.yaml", text);
    return sp_scene_load("scene.yaml", error);
}

static void none_unless_asked_for(void **state)
{
    (void)state;
    static const char *const rests[] = {"", "  alternatives: []\n"};
    assert_int_equal(sp_scene_alternative_count(NULL), 0);
    for (size_t i = 0; i < 2; i++) {
        sp_error error = {0};
        sp_scene *scene = load(rests[i], &error);
        assert_non_null(scene);
        assert_int_equal(sp_scene_alternative_count(scene), 0);
        sp_place_options all = sp_scene_place_options(scene);
        assert_int_equal(all.mounts[1].most, 3);
        assert_int_equal(all.mounts[0].most, 0);
        assert_string_equal(all.mounts[3].name, "inside");
        assert_string_equal(all.mounts[2].name, "");
        assert_int_equal(all.other_count, 0);
        sp_scene_destroy(scene);
    }
}

static void what_is_not_said_is_of_place(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_scene *scene = load("  alternatives:\n"
                           "    - {name: all of it}\n"
                           "    - name: own\n"
                           "      mounts: [inside, {mount: lid, max_nozzles: 1}, P1]\n"
                           "      types: [set]\n"
                           "      pressure: 3 bar\n"
                           "      max_nozzles: 2\n"
                           "      max_water: 30 L/min\n",
                           &error);
    assert_non_null(scene);
    assert_int_equal(sp_scene_alternative_count(scene), 2);
    sp_place_options place = sp_scene_place_options(scene), all = sp_scene_alternative_options(scene, 0),
                     own = sp_scene_alternative_options(scene, 1);
    assert_string_equal(sp_scene_alternative_name(scene, 0), "all of it");
    assert_true(all.objective == SP_OBJECTIVE_MIN_WATER && own.objective == SP_OBJECTIVE_MIN_WATER);
    assert_true(all.coverage == place.coverage && own.coverage == place.coverage && own.clearance == place.clearance);
    assert_true(all.kept == sp_scene_layout(scene) && own.kept == sp_scene_layout(scene));
    assert_int_equal(all.max_nozzles, 7);
    assert_true(all.max_water == place.max_water);
    assert_ptr_equal(all.mounts, place.mounts);
    assert_int_equal(all.mount_count, 5);
    assert_int_equal(all.type_count, 2);
    assert_int_equal(all.pressure_count, 2);
    /* in place's order, whatever the list's; place's own limit stays as it was */
    assert_int_equal(own.mount_count, 3);
    assert_string_equal(own.mounts[0].name, "P1");
    assert_string_equal(own.mounts[1].name, "lid");
    assert_string_equal(own.mounts[2].name, "inside");
    assert_int_equal(own.mounts[1].most, 1);
    assert_int_equal(place.mounts[1].most, 3);
    assert_int_equal(own.type_count, 1);
    assert_string_equal(own.types[0]->name, "set");
    assert_int_equal(own.pressure_count, 1);
    assert_true(fabs(own.pressures[0] - 3e5) < 1e-6);
    assert_int_equal(own.max_nozzles, 2);
    assert_true(fabs(own.max_water - 0.03 / 60) < 1e-12);
    /* the port that it does not use is still there */
    assert_int_equal(own.other_count, 5);
    assert_string_equal(own.others[4].name, "P2");
    sp_scene_destroy(scene);
}

/* A layout written as a scene offers the same choice again. */
static void written_and_read_again(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_scene *scene = load("  alternatives: [{name: few, mounts: [P1, {mount: lid, max_nozzles: 2}]}]\n", &error);
    assert_non_null(scene);
    char *text = written_text(scene, ".", &error);
    assert_non_null(text);
    scratch_write("again.yaml", text);
    sp_scene *again = sp_scene_load("again.yaml", &error);
    assert_non_null(again);
    sp_place_options few = sp_scene_alternative_options(again, 0);
    assert_int_equal(few.mount_count, 2);
    assert_int_equal(few.mounts[1].most, 2);
    sp_scene_destroy(again);
    free(text);
    sp_scene_destroy(scene);
}

static void faults_are_reported_where_they_are(void **state)
{
    (void)state;
    static const struct {
        const char *rest, *expected;
    } faults[] = {
        {"  alternatives: {name: a}\n",
         "scene.yaml:18:17: alternatives: found a block of keys, expected a list of alternatives"},
        {"  alternatives: [{mounts: [P1]}]\n", "scene.yaml:18:18: name: "},
        {"  alternatives: [{name: manual}]\n",
         "scene.yaml:18:25: name: found 'manual', expected another name than those of layouts, manual, greedy and "
         "proposed"},
        {"  alternatives: [{name: a}, {name: a}]\n",
         "scene.yaml:18:36: name: found 'a', expected a name that no other alternative has"},
        {"  alternatives: [{name: a, mounts: [P1, P3]}]\n",
         "scene.yaml:18:41: mounts: found 'P3', expected the `name` of one of place's mounts: P1, lid, inside, P2"},
        {"  alternatives: [{name: a, mounts: [P1, P1]}]\n",
         "scene.yaml:18:41: mounts: found 'P1', expected each mount once"},
        {"  alternatives: [{name: a, mounts: []}]\n",
         "scene.yaml:18:36: mounts: found an empty list, expected a list of names of place's mounts"},
        {"  alternatives: [{name: a, mounts: P1}]\n",
         "scene.yaml:18:36: mounts: found 'P1', expected a list of names of place's mounts"},
        {"  alternatives: [{name: a, mounts: [{mount: P1, max_nozzles: 1}]}]\n",
         "scene.yaml:18:62: max_nozzles: found '1', expected none beside a port, which takes one nozzle"},
        {"  alternatives: [{name: a, mounts: [{mount: lid, max_nozzles: 0}]}]\n",
         "scene.yaml:18:63: max_nozzles: found '0'"},
        {"  alternatives: [{name: a, mounts: [{mount: lid}]}]\n", "scene.yaml:18:37: max_nozzles: "},
        {"  alternatives: [{name: a, types: [rocket]}]\n", "scene.yaml:18:36: types: found 'rocket'"},
        {"  alternatives: [{name: a, max_water: 3}]\n", "scene.yaml:18:39: max_water: found '3'"},
        {"  alternatives: [{name: a, pressure: []}]\n", "scene.yaml:18:38: pressure: "},
        {"  alternatives: [{name: a, coverage: 9 %}]\n",
         "scene.yaml:18:28: coverage: found a key that an alternative does not have, expected "},
        {"  alternatives: [{name: a},{name: b},{name: c},{name: d},{name: e},{name: f},{name: g},{name: h},{name: i},"
         "{name: j},{name: k},{name: l},{name: m}]\n",
         "scene.yaml:18:17: alternatives: found 13 alternatives, expected at most 12"},
        {"    - line: {name: P1, from: [0, 0, 0], to: [0, 0, 0]}\n",
         "scene.yaml:18:20: name: found 'P1', expected a name that no other mount has"},
        {"    - port: {name: P1, position: [0, 0, 1]}\n",
         "scene.yaml:18:20: name: found 'P1', expected a name that no other port has"},
        {"    - port: {name: P3, position: [0, 0, 1], max_nozzles: 2}\n",
         "scene.yaml:18:45: max_nozzles: found a key that a port does not have, expected "},
    };
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        sp_error error = {0};
        char message[2000];
        assert_null(load(faults[i].rest, &error));
        sp_error_text(&error, message, sizeof message);
        if (strncmp(message, faults[i].expected, strlen(faults[i].expected)) != 0)
            fail_msg("%s  gives %s", faults[i].rest, message);
    }
    scratch_write("bare.yaml", "geometry: [{file: tank.obj}]\ncatalogue: catalogue.yaml\n"
                               "place:\n  alternatives: [{name: a}]\n");
    sp_error error = {0};
    assert_null(sp_scene_load("bare.yaml", &error));
    assert_int_equal(error.line, 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(none_unless_asked_for),
        cmocka_unit_test(what_is_not_said_is_of_place),
        cmocka_unit_test(written_and_read_again),
        cmocka_unit_test(faults_are_reported_where_they_are),
    };
    return cmocka_run_group_tests_name("alternatives in scenes", tests, scratch_make, scratch_remove);
}
