/* What the program tells the OpenMP runtime of how threads wait. */
#include "results.h"

#include <signal.h>
#include <time.h>

/* Whether the process runs the program under test, with `wanted` in the environment that it was given. */
static bool runs_with(pid_t process, const char *wanted)
{
    static char text[1 << 20];
    char path[64], *program = text;
    snprintf(path, sizeof path, "/proc/%d/exe", (int)process);
    ssize_t named = readlink(path, program, sizeof text - 1);
    text[named > 0 ? named : 0] = 0;
    if (strcmp(program, BINARY_DIR "/sprayplan") != 0)
        return false;
    snprintf(path, sizeof path, "/proc/%d/environ", (int)process);
    FILE *file = fopen(path, "r");
    size_t length = file ? fread(text, 1, sizeof text - 1, file) : 0;
    if (file)
        fclose(file);
    text[length] = 0;
    for (size_t i = 0; i < length; i += strlen(text + i) + 1)
        if (!strcmp(text + i, wanted))
            return true;
    return false;
}

/* place on thousands of mounting points, which the caller stops. */
static pid_t begin_place(const char *policy)
{
    pid_t child = fork();
    if (child == 0) {
        bool set = (policy ? setenv("OMP_WAIT_POLICY", policy, 1) : unsetenv("OMP_WAIT_POLICY")) == 0;
        if (!set || chdir(workplace) != 0 || !freopen(".out", "w", stdout) || !freopen(".err", "w", stderr))
            _exit(127);
        execl(BINARY_DIR "/sprayplan", "sprayplan", "place", "long.yaml", "-o", "waited", (char *)NULL);
        _exit(127);
    }
    return child;
}

/* False where the process ends, or half a minute passes, before that. */
static bool comes_to_run_with(pid_t child, const char *wanted)
{
    struct timespec pause = {0, 10000000};
    for (int i = 0; i < 3000 && waitpid(child, NULL, WNOHANG) == 0; i++) {
        if (runs_with(child, wanted))
            return true;
        nanosleep(&pause, NULL);
    }
    return false;
}

static void threads_sleep_unless_told_otherwise(void **state)
{
    (void)state;
    static const struct {
        const char *policy, *wanted;
    } cases[] = {{NULL, "OMP_WAIT_POLICY=passive"}, {"active", "OMP_WAIT_POLICY=active"}};
    write_long_scene("long.yaml", "", "40 mm");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        pid_t child = begin_place(cases[i].policy);
        assert_true(child > 0);
        bool runs = comes_to_run_with(child, cases[i].wanted);
        kill(child, SIGKILL);
        waitpid(child, NULL, 0);
        assert_true(runs);
    }
}

static void starting_anew_changes_nothing_else(void **state)
{
    (void)state;
    static const char command[] = "check room.yaml --json";
    setenv("OMP_WAIT_POLICY", "passive", 1);
    outcome told = run_program(command);
    unsetenv("OMP_WAIT_POLICY");
    outcome untold = run_program(command);
    assert_int_equal(told.status, 0);
    assert_int_equal(untold.status, 0);
    assert_string_equal(untold.out, told.out);
    forget(&told);
    forget(&untold);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_sleep_unless_told_otherwise),
        cmocka_unit_test(starting_anew_changes_nothing_else),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
