/* No scene makes its reader hold more than ten times its size and 64 MiB, what libraries hold for it included. */
#include "../fuzz/meter.h"

#include <sprayplan/scene.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Of most files: a larger share of the limit than the 64 MiB; and where sanitizers have malloc for themselves and
 * nothing is measured, as little as is too much. */
#ifdef SPRAYPLAN_SANITIZE
enum { SIZE = 2 << 20 };
#else
enum { SIZE = 12 << 20 };
#endif

/* Writes `head`, then `piece` up to `size` bytes in all; it is refused within the limit. */
static void read_within(const char *head, const char *piece, size_t size, const char *what)
{
    char path[64];
    snprintf(path, sizeof path, "scene_memory-%ld.yaml", (long)getpid());
    FILE *file = fopen(path, "wb");
    assert_true(file && fputs(head, file) >= 0);
    for (size_t at = strlen(head); at < size; at += strlen(piece))
        assert_true(fputs(piece, file) >= 0);
    assert_int_equal(fclose(file), 0);
    sp_error error = {0};
    meter_start();
    sp_scene *scene = sp_scene_load(path, &error);
    if (meter_peak() > 10 * size + (64 << 20))
        fail_msg("%zu bytes for %zu of \"%s\" and \"%s\"", meter_peak(), size, head, piece);
    assert_null(scene);
    if (error.kind != SP_ERROR_INPUT || !strstr(error.message, what))
        fail_msg("%d: %s\nexpected \"%s\"", error.line, error.message, what);
    assert_int_equal(remove(path), 0);
}

/* Until a list that begins a file ends, libfyaml holds all of it. */
static void lists_without_end(void **state)
{
    (void)state;
    const char too_many[] = "100,000 brackets, commas and colons";
    read_within("", "[", 1 << 20, too_many);
    read_within("", "{", SIZE, too_many);
    read_within("x: ", "[", 1 << 20, "");
    read_within("", "[{", SIZE, too_many);
    read_within("[", "a,", SIZE, too_many);
    read_within("{", "a: b,", SIZE, too_many);
    read_within("[", "a:b :c ,", SIZE, too_many);
    read_within("- [", "a,", SIZE, "");
    read_within("? [", "a,", SIZE, "");
}

static void values_of_few_bytes(void **state)
{
    (void)state;
    const char too_many[] = "400,000 values";
    read_within("x: [", "a,", SIZE, too_many);
    read_within("x: [", "a,", 1 << 20, too_many);
    read_within("x: [", "{a},", SIZE, too_many);
    read_within("x: [", "[],", SIZE, too_many);
    read_within("x: [", "'',", SIZE, too_many);
    read_within("x:\n", "- - -\n", SIZE, too_many);
    read_within("x:\n", "- a\n", SIZE, too_many);
    read_within("x:\n", "  ?\n", SIZE, too_many);
    read_within("x:\n", "  a:\n", SIZE, too_many);
}

static void few_values_of_many_bytes(void **state)
{
    (void)state;
    read_within("", "# [a, b]: {c: d}\n", SIZE, "");
    read_within("x: |\n", "  [a, b]: {c: d}\n", SIZE, "");
    read_within("x: '", "[a, b]: {c: d}\n", SIZE, "");
    read_within("x: ", "a b", SIZE, "");
    read_within("", "\n", SIZE, "");
    read_within("", " ", SIZE, "");
    read_within("", "%TAG ! tag:a,2000:b\n", SIZE, "");
    read_within("", "--- a\n", SIZE, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_without_end),
        cmocka_unit_test(values_of_few_bytes),
        cmocka_unit_test(few_values_of_many_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
