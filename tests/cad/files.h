/* CAD files for tests, made by make-cad; where that was not built, for want of OpenCASCADE, tests skip. */
#ifndef TESTS_CAD_FILES_H
#define TESTS_CAD_FILES_H

#include <sprayplan/cad.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define MAKE_CAD BINARY_DIR "/tests/cad/occt/make-cad"

/* Skips the test where there are none. */
static inline void need_cad(void)
{
    if (access(MAKE_CAD, X_OK) != 0) {
        print_message("OpenCASCADE is not here: CAD files are neither made nor read\n");
        skip();
    }
}

/* `what` as make-cad knows it, `more` a unit or a count. */
static inline void make_cad(const char *what, const char *path, const char *more)
{
    char line[2048];
    snprintf(line, sizeof line, "'%s' %s '%s' %s >/dev/null", MAKE_CAD, what, path, more);
    assert_int_equal(system(line), 0);
}

/* The caller frees. */
static inline char *read_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    char *text = calloc(1, 1 << 20);
    assert_true(file && text && fread(text, 1, (1 << 20) - 1, file) > 0);
    assert_int_equal(fclose(file), 0);
    return text;
}

static inline sp_mesh *load_cad(const char *path, double unit, const sp_cad_options *options, sp_cad_account *account)
{
    sp_error error = {0};
    sp_mesh *mesh = sp_cad_load(path, unit, options, account, &error);
    if (!mesh)
        fail_msg("%s: %s", error.file, error.message);
    return mesh;
}

static inline double part_area(const sp_mesh *mesh, uint32_t part)
{
    double area = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        area += mesh->part[t] == part ? sp_triangle_area(mesh, t) : 0;
    return area;
}

#endif
