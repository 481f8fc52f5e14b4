/* Where a piece of surface that is made of convex polygons is judged: at its point nearest to its centroid. */
#ifndef SPRAY_JUDGED_POINT_H
#define SPRAY_JUDGED_POINT_H

#include <sprayplan/vector.h>

#include <stdbool.h>
#include <stdint.h>

/* All polygons are added, then all looked at again. Starts as zero. */
typedef struct {
    double area;       /* m² */
    sp_vec3 moment;    /* m³, area times centroid */
    double least;      /* m, from the centroid to `point` */
    sp_vec3 point;     /* m, once any polygon was looked at */
    uint32_t triangle; /* that of its polygon */
    bool found;
} sp_judged_point;

void sp_judged_point_add(sp_judged_point *middle, const sp_vec3 *polygon, int corners);
sp_vec3 sp_judged_point_centroid(const sp_judged_point *middle);
/* Takes the polygon's point nearest to the centroid where none yet was as near. `triangle` is the polygon's. */
void sp_judged_point_look(sp_judged_point *middle, const sp_vec3 *polygon, int corners, uint32_t triangle);

#endif
