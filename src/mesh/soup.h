/* What a reader collects before the mesh is welded. */
#ifndef SPRAYPLAN_MESH_SOUP_H
#define SPRAYPLAN_MESH_SOUP_H

#include "mesh/weld.h"

typedef struct {
    size_t vertex_count, vertex_room;
    sp_vec3 *vertices;
    sp_weld_table welded; /* of the vertices, where all were added by sp_soup_weld_vertex */
    size_t triangle_count, triangle_room;
    uint32_t (*triangles)[3];
    uint32_t *part;
    size_t corner_count, corner_room;
    uint32_t *corners; /* of the polygon that is being read */
    size_t tangled;    /* polygons, as sp_facets has it */
    size_t part_count, part_room;
    char **part_names;
    size_t name_length;   /* of all names together */
    uint32_t *part_table; /* [part_table_size] of part numbers by hash of their names, SP_NONE where free */
    size_t part_table_size;
    sp_hash_key part_key; /* of the hashes */
} sp_soup;

/* Starts as {0}. */
void sp_soup_clear(sp_soup *soup);
/* Room for so many vertices and triangles altogether: for counts that are certain. */
bool sp_soup_reserve(sp_soup *soup, size_t vertices, size_t triangles, sp_error *error);
bool sp_soup_add_vertex(sp_soup *soup, sp_vec3 vertex, sp_error *error);
/* Adds a vertex unless there is an equal one; its number. A soup's vertices are added either all so or all as above. */
bool sp_soup_weld_vertex(sp_soup *soup, sp_vec3 vertex, uint32_t *number, sp_error *error);
bool sp_soup_add_triangle(sp_soup *soup, uint32_t a, uint32_t b, uint32_t c, uint32_t part, sp_error *error);
/* One more corner of a polygon: a vertex of the soup; then the whole of three or more, as triangles. */
bool sp_soup_add_corner(sp_soup *soup, uint32_t vertex, sp_error *error);
bool sp_soup_add_polygon(sp_soup *soup, uint32_t part, sp_error *error);
/* The number of the part of that name, made where there is none yet; SP_NONE on error. */
uint32_t sp_soup_part(sp_soup *soup, const char *name, sp_error *error);
/* Whether all of this, found in the first `length` bytes of a file, leads to a mesh at no time larger than nine times
 * that and 48 MiB: few bytes can name very many triangles, though never those of a surface that is there. Fails at
 * `line` (0: none). */
bool sp_soup_check_size(const sp_soup *soup, const char *path, size_t length, int line, sp_error *error);
/* The welded mesh of at least one triangle; the soup's memory goes into it, and the soup is empty unless memory ran
 * out or its counts or coordinates are beyond a mesh's. NULL on error. */
sp_mesh *sp_soup_mesh(sp_soup *soup, sp_error *error);

/* The readers. Coordinates are multiplied by `unit`. */
bool sp_obj_read(const char *path, const char *text, size_t size, double unit, sp_soup *soup, sp_error *error);
bool sp_stl_read(const char *path, const char *text, size_t size, double unit, sp_soup *soup, sp_error *error);
bool sp_stl_is(const char *text, size_t size); /* by how it begins, or by its size */
bool sp_ply_read(const char *path, const char *text, size_t size, double unit, sp_soup *soup, sp_error *error);

/* The largest magnitude of a coordinate, m: cubes of it stay far from overflow. */
#define SP_COORDINATE_LIMIT 1e30
static inline bool sp_coordinates_allowed(sp_vec3 p)
{
    return fabs(p.x) <= SP_COORDINATE_LIMIT && fabs(p.y) <= SP_COORDINATE_LIMIT && fabs(p.z) <= SP_COORDINATE_LIMIT;
}

#endif
