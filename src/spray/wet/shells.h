/* Shells: connected surface, and on which side of it there is material. */
#ifndef SPRAY_SHELLS_H
#define SPRAY_SHELLS_H

#include "spray/state/state.h"

/* Triangles that hang together by edges, and that are closed together or open together. */
typedef struct {
    size_t count;
    uint32_t *of;        /* [triangle_count], the shell of each triangle */
    int8_t *closed;      /* [count], 0: open; 1: every edge runs as often one way as the other */
    int8_t *turn;        /* [count], of closed ones: -1 where the solid is drawn inside out, else 1; open: 0 */
    bool *simple;        /* [count], closed, and no edge is of more than two triangles */
    double *volume;      /* [count], m³, of closed ones, positive for normals that point outwards */
    uint32_t *widest;    /* [count], the largest triangle */
    sp_vec3 *low, *high; /* [count], box, m */
} sp_shells;

/* Whether a point lies in a box. */
static inline bool sp_is_within(sp_vec3 low, sp_vec3 high, sp_vec3 point)
{
    return point.x >= low.x && point.y >= low.y && point.z >= low.z && point.x <= high.x && point.y <= high.y &&
           point.z <= high.z;
}

/* Corners nearer than `same` (m) are one. Every turn of a closed shell is 1. */
bool sp_shells_create(sp_shells *shells, const sp_mesh *mesh, double same, sp_error *error);
/* Accepts what was never created, if it is all zeros. */
void sp_shells_destroy(sp_shells *shells);

#endif
