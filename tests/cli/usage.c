/* How the program is called, and what it says when it is called wrongly. */
#include "workplace.h"

static void says_its_version(void **state)
{
    (void)state;
    expect("--version", 0, "sprayplan 0.1.0\n", "");
    expect("-V", 0, "sprayplan 0.1.0\n", "");
    expect("check --version", 0, "sprayplan 0.1.0\n", "");
    expect("-qV", 0, "sprayplan 0.1.0\n", "");
}

/* Both ways to ask give the same, and no line is wider than a terminal. */
static void help_goes_to_standard_output(void **state)
{
    (void)state;
    static const char *const commands[] = {"",       "check ", "simulate ", "place ", "compare ",
                                           "trace ", "atlas ", "bench ",    "study ", "help "};
    for (size_t i = 0; i < sizeof commands / sizeof *commands; ++i) {
        char line[64];
        snprintf(line, sizeof line, "%s--help", commands[i]);
        outcome result = run_program(line);
        assert_int_equal(result.status, 0);
        assert_ptr_equal(strstr(result.out, "usage: sprayplan"), result.out);
        for (const char *at = result.out; *at; at += strcspn(at, "\n") + 1)
            assert_in_range(strcspn(at, "\n"), 0, 80);
        snprintf(line, sizeof line, "help %s", commands[i]);
        expect(line, 0, result.out, "");
        assert_string_equal(result.err, "");
        forget(&result);
    }
    outcome result = run_program("help place");
    assert_non_null(strstr(result.out, "--time-limit S"));
    assert_non_null(strstr(result.out, "-q, --quiet"));
    assert_null(strstr(result.out, "--rays"));
    forget(&result);
    result = run_program("help result");
    assert_non_null(strstr(result.out, "\n\ncertificate:\nProved of layouts"));
    forget(&result);
}

static void options_stand_anywhere(void **state)
{
    (void)state;
    json_t *object = expect_json("--json --set simulate.texel=100mm check room.yaml", 0);
    assert_string_equal(json_string_value(json_object_get(object, "command")), "check");
    json_decref(object);
    expect("-q check -- room.yaml", 0, "", "");
    object = expect_json("help --json result", 0);
    assert_non_null(json_object_get(object, "$schema"));
    json_decref(object);
}

