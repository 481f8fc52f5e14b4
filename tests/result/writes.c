/* A set of files while each call that writes fails, while its process is killed, and while others write to the folder.
 */
#include <sprayplan/result.h>

#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/wait.h>
#include <time.h>

#include <cmocka.h>

#include "../cli/faults/faults.h"
#include "folder.h"

#define FOLDER "writes-test"
#define FIGURES(of) "{\"sprayplan\": \"0.1.0\", \"command\": \"" of "\"}\n"

static void put(const char *name, const char *text)
{
    char path[256];
    snprintf(path, sizeof path, FOLDER "/%s", name);
    FILE *file = fopen(path, "wb");
    assert_true(file && fputs(text, file) >= 0 && fclose(file) == 0);
}

/* A folder that an earlier run wrote to, and others. */
static void set_up(void)
{
    remove_folder(FOLDER);
    assert_true(mkdir(FOLDER, 0777) == 0 && mkdir(FOLDER "/folder", 0777) == 0);
    put("result.json", FIGURES("place"));
    put("report.html", "an old page");
    put("model-greedy.glb", "an old model");
    put("layout.yaml", "an old layout, edited");
    put("notes.txt", "another's");
    put("folder/model-greedy.glb", "another's");
}

/* As writers do that are given a path. */
static bool write_to_path(sp_output *output, const char *name, const char *text, sp_error *error)
{
    const char *path = sp_output_path(output, name, error);
    FILE *file = path ? fopen(path, "wb") : NULL;
    if (!path)
        return false;
    bool good = file && fwrite(text, 1, strlen(text), file) == strlen(text);
    if (file && fclose(file) != 0)
        good = false;
    if (!good)
        sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be written");
    sp_output_tell(output, error);
    return good;
}

static bool write_set(const char *page, sp_error *error)
{
    sp_output *output = sp_output_open(FOLDER, error);
    bool good =
        output && sp_output_protect(output, FOLDER "/layout.yaml", error) && sp_output_supersede(output, error) &&
        sp_output_text(output, "result.json", FIGURES("simulate"), error) &&
        write_to_path(output, "coverage.png", page, error) && sp_output_text(output, "report.html", page, error);
    if (good)
        return sp_output_commit(output, error);
    sp_output_discard(output);
    return false;
}

static bool write_one(const char *name, sp_error *error)
{
    sp_output *output = sp_output_open(FOLDER, error);
    if (output && sp_output_text(output, name, name, error))
        return sp_output_commit(output, error);
    sp_output_discard(output);
    return false;
}

/* What set_up leaves, and what is there after a run that ends well. */
static char *before, *after;

static int open_texts(void **state)
{
    (void)state;
    sp_error error = {0};
    set_up();
    before = folder_text(FOLDER, true);
    assert_true(write_set("a new page", &error));
    after = folder_text(FOLDER, true);
    return strstr(after, "a new page") && strstr(after, "another's") && strstr(after, "edited") &&
                   strstr(after, "folder/model-greedy.glb") && !strstr(after, FOLDER "/model-greedy.glb")
               ? 0
               : -1;
}

static int close_texts(void **state)
{
    (void)state;
    free(before);
    free(after);
    remove_folder(FOLDER);
    return 0;
}

static void assert_folder(const char *expected, bool hidden)
{
    char *found = folder_text(FOLDER, hidden);
    assert_string_equal(found, expected);
    free(found);
}

/* Nothing or all. Where only the tidying up failed, the next run does it. */
static void assert_whole(bool done, const sp_error *error)
{
    if (done) {
        sp_error none = {0};
        assert_folder(after, false);
        assert_true(write_set("a new page", &none));
        assert_folder(after, true);
        return;
    }
    assert_true(error->kind == SP_ERROR_FILE && !strncmp(error->file, FOLDER, strlen(FOLDER)));
    assert_null(strstr(error->file, ".sprayplan"));
    assert_folder(before, true);
}

