/* All that liquid may fly through from one point to a piece of surface, along lines and along low parabolas. */
#ifndef SPRAY_SHAFT_H
#define SPRAY_SHAFT_H

#include "mesh/half_edge.h"
#include "spray/state/state.h"
#include "trace/ray/visit.h"

/* A convex, flat part of the piece. */
typedef struct {
    uint32_t triangle;
    sp_vec3 normal;    /* unit, either way */
    size_t first, end; /* of the shaft's corners */
} sp_shaft_face;

/* The flights to p are from + s (p - from) + k up, s from 0 to 1, k being 0 for a line, and (g T²/2) s (1 - s) for a
 * parabola of duration T; `rise` is no less than any g T²/2. */
typedef struct {
    const sp_tracer *tracer;
    const sp_half_edges *edges; /* of the tracer's mesh */
    sp_vec3 from, up;           /* m; unit, against gravity */
    double rise;                /* m */
    sp_vec3 middle;             /* m, of the piece */
    double radius;              /* m, from there, within which the piece lies */
    const sp_vec3 *corners;     /* [corner_count], m; the piece lies in their convex hull */
    size_t corner_count;
    const sp_shaft_face *faces; /* [face_count], all of the piece; for sp_shaft_is_free */
    size_t face_count;
    double round_off; /* m */
    /* from sp_shaft_open: */
    sp_vec3 way, axis, across[2]; /* from `from` to the middle, m; that as a unit vector, and two square to it */
    double distance;              /* m, of the way */
} sp_shaft;

/* Works out what follows from the rest. */
void sp_shaft_open(sp_shaft *shaft);
/* True where it is proved that nothing lies in the way of any flight to any point of the piece. */
bool sp_shaft_is_free(const sp_shaft *shaft);
/* True where it is proved that something lies in the way of every one. */
bool sp_shaft_is_blocked(const sp_shaft *shaft);

#endif