static void wrong_usage_ends_with_2_and_prints_nothing(void **state)
{
    (void)state;
    static const struct {
        const char *arguments, *complaint;
    } calls[] = {
        {"", "usage: sprayplan"},
        {"paint room.yaml", "unknown command \"paint\"; see sprayplan help\n"},
        {"plcae room.yaml", "unknown command \"plcae\"; did you mean place?\n"},
        {"help simulat", "unknown command or topic \"simulat\"; did you mean simulate?\n"},
        {"help scnee", "unknown command or topic \"scnee\"; did you mean scene?\n"},
        {"help catalog", "unknown command or topic \"catalog\"; did you mean catalogue?\n"},
        {"help rain", "unknown command or topic \"rain\"; see sprayplan help\n"},
        {"help check place", "help: found 2 file names"},
        {"help check --json", "help: found \"check\", expected scene, catalogue or result"},
        {"--json", "found no command"},
        {"place room.yaml --time-limt 3", "unknown option --time-limt; did you mean --time-limit?\n"},
        {"place room.yaml --time 3", "unknown option --time; did you mean --time-limit?\n"},
        {"--prove check room.yaml", "check does not take --prove"},
        {"check room.yaml -x", "unknown option -x\n"},
        {"check room.yaml -qx", "unknown option -x\n"},
        {"check room.yaml --json=yes", "--json: found \"yes\", expected no value"},
        {"check room.yaml -o", "-o: found nothing behind it, expected DIR"},
        {"check --threads", "--threads: found nothing behind it, expected N"},
        {"check -- room.yaml --json", "found 2 file names, expected one"},
        {"study", "found 0 file names, expected one"},
        {"study room.yaml room.yaml", "found 2 file names, expected one"},
        {"study room.yaml --prove", "study does not take --prove"},
        {"study room.yaml --texel 3mm", "study does not take --texel"},
        {"check", "found 0 file names, expected one"},
        {"check room.yaml room.yaml", "found 2 file names, expected one"},
        {"compare room.yaml", "found 1 file names, expected two or more"},
        {"check room.yaml --threads 0", "--threads: found \"0\", expected a whole number"},
        {"check room.yaml --threads two", "--threads: found \"two\""},
        {"check room.yaml --set simulate.jets", "--set: found \"simulate.jets\", expected KEY=VALUE"},
        {"bench room.obj -o out", "bench does not take -o"},
        {"simulate room.yaml --time-limit 3", "simulate does not take --time-limit"},
        {"simulate room.yaml --memory 1GB", "simulate does not take --memory"},
        {"place room.yaml --memory 2",
         "--memory: found \"2\", expected a size above 0 with its unit, as \"2 GB\" or 500MiB"},
        {"place room.yaml --memory 0GB", "--memory: found \"0GB\", expected a size above 0"},
        {"place room.yaml --memory 3apples", "--memory: found \"3apples\", expected a size above 0"},
        {"place room.yaml --time-limit 0", "--time-limit: found \"0\", expected seconds above 0"},
        {"place room.yaml --frobnicate", "frobnicate"},
        {"trace room.obj", "found no --rays"},
        {"trace room.obj --rays r --accel octree", "--accel: found \"octree\", expected bvh, sah, naive or none"},
        {"trace room.obj --rays r --gravity 0,0", "--gravity: found \"0,0\", expected gx,gy,gz"},
        {"atlas room.obj --set simulate.jets=1", "atlas does not take --set"},
        {"atlas room.obj -o unfolded.png", "-o: found \"unfolded.png\", expected a file name ending in .obj"},
        {"bench room.obj --rays 0", "--rays: found \"0\", expected a whole number"},
        {"bench room.obj --rays 1e3", "--rays: found \"1e3\", expected a whole number"},
        {"bench room.obj --mode spiral", "--mode: found \"spiral\", expected cone, grid"},
        {"bench room.obj --trajectory arc", "--trajectory: found \"arc\", expected line or parabola"},
        {"bench room.obj --accel sah", "bench does not take --accel"},
        {"bench", "found 0 file names, expected one"},
        {"check room.yaml --mode cone", "check does not take --mode"},
        {"atlas room.obj --unit bar", "--unit: found \"bar\", expected a unit of length such as mm"},
        {"atlas room.obj --unit=", "--unit: found \"\", expected a unit of length such as mm"},
        {"bench room.obj --unit 3", "--unit: found \"3\", expected a unit of length such as mm"},
        {"check room.yaml --unit mm", "check does not take --unit"},
        {"atlas room.obj --texel 3s", "--texel: found \"3s\", expected a length above 0"},
    };
    for (size_t i = 0; i < sizeof calls / sizeof *calls; ++i) {
        outcome result = run_program(calls[i].arguments);
        if (result.status != 2 || !strstr(result.err, calls[i].complaint))
            print_error("sprayplan %s: status %d, %s\n", calls[i].arguments, result.status, result.err);
        assert_int_equal(result.status, 2);
        assert_non_null(strstr(result.err, calls[i].complaint));
        assert_string_equal(result.out, "");
        forget(&result);
    }
}