/* How many writes there are. */
static long fail_each_write(int cause, bool lasting)
{
    for (long n = 1;; n++) {
        sp_error error = {0};
        set_up();
        faults->changes = 0;
        faults->cause = cause;
        faults->lasting = lasting;
        faults->failing_change = n;
        bool done = write_set("a new page", &error), failed = faults->changes >= n;
        faults->failing_change = 0;
        assert_whole(done, &error);
        if (!failed)
            return n - 1;
    }
}

static void each_write_fails(void **state)
{
    (void)state;
    long count = fail_each_write(EIO, false);
    fail_each_write(ENOSPC, true);
    print_message("%ld writes, of which each failed\n", count);
    assert_true(count > 20);
}

static void each_allocation_fails(void **state)
{
    (void)state;
    for (long n = 1;; n++) {
        sp_error error = {0};
        set_up();
        faults->failing_allocation = faults->allocations + n;
        bool done = write_set("a new page", &error), failed = faults->allocations >= faults->failing_allocation;
        faults->failing_allocation = 0;
        if (!failed)
            break;
        assert_false(done);
        assert_int_equal(error.kind, SP_ERROR_MEMORY);
        assert_folder(before, true);
    }
}

static void each_write_of_a_new_folder_fails(void **state)
{
    (void)state;
    for (long n = 1;; n++) {
        sp_error error = {0};
        remove_folder(FOLDER);
        faults->changes = 0;
        faults->cause = ENOSPC;
        faults->lasting = true;
        faults->failing_change = n;
        bool done = write_set("a new page", &error), failed = faults->changes >= n;
        faults->failing_change = 0;
        if (!failed)
            break;
        if (!done)
            assert_int_not_equal(access(FOLDER, F_OK), 0);
    }
}

/* Ends at its n-th write; false where it came to its end. */
static bool kill_at(long n)
{
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        sp_error error = {0};
        faults->changes = 0;
        faults->cause = -SIGKILL;
        faults->failing_change = n;
        _exit(write_set("a new page", &error) ? 0 : 1);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status) ? WTERMSIG(status) == SIGKILL : WEXITSTATUS(status) == 0);
    return WIFSIGNALED(status);
}

/* All of the old or, after the next run, all of the new. */
static void each_write_is_the_last(void **state)
{
    (void)state;
    size_t old = 0, new = 0, between = 0;
    for (long n = 1;; n++) {
        set_up();
        bool killed = kill_at(n);
        bool begun = access(FOLDER "/.sprayplan-commit/lock", F_OK) == 0;
        char *seen = folder_text(FOLDER, false);
        between += begun && strcmp(seen, before) != 0 && strcmp(seen, after) != 0;
        if (!begun)
            assert_true(!strcmp(seen, before) || !strcmp(seen, after));
        old += !strcmp(seen, before) && !begun;
        sp_error error = {0};
        bool is_new = begun || !strcmp(seen, after);
        free(seen);
        assert_true(write_one("next.txt", &error));
        assert_int_equal(unlink(FOLDER "/next.txt"), 0);
        assert_folder(is_new ? after : before, true);
        new += is_new;
        if (!killed)
            break;
    }
    print_message("killed: %zu times all old, %zu all new after the next run, of these %zu half seen before it\n", old,
                  new, between);
    assert_true(old > 5 && new > 5 && between > 1);
}

/* What a killed run had begun to move does not go over a file that the next one has read. */
static void what_was_left_spares_inputs(void **state)
{
    (void)state;
    sp_error error = {0};
    set_up();
    long n = 1;
    while (kill_at(n) && access(FOLDER "/.sprayplan-commit", F_OK) != 0) {
        set_up();
        n++;
    }
    assert_int_equal(access(FOLDER "/.sprayplan-commit/new/report.html", F_OK), 0);
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_true(output && sp_output_protect(output, FOLDER "/report.html", &error));
    assert_true(sp_output_text(output, "next.txt", "next", &error) && sp_output_commit(output, &error));
    char *found = folder_text(FOLDER, true);
    assert_true(strstr(found, "an old page") && strstr(found, "simulate") && !strstr(found, ".sprayplan"));
    free(found);
}

