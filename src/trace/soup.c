#include "mesh/soup.h"

#include <stdlib.h>
#include <string.h>

void sp_soup_clear(sp_soup *soup)
{
    for (size_t i = 0; i < soup->part_count; i++)
        free(soup->part_names[i]);
    free(soup->part_names);
    free(soup->part_table);
    free(soup->vertices);
    free(soup->triangles);
    free(soup->part);
    *soup = (sp_soup){0};
}

/* Makes room for one more item of `size` bytes; twice as much as before, so that adding n takes time in n. */
static bool grow(void **items, size_t *room, size_t count, size_t size, sp_error *error)
{
    if (count < *room)
        return true;
    size_t more = *room ? 2 * *room : 256;
    void *larger = more <= SIZE_MAX / size ? realloc(*items, more * size) : NULL;
    if (!larger) {
        sp_fail_memory(error);
        return false;
    }
    *items = larger;
    *room = more;
    return true;
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

/* FNV-1a, http://www.isthe.com/chongo/tech/comp/fnv/ */
static uint64_t hash_name(const char *name)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (; *name; name++)
        hash = (hash ^ (unsigned char)*name) * 0x100000001b3u;
    return hash;
}

/* Where the name is, or where it would go. */
static size_t find_slot(const sp_soup *soup, const char *name)
{
    size_t mask = soup->part_table_size - 1, slot = hash_name(name) & mask;
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
    char *copy = grown ? strdup(name) : NULL;
    if (!copy) {
        sp_fail_memory(error);
        return SP_NONE;
    }
    soup->part_names[soup->part_count] = copy;
    soup->part_table[slot] = (uint32_t)soup->part_count;
    return (uint32_t)soup->part_count++;
}
