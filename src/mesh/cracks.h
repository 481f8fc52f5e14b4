/* Cracks: where open edges lie along each other, nearly, and the surface goes on from one to the other. */
#ifndef MESH_CRACKS_H
#define MESH_CRACKS_H

#include "mesh/half_edge.h"

/* A stretch of one open half-edge, and the one across from it. */
typedef struct {
    uint32_t half_edge[2]; /* the lower number first */
    double part[2][2];     /* of either, where it begins and ends; the second's falls where they run against each other,
                            * as they do where the front goes on in the front */
} sp_crack;

/* One half-edge's own stretch of a crack. */
typedef struct {
    uint32_t half_edge;
    uint32_t crack;  /* its number */
    double from, to; /* parts of the half-edge */
} sp_crack_side;

typedef struct {
    size_t count;
    sp_crack *cracks;
    sp_crack_side *sides; /* [2 count], by half-edge, then along it; they do not overlap */
} sp_cracks;

/* Cracks no wider than `width` (m), nor than a quarter of a triangle's edge or height there: across a gap, a step or an
 * overlap of that, also where one long edge faces several short ones. The narrowest come first where several edges lie
 * side by side. Two rims over each other, as of parallel walls, are none. What is left between two cracks along an edge
 * that is no longer than twice the width goes with them. Near linear in time; of a crowd of edges in one place some may
 * stay open. False only when memory runs out. */
bool sp_cracks_find(const sp_mesh *mesh, const sp_half_edges *edges, double width, sp_cracks *cracks, sp_error *error);
/* Accepts what is all zeros. */
void sp_cracks_free(sp_cracks *cracks);
/* The sides on a half-edge: sides[*first] up to the value that is returned. */
size_t sp_cracks_on(const sp_cracks *cracks, uint32_t half_edge, size_t *first);

#endif
