/* A mesh as OBJ text. */
#include <sprayplan/mesh.h>

#include "mesh/locales.h"
#include "mesh/obj_name.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void write_group(FILE *file, const char *name)
{
    fputs("g ", file);
    for (size_t at = 0; name[at]; at++)
        fputc(sp_obj_name_letter(name, at), file);
    fputc('\n', file);
}

static void write_vertices(FILE *file, const sp_mesh *mesh, uint32_t *number)
{
    uint32_t count = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            number[mesh->triangles[t][k]] = 1;
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        if (!number[v])
            continue;
        number[v] = ++count;
        fprintf(file, "v %.17g %.17g %.17g\n", mesh->vertices[v].x, mesh->vertices[v].y, mesh->vertices[v].z);
    }
}

static void write_triangles(FILE *file, const sp_mesh *mesh, const uint32_t *number)
{
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        const uint32_t *corners = mesh->triangles[t];
        if (t == 0 || mesh->part[t] != mesh->part[t - 1])
            write_group(file, mesh->parts[mesh->part[t]].name);
        fprintf(file, "f %lu %lu %lu\n", (unsigned long)number[corners[0]], (unsigned long)number[corners[1]],
                (unsigned long)number[corners[2]]);
    }
}

/* Numbers have a decimal point whatever the program has set; only this thread is touched. */
static bool write_in_c_locale(FILE *file, const sp_mesh *mesh, sp_error *error)
{
    uint32_t *number = calloc(mesh->vertex_count + 1, sizeof *number);
    locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    bool good = number && c != (locale_t)0;
    if (good) {
        locale_t before = uselocale(c);
        write_vertices(file, mesh, number);
        write_triangles(file, mesh, number);
        uselocale(before);
    }
    if (c != (locale_t)0)
        freelocale(c);
    free(number);
    return good || sp_fail_memory(error);
}

bool sp_mesh_write_obj(const sp_mesh *mesh, const char *path, sp_error *error)
{
    if (!mesh || !path)
        return false;
    FILE *file = fopen(path, "wb");
    if (!file)
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be written: %s", strerror(errno));
    bool good = write_in_c_locale(file, mesh, error);
    bool failed = ferror(file);
    failed |= fclose(file) != 0;
    if (good && failed)
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be written: %s", strerror(errno));
    return good;
}
