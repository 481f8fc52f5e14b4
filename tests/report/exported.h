/* A small tank with its manual design, for tests of files for other programs: names that such a file must stand. */
#ifndef TESTS_REPORT_EXPORTED_H
#define TESTS_REPORT_EXPORTED_H

#include "tank.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#define EXPORTED_NAME "dip <tube> & \"]]>\x01\xff\n"
#define EXPORTED_NAME_TOLD "dip <tube> & \"]]>\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"

typedef struct {
    sp_mesh *mesh;
    sp_evaluator *evaluator;
    sp_layout *layout;
    sp_coverage *coverage;
    sp_design design;
} exported;

/* With a part and a nozzle of a strange name, and a shell that faces outwards, so that its wet side is its back;
 * without a cavity both sides of all are one. The shell has so many corners `around`. */
static inline void export_set_up_around(exported *e, int around, bool cavity, sp_vec3 origin, sp_transform file)
{
    sp_error error = {0};
    *e = (exported){.mesh = tank_mesh(around, &error)};
    free(e->mesh->parts[1].name);
    e->mesh->parts[1].name = strdup(EXPORTED_NAME);
    for (uint32_t t = 0; t < e->mesh->triangle_count; t++)
        if (e->mesh->part[t] == 0) {
            uint32_t corner = e->mesh->triangles[t][1];
            e->mesh->triangles[t][1] = e->mesh->triangles[t][2];
            e->mesh->triangles[t][2] = corner;
        }
    sp_setup setup = tank_setup(e->mesh, 0.05);
    setup.cavity = cavity ? SP_CAVITY_POINT : SP_CAVITY_NONE;
    setup.origin = origin;
    setup.file = file;
    e->evaluator = sp_evaluator_create(&setup, &error);
    e->layout = sp_layout_create(tank_proposed, 4, &error);
    e->layout->nozzles[3].roll = 0.7;
    snprintf(e->layout->nozzles[2].name, SP_NAME, "%s", EXPORTED_NAME);
    e->coverage = sp_evaluate(e->evaluator, e->layout, &error);
    assert_non_null(e->coverage);
    e->design =
        (sp_design){.name = "proposed", .evaluator = e->evaluator, .layout = e->layout, .coverage = e->coverage};
}

static inline void export_set_up(exported *e, bool cavity, sp_vec3 origin, sp_transform file)
{
    export_set_up_around(e, 24, cavity, origin, file);
}

static void export_tear_down(exported *e)
{
    sp_coverage_destroy(e->coverage);
    sp_layout_destroy(e->layout);
    sp_evaluator_destroy(e->evaluator);
    sp_mesh_destroy(e->mesh);
}

typedef bool export_writer(const sp_design *design, const char *path, sp_error *error);

/* The file's bytes, malloc'd, with a zero behind them. Writing it again must give the same. */
static inline char *export_bytes(const exported *e, export_writer *write, const char *path, size_t *size)
{
    char *bytes[2];
    size_t sizes[2];
    for (int i = 0; i < 2; i++) {
        sp_error error = {0};
        if (!write(&e->design, path, &error))
            fail_msg("%s", error.message);
        FILE *file = fopen(path, "rb");
        assert_non_null(file);
        fseek(file, 0, SEEK_END);
        sizes[i] = (size_t)ftell(file);
        rewind(file);
        bytes[i] = malloc(sizes[i] + 1);
        assert_int_equal(fread(bytes[i], 1, sizes[i], file), sizes[i]);
        bytes[i][sizes[i]] = 0;
        fclose(file);
    }
    assert_int_equal(sizes[0], sizes[1]);
    assert_memory_equal(bytes[0], bytes[1], sizes[0]);
    free(bytes[1]);
    *size = sizes[0];
    return bytes[0];
}

static inline uint64_t export_number(const char *bytes, size_t width)
{
    uint64_t value = 0;
    for (size_t k = width; k-- > 0;)
        value = value << 8 | (unsigned char)bytes[k];
    return value;
}

#endif
