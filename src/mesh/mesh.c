/* Meshes: assembling, exact welding, sorting out degenerate triangles. */
#include "mesh/build.h"

#include <stdlib.h>
#include <string.h>

static bool grow(void *array, size_t *capacity, size_t count, size_t item, sp_error *error)
{
    void **items = array;
    if (count < *capacity)
        return true;
    size_t more = *capacity ? 2 * *capacity : 256;
    void *moved = more > SIZE_MAX / item ? NULL : realloc(*items, more * item);
    if (!moved)
        return sp_fail_memory(error);
    *items = moved;
    *capacity = more;
    return true;
}

bool mesh_build_point(mesh_build *build, sp_vec3 point, sp_error *error)
{
    if (build->point_count >= SP_NONE)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "found more than 4 billion vertices");
    if (!grow(&build->points, &build->point_capacity, build->point_count, sizeof *build->points, error))
        return false;
    build->points[build->point_count++] = point;
    return true;
}

bool mesh_build_triangle(mesh_build *build, uint32_t a, uint32_t b, uint32_t c, uint32_t part, sp_error *error)
{
    size_t capacity = build->triangle_capacity;
    if (build->triangle_count >= SP_NONE / 4)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "found more than a billion triangles");
    if (!grow(&build->triangles, &capacity, build->triangle_count, sizeof *build->triangles, error) ||
        !grow(&build->part, &build->triangle_capacity, build->triangle_count, sizeof *build->part, error))
        return false;
    uint32_t *corners = build->triangles[build->triangle_count];
    corners[0] = a;
    corners[1] = b;
    corners[2] = c;
    build->part[build->triangle_count++] = part;
    return true;
}

/* Names come from strangers and end up in JSON, HTML and on terminals. Returns the length of the UTF-8 sequence of a
 * printable character at `text`, 0 where there is none (RFC 3629). */
static size_t printable_length(const unsigned char *text, size_t left)
{
    if (text[0] < 0x80)
        return text[0] >= 0x20 && text[0] != 0x7f;
    size_t length = text[0] >= 0xf0 && text[0] <= 0xf4 ? 4 : text[0] >= 0xe0 ? 3 : text[0] >= 0xc2 ? 2 : 0;
    if (!length || text[0] > 0xf4 || length > left)
        return 0;
    for (size_t i = 1; i < length; i++)
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    bool overlong = (text[0] == 0xe0 && text[1] < 0xa0) || (text[0] == 0xf0 && text[1] < 0x90);
    bool beyond = (text[0] == 0xed && text[1] > 0x9f) || (text[0] == 0xf4 && text[1] > 0x8f);
    bool control = text[0] == 0xc2 && text[1] < 0xa0;
    return overlong || beyond || control ? 0 : length;
}

static char *printable_copy(const char *name, size_t length)
{
    char *copy = malloc(length + 1);
    for (size_t i = 0; copy && i < length;) {
        size_t step = printable_length((const unsigned char *)name + i, length - i);
        if (step)
            memcpy(copy + i, name + i, step);
        else
            copy[i] = '?';
        i += step ? step : 1;
    }
    if (copy)
        copy[length] = 0;
    return copy;
}

bool mesh_build_part(mesh_build *build, const char *name, size_t length, uint32_t *part, sp_error *error)
{
    char *copy = printable_copy(name, length);
    if (!copy)
        return sp_fail_memory(error);
    for (size_t i = 0; i < build->name_count; i++)
        if (!strcmp(build->names[i], copy)) {
            free(copy);
            *part = (uint32_t)i;
            return true;
        }
    if (build->name_count >= 65536) {
        free(copy);
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "found more than 65536 parts");
    }
    if (!grow(&build->names, &build->name_capacity, build->name_count, sizeof *build->names, error)) {
        free(copy);
        return false;
    }
    *part = (uint32_t)build->name_count;
    build->names[build->name_count++] = copy;
    return true;
}

void mesh_build_free(mesh_build *build)
{
    for (size_t i = 0; i < build->name_count; i++)
        free(build->names[i]);
    free(build->names);
    free(build->points);
    free(build->triangles);
    free(build->part);
    *build = (mesh_build){0};
}
