/* What check says of a mesh that is not sound. */
#include "workplace.h"

#include <sprayplan/mesh.h>

static json_t *flaw(const json_t *check, const char *kind)
{
    json_t *found = json_object_get(json_object_get(check, "flaws"), kind);
    assert_non_null(found);
    return found;
}

static void expect_flaw(const json_t *check, const char *kind, json_int_t count, double x, double y, double z)
{
    json_t *found = flaw(check, kind), *place = json_array_get(json_object_get(found, "places_m"), 0);
    const double expected[] = {x, y, z};
    assert_int_equal(json_integer_value(json_object_get(found, "count")), count);
    assert_false(json_boolean_value(json_object_get(found, "perhaps_more")));
    for (size_t k = 0; k < 3; k++)
        assert_true(fabs(json_number_value(json_array_get(place, k)) - expected[k]) < 1e-9);
}

static void a_sound_room_has_none(void **state)
{
    (void)state;
    json_t *check = expect_json("check room.yaml --json", 0), *flaws = json_object_get(check, "flaws"), *found;
    const char *kind;
    json_object_foreach(flaws, kind, found)
    {
        assert_int_equal(json_integer_value(json_object_get(found, "count")), 0);
    }
    assert_int_equal(json_object_size(flaws), 9);
    json_decref(check);
}

/* The room with a lid that is not joined to it, a floor tile laid twice, a crumb and a triangle without area. Places as
 * in the scene's file, whatever the evaluator makes of them. */
static void flaws_have_places(void **state)
{
    (void)state;
    write_file("unsound.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                              "v 0 0 1.00001\nv 1 0 1.00001\nv 1 1 1.00001\nv 0 1 1.00001\n"
                              "v .5 .5 .5\nv .501 .5 .5\nv .5 .501 .5\n"
                              "g floor\nf 1 2 3 4\nf 1 2 3\n"
                              "g ceiling\nf 9 12 11 10\n"
                              "g walls\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n"
                              "g crumb\nf 13 14 15\nf 13 14 14\n");
    write_file("unsound.yaml", "geometry:\n  - {file: unsound.obj, unit: m, translate: [2 m, 0 m, 0 m]}\n");
    json_t *check = expect_json("check unsound.yaml --json", 0);
    expect_flaw(check, "degenerate", 1, 2.5 + 0.002 / 3, 0.5, 0.5);
    expect_flaw(check, "duplicate_triangles", 1, 2 + 2.0 / 3, 1.0 / 3, 0);
    expect_flaw(check, "bits", 1, 2.5 + 0.001 / 3, 0.5 + 0.001 / 3, 0.5);
    expect_flaw(check, "cracks", 8, 2, 0, 1);
    assert_int_equal(json_integer_value(json_object_get(flaw(check, "open_edges"), "count")), 4 + 4 + 3);
    assert_int_equal(json_array_size(json_object_get(flaw(check, "open_edges"), "places_m")), SP_PLACES);
    json_decref(check);
    outcome result = run_program("check unsound.yaml");
    assert_non_null(strstr(result.out, "corners at cracks                  8  [2, 0, 1]"));
    assert_non_null(strstr(result.out, "within 0.00017 m of others"));
    forget(&result);
}

