/* Corners that round-off keeps apart. */
#ifndef SPRAY_SAME_CORNERS_H
#define SPRAY_SAME_CORNERS_H

#include <sprayplan/mesh.h>

/* The mesh's triangles with one number for all corners nearer to each other than `same` (m), but for triangles of which
 * that would leave less than three corners. [triangle_count], malloc'd; NULL with an error. */
uint32_t (*sp_same_corners(const sp_mesh *mesh, double same, sp_error *error))[3];

#endif
