/* How far an opening reaches in its plane. */
#ifndef SPRAY_OPENING_SIZE_H
#define SPRAY_OPENING_SIZE_H

#include "spray/wet/flood_fill.h"

#define SP_OPENING_FLAT 0.25 /* of an opening's width, that its rim may lie off a plane */

/* Whether nothing, nor a cap, is between two points. */
bool sp_opening_is_clear(const sp_flood *flood, sp_vec3 from, sp_vec3 to);
/* Finds an opening's place, width and radius (to its farthest corner) from its rim around `through`, a point of it in
 * its plane; its width is known roughly. False, and it is left as it is, where some direction in the plane meets no
 * rim. */
bool sp_opening_size_find(const sp_flood *flood, sp_vec3 through, sp_opening *opening);

#endif
