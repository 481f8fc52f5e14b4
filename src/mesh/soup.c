#include "mesh/soup.h"

#include "mesh/polygon.h"

#include <stdlib.h>
#include <string.h>

void sp_soup_clear(sp_soup *soup)
{
    for (size_t i = 0; i < soup->part_count; i++)
        free(soup->part_names[i]);
    free(soup->part_names);
    free(soup->part_table);
    free(soup->vertices);
    free(soup->welded.slots);
    free(soup->triangles);
    free(soup->part);
    free(soup->corners);
    *soup = (sp_soup){0};
}

static bool set_room(void **items, size_t *room, size_t more, size_t size, sp_error *error)
{
    void *larger = more <= SIZE_MAX / size ? realloc(*items, more * size) : NULL;
    if (!larger)
        return sp_fail_memory(error);
    *items = larger;
    *room = more;
    return true;
}

/* Makes room for one more item of `size` bytes; by half of what there was, so that adding n takes time in n. */
static bool grow(void **items, size_t *room, size_t count, size_t size, sp_error *error)
{
    return count < *room || set_room(items, room, *room ? *room + *room / 2 : 256, size, error);
}

bool sp_soup_reserve(sp_soup *soup, size_t vertices, size_t triangles, sp_error *error)
{
    void *points = soup->vertices, *corners = soup->triangles, *parts = soup->part;
    size_t room = soup->triangle_room;
    bool good =
        vertices <= soup->vertex_room || set_room(&points, &soup->vertex_room, vertices, sizeof *soup->vertices, error);
    soup->vertices = points;
    if (triangles <= room)
        return good;
    good = good && set_room(&corners, &room, triangles, sizeof *soup->triangles, error);
    soup->triangles = corners;
    good = good && set_room(&parts, &soup->triangle_room, triangles, sizeof *soup->part, error);
    soup->part = parts;
    return good;
}

bool sp_soup_add_vertex(sp_soup *soup, sp_vec3 vertex, sp_error *error)
{
    void *items = soup->vertices;
    bool grown = grow(&items, &soup->vertex_room, soup->vertex_count, sizeof *soup->vertices, error);
    soup->vertices = items;
    if (grown)
        soup->vertices[soup->vertex_count++] = vertex;
    return grown;
}

bool sp_soup_weld_vertex(sp_soup *soup, sp_vec3 vertex, uint32_t *number, sp_error *error)
{
    size_t room = soup->vertex_count < soup->vertex_room ? soup->vertex_room : soup->vertex_count + 1;
    if (!sp_weld_reserve(&soup->welded, room, soup->vertices, soup->vertex_count))
        return sp_fail_memory(error);
    sp_vec3 point = sp_weld_canonical(vertex);
    uint32_t *slot = sp_weld_slot(&soup->welded, soup->vertices, point);
    if (*slot == SP_NONE) {
        if (!sp_soup_add_vertex(soup, point, error))
            return false;
        *slot = (uint32_t)(soup->vertex_count - 1);
    }
    *number = *slot;
    return true;
}

bool sp_soup_add_triangle(sp_soup *soup, uint32_t a, uint32_t b, uint32_t c, uint32_t part, sp_error *error)
{
    void *triangles = soup->triangles, *parts = soup->part;
    size_t room = soup->triangle_room;
    bool grown = grow(&triangles, &room, soup->triangle_count, sizeof *soup->triangles, error);
    soup->triangles = triangles;
    grown = grown && grow(&parts, &soup->triangle_room, soup->triangle_count, sizeof *soup->part, error);
    soup->part = parts;
    if (!grown)
        return false;
    uint32_t *triangle = soup->triangles[soup->triangle_count];
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
    soup->part[soup->triangle_count++] = part;
    return true;
}

bool sp_soup_add_corner(sp_soup *soup, uint32_t vertex, sp_error *error)
{
    void *corners = soup->corners;
    bool grown = grow(&corners, &soup->corner_room, soup->corner_count, sizeof *soup->corners, error);
    soup->corners = corners;
    if (grown)
        soup->corners[soup->corner_count++] = vertex;
    return grown;
}

