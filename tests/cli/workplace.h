/* A folder for one test program, with a small scene in it, and the program run there as a user would. */
#ifndef CLI_WORKPLACE_H
#define CLI_WORKPLACE_H

#include "explained.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef SPRAYPLAN_SANITIZE
#define ROOM_TEXEL "100 mm"
#else
#define ROOM_TEXEL "40 mm"
#endif

/* That any number of threads gives the same bytes is seen without sanitizers, for which nothing new runs. */
#ifdef SPRAYPLAN_SANITIZE
#define COMPARES_THREADS false
#else
#define COMPARES_THREADS true
#endif

/* A closed room of 1 m × 1 m × 1 m, faces as quads in three groups. */
static const char room_obj[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                               "g floor\nf 1 2 3 4\n"
                               "g ceiling\nf 5 8 7 6\n"
                               "g walls\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

static const char catalogue_yaml[] =
    "nozzles:\n"
    "  - {name: cone, pattern: full_cone, angle: 120 deg, flow: 12 L/min, at: 2 bar, exponent: 0.46}\n"
    "  - {name: ball, pattern: full_cone, angle: 360 deg, flow: 20 L/min, at: 2 bar}\n";

static const char room_yaml[] =
    "geometry:\n"
    "  - file: room.obj\n"
    "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
    "criterion: {flux: 1 L/min/m2}\n"
    "catalogue: catalogue.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: cone, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 0, -1], pressure: 2 bar}\n"
    "simulate: {texel: " ROOM_TEXEL "}\n"
    "place:\n"
    "  coverage: 90 %\n"
    "  max_nozzles: 4\n"
    "  pressure: 2 bar\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [0.3 m, 0.3 m, 1 m], axis: [0, 0, -1], tilt: 20 deg, depth: {from: 100 mm, to: "
    "500 mm, spacing: 200 mm}}\n"
    "    - port: {name: P2, position: [0.7 m, 0.7 m, 1 m], axis: [0, 0, -1], tilt: 20 deg, depth: {from: 100 mm, to: "
    "500 mm, spacing: 200 mm}}\n";

static char workplace[512];

static void write_file(const char *name, const char *text)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", workplace, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

/* The file's bytes with a zero behind them, malloc'd; NULL where there is no such file. `size` may be NULL. */
static char *read_file(const char *name, size_t *size)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", workplace, name);
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    long length = ftell(file);
    assert_true(length >= 0);
    rewind(file);
    char *bytes = malloc((size_t)length + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, (size_t)length, file), (size_t)length);
    bytes[length] = 0;
    fclose(file);
    if (size)
        *size = (size_t)length;
    return bytes;
}

typedef struct {
    int status;
    char *out, *err; /* owned */
} outcome;

/* Runs `sprayplan <arguments>` in the workplace, through the shell. */
static outcome run_program(const char *arguments)
{
    char line[4096];
    snprintf(line, sizeof line, "cd '%s' && exec '%s/sprayplan' %s >.out 2>.err </dev/null", workplace, BINARY_DIR,
             arguments);
    int status = system(line);
    assert_true(WIFEXITED(status));
    return (outcome){WEXITSTATUS(status), read_file(".out", NULL), read_file(".err", NULL)};
}

static void forget(outcome *result)
{
    free(result->out);
    free(result->err);
}

/* Runs and compares all of status, standard output and standard error. */
static inline void expect(const char *arguments, int status, const char *out, const char *err)
{
    outcome result = run_program(arguments);
    assert_string_equal(result.err, err);
    assert_string_equal(result.out, out);
    assert_int_equal(result.status, status);
    forget(&result);
}

/* Runs, expecting this status, and reads standard output as one JSON object, which the caller owns. */
static inline json_t *expect_json(const char *arguments, int status)
{
    outcome result = run_program(arguments);
    if (result.status != status)
        print_error("%s: %s", arguments, result.err);
    assert_int_equal(result.status, status);
    json_error_t error;
    json_t *object = json_loads(result.out, JSON_REJECT_DUPLICATES, &error);
    if (!object)
        print_error("line %d: %s\n", error.line, error.text);
    assert_true(json_is_object(object));
    require_output_explained(object);
    forget(&result);
    return object;
}

/* The same program with other threads, or what it gave before where that is not compared. */
static inline json_t *expect_again(const json_t *before, const char *arguments, int status)
{
    return COMPARES_THREADS ? expect_json(arguments, status) : json_incref((json_t *)before);
}

/* The names in the workplace's folder, sorted, one a line; what this header leaves there aside. */
static inline char *list_folder(const char *folder)
{
    char line[2048];
    snprintf(line, sizeof line, "cd '%s/%s' && LC_ALL=C ls -A | grep -v -x -e .out -e .err -e .list >'%s/.list'",
             workplace, folder, workplace);
    assert_true(WIFEXITED(system(line)));
    return read_file(".list", NULL);
}

static int open_workplace(void **state)
{
    (void)state;
    snprintf(workplace, sizeof workplace, "%s/tests/cli-XXXXXX", BINARY_DIR);
    if (!mkdtemp(workplace))
        return -1;
    write_file("room.obj", room_obj);
    write_file("catalogue.yaml", catalogue_yaml);
    write_file("room.yaml", room_yaml);
    return 0;
}

static int close_workplace(void **state)
{
    (void)state;
    char line[1024];
    snprintf(line, sizeof line, "rm -rf '%s'", workplace);
    return system(line);
}

#endif
