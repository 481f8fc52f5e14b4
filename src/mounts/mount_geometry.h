/* Which mount holds a nozzle, and whether it takes it. */
#ifndef MOUNTS_MOUNT_GEOMETRY_H
#define MOUNTS_MOUNT_GEOMETRY_H

#include <sprayplan/place.h>

/* m, by which a nozzle may lie off a mount that it is taken to sit on. */
double sp_mount_tolerance(const sp_setup *setup);
/* A port's lance reaches the point, or all but the tolerance. */
bool sp_port_holds(const sp_mount *mount, sp_vec3 point, double tolerance);

/* A surface mount's: whether a triangle belongs to it, how far nozzles stand off (m), and of its triangles the one
 * nearest to a point, SP_NONE where there is none. */
bool sp_mount_has(const sp_mesh *mesh, const sp_mount *mount, uint32_t triangle);
double sp_mount_standoff(const sp_mount *mount);
uint32_t sp_mount_triangle(const sp_mesh *mesh, const sp_mount *mount, sp_vec3 point);

#endif
