/* The line on standard error that tells how far a command has come, where that is a terminal. */
#include "workplace.h"

#define PROGRAM BINARY_DIR "/sprayplan"

/* What `sprayplan <arguments>` shows on a terminal, the summary with it, owned; NULL where there is nothing to make a
 * terminal with. */
static char *shown(const char *environment, const char *arguments)
{
    char line[2048];
    snprintf(line, sizeof line,
             "cd '%s' && command -v script >.list && %s script -qec \"'" PROGRAM "' %s\" /dev/null </dev/null >.out",
             workplace, environment, arguments);
    int status = system(line);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? read_file(".out", NULL) : NULL;
}

static size_t count(const char *text, const char *what)
{
    size_t found = 0;
    for (const char *at = text; (at = strstr(at, what)); at += strlen(what))
        found++;
    return found;
}

/* Stages in their order, each with its number of all. */
static void shows_which_of_how_many_stages(void **state)
{
    (void)state;
    static const char *const stages[] = {"[1/5] geometry", "[2/5] atlas", "[3/5] simulate", "[4/5] measured error",
                                         "[5/5] report"};
    char *text = shown("TERM=xterm", "simulate room.yaml --set simulate.texel=100mm");
    if (!text)
        skip();
    const char *at = text;
    for (size_t i = 0; i < sizeof stages / sizeof *stages; i++)
        assert_non_null(at = strstr(at, stages[i]));
    assert_null(strstr(text, "s left")); /* not known */
    assert_non_null(strstr(text, "\r\033[K"));
    free(text);
}

/* Rows that go elsewhere leave the terminal to the line. */
static void so_do_atlas_and_trace(void **state)
{
    (void)state;
    static const struct {
        const char *arguments, *stages[5];
    } runs[] = {
        {"atlas room.obj -o out.obj", {"[1/5] mesh", "[2/5] charts", "[3/5] texels", "[4/5] figures", "[5/5] files"}},
        {"atlas out.obj --reuse --json", {"[1/3] mesh", "[2/3] reuse", "[3/3] figures"}},
        {"trace room.obj --rays rays.csv >rows.csv", {"[1/3] mesh", "[2/3] accelerator", "[3/3] rays"}},
    };
    write_file("rays.csv", "0,0,0,1,0,0\n");
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        char *text = shown("TERM=xterm", runs[i].arguments), *at = text;
        if (!text)
            skip();
        for (size_t k = 0; k < 5 && runs[i].stages[k]; k++)
            assert_non_null(at = strstr(at, runs[i].stages[k]));
        free(text);
    }
    char *rows = read_file("rows.csv", NULL);
    assert_non_null(strstr(rows, "\n0,"));
    free(rows);
}

/* Each alternative has the same stages again; with a limit the time that is left of it is known. */
static void shows_the_time_left_of_the_limit(void **state)
{
    (void)state;
    char *text = shown("TERM=xterm", "place room.yaml --set simulate.texel=200mm --time-limit 100");
    if (!text)
        skip();
    assert_non_null(strstr(text, "[4/10] visibility"));
    assert_non_null(strstr(text, "at most 9"));
    assert_non_null(strstr(text, "[9/10] certificate"));
    free(text);
}

static void has_no_escape_codes_where_none_are_wanted(void **state)
{
    (void)state;
    static const char *const environments[] = {"TERM=dumb", "env -u TERM", "TERM=xterm NO_COLOR=1"};
    for (size_t i = 0; i < sizeof environments / sizeof *environments; i++) {
        char *text = shown(environments[i], "check room.yaml --set simulate.texel=100mm");
        if (!text)
            skip();
        assert_null(strchr(text, '\033'));
        assert_non_null(strstr(text, "[1/3] geometry"));
        assert_non_null(strstr(text, "[3/3] check"));
        if (i < 2)
            assert_int_equal(count(text, "\r"), count(text, "\n")); /* lines, of which none is drawn again */
        free(text);
    }
    char *text = shown("TERM=xterm", "check room.yaml --quiet");
    assert_string_equal(text, "");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shows_which_of_how_many_stages),
        cmocka_unit_test(so_do_atlas_and_trace),
        cmocka_unit_test(shows_the_time_left_of_the_limit),
        cmocka_unit_test(has_no_escape_codes_where_none_are_wanted),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
