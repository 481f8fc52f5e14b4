/* What a reader collects before the mesh is welded. */
#ifndef SPRAYPLAN_MESH_SOUP_H
#define SPRAYPLAN_MESH_SOUP_H

#include <sprayplan/mesh.h>

typedef struct {
    size_t vertex_count, vertex_room;
    sp_vec3 *vertices;
    size_t triangle_count, triangle_room;
    uint32_t (*triangles)[3];
    uint32_t *part;
    size_t part_count, part_room;
    char **part_names;
    uint32_t *part_table; /* [part_table_size] of part numbers by hash of their names, SP_NONE where free */
    size_t part_table_size;
} sp_soup;

/* Starts as {0}. */
void sp_soup_clear(sp_soup *soup);
bool sp_soup_add_vertex(sp_soup *soup, sp_vec3 vertex, sp_error *error);
bool sp_soup_add_triangle(sp_soup *soup, uint32_t a, uint32_t b, uint32_t c, uint32_t part, sp_error *error);
/* The number of the part of that name, made where there is none yet; SP_NONE on error. */
uint32_t sp_soup_part(sp_soup *soup, const char *name, sp_error *error);

/* The readers. Coordinates are multiplied by `unit`. */
bool sp_obj_read(const char *path, const char *text, size_t size, double unit, sp_soup *soup, sp_error *error);
bool sp_stl_read(const char *path, const char *text, size_t size, double unit, sp_soup *soup, sp_error *error);
bool sp_ply_read(const char *path, const char *text, size_t size, double unit, sp_soup *soup, sp_error *error);

/* The largest magnitude of a coordinate, m: cubes of it stay far from overflow. */
#define SP_COORDINATE_LIMIT 1e30
static inline bool sp_coordinates_allowed(sp_vec3 p)
{
    return fabs(p.x) <= SP_COORDINATE_LIMIT && fabs(p.y) <= SP_COORDINATE_LIMIT && fabs(p.z) <= SP_COORDINATE_LIMIT;
}

#endif
