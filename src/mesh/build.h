/* Assembling a mesh: what the readers hand over. */
#ifndef MESH_BUILD_H
#define MESH_BUILD_H

#include <sprayplan/mesh.h>

/* A growing list of points, triangles and parts. Starts as {0}. */
typedef struct {
    sp_vec3 *points;
    size_t point_count, point_capacity;
    uint32_t (*triangles)[3];
    uint32_t *part; /* of each triangle; shares its count and capacity */
    size_t triangle_count, triangle_capacity;
    char **names; /* of the parts */
    size_t name_count, name_capacity;
} mesh_build;

bool mesh_build_point(mesh_build *build, sp_vec3 point, sp_error *error);
bool mesh_build_triangle(mesh_build *build, uint32_t a, uint32_t b, uint32_t c, uint32_t part, sp_error *error);
/* The index of the part called `name` (of `length` bytes), a new one where there is none yet. Bytes that are not
 * printable UTF-8 become '?'. */
bool mesh_build_part(mesh_build *build, const char *name, size_t length, uint32_t *part, sp_error *error);
void mesh_build_free(mesh_build *build);

/* Readers: obj.c, stl.c. */
bool mesh_read_obj(char *text, size_t size, double unit, mesh_build *build, sp_error *error);
bool mesh_read_stl(const char *bytes, size_t size, double unit, mesh_build *build, sp_error *error);

#endif
