/* Wet sides: which parts of the triangles' sides face the liquid. */
#ifndef SPRAY_WET_H
#define SPRAY_WET_H

#include "spray/wet/flood_fill.h"

typedef struct sp_wet {
    sp_shells shells;
    sp_winding *solids; /* NULL where no shell is closed */
    int base;           /* added to their winding numbers: how many rooms are around the cavity's point */
    sp_cuts cuts;
    sp_faces faces;
    sp_flooded flooded;
    uint8_t *sides; /* [triangle_count], bit 0 front, bit 1 back: some of it is wet */
    uint8_t *whole; /* [triangle_count], likewise: all of it is */
} sp_wet;

/* All triangles on both sides where no cavity is named. Fails with SP_ERROR_INPUT for a cavity's point in material, on
 * a surface, or from which nothing is seen. The setup's mesh and the tracer are borrowed. */
sp_wet *sp_wet_create(const sp_setup *setup, const sp_tracer *tracer, sp_error *error);
/* Accepts NULL. */
void sp_wet_destroy(sp_wet *wet);

/* Bit 0: the point (1-u-v, u, v) of a triangle is wet on the front, bit 1: on the back. */
unsigned sp_wet_at(const sp_wet *wet, uint32_t triangle, double u, double v);
/* Whether a point lies in a solid. */
bool sp_wet_is_material(const sp_wet *wet, sp_vec3 point);
/* The part of the innermost body that has a point within its surface, in material or in a hollow; SP_NONE: none, as in
 * a room of one shell. */
uint32_t sp_wet_part_around(const sp_wet *wet, const sp_mesh *mesh, sp_vec3 point);

#endif
