/* Room for a mesh. */
#ifndef SPRAYPLAN_MESH_ALLOCATE_H
#define SPRAYPLAN_MESH_ALLOCATE_H

#include <sprayplan/mesh.h>

/* All zeros: room for that many vertices, triangles (as read and as kept) and parts. vertex_count and triangle_count
 * start at zero, to be raised as they fill; the other counts are set. NULL when memory runs out. */
sp_mesh *sp_mesh_allocate(size_t vertex_count, size_t triangle_count, size_t part_count, sp_error *error);

#endif
