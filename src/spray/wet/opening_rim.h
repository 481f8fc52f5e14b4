/* The rim of an opening, as it is seen around a line that leaves by it. */
#ifndef SPRAY_OPENING_RIM_H
#define SPRAY_OPENING_RIM_H

#include "spray/wet/flood_fill.h"

enum { SP_RIM_POINTS = 8 }; /* directions about a line */

typedef struct {
    sp_vec3 point[SP_RIM_POINTS]; /* m; i and i + SP_RIM_POINTS / 2 are on opposite sides */
    bool there[SP_RIM_POINTS];    /* else nothing is in the way within 45 degrees */
    int count;                    /* of those that are there */
} sp_opening_rim;

/* `liquid` tells by side what lines stay with: [flood->sides]. */
sp_opening_rim sp_opening_rim_find(const sp_flood *flood, const bool *liquid, sp_ray line);
bool sp_opening_rim_is_flat(const sp_opening_rim *rim, double off, sp_vec3 direction);
/* Of flat rims of `count` points in turn: square to it and as long as twice its area; the middle of its area; the
 * narrowest that it is, square to one of the sides between its points. */
sp_vec3 sp_rim_normal(const sp_vec3 *rim, int count);
sp_vec3 sp_rim_middle(const sp_vec3 *rim, int count);
double sp_rim_width(const sp_vec3 *rim, int count, sp_vec3 normal);

#endif
