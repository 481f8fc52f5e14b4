/* What a command leaves while writing fails: all that it had to say, or what was there before, and an exit status. */
#define _GNU_SOURCE /* unshare */
#include "faults/program.h"

#include "../result/folder.h"

#include <errno.h>
#include <sched.h>
#include <sys/mount.h>

/* Under the sanitizers, where a run takes ten times as long, one of so many. */
#ifdef SPRAYPLAN_SANITIZE
enum { FEW = 3 };
#else
enum { FEW = 1 };
#endif

static const char small_yaml[] =
    "geometry:\n"
    "  - file: room.obj\n"
    "criterion: {flux: 1 L/min/m2}\n"
    "catalogue: catalogue.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: cone, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 0, -1], pressure: 2 bar}\n"
    "simulate: {texel: 500 mm, accuracy: 50 %}\n";

static const char mounts_yaml[] = "place:\n"
                                  "  coverage: 90 %\n"
                                  "  max_nozzles: 2\n"
                                  "  pressure: 2 bar\n"
                                  "  mounts:\n"
                                  "    - port: {name: P1, position: [0.3 m, 0.3 m, 1 m], axis: [0, 0, -1], depth: "
                                  "{from: 100 mm, to: 300 mm, spacing: "
                                  "200 mm}}\n";

/* What another run, and somebody else, left in out/. */
static void set_up(void)
{
    char path[600];
    snprintf(path, sizeof path, "%s/out", workplace);
    remove_folder(path);
    assert_int_equal(mkdir(path, 0777), 0);
    write_file("out/result.json", "{\"sprayplan\": \"0.1.0\", \"command\": \"place\"}\n");
    write_file("out/report.html", "an old page");
    write_file("out/wet.png", "an old picture");
    write_file("out/a.obj", "an old mesh");
    write_file("out/notes.txt", "another's");
}

static char *out_text(bool hidden)
{
    char path[600];
    snprintf(path, sizeof path, "%s/out", workplace);
    return folder_text(path, hidden);
}

/* Names alone, as measured times are part of what is written; what only tidying up has left aside, which the next run
 * does. */
static char *names(void)
{
    char line[1024];
    snprintf(line, sizeof line, "cd '%s/out' && LC_ALL=C ls >../.list", workplace);
    assert_int_equal(system(line), 0);
    return read_file(".list", NULL);
}

static void fails_at(const char *command, long n, const char *before, const char *all)
{
    set_up();
    plan->failing_change = n;
    outcome result = run_faulty(command);
    char *now = out_text(true), *listed = names();
    bool whole = (result.status == 0 || result.status == 4) && !strcmp(listed, all);
    bool nothing = result.status == 1 && !strcmp(now, before) && strstr(result.err, "out");
    if (!whole && !nothing)
        print_error("sprayplan %s, write %ld fails: status %d, %s\n%s", command, n, result.status, result.err, listed);
    assert_true(whole || nothing);
    free(now);
    free(listed);
    forget(&result);
}

/* A full disk from one write on, for `runs` of them, all with SPRAYPLAN_LONG. */
static void each_fails(const char *command, long runs)
{
    set_up();
    *plan = (fault_plan){0};
    outcome result = run_faulty(command);
    assert_true(result.status == 0 || result.status == 4);
    forget(&result);
    long count = plan->changes, step = getenv("SPRAYPLAN_LONG") ? 1 : count / runs + 1;
    char *all = names();
    set_up();
    char *before = out_text(true);
    plan->cause = ENOSPC;
    plan->lasting = true;
    for (long n = 1 + step / 2; n <= count; n += step)
        fails_at(command, n, before, all);
    print_message("sprayplan %s: %ld writes\n", command, count);
    free(before);
    free(all);
}

static void full_disks(void **state)
{
    (void)state;
    each_fails("check small.yaml -o out --quiet", 3 / FEW);
    each_fails("atlas room.obj -o out/a.obj --texel 100mm --quiet", 6 / FEW);
    if (FEW == 1)
        each_fails("simulate small.yaml -o out --quiet", 2);
    if (!getenv("SPRAYPLAN_LONG"))
        return;
    each_fails("compare small.yaml small.yaml -o out --quiet", 1);
    each_fails("study small.yaml -o out --quiet --time-limit 1", 1);
    each_fails("place mounts.yaml -o out --quiet", 1);
}

/* Killed at some writes: all old, or all new once another run has written there. */
static void killed(void **state)
{
    (void)state;
    static const char atlas[] = "atlas room.obj -o out/a.obj --texel 100mm --quiet";
    set_up();
    char *before = out_text(true);
    *plan = (fault_plan){.cause = -SIGKILL};
    outcome result = run_faulty(atlas);
    forget(&result);
    char *after = out_text(true);
    long count = plan->changes, step = getenv("SPRAYPLAN_LONG") ? 1 : 4 * FEW;
    for (long n = 1; n <= count; n += step) {
        set_up();
        plan->failing_change = n;
        outcome ended = run_faulty(atlas);
        assert_int_equal(ended.status, -SIGKILL);
        forget(&ended);
        plan->failing_change = 0;
        result = run_faulty("atlas room.obj -o out/next.obj --texel 100mm --quiet");
        assert_int_equal(result.status, 0);
        forget(&result);
        char *line = NULL;
        assert_true(asprintf(&line, "rm '%s/out/next.obj' '%s/out/next-page_0.png'", workplace, workplace) > 0);
        assert_int_equal(system(line), 0);
        free(line);
        char *now = out_text(true);
        assert_true(!strcmp(now, before) || !strcmp(now, after));
        free(now);
    }
    free(before);
    free(after);
}

