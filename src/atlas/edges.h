/* The half-edges of a mesh brought together by edge. Half-edge 3t + i runs from corner i of triangle t to the next. */
#ifndef ATLAS_EDGES_H
#define ATLAS_EDGES_H

#include <sprayplan/mesh.h>

/* The edge of a half-edge: its two vertices, the lower one in the upper half. */
uint64_t sp_edge_key(const sp_mesh *mesh, uint32_t half_edge);
/* All half-edges, those of one edge beside each other, lowest first. [3 triangle_count], malloc'd; NULL when memory
 * runs out. */
uint32_t *sp_edges_in_order(const sp_mesh *mesh);

#endif