/* Nor is it removed, though a run left it that is superseded. */
static void what_is_superseded_spares_inputs(void **state)
{
    (void)state;
    sp_error error = {0};
    set_up();
    put("deposits.exr", "an old measurement");
    put("wet.png", "an old picture");
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_true(output && sp_output_protect(output, FOLDER "/deposits.exr", &error));
    assert_true(sp_output_supersede(output, &error) && sp_output_text(output, "report.html", "a page", &error));
    assert_true(sp_output_commit(output, &error));
    assert_int_equal(access(FOLDER "/deposits.exr", F_OK), 0);
    assert_int_not_equal(access(FOLDER "/model-greedy.glb", F_OK), 0);
    assert_int_not_equal(access(FOLDER "/wet.png", F_OK), 0);
}

/* Without figures of ours nothing is known to be ours. */
static char *read_back(const char *name)
{
    char path[256];
    snprintf(path, sizeof path, FOLDER "/%s", name);
    FILE *file = fopen(path, "rb");
    char *text = calloc(1, 4096);
    assert_true(file && text);
    text[fread(text, 1, 4095, file)] = 0;
    fclose(file);
    return text;
}

static bool write_scene(const char *name, const char *text, bool force, sp_error *error)
{
    sp_output *output = sp_output_open(FOLDER, error);
    if (output && sp_output_scene(output, name, text, force, error))
        return sp_output_commit(output, error);
    sp_output_discard(output);
    return false;
}

static void edited_scenes_are_replaced_by_force_alone(void **state)
{
    (void)state;
    sp_error error = {0};
    set_up();
    assert_true(write_scene("layout.yaml", "one: 1\n", true, &error));
    assert_true(write_scene("layout.yaml", "two: 2\n", false, &error));
    char *whole = read_back("layout.yaml"), more[4200], other[4200];
    assert_non_null(strstr(whole, "\ntwo: 2\n"));
    snprintf(more, sizeof more, "%sthree: 3\n", whole);
    snprintf(other, sizeof other, "%s", whole);
    *strrchr(other, '2') = '3';
    const char *edits[] = {strstr(whole, "two"), "one: 1\n", "", more, other};
    for (size_t i = 0; i < sizeof edits / sizeof *edits; i++) {
        put("layout.yaml", edits[i]);
        error = (sp_error){0};
        assert_false(write_scene("layout.yaml", "one: 1\n", false, &error));
        assert_int_equal(error.kind, SP_ERROR_FILE);
        assert_string_equal(error.file, FOLDER "/layout.yaml");
        char *kept = read_back("layout.yaml");
        assert_string_equal(kept, edits[i]);
        free(kept);
        error = (sp_error){0};
        assert_true(write_scene("layout.yaml", "two: 2\n", true, &error));
        kept = read_back("layout.yaml");
        assert_string_equal(kept, whole);
        free(kept);
    }
    free(whole);
}

/* Figures of one run and scenes of another are not to lie in one folder, but what was edited is not lost. */
static void superseded_scenes_go_unless_edited(void **state)
{
    (void)state;
    sp_error error = {0};
    static const char *const names[] = {"layout.yaml", "layout-1.yaml", "layout-2.yaml", "layout-x.yaml"};
    set_up();
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        assert_true(write_scene(names[i], "one: 1\n", true, &error));
    put("layout-2.yaml", "edited");
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_true(output && sp_output_supersede(output, &error) &&
                sp_output_scene(output, "layout-1.yaml", "two: 2\n", false, &error) &&
                sp_output_commit(output, &error));
    assert_int_equal(access(FOLDER "/layout.yaml", F_OK), -1);
    assert_int_equal(access(FOLDER "/result.json", F_OK), -1);
    char *one = read_back("layout-1.yaml"), *two = read_back("layout-2.yaml"), *other = read_back("layout-x.yaml");
    assert_non_null(strstr(one, "two: 2"));
    assert_string_equal(two, "edited");
    assert_non_null(strstr(other, "one: 1"));
    free(one);
    free(two);
    free(other);
}

static void what_others_made_is_not_superseded(void **state)
{
    (void)state;
    sp_error error = {0};
    set_up();
    put("result.json", "{\"sprayplan\": 1}");
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_true(output && sp_output_supersede(output, &error));
    assert_true(sp_output_text(output, "report.html", "a page", &error) && sp_output_commit(output, &error));
    assert_int_equal(access(FOLDER "/model-greedy.glb", F_OK), 0);
}