static void bad_input_ends_with_3_and_says_where(void **state)
{
    (void)state;
    write_file("unit.yaml", "geometry:\n  - file: room.obj\ncriterion:\n  flux: 1 bar\ncatalogue: catalogue.yaml\n");
    write_file("key.yaml", "geometry:\n  - file: room.obj\n    colour: red\ncatalogue: catalogue.yaml\n");
    write_file("type.yaml", "geometry:\n  - file: room.obj\ncatalogue: catalogue.yaml\nnozzles:\n"
                            "  - {name: N, type: hose, position: [0.5, 0.5, 0.5], axis: [0, 0, 1], pressure: 2 bar}\n");
    write_file("mesh.yaml", "geometry:\n  - file: broken.obj\ncatalogue: catalogue.yaml\n");
    write_file("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    write_file("syntax.yaml", "geometry: [\n");
    write_file("bare.yaml", "geometry:\n  - file: room.obj\ncatalogue: catalogue.yaml\n");
    static const struct {
        const char *arguments, *place, *subject;
    } calls[] = {
        {"check unit.yaml", "unit.yaml:4:9: ", "flux"},
        {"check key.yaml", "key.yaml:3:5: ", "colour"},
        {"check type.yaml", "type.yaml:5:21: ", "hose"},
        {"check mesh.yaml", "broken.obj:4", "4"},
        {"check syntax.yaml", "syntax.yaml:", ""},
        {"check nowhere.yaml", "nowhere.yaml", ""},
        {"check room.yaml --set simulate.jets=none", "", "simulate.jets"},
        {"check room.yaml --set simulate.colour=red", "", "colour"},
        {"simulate bare.yaml", "bare.yaml", "nozzles"},
        {"place bare.yaml", "bare.yaml", "place"},
        {"study bare.yaml", "bare.yaml", "nozzles"},
        {"study nowhere.yaml", "nowhere.yaml", ""},
        {"study room.yaml --set simulate.texel=none", "", "simulate.texel"},
        {"trace broken.obj --rays room.yaml", "broken.obj:4", ""},
        {"atlas nowhere.obj", "nowhere.obj", ""},
        {"bench nowhere.obj", "nowhere.obj", ""},
        {"bench broken.obj --rays 10", "broken.obj:4", ""},
    };
    for (size_t i = 0; i < sizeof calls / sizeof *calls; ++i)
        for (int json = 0; json < 2; ++json) {
            char line[256];
            snprintf(line, sizeof line, "%s%s", calls[i].arguments, json ? " --json" : "");
            outcome result = run_program(line);
            if (result.status != 3 || !strstr(result.err, calls[i].place) || !strstr(result.err, calls[i].subject))
                print_error("sprayplan %s: status %d, %s\n", line, result.status, result.err);
            assert_int_equal(result.status, 3);
            assert_non_null(strstr(result.err, calls[i].place));
            assert_non_null(strstr(result.err, calls[i].subject));
            assert_string_equal(result.out, "");
            forget(&result);
        }
}

/* Runs a command of the shell in the workplace; its status, and what it prints in .out. */
static int run_shell(const char *command)
{
    char line[1024];
    snprintf(line, sizeof line, "cd '%s' && { %s; } >.out 2>&1", workplace, command);
    int status = system(line);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/* As far as the page is made here, and there is something to read it. */
static void the_manual_page_is_sound(void **state)
{
    (void)state;
    static const char *const readers[] = {"groff -man -ww -z -Tutf8", "mandoc -Tlint -Wwarning"};
    static const char page[] = BINARY_DIR "/man/man1/sprayplan.1";
    bool read = false;
    if (access(page, R_OK) != 0)
        skip();
    for (size_t i = 0; i < sizeof readers / sizeof *readers; ++i) {
        char line[600];
        snprintf(line, sizeof line, "command -v %.*s", (int)strcspn(readers[i], " "), readers[i]);
        if (run_shell(line) != 0)
            continue;
        snprintf(line, sizeof line, "%s '%s'", readers[i], page);
        assert_int_equal(run_shell(line), 0);
        char *complaints = read_file(".out", NULL);
        assert_string_equal(complaints, "");
        free(complaints);
        read = true;
    }
    if (!read || run_shell("MANWIDTH=80 man -l " BINARY_DIR "/man/man1/sprayplan.1 | col -b") != 0)
        skip();
    char *text = read_file(".out", NULL);
    static const char *const said[] = {"sprayplan place [OPTION]... SCENE",
                                       "--time-limit S",
                                       "-q, --quiet",
                                       "layout-1.yaml",
                                       "OMP_NUM_THREADS",
                                       "130 "};
    for (size_t i = 0; i < sizeof said / sizeof *said; ++i)
        assert_non_null(strstr(text, said[i]));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(says_its_version),
        cmocka_unit_test(help_goes_to_standard_output),
        cmocka_unit_test(options_stand_anywhere),
        cmocka_unit_test(wrong_usage_ends_with_2_and_prints_nothing),
        cmocka_unit_test(bad_input_ends_with_3_and_says_where),
        cmocka_unit_test(the_manual_page_is_sound),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
