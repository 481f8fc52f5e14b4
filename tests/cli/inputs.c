/* No file that a command has read is written to, whatever its kind and whatever it is called. */
#include "workplace.h"

static const char scene_yaml[] =
    "geometry:\n"
    "  - file: room.obj\n"
    "catalogue: measured.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: rim, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 0, -1], pressure: 2 bar}\n"
    "simulate: {texel: 500 mm, accuracy: 50 %}\n"
    "place:\n"
    "  max_nozzles: 1\n"
    "  pressure: 2 bar\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [0.3 m, 0.3 m, 1 m], axis: [0, 0, -1]}\n";

static const char measured_yaml[] =
    "nozzles:\n"
    "  - {name: rim, pattern: measured, image: rim.exr, angle: 100 deg, flow: 24 L/min, at: 2 bar}\n";

static const char result_json[] =
    "{\"sprayplan\": \"0.1.0\", \"command\": \"simulate\", \"layouts\": [{\"name\": \"manual\", \"water_l_min\": 60, "
    "\"covered_area_m2\": 4, \"coverage\": 0.8, \"nozzles\": []}]}\n";

static void run_shell(const char *format, const char *first, const char *second)
{
    char line[2048];
    int length = snprintf(line, sizeof line, "cd '%s' && ", workplace);
    snprintf(line + length, sizeof line - (size_t)length, format, first, second);
    assert_int_equal(system(line), 0);
}

/* out/<target> is `input` by another name, which `way` makes. */
static void refuses(const char *command, const char *target, const char *input, const char *way)
{
    char path[256], expected[512];
    size_t size, size_after;
    snprintf(path, sizeof path, "out/%s", target);
    run_shell("rm -rf out && mkdir out && %s", "true", "");
    run_shell(way, input, path);
    char *before = read_file(input, &size), *listed = list_folder("out");
    outcome result = run_program(command);
    snprintf(expected, sizeof expected, "%s: would replace a file that was read, expected another folder to write to\n",
             path);
    if (result.status != 1 || strcmp(result.err, expected) != 0)
        print_error("%s, %s is %s: status %d, %s\n", command, path, input, result.status, result.err);
    assert_int_equal(result.status, 1);
    assert_string_equal(result.err, expected);
    char *after = read_file(input, &size_after), *listed_after = list_folder("out");
    assert_int_equal(size, size_after);
    assert_memory_equal(before, after, size);
    assert_string_equal(listed, listed_after);
    free(before);
    free(after);
    free(listed);
    free(listed_after);
    forget(&result);
}

#ifdef SPRAYPLAN_SANITIZE
#define COMPARES_LINKS false
#else
#define COMPARES_LINKS true
#endif

#define HARD "ln %s %s"
#define SOFT "ln -s ../%s %s"

/* All pairs of a command and a kind of input with SPRAYPLAN_LONG. */
static void no_kind_of_input_is_replaced(void **state)
{
    (void)state;
    static const char *const inputs[] = {"scene.yaml", "room.obj", "measured.yaml", "rim.exr"};
    static const char *const calls[][2] = {{"check scene.yaml -o out", "wet.png"},
                                           {"simulate scene.yaml -o out", "coverage.png"},
                                           {"place scene.yaml -o out", "layout.yaml"},
                                           {"study scene.yaml -o out", "report.html"}};
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++)
        for (size_t k = 0; k < sizeof calls / sizeof *calls; k++)
            if (i == k || getenv("SPRAYPLAN_LONG")) {
                refuses(calls[k][0], calls[k][1], inputs[i], HARD);
                if (COMPARES_LINKS)
                    refuses(calls[k][0], calls[k][1], inputs[3 - i], SOFT);
            }
    refuses("compare before/result.json scene.yaml -o out", "report.html", "measured.yaml", HARD);
    refuses("compare before/result.json before/result.json -o out", "report.html", "before/result.json", HARD);
    refuses("compare before/result.json before/result.json -o out", "result.json", "before/result.json", SOFT);
    refuses("atlas room.obj -o out/a.obj", "a.obj", "room.obj", HARD);
    refuses("atlas room.obj -o out/a.obj", "a-page_0.png", "room.obj", SOFT);
}

/* By its own path, and over folders and links. */
static void nor_by_its_own_name(void **state)
{
    (void)state;
    static const char *const calls[] = {"atlas room.obj -o room.obj",
                                        "atlas room.obj -o ./room.obj",
                                        "atlas room.obj -o before/../room.obj",
                                        "compare before/result.json before/result.json -o before",
                                        "check wet.png -o .",
                                        "simulate before/layout.yaml -o before"};
    run_shell("cp scene.yaml wet.png", "", "");
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
        outcome result = run_program(calls[i]);
        if (result.status != 1)
            print_error("%s: status %d, %s\n", calls[i], result.status, result.err);
        assert_int_equal(result.status, 1);
        assert_non_null(strstr(result.err, "would replace a file that was read"));
        forget(&result);
    }
}

static int open_inputs(void **state)
{
    if (open_workplace(state))
        return -1;
    write_file("scene.yaml", scene_yaml);
    write_file("measured.yaml", measured_yaml);
    run_shell("cp '%s' rim.exr", SOURCE_DIR "/scenes/heavy_rim.exr", "");
    run_shell("mkdir before", "", "");
    write_file("before/result.json", result_json);
    run_shell("sed 's/: room/: ..\\/room/; s/: measured/: ..\\/measured/' scene.yaml >before/layout.yaml", "", "");
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_kind_of_input_is_replaced),
        cmocka_unit_test(nor_by_its_own_name),
    };
    return cmocka_run_group_tests(tests, open_inputs, close_workplace);
}
