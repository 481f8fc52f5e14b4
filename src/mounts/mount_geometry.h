/* Which mount holds a nozzle, and whether it takes it. */
#ifndef MOUNTS_MOUNT_GEOMETRY_H
#define MOUNTS_MOUNT_GEOMETRY_H

#include <sprayplan/place.h>

/* m, by which a nozzle may lie off a mount that it is taken to sit on. */
double sp_mount_tolerance(const sp_setup *setup);
/* A port's lance reaches the point, or all but the tolerance. */
bool sp_port_holds(const sp_mount *mount, sp_vec3 point, double tolerance);

/* How many points lie from one end of a length (m) to the other, both included, no further apart than the spacing (m):
 * 1 of no length; infinite where there is a length and no spacing. */
double sp_mount_points_along(double length, double spacing);

/* A surface mount's: whether a triangle belongs to it, how far nozzles stand off (m), and the triangle that a nozzle of
 * the mount is welded to: the one that it stands off as the mount asks for, with its axis within the mount's tilt, or
 * else the nearest. SP_NONE where the mount has none. */
bool sp_mount_has(const sp_mesh *mesh, const sp_mount *mount, uint32_t triangle);
double sp_mount_standoff(const sp_mount *mount);
uint32_t sp_mount_weld(const sp_setup *setup, const sp_mount *mount, const sp_nozzle *nozzle);

#endif
