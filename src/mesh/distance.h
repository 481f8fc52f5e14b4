/* How far a point is from surfaces. */
#ifndef MESH_DISTANCE_H
#define MESH_DISTANCE_H

#include <sprayplan/mesh.h>

#include <stdbool.h>

/* The triangle's point nearest to `point`. */
sp_vec3 sp_triangle_nearest(const sp_mesh *mesh, uint32_t triangle, sp_vec3 point);
/* The triangle nearest to `point` (of equal distance the first), among those of `part` or, with SP_NONE, all; SP_NONE
 * where there is none. */
uint32_t sp_nearest_triangle(const sp_mesh *mesh, uint32_t part, sp_vec3 point);
/* True where no triangle but those of part `own` (SP_NONE: no exception) is nearer than `clearance` (m). */
bool sp_is_clear(const sp_mesh *mesh, sp_vec3 point, double clearance, uint32_t own);
/* The same of a way from `from` to `to`: true where no triangle comes nearer to any point of it. */
bool sp_way_is_clear(const sp_mesh *mesh, sp_vec3 from, sp_vec3 to, double clearance);

#endif
