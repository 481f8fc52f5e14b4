/* Outlines in the plane, cut into triangles. */
#ifndef MESH_EARS_H
#define MESH_EARS_H

#include <sprayplan/error.h>

#include <stddef.h>
#include <stdint.h>

/* Cuts an anticlockwise outline of `count` >= 3 corners into count - 2 triangles of these, anticlockwise or without
 * area. *done is false where it could not: where the outline crosses itself, or is so intricate that it would take more
 * than a certain time for every corner; then what the triangles hold is no matter. False only when memory runs out. */
bool sp_clip_ears(const double (*points)[2], uint32_t count, uint32_t (*triangles)[3], bool *done, sp_error *error);

#endif
