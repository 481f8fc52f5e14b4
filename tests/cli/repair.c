/* What check mends, and which unit it asks for. */
#include "results.h"

#include <math.h>
#include <sys/stat.h>

/* The room with a loose lid, a floor tile laid twice and a triangle without area. */
static const char unsound_obj[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                  "v 0 0 1.00001\nv 1 0 1.00001\nv 1 1 1.00001\nv 0 1 1.00001\n"
                                  "g floor\nf 1 2 3 4\nf 1 2 3\nf 1 2 2\n"
                                  "g ceiling #1\nf 9 12 11 10\n"
                                  "g walls\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

static double at(const json_t *object, const char *key, size_t index)
{
    const json_t *value = json_array_get(json_object_get(object, key), index);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

static json_int_t flaws(const json_t *file, const char *when, const char *kind)
{
    return json_integer_value(json_object_get(json_object_get(json_object_get(file, when), kind), "count"));
}

static void a_copy_is_mended(void **state)
{
    (void)state;
    write_file("unsound.obj", unsound_obj);
    write_file("unsound.yaml",
               "geometry:\n  - {file: unsound.obj, unit: cm, scale: 100, translate: [2 m, 0 m, 0 m]}\n");
    json_t *check = expect_json("check unsound.yaml --repair mended.obj --json", 0);
    json_t *files = json_object_get(check, "repair"), *file = json_array_get(files, 0);
    assert_int_equal(json_array_size(files), 1);
    assert_string_equal(json_string_value(json_object_get(file, "file")), "mended.obj");
    assert_true(number(file, "joined_corners") == 4);
    assert_true(number(file, "copies") == 1);
    assert_true(number(file, "dropped_triangles") == 1);
    assert_true(number(file, "split_triangles") == 0 && number(file, "turned_triangles") == 0);
    assert_true(fabs(at(file, "area_m2", 0) - 6.5) < 1e-9);
    assert_true(fabs(at(file, "area_m2", 1) - 6) < 1e-9);
    assert_true(at(file, "closed_shells", 0) == 0 && at(file, "closed_shells", 1) == 1);
    assert_int_equal(flaws(file, "flaws_before", "cracks"), 8);
    assert_int_equal(flaws(file, "flaws_after", "cracks"), 0);
    assert_int_equal(flaws(file, "flaws_after", "open_edges"), 0);
    json_decref(check);
    /* the copy is where the scene has it, and sound */
    write_file("mended.yaml", "geometry:\n  - {file: mended.obj, clean_parts: [floor, \"ceiling*\"]}\n");
    check = expect_json("check mended.yaml --repair again.obj --json", 0);
    assert_true(at(json_object_get(check, "mesh"), "minimum_m", 0) == 2);
    assert_true(number(json_object_get(check, "mesh"), "closed_shells") == 1);
    assert_true(fabs(number(check, "clean_area_m2") - 2) < 1e-9);
    json_decref(check);
    char *once = read_file("mended.obj", NULL), *twice = read_file("again.obj", NULL);
    assert_string_equal(once, twice);
    free(once);
    free(twice);
}

static void the_table_says_so(void **state)
{
    (void)state;
    outcome result = run_program("check unsound.yaml --repair mended.obj");
    assert_int_equal(result.status, 0);
    assert_non_null(strstr(result.out, "\nmended.obj: 4 corners at cracks joined, 1 copies taken out, 1 triangles "
                                       "without area dropped; area 6.5 -> 6 m2, closed shells 0 of 2 -> 1 of 1\n"));
    assert_non_null(strstr(result.out, "corners at cracks                  8            0"));
    forget(&result);
    result = run_program("check room.yaml --repair same.obj");
    assert_non_null(strstr(result.out, "\nsame.obj: nothing to mend; area 6 -> 6 m2"));
    forget(&result);
}

/* Of the floor there is a copy in another part, before it or behind it: what is to be cleaned keeps it. */
static void parts_that_lose_are_named(void **state)
{
    (void)state;
    static const char vertices[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
    static const char room[] = "g room\nf 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
    static const char frame[] = "g frame\nf 1 2 3 4\n";
    for (int order = 0; order < 2; order++) {
        char text[600];
        snprintf(text, sizeof text, "%s%s%s", vertices, order ? frame : room, order ? room : frame);
        write_file("framed.obj", text);
        write_file("framed.yaml", "geometry:\n  - {file: framed.obj, clean_parts: [room]}\n");
        json_t *check = expect_json("check framed.yaml --repair unframed.obj --json", 0);
        json_t *file = json_array_get(json_object_get(check, "repair"), 0);
        json_t *lost = json_object_get(file, "lost_parts"), *copies = json_object_get(file, "copies_of_other_parts");
        assert_int_equal(json_array_size(lost), 1);
        assert_string_equal(json_string_value(json_array_get(lost, 0)), "frame");
        assert_int_equal(json_array_size(copies), 1);
        assert_string_equal(json_string_value(json_object_get(json_array_get(copies, 0), "to")), "room");
        assert_true(fabs(number(json_array_get(copies, 0), "area_m2") - 1) < 1e-15);
        assert_true(fabs(at(file, "clean_parts_area_m2", 0) - 6) < 1e-12);
        assert_true(fabs(at(file, "clean_parts_area_m2", 1) - 6) < 1e-12);
        json_decref(check);
        outcome result = run_program("check framed.yaml --repair unframed.obj");
        assert_non_null(strstr(result.out, "copies: 1 m2 of part \"frame\" taken out in favour of part \"room\"\n"
                                           "part \"frame\" is gone: nothing is left of it\n"));
        forget(&result);
        char *written = read_file("unframed.obj", NULL);
        assert_null(strstr(written, "frame"));
        free(written);
    }
}

static void what_is_put_in_is_reported(void **state)
{
    (void)state;
    write_file("torn.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                           "f 1 2 3\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
    write_file("torn.yaml", "geometry:\n  - {file: torn.obj}\n");
    json_t *check = expect_json("check torn.yaml --repair whole.obj --json", 0);
    json_t *file = json_array_get(json_object_get(check, "repair"), 0);
    json_t *largest = json_array_get(json_object_get(file, "largest_filled"), 0);
    assert_true(fabs(number(file, "filled_area_m2") - 0.5) < 1e-15);
    assert_true(fabs(number(largest, "area_m2") - 0.5) < 1e-15);
    assert_true(fabs(at(largest, "place_m", 0) - 1.0 / 3) < 1e-15);
    json_decref(check);
    outcome result = run_program("check torn.yaml --repair whole.obj");
    assert_non_null(strstr(result.out, "\nput in: 0.5 m2"));
    assert_non_null(strstr(result.out, "the largest: 0.5 m2 at [0.33333, 0.66667, 0]\n"));
    forget(&result);
}

/* One copy of each, in its file's place; another folder is made. */
static void several_files_are_mended_each(void **state)
{
    (void)state;
    write_file("two.yaml", "geometry:\n  - file: room.obj\n  - {file: unsound.obj, translate: [1 m, 0 m, 0 m]}\n");
    json_t *check = expect_json("check two.yaml --repair new/m.obj --json", 0),
           *files = json_object_get(check, "repair");
    assert_int_equal(json_array_size(files), 2);
    assert_string_equal(json_string_value(json_object_get(json_array_get(files, 1), "file")), "new/m-1.obj");
    assert_int_equal(flaws(json_array_get(files, 0), "flaws_after", "non_manifold_edges"), 0);
    json_decref(check);
    char *names = list_folder("new"), *first = read_file("new/m-0.obj", NULL);
    assert_string_equal(names, "m-0.obj\nm-1.obj\n");
    assert_non_null(strstr(first, "g floor\nf 1 2 3\nf 1 3 4\n"));
    free(first);
    free(names);
}

/* By its own name, another one, or a link. */
static void no_input_is_replaced(void **state)
{
    (void)state;
    char from[1100], to[1100];
    snprintf(from, sizeof from, "%s/unsound.obj", workplace);
    snprintf(to, sizeof to, "%s/hard.obj", workplace);
    assert_int_equal(link(from, to), 0);
    snprintf(to, sizeof to, "%s/soft.obj", workplace);
    assert_int_equal(symlink("unsound.obj", to), 0);
    static const char *const names[] = {"unsound.obj", "./unsound.obj", "hard.obj", "soft.obj", "../%s/unsound.obj"};
    for (int i = 0; i < 5; i++) {
        char line[1400], name[600];
        snprintf(name, sizeof name, i < 4 ? "%s" : "../%s/unsound.obj", i < 4 ? names[i] : strrchr(workplace, '/') + 1);
        snprintf(line, sizeof line, "check unsound.yaml --repair %s", name);
        outcome result = run_program(line);
        assert_int_equal(result.status, 1);
        assert_string_equal(result.out, "");
        assert_non_null(strstr(result.err, "would replace a file that was read"));
        forget(&result);
    }
    char *text = read_file("unsound.obj", NULL);
    assert_string_equal(text, unsound_obj);
    free(text);
    /* the second of two as well, and then the first does not appear */
    write_file("n-1.obj", unsound_obj);
    write_file("both.yaml", "geometry:\n  - file: room.obj\n  - file: n-1.obj\n");
    outcome result = run_program("check both.yaml --repair n.obj");
    assert_int_equal(result.status, 1);
    forget(&result);
    text = list_folder(".");
    assert_null(strstr(text, "n-0.obj"));
    assert_null(strstr(text, "writing"));
    free(text);
}

static void wrong_names_are_refused(void **state)
{
    (void)state;
    static const char *const lines[] = {"check room.yaml --repair", "check room.yaml --repair m.stl",
                                        "check room.yaml --repair .obj", "check room.yaml --repair ''",
                                        "simulate room.yaml --repair m.obj"};
    for (int i = 0; i < 5; i++) {
        outcome result = run_program(lines[i]);
        assert_int_equal(result.status, 2);
        assert_string_equal(result.out, "");
        forget(&result);
    }
    outcome result = run_program("check room.yaml --repair room.obj/m.obj");
    assert_int_equal(result.status, 1);
    forget(&result);
}

static const char *likelier(const json_t *check, size_t index)
{
    json_t *size = json_array_get(json_object_get(check, "sizes"), 0);
    json_t *unit = json_array_get(json_object_get(size, "likelier_units"), index);
    return unit ? json_string_value(json_object_get(unit, "unit")) : "";
}

static void a_likelier_unit_is_named(void **state)
{
    (void)state;
    static const struct {
        const char *unit, *scale, *units[3];
    } cases[] = {{"m", "1", {"", ""}},
                 {"m", "40", {"", ""}},
                 {"m", "1000", {"mm", "cm", "inch"}},
                 {"m", "80", {"inch", "cm", "ft"}},
                 {"mm", "2", {"m", "ft", "inch"}},
                 {"mm", "30", {"", ""}},
                 {"mm", "300", {"", ""}},
                 {"m", "1e6", {"", ""}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char scene[300];
        snprintf(scene, sizeof scene, "geometry:\n  - {file: room.obj, unit: %s, scale: %s}\n", cases[i].unit,
                 cases[i].scale);
        write_file("sized.yaml", scene);
        char line[200];
        double edge = atof(cases[i].scale) * (strcmp(cases[i].unit, "mm") ? 1 : 1e-3);
        snprintf(line, sizeof line, "check sized.yaml --json --set simulate.texel=%g", edge / 10);
        json_t *check = expect_json(line, 0);
        json_t *size = json_array_get(json_object_get(check, "sizes"), 0);
        for (size_t k = 0; k < 3; k++)
            assert_string_equal(likelier(check, k), cases[i].units[k] ? cases[i].units[k] : "");
        bool asks = i == 2 || i == 3 || i == 4 || i == 7;
        assert_int_equal(json_is_true(json_object_get(size, "plausible")), !asks);
        json_decref(check);
    }
    write_file("sized.yaml", "geometry:\n  - {file: room.obj, scale: 1000}\n");
    outcome result = run_program("check sized.yaml --set simulate.texel=100");
    assert_non_null(strstr(result.out,
                           "warning: geometry: file 0 is 1000 m x 1000 m x 1000 m: is the unit mm (1 m x 1 m "
                           "x 1 m), cm (10 m x 10 m x 10 m) or inch (25.4 m x 25.4 m x 25.4 m)?\n"));
    forget(&result);
    write_file("sized.yaml", "geometry:\n  - {file: room.obj, scale: 1e6}\n");
    result = run_program("check sized.yaml --set simulate.texel=1e5");
    assert_non_null(strstr(result.out, "is `unit` the unit of its coordinates?\n"));
    forget(&result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_copy_is_mended),
        cmocka_unit_test(the_table_says_so),
        cmocka_unit_test(parts_that_lose_are_named),
        cmocka_unit_test(what_is_put_in_is_reported),
        cmocka_unit_test(several_files_are_mended_each),
        cmocka_unit_test(no_input_is_replaced),
        cmocka_unit_test(wrong_names_are_refused),
        cmocka_unit_test(a_likelier_unit_is_named),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