static double account(const json_t *result, const char *key)
{
    const json_t *value = json_object_get(json_object_get(json_object_get(result, "geometry"), "account"), key);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

/* The room, with its front outside. */
static const char outwards_obj[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                   "f 3 2 1 4\nf 6 7 8 5\nf 2 6 5 1\nf 3 7 6 2\nf 4 8 7 3\nf 1 5 8 4\n";

/* Whether a lone box of 1 m is inside out depends on what is cleaned: check lists what a simulation turns round, with
 * its place in the scene's file, and nothing else. */
static void inside_out_is_what_is_turned_round(void **state)
{
    (void)state;
    static const struct {
        bool outwards, within;
        int turned;
    } cases[] = {{true, true, 1}, {false, true, 0}, {true, false, 0}, {false, false, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char scene[sizeof room_yaml];
        write_file("lone.obj", cases[i].outwards ? outwards_obj : room_obj);
        snprintf(
            scene, sizeof scene,
            "geometry:\n  - {file: lone.obj, translate: [2 m, 0 m, 0 m]}\ncavity: %s\ncatalogue: catalogue.yaml\n"
            "nozzles:\n  - {name: N1, type: cone, position: [2.5 m, 0.5 m, %s], axis: [0, 0, -1], pressure: 2 bar}\n"
            "simulate: {texel: " ROOM_TEXEL "}\n",
            cases[i].within ? "[2.5 m, 0.5 m, 0.5 m]" : "outside", cases[i].within ? "0.9 m" : "1.5 m");
        write_file("lone.yaml", scene);
        json_t *check = expect_json("check lone.yaml --json", 0), *result = expect_json("simulate lone.yaml --json", 0);
        assert_true(account(result, "turned_shells") == cases[i].turned);
        if (cases[i].turned)
            expect_flaw(check, "inside_out", 1, 2 + 2.0 / 3, 1.0 / 3, 0);
        assert_int_equal(json_integer_value(json_object_get(flaw(check, "inside_out"), "count")), cases[i].turned);
        json_decref(check);
        json_decref(result);
        outcome told = run_program("check lone.yaml");
        assert_int_equal(strstr(told.out, "shells inside out ") != NULL, cases[i].turned);
        forget(&told);
    }
}

/* Where nothing is turned round, and where the mesh is looked at alone, it is what faces inwards. */
static void without_a_cavity_it_is_what_faces_inwards(void **state)
{
    (void)state;
    write_file("bare.yaml", "geometry:\n  - file: room.obj\n");
    json_t *check = expect_json("check bare.yaml --json", 0);
    assert_int_equal(json_integer_value(json_object_get(flaw(check, "inside_out"), "count")), 1);
    json_decref(check);
    outcome told = run_program("check room.yaml --repair mended.obj");
    assert_null(strstr(told.out, "inside out"));
    assert_non_null(strstr(told.out, "shells facing inwards              1            1 \n"));
    assert_non_null(strstr(told.out, "\nnothing wrong found\n"));
    forget(&told);
}

/* A box drawn inside out in the room, a sheet beside it, and a triangle without area. */
static void a_simulation_says_what_it_made_of_them(void **state)
{
    (void)state;
    write_file("box.obj", "v .4 .4 .1\nv .6 .4 .1\nv .6 .6 .1\nv .4 .6 .1\nv .4 .4 .3\nv .6 .4 .3\nv .6 .6 .3\n"
                          "v .4 .6 .3\nv .1 .1 .5\nv .3 .1 .5\nv .3 .3 .5\nv .1 .3 .5\n"
                          "g box\nf 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n"
                          "g sheet\nf 9 10 11 12\nf 9 11 11\n");
    char scene[sizeof room_yaml + 100];
    snprintf(scene, sizeof scene, "geometry:\n  - file: room.obj\n  - file: box.obj\n%s", strstr(room_yaml, "cavity:"));
    write_file("doubtful.yaml", scene);
    json_t *result = expect_json("simulate doubtful.yaml --json", 0);
    assert_true(account(result, "left_out_triangles") == 1);
    assert_true(account(result, "closed_shells") == 2);
    assert_true(account(result, "turned_shells") == 1);
    assert_true(account(result, "open_shells") == 1);
    assert_true(fabs(account(result, "open_shells_m2") - 0.04) < 1e-12);
    assert_true(account(result, "wet_on_both_sides_m2") == 0);
    assert_true(account(result, "outdoors_m2") == 0);
    json_decref(result);
    outcome run = run_program("simulate doubtful.yaml -o doubtful");
    assert_int_equal(run.status, 0);
    assert_non_null(strstr(run.out, "geometry: 1 triangle without area is left out\n"
                                    "geometry: 1 closed shell drawn inside out is turned round\n"));
    assert_null(strstr(run.out, "sheet"));
    forget(&run);
    char *report = read_file("doubtful/report.html", NULL);
    assert_non_null(strstr(report, "<dt>Geometry</dt><dd><strong>1 triangle without area is left out</strong>"));
    assert_non_null(strstr(report, "1 open shell of 0.04 m\xc2\xb2 is a sheet"));
    free(report);
    run = run_program("simulate room.yaml");
    assert_null(strstr(run.out, "geometry:"));
    forget(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sound_room_has_none),
        cmocka_unit_test(flaws_have_places),
        cmocka_unit_test(inside_out_is_what_is_turned_round),
        cmocka_unit_test(without_a_cavity_it_is_what_faces_inwards),
        cmocka_unit_test(a_simulation_says_what_it_made_of_them),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
