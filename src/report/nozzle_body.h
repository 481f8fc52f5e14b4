/* What stands for a nozzle in a model: a cylinder that ends in a cone. */
#ifndef REPORT_NOZZLE_BODY_H
#define REPORT_NOZZLE_BODY_H

#include <sprayplan/setup.h>

#define SP_BODY_SIDES 16
#define SP_BODY_VERTICES (2 * SP_BODY_SIDES + 2)
#define SP_BODY_TRIANGLES (4 * SP_BODY_SIDES)

/* Closed, in the nozzle's frame (see sp_nozzle_frame): the cone's tip, where the liquid leaves, is (0, 0, 0) and points
 * along z. Its length is 1/50 of the geometry's diagonal. */
typedef struct {
    sp_vec3 vertices[SP_BODY_VERTICES];     /* m */
    uint32_t corners[SP_BODY_TRIANGLES][3]; /* anticlockwise seen from outside */
} sp_nozzle_body;

sp_nozzle_body sp_nozzle_body_create(const sp_setup *setup);

#endif