/* The real thing: of files, of a disk, and a folder that takes none, also from root. */
static void assert_refused(const char *prefix, const char *command, const char *reason)
{
    char line[2048];
    snprintf(line, sizeof line, "cd '%s' && %s exec '%s/sprayplan' %s 2>.err >.out </dev/null", workplace, prefix,
             BINARY_DIR, command);
    set_up();
    char *before = out_text(true);
    int status = system(line);
    char *now = out_text(true), *err = read_file(".err", NULL);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 1 || !strstr(err, reason) || strcmp(now, before) != 0)
        print_error("sprayplan %s: status %d, %s\n", command, status, err);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 1);
    assert_non_null(strstr(err, reason));
    assert_string_equal(now, before);
    free(before);
    free(now);
    free(err);
}

static void files_may_not_grow(void **state)
{
    (void)state;
    assert_refused("ulimit -f 8 &&", "check small.yaml -o out --quiet",
                   "out/wet.png: cannot be written: File too large");
    if (FEW == 1)
        assert_refused("ulimit -f 200 &&", "simulate small.yaml -o out --quiet",
                       "out/report.html: cannot be written: File too large");
}

/* In a mount of its own, where that is allowed; ends the process. */
static void in_own_mounts(const char *options, unsigned long flags, const char *command, const char *reason)
{
    char path[600], page[256 << 10];
    snprintf(path, sizeof path, "%s/out", workplace);
    set_up();
    if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0)
        _exit(77);
    if (mount(NULL, "/", NULL, MS_REC | MS_PRIVATE, NULL) != 0 || mount("none", path, "tmpfs", 0, options) != 0)
        _exit(77);
    memset(page, 'x', sizeof page - 1);
    page[sizeof page - 1] = 0;
    write_file("out/report.html", page);
    if (flags && mount(NULL, path, NULL, MS_REMOUNT | flags, NULL) != 0)
        _exit(77);
    char *before = out_text(true);
    outcome result = run_program(command);
    char *now = out_text(true);
    bool good = result.status == 1 && strstr(result.err, reason) && !strcmp(now, before);
    if (!good)
        print_error("%s: status %d, %s\n", command, result.status, result.err);
    _exit(good ? 0 : 1);
}

static void mounted(const char *options, unsigned long flags, const char *command, const char *reason)
{
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
        in_own_mounts(options, flags, command, reason);
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 77)
        skip();
    assert_int_equal(status, 0);
}

static void disk_is_full(void **state)
{
    (void)state;
    mounted("size=300k", 0, "check small.yaml -o out --quiet",
            "out/wet.png: cannot be written: No space left on device");
}

static void folder_is_read_only(void **state)
{
    (void)state;
    mounted("size=1M", MS_RDONLY, "simulate small.yaml -o out --quiet",
            "out: cannot be written to: Read-only file system");
}

/* Standard output, where what is printed goes nowhere: a full disk, none, and a reader who has gone. */
static void standard_output_fails(void **state)
{
    (void)state;
    static const char *const calls[] = {
        "--help",
        "--version",
        "check --help",
        "check small.yaml",
        "check small.yaml --json",
        "simulate small.yaml --json",
        "atlas room.obj --json",
        "trace room.obj --rays rays.csv",
    };
    int ends[2];
    char gone[16];
    assert_int_equal(pipe(ends), 0);
    close(ends[0]);
    snprintf(gone, sizeof gone, "&%d", ends[1]);
    const char *const ways[] = {"/dev/full", "&-", gone};
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++)
        for (size_t k = i % FEW; k < sizeof ways / sizeof *ways; k += FEW) {
            char line[2048];
            snprintf(line, sizeof line, "cd '%s' && exec '%s/sprayplan' %s </dev/null 2>.err >%s", workplace,
                     BINARY_DIR, calls[i], ways[k]);
            int status = system(line);
            char *err = read_file(".err", NULL);
            if (!WIFEXITED(status) || WEXITSTATUS(status) != 1)
                print_error("%s: status %d\n", line, status);
            assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 1);
            assert_string_equal(err, "sprayplan: standard output could not be written\n");
            free(err);
        }
    close(ends[1]);
}

/* Two scenes into one folder at the same time: all files are of one of them. */
static void two_at_once(void **state)
{
    (void)state;
    char line[2048];
    snprintf(
        line, sizeof line,
        "cd '%s' && for scene in small mounts; do '%s/sprayplan' simulate $scene.yaml -o both --quiet & done; wait",
        workplace, BINARY_DIR);
    for (int round = 0; round < (getenv("SPRAYPLAN_LONG") ? 20 : FEW == 1); round++) {
        assert_int_equal(system(line), 0);
        char *layout = read_file("both/layout.yaml", NULL), *result = read_file("both/result.json", NULL);
        assert_non_null(layout);
        assert_non_null(result);
        assert_int_equal(strstr(layout, "mounts:") != NULL, strstr(result, "mounts.yaml") != NULL);
        char *hidden = list_folder("both");
        assert_null(strstr(hidden, ".sprayplan"));
        free(hidden);
        free(layout);
        free(result);
    }
}

static int open_scenes(void **state)
{
    if (open_faults(state))
        return -1;
    char text[4096];
    snprintf(text, sizeof text, "%s%s", small_yaml, mounts_yaml);
    write_file("small.yaml", small_yaml);
    write_file("mounts.yaml", text);
    write_file("rays.csv", "0.5,0.5,0.5,0,0,-1\n");
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(standard_output_fails), cmocka_unit_test(files_may_not_grow), cmocka_unit_test(disk_is_full),
        cmocka_unit_test(folder_is_read_only),   cmocka_unit_test(full_disks),         cmocka_unit_test(killed),
        cmocka_unit_test(two_at_once),
    };
    return cmocka_run_group_tests(tests, open_scenes, close_faults);
}
