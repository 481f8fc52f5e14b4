/* How far a point, or a way, is from a triangle. */
#ifndef MESH_DISTANCE_H
#define MESH_DISTANCE_H

#include <sprayplan/mesh.h>

#include <stdbool.h>

/* The triangle's point nearest to `point`. */
sp_vec3 sp_triangle_nearest(const sp_mesh *mesh, uint32_t triangle, sp_vec3 point);
/* Whether the triangle's box, and so perhaps the triangle, comes as near as a distance squared. */
bool sp_triangle_may_be_within(const sp_mesh *mesh, uint32_t triangle, sp_vec3 point, double distance2);
/* How near the way from `from` to `to` comes to the triangle, m². */
double sp_triangle_way2(const sp_mesh *mesh, uint32_t triangle, sp_vec3 from, sp_vec3 to);

#endif
