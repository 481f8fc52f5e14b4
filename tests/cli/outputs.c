/* What simulate writes and says on a small room, and what is never written over. */
#include "results.h"

#include <sprayplan/sprayplan.h>

static void without_output_nothing_is_written(void **state)
{
    (void)state;
    char *before = list_folder(".");
    outcome result = run_program("simulate room.yaml");
    assert_int_equal(result.status, 0);
    assert_string_equal(result.err, "sprayplan: nothing was written; -o DIR says where to\n");
    assert_non_null(strstr(result.out, "manual"));
    forget(&result);
    expect("simulate room.yaml --quiet", 0, "", "");
    expect("check room.yaml --quiet", 0, "", "");
    char *after = list_folder(".");
    assert_string_equal(before, after);
    free(before);
    free(after);
}

#define WROTE(where)                                                                                                   \
    where ": report.html, result.json, coverage.png, deposits.exr, model.glb, swabs.csv, surface.vtp, texels.vtp, "    \
          "nozzles.stl, nozzles.csv, layout.yaml\n"

/* Beside JSON on standard error, else last of all on standard output. */
static void what_was_written_is_said(void **state)
{
    (void)state;
    outcome result = run_program("simulate room.yaml " COARSE " -o said");
    const char *at = strstr(result.out, WROTE("\nwrote said"));
    assert_non_null(at);
    assert_string_equal(at, WROTE("\nwrote said"));
    assert_string_equal(result.err, "");
    forget(&result);
    result = run_program("atlas room.obj -o said/a.obj --texel 10mm");
    assert_non_null(strstr(result.out, "\nwrote said: a.obj, a-page_0.png\n"));
    forget(&result);
    result = run_program("atlas room.obj -o a.obj --texel 10mm");
    assert_non_null(strstr(result.out, "\nwrote a.obj, a-page_0.png\n"));
    forget(&result);
    result = run_program("simulate room.yaml " COARSE " --json");
    assert_string_equal(result.err, "");
    forget(&result);
}

static void simulate_writes_its_files(void **state)
{
    (void)state;
    outcome result = run_program("simulate room.yaml -o simulated --json");
    assert_int_equal(result.status, 0);
    char *written = read_file("simulated/result.json", NULL);
    assert_string_equal(written, result.out);
    assert_string_equal(result.err, WROTE("sprayplan: wrote simulated"));
    free(written);
    forget(&result);
    char *names = list_folder("simulated");
    assert_string_equal(names,
                        "coverage.png\ndeposits.exr\nlayout.yaml\nmodel.glb\nnozzles.csv\nnozzles.stl\nreport.html\n"
                        "result.json\nsurface.vtp\nswabs.csv\ntexels.vtp\n");
    free(names);
}

/* When it was made stands in the page alone; what was read, in both. */
static void what_was_read_is_reported(void **state)
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

static void nor_what_was_edited(void **state)
{
    (void)state;
    static const char complaint[] = "told/layout.yaml: was edited since it was written, or is not sprayplan's; "
                                    "expected another folder to write to, or to force it (--force)\n";
    ensure("told", "simulate room.yaml " COARSE);
    char *layout = read_file("told/layout.yaml", NULL);
    expect("simulate room.yaml " COARSE " -o told --quiet", 0, "", "");
    char *same = read_file("told/layout.yaml", NULL);
    assert_string_equal(layout, same);
    free(same);
    layout[strlen(layout) - 1] = ' ';
    write_file("told/layout.yaml", layout);
    expect("simulate room.yaml " COARSE " -o told --quiet", 1, "", complaint);
    expect("place room.yaml -o told --set place.clearance=9", 1, "", complaint);
    char *kept = read_file("told/layout.yaml", NULL);
    assert_string_equal(layout, kept);
    free(kept);
    expect("simulate room.yaml " COARSE " -o told --quiet --force", 0, "", "");
    free(layout);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_output_nothing_is_written),
        cmocka_unit_test(simulate_writes_its_files),
        cmocka_unit_test(what_was_written_is_said),
        cmocka_unit_test(what_was_read_is_reported),
        cmocka_unit_test(what_came_through_a_pipe_has_no_digest),
        cmocka_unit_test(json_is_the_same_with_files_and_without),
        cmocka_unit_test(no_input_is_overwritten),
        cmocka_unit_test(nor_is_what_the_scene_names),
        cmocka_unit_test(nor_what_was_edited),
        cmocka_unit_test(where_nothing_can_be_written_is_said_first),
        cmocka_unit_test(late_errors_are_located),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
