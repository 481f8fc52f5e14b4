/* A program in sprayplan-cad's place that dies, lies, sleeps or is not there: always an error, and nothing is left. */
#include "mesh/cad/process.h"

#include <dirent.h>
#include <errno.h>
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>

#include <cmocka.h>

static size_t count_descriptors(void)
{
    size_t count = 0;
    DIR *folder = opendir("/proc/self/fd");
    assert_non_null(folder);
    while (readdir(folder))
        count++;
    closedir(folder);
    return count;
}

static bool run_for(const char *program, const char *script, double seconds, const sp_run *run, sp_error *error)
{
    char *const arguments[] = {(char *)program, (char *)"-c", (char *)script, NULL};
    sp_soup soup = {0};
    sp_cad_stream stream = sp_cad_stream_open("some.step", &soup);
    bool good = sp_cad_process_run(arguments, seconds, &stream, run, error);
    sp_cad_stream_clear(&stream);
    sp_soup_clear(&soup);
    return good;
}

/* Fails with that kind and text, naming the file; no child and no descriptor stays. */
static void expect(const char *program, const char *script, double seconds, const sp_run *run, sp_error_kind kind,
                   const char *what)
{
    size_t before = count_descriptors();
    sp_error error = {0};
    assert_false(run_for(program, script, seconds, run, &error));
    if (error.kind != kind || !strstr(error.message, what))
        fail_msg("%s: %d, %s", script, error.kind, error.message);
    assert_true(error.file[0]);
    assert_int_equal(count_descriptors(), before);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(errno, ECHILD);
}

static const sp_run silent = {0};

/* The greeting, 12 bytes, as printf of the shell writes it. */
#define GREETING "printf '\\001\\000\\000\\000\\004\\000\\000\\000\\001\\000\\000\\000'; "

static void programs_that_fail_are_errors(void **state)
{
    (void)state;
    static const struct {
        const char *script, *what;
    } cases[] = {
        {"kill -SEGV $$", "OpenCASCADE crashed on it (Segmentation fault), expected a sound file"},
        {"kill -KILL $$", "OpenCASCADE crashed on it (Killed)"},
        {"kill -XCPU $$", "more processor time than a file of its size may"},
        {"exit 3", "sprayplan-cad ended early, with status 3"},
        {"exit 0", "sprayplan-cad ended early, with status 0"},
        {GREETING "exit 0", "ended early, with status 0"},
        {GREETING "kill -ABRT $$", "crashed on it (Aborted)"},
        {GREETING GREETING "sleep 100", "found a record of no kind that is expected there"},
        {"echo hello, this is no greeting; sleep 100", "found a record of no kind that is expected there"},
        {"cat /dev/zero", "found a record of no kind that is expected there"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect("/bin/sh", cases[i].script, 1000, &silent, SP_ERROR_INPUT, cases[i].what);
}

static void programs_that_do_not_end_are_ended(void **state)
{
    (void)state;
    expect("/bin/sh", GREETING "exec sleep 100", 0.05, &silent, SP_ERROR_INPUT, "takes longer than a file of its size");
}

static bool cancel(void *user, const char *stage, double done)
{
    int *left = user;
    assert_string_equal(stage, "geometry");
    assert_true(done >= 0 && done <= 1);
    return --*left > 0;
}

static void cancelling_ends_the_program(void **state)
{
    (void)state;
    for (int times = 1; times <= 3; times++) {
        int left = times;
        const sp_run run = {.progress = cancel, .user = &left};
        expect("/bin/sh", "exec sleep 100", 1000, &run, SP_ERROR_INTERRUPTED, "interrupted");
        assert_int_equal(left, 0);
    }
}

static void a_program_that_is_missing_is_named(void **state)
{
    (void)state;
    expect("./no-such-program", "", 1, &silent, SP_ERROR_FILE, "cannot be started: No such file or directory");
}

static void *fail_often(void *unused)
{
    for (int i = 0; i < 5; i++) {
        sp_error error = {0};
        assert_false(run_for("/bin/sh", GREETING "exit 4", 1000, &silent, &error));
        assert_non_null(strstr(error.message, "status 4"));
    }
    return unused;
}

/* No end of one thread's pipe is held by another's program, and what signals do here is not what they do there. */
static void threads_do_not_mix(void **state)
{
    (void)state;
    pthread_t threads[4];
    size_t before = count_descriptors();
    void (*handler)(int) = signal(SIGPIPE, SIG_IGN);
    for (int i = 0; i < 4; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, fail_often, NULL), 0);
    for (int i = 0; i < 4; i++)
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    expect("/bin/sh", "kill -PIPE $$; sleep 100", 1000, &silent, SP_ERROR_INPUT, "crashed on it (Broken pipe)");
    signal(SIGPIPE, handler);
    assert_int_equal(count_descriptors(), before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(programs_that_fail_are_errors),
        cmocka_unit_test(programs_that_do_not_end_are_ended),
        cmocka_unit_test(cancelling_ends_the_program),
        cmocka_unit_test(a_program_that_is_missing_is_named),
        cmocka_unit_test(threads_do_not_mix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
