/* Which boxes overlap. */
#ifndef MESH_BOX_PAIRS_H
#define MESH_BOX_PAIRS_H

#include <sprayplan/mesh.h>

/* Upright, its rims included. */
typedef struct {
    double low[3], high[3]; /* m */
} sp_box;

/* The box of a triangle, wider by `margin` (m) on every side. */
sp_box sp_box_of(const sp_mesh *mesh, uint32_t triangle, double margin);
/* As far as `radius` (m) from a point along each axis. */
sp_box sp_box_around(sp_vec3 point, double radius);
bool sp_boxes_overlap(const sp_box *a, const sp_box *b);

/* Of two boxes that overlap, either the first. False to stop. */
typedef bool sp_box_visitor(void *user, uint32_t a, uint32_t b);
/* Visits all pairs among boxes[list[0 .. count]], each once, in an order that depends on the boxes alone. False where
 * it was stopped or, with the error set, memory ran out. */
bool sp_box_pairs(const sp_box *boxes, const uint32_t *list, size_t count, sp_box_visitor *visit, void *user,
                  sp_error *error);

#endif
