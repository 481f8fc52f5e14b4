/* scenes/read_results.py reads what the program writes and finds it in agreement; and tells where it is not. */
#include "workplace.h"

static const char sheet_obj[] = "v .2 .5 .1\nv .8 .5 .1\nv .8 .5 .6\nv .2 .5 .6\ng sheet\nf 1 2 3 4\n";

static const char two_yaml[] =
    "geometry: [{file: room.obj}, {file: sheet.obj}]\n"
    "cavity: [0.5 m, 0.7 m, 0.5 m]\n"
    "criterion: {flux: 1 L/min/m2}\n"
    "catalogue: catalogue.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: ball, position: [0.5 m, 0.7 m, 0.4 m], axis: [0, 0, -1], pressure: 2 bar}\n"
    "simulate: {texel: 100 mm}\n";

static void skip_without_python(void)
{
    if (system("python3 -c 'import sys; sys.exit(sys.version_info < (3, 8))' >/dev/null 2>&1") != 0) {
        print_message("python3 is not installed, or older than 3.8\n");
        skip();
    }
}

static outcome read_results(const char *folder)
{
    char line[4096];
    snprintf(line, sizeof line,
             "cd '%s' && exec python3 -W error '" SOURCE_DIR "/scenes/read_results.py' %s >.out 2>.err </dev/null",
             workplace, folder);
    int status = system(line);
    assert_true(WIFEXITED(status));
    return (outcome){WEXITSTATUS(status), read_file(".out", NULL), read_file(".err", NULL)};
}

static void expect_agreement(const char *folder, const char *part)
{
    outcome read = read_results(folder);
    assert_string_equal(read.err, "");
    assert_int_equal(read.status, 0);
    assert_non_null(strstr(read.out, part));
    assert_non_null(strstr(read.out, "deposits.exr: coverage"));
    forget(&read);
}

static void files_agree_with_the_result(void **state)
{
    (void)state;
    skip_without_python();
    outcome run = run_program("simulate room.yaml -o one --no-live --quiet --set simulate.texel=100mm");
    assert_int_equal(run.status, 0);
    forget(&run);
    expect_agreement("one", "ceiling");
}

/* An image of two parts: a sheet is wet on its back too. */
static void sheets_have_a_back(void **state)
{
    (void)state;
    skip_without_python();
    write_file("sheet.obj", sheet_obj);
    write_file("two.yaml", two_yaml);
    outcome run = run_program("simulate two.yaml -o two --no-live --quiet");
    assert_int_equal(run.status, 0);
    forget(&run);
    expect_agreement("two", "sheet");
}

static void alternatives_are_read_too(void **state)
{
    (void)state;
    skip_without_python();
    char text[4096];
    snprintf(text, sizeof text, "%s  refine: none\n  alternatives: [{name: first, mounts: [P1]}, {name: both}]\n",
             room_yaml);
    write_file("choice.yaml", text);
    outcome run = run_program("place choice.yaml -o choice --no-live --quiet --set simulate.texel=100mm");
    assert_string_equal(run.err, "");
    forget(&run);
    expect_agreement("choice", "ceiling");
}

static void what_differs_is_reported(void **state)
{
    (void)state;
    skip_without_python();
    size_t size;
    char *bytes = read_file("one/result.json", &size), *covered = strstr(bytes, "\"covered_area_m2\": "), path[1024];
    assert_non_null(covered);
    covered += strlen("\"covered_area_m2\": ");
    *covered = *covered == '1' ? '2' : '1';
    snprintf(path, sizeof path, "%s/one/result.json", workplace);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    free(bytes);
    outcome read = read_results("one");
    assert_string_equal(read.err, "");
    assert_int_equal(read.status, 1);
    assert_non_null(strstr(read.out, "differs"));
    forget(&read);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_agree_with_the_result),
        cmocka_unit_test(sheets_have_a_back),
        cmocka_unit_test(alternatives_are_read_too),
        cmocka_unit_test(what_differs_is_reported),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