bool sp_soup_add_polygon(sp_soup *soup, uint32_t part, sp_error *error)
{
    sp_facets cut;
    const uint32_t *corners = soup->corners;
    bool good = sp_polygon_cut(soup->vertices, corners, soup->corner_count, &cut, error);
    for (size_t i = 0; good && i + 2 < soup->corner_count; i++) {
        uint32_t own[3];
        sp_facets_triangle(&cut, i, own);
        good = sp_soup_add_triangle(soup, corners[own[0]], corners[own[1]], corners[own[2]], part, error);
    }
    soup->tangled += cut.tangled;
    soup->corner_count = 0;
    sp_facets_free(&cut);
    return good;
}

/* Where the name is, or where it would go. */
static size_t find_slot(const sp_soup *soup, const char *name)
{
    size_t mask = soup->part_table_size - 1, slot = sp_siphash(soup->part_key, name, strlen(name)) & mask;
    while (soup->part_table[slot] != SP_NONE && strcmp(soup->part_names[soup->part_table[slot]], name) != 0)
        slot = (slot + 1) & mask;
    return slot;
}

static bool widen_table(sp_soup *soup, sp_error *error)
{
    if (2 * (soup->part_count + 1) <= soup->part_table_size)
        return true;
    size_t size = soup->part_table_size ? 2 * soup->part_table_size : 64;
    uint32_t *table = size <= SIZE_MAX / sizeof *table ? malloc(size * sizeof *table) : NULL;
    if (!table) {
        sp_fail_memory(error);
        return false;
    }
    memset(table, 0xFF, size * sizeof *table);
    if (!soup->part_table)
        soup->part_key = sp_hash_key_draw();
    free(soup->part_table);
    soup->part_table = table;
    soup->part_table_size = size;
    for (size_t i = 0; i < soup->part_count; i++)
        soup->part_table[find_slot(soup, soup->part_names[i])] = (uint32_t)i;
    return true;
}

uint32_t sp_soup_part(sp_soup *soup, const char *name, sp_error *error)
{
    if (!widen_table(soup, error))
        return SP_NONE;
    size_t slot = find_slot(soup, name);
    if (soup->part_table[slot] != SP_NONE)
        return soup->part_table[slot];
    void *items = soup->part_names;
    bool grown = grow(&items, &soup->part_room, soup->part_count, sizeof *soup->part_names, error);
    soup->part_names = items;
    size_t length = strlen(name);
    char *copy = grown ? malloc(length + 1) : NULL;
    if (!copy) {
        sp_fail_memory(error);
        return SP_NONE;
    }
    memcpy(copy, name, length + 1);
    soup->part_names[soup->part_count] = copy;
    soup->name_length += length;
    soup->part_table[slot] = (uint32_t)soup->part_count;
    return (uint32_t)soup->part_count++;
}

bool sp_soup_check_size(const sp_soup *soup, const char *path, size_t length, int line, sp_error *error)
{
    /* What each takes at its worst, when an array moves to a larger one: 5/2 of its items, and with a part its name's
     * block and its entry in the table and the old one. The mesh takes less. Of a corner that is no triangle's yet also
     * what cutting takes. */
    enum { VERTEX = 60, TRIANGLE = 40, CORNER = 100, PART = 80, FREE = 48 << 20 };
    uint64_t bytes = CORNER * (uint64_t)soup->corner_count + VERTEX * (uint64_t)soup->vertex_count +
                     TRIANGLE * (uint64_t)soup->triangle_count + PART * (uint64_t)soup->part_count + soup->name_length;
    return bytes <= 9 * (uint64_t)length + FREE ||
           sp_fail(error, SP_ERROR_INPUT, path, line, 0,
                   "found %zu triangles, %zu vertices and %zu parts within %zu bytes, expected a mesh of at most ten "
                   "times its file's size",
                   soup->triangle_count + (soup->corner_count > 2 ? soup->corner_count - 2 : 0), soup->vertex_count,
                   soup->part_count, length);
}
