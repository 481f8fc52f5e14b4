/* Mesh files: which reader, and the bytes for it. */
#include "mesh/weld.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The whole file, a zero byte behind it. */
static char *read_file(const char *path, size_t *size, sp_error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "cannot be opened: %s", strerror(errno));
        return NULL;
    }
    long end = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    char *bytes = end >= 0 && end < INT64_MAX / 2 ? malloc((size_t)end + 1) : NULL;
    bool good = false;
    if (end < 0)
        sp_fail(error, SP_ERROR_FILE, path, 0, 0, "is not a file that can be read");
    else if (!bytes)
        sp_fail_memory(error);
    else if (fseek(file, 0, SEEK_SET) != 0 || fread(bytes, 1, (size_t)end, file) != (size_t)end)
        sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be read");
    else
        good = true;
    fclose(file);
    if (!good) {
        free(bytes);
        return NULL;
    }
    bytes[end] = 0;
    *size = (size_t)end;
    return bytes;
}

static bool read_mesh(const char *path, char *bytes, size_t size, double unit, mesh_build *build, sp_error *error)
{
    const char *dot = strrchr(path, '.');
    if (dot && !strcasecmp(dot, ".obj"))
        return mesh_read_obj(bytes, size, unit, build, error);
    if (dot && !strcasecmp(dot, ".stl"))
        return mesh_read_stl(bytes, size, unit, build, error);
    return sp_fail(error, SP_ERROR_UNSUPPORTED, path, 0, 0, "found a file name ending in \"%s\", expected .obj or .stl",
                   dot ? dot : "");
}

sp_mesh *sp_mesh_load(const char *path, double unit, sp_error *error)
{
    size_t size;
    mesh_build build = {0};
    sp_mesh *mesh = NULL;
    if (!(isfinite(unit) && unit > 0)) {
        sp_fail(error, SP_ERROR_ARGUMENT, path, 0, 0, "unit: found %g, expected a length above 0", unit);
        return NULL;
    }
    char *bytes = read_file(path, &size, error);
    sp_error inner = {0};
    if (bytes && read_mesh(path, bytes, size, unit, &build, &inner))
        mesh = mesh_weld(&build, &inner);
    if (inner.kind != SP_OK)
        sp_fail(error, inner.kind, path, inner.line, inner.column, "%s", inner.message);
    mesh_build_free(&build);
    free(bytes);
    return mesh;
}
