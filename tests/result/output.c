#include <sprayplan/result.h>

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#define FOLDER BINARY_DIR "/output-test"

static int entries(const char *path)
{
    DIR *directory = opendir(path);
    if (!directory)
        return -1;
    int count = 0;
    for (struct dirent *entry; (entry = readdir(directory));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(directory);
    return count;
}

static void assert_content(const char *path, const char *expected)
{
    char text[100] = "";
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    assert_string_equal(text, expected);
}

static void put(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static int clean(void **state)
{
    (void)state;
    rmdir(FOLDER "/b.txt");
    unlink(FOLDER "/one/two/a.txt");
    rmdir(FOLDER "/one/two");
    rmdir(FOLDER "/one");
    unlink(FOLDER "/a.txt");
    unlink(FOLDER "/b.txt");
    unlink(FOLDER "/in.txt");
    unlink(FOLDER "/link.txt");
    rmdir(FOLDER);
    return access(FOLDER, F_OK) == 0;
}

static void commit_shows_all(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_non_null(output);
    assert_true(sp_output_text(output, "a.txt", "one", &error));
    const char *path = sp_output_path(output, "b.txt", &error);
    put(path, "two");
    assert_ptr_equal(path, sp_output_path(output, "b.txt", &error));
    assert_int_equal(access(FOLDER "/a.txt", F_OK), -1);
    assert_int_equal(access(FOLDER "/b.txt", F_OK), -1);
    assert_true(sp_output_commit(output, &error));
    assert_content(FOLDER "/a.txt", "one");
    assert_content(FOLDER "/b.txt", "two");
    assert_int_equal(entries(FOLDER), 2);
}

static void discard_leaves_nothing(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_true(sp_output_text(output, "a.txt", "one", &error));
    sp_output_discard(output);
    assert_int_equal(entries(FOLDER), -1);
    sp_output_discard(NULL);
    assert_false(sp_output_commit(NULL, &error));
}

static void discard_keeps_what_was_there(void **state)
{
    (void)state;
    sp_error error = {0};
    mkdir(FOLDER, 0777);
    put(FOLDER "/a.txt", "old");
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_true(sp_output_text(output, "a.txt", "new", &error));
    sp_output_discard(output);
    assert_content(FOLDER "/a.txt", "old");
    assert_int_equal(entries(FOLDER), 1);
}

static void failed_commit_puts_back(void **state)
{
    (void)state;
    sp_error error = {0};
    mkdir(FOLDER, 0777);
    put(FOLDER "/a.txt", "old");
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_true(sp_output_text(output, "a.txt", "new", &error));
    assert_true(sp_output_text(output, "b.txt", "new", &error));
    mkdir(FOLDER "/b.txt", 0777); /* appears meanwhile, and a file cannot replace it */
    assert_false(sp_output_commit(output, &error));
    assert_int_equal(error.kind, SP_ERROR_FILE);
    assert_content(FOLDER "/a.txt", "old");
    assert_int_equal(entries(FOLDER), 2);
}

static void failed_commit_takes_back_new_files(void **state)
{
    (void)state;
    sp_error error = {0};
    mkdir(FOLDER, 0777);
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_true(sp_output_text(output, "a.txt", "new", &error));
    unlink(sp_output_path(output, "b.txt", &error));
    assert_false(sp_output_commit(output, &error));
    assert_int_equal(entries(FOLDER), 0);
}

static void commit_replaces(void **state)
{
    (void)state;
    sp_error error = {0};
    mkdir(FOLDER, 0777);
    put(FOLDER "/a.txt", "old");
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_true(sp_output_text(output, "a.txt", "new", &error));
    assert_true(sp_output_commit(output, &error));
    assert_content(FOLDER "/a.txt", "new");
    assert_int_equal(entries(FOLDER), 1);
}

static void inputs_are_protected(void **state)
{
    (void)state;
    sp_error error = {0};
    mkdir(FOLDER, 0777);
    put(FOLDER "/in.txt", "input");
    assert_int_equal(symlink("in.txt", FOLDER "/link.txt"), 0);
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_true(sp_output_protect(output, FOLDER "/../output-test/in.txt", &error));
    assert_true(sp_output_protect(output, FOLDER "/none.txt", &error));
    assert_false(sp_output_text(output, "in.txt", "new", &error));
    assert_int_equal(error.kind, SP_ERROR_FILE);
    error = (sp_error){0};
    assert_false(sp_output_text(output, "link.txt", "new", &error));
    sp_output_discard(output);
    assert_content(FOLDER "/in.txt", "input");
}

static void bad_places(void **state)
{
    (void)state;
    sp_error error = {0};
    mkdir(FOLDER, 0777);
    put(FOLDER "/a.txt", "file");
    assert_null(sp_output_open(FOLDER "/a.txt/folder", &error));
    assert_int_equal(error.kind, SP_ERROR_FILE);
    error = (sp_error){0};
    assert_null(sp_output_open(FOLDER "/a.txt", &error));
    assert_int_equal(error.kind, SP_ERROR_FILE);
    error = (sp_error){0};
    sp_output *output = sp_output_open(FOLDER, &error);
    assert_null(sp_output_path(output, "../a.txt", &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    sp_output_discard(output);
}

static void missing_parents_are_made(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_output *output = sp_output_open(FOLDER "/one/two", &error);
    assert_non_null(output);
    assert_true(sp_output_text(output, "a.txt", "deep", &error));
    assert_true(sp_output_commit(output, &error));
    assert_content(FOLDER "/one/two/a.txt", "deep");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(commit_shows_all, clean, clean),
        cmocka_unit_test_setup_teardown(missing_parents_are_made, clean, clean),
        cmocka_unit_test_setup_teardown(discard_leaves_nothing, clean, clean),
        cmocka_unit_test_setup_teardown(discard_keeps_what_was_there, clean, clean),
        cmocka_unit_test_setup_teardown(failed_commit_puts_back, clean, clean),
        cmocka_unit_test_setup_teardown(failed_commit_takes_back_new_files, clean, clean),
        cmocka_unit_test_setup_teardown(commit_replaces, clean, clean),
        cmocka_unit_test_setup_teardown(inputs_are_protected, clean, clean),
        cmocka_unit_test_setup_teardown(bad_places, clean, clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