enum { WRITERS = 3, SETS = 5, ROUNDS = 4 };
#define HELD 50000000 /* ns */

static void write_as(int writer)
{
    char page[32];
    sp_error error = {0};
    snprintf(page, sizeof page, "page %d", writer);
    sp_output *output = sp_output_open(FOLDER, &error);
    bool good = output && sp_output_supersede(output, &error) &&
                sp_output_text(output, "result.json", FIGURES("place"), &error) &&
                sp_output_text(output, "report.html", page, &error) &&
                (writer == 0 || sp_output_text(output, "model-greedy.glb", page, &error)) &&
                (writer < 2 || sp_output_text(output, "nozzles.csv", page, &error)) && sp_output_commit(output, &error);
    if (!good) {
        fprintf(stderr, "%s: %s\n", error.file, error.message);
        _exit(1);
    }
}

/* All files of one of them. */
static void assert_of_one_writer(void)
{
    char page[32];
    int found = -1;
    FILE *file = fopen(FOLDER "/report.html", "rb");
    assert_true(file && fscanf(file, "page %d", &found) == 1 && fclose(file) == 0);
    snprintf(page, sizeof page, "page %d", found);
    assert_int_equal(access(FOLDER "/model-greedy.glb", F_OK) == 0, found > 0);
    assert_int_equal(access(FOLDER "/nozzles.csv", F_OK) == 0, found > 1);
    char *text = folder_text(FOLDER, true);
    assert_null(strstr(text, ".sprayplan"));
    for (const char *at = text; (at = strstr(at, ": page ")); at++)
        assert_memory_equal(at + 2, page, strlen(page));
    free(text);
}

static void wait_for(pid_t writer)
{
    int status;
    assert_int_equal(waitpid(writer, &status, 0), writer);
    assert_int_equal(status, 0);
}

static void runs_do_not_mix(void **state)
{
    (void)state;
    for (int round = 0; round < (getenv("SPRAYPLAN_LONG") ? 100 : ROUNDS); round++) {
        pid_t writers[WRITERS];
        remove_folder(FOLDER);
        for (int i = 0; i < WRITERS; i++)
            if ((writers[i] = fork()) == 0) {
                for (int set = 0; set < SETS; set++)
                    write_as(i);
                _exit(0);
            }
        for (int i = 0; i < WRITERS; i++)
            wait_for(writers[i]);
        assert_of_one_writer();
    }
}

/* One of them is stopped before its n-th write, and goes on when the other had time to write all. */
static void nor_where_one_is_held_up(void **state)
{
    (void)state;
    for (long n = 1;; n++) {
        int status;
        remove_folder(FOLDER);
        pid_t held = fork(), other = -1;
        if (held == 0) {
            faults->changes = 0;
            faults->cause = -SIGSTOP;
            faults->lasting = false;
            faults->failing_change = n;
            write_as(2);
            _exit(0);
        }
        assert_int_equal(waitpid(held, &status, WUNTRACED), held);
        if (!WIFSTOPPED(status))
            break;
        if ((other = fork()) == 0) {
            write_as(0);
            _exit(0);
        }
        nanosleep(&(struct timespec){.tv_nsec = HELD}, NULL);
        assert_int_equal(kill(held, SIGCONT), 0);
        wait_for(held);
        wait_for(other);
        assert_of_one_writer();
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_write_fails),
        cmocka_unit_test(each_allocation_fails),
        cmocka_unit_test(each_write_of_a_new_folder_fails),
        cmocka_unit_test(each_write_is_the_last),
        cmocka_unit_test(what_was_left_spares_inputs),
        cmocka_unit_test(what_is_superseded_spares_inputs),
        cmocka_unit_test(what_others_made_is_not_superseded),
        cmocka_unit_test(edited_scenes_are_replaced_by_force_alone),
        cmocka_unit_test(superseded_scenes_go_unless_edited),
        cmocka_unit_test(runs_do_not_mix),
        cmocka_unit_test(nor_where_one_is_held_up),
    };
    return cmocka_run_group_tests(tests, open_texts, close_texts);
}
