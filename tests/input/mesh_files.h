/* Mesh files written for a test and read back. */
#ifndef TESTS_MESH_FILES_H
#define TESTS_MESH_FILES_H

#include <sprayplan/mesh.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* Writes `bytes` to a file of its own with that extension, reads it as a mesh and removes it. */
static inline sp_mesh *read_bytes(const char *extension, const void *bytes, size_t size, sp_error *error)
{
    char path[128];
    snprintf(path, sizeof path, "mesh-test-%ld%s", (long)getpid(), extension);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    sp_mesh *mesh = sp_mesh_load(path, 1, error);
    assert_int_equal(remove(path), 0);
    return mesh;
}

static inline sp_mesh *read_text(const char *extension, const char *text, sp_error *error)
{
    return read_bytes(extension, text, strlen(text), error);
}

/* Reads what must be good. */
static inline sp_mesh *read_good(const char *extension, const char *text)
{
    sp_error error = {0};
    sp_mesh *mesh = read_text(extension, text, &error);
    if (!mesh)
        fail_msg("%d: %s\n%s", error.line, error.message, text);
    return mesh;
}

/* Reads what must be refused with that line (0 for none) and a message that holds `what`. */
static inline void read_bad(const char *extension, const char *text, int line, const char *what)
{
    sp_error error = {0};
    sp_mesh *mesh = read_text(extension, text, &error);
    if (mesh)
        fail_msg("accepted:\n%s", text);
    if (error.line != line || !strstr(error.message, what) || !error.file[0])
        fail_msg("%s:%d: %s\nexpected line %d and \"%s\" for:\n%s", error.file, error.line, error.message, line, what,
                 text);
}

#endif
