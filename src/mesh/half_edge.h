/* Half edges: which triangles lie side by side. */
#ifndef SPRAYPLAN_MESH_HALF_EDGE_H
#define SPRAYPLAN_MESH_HALF_EDGE_H

#include <sprayplan/mesh.h>

typedef enum {
    SP_EDGE_PAIRED,       /* of two triangles that agree which side is the front */
    SP_EDGE_OPEN,         /* of one triangle */
    SP_EDGE_FLIPPED,      /* of two triangles that disagree which side is the front */
    SP_EDGE_NON_MANIFOLD, /* of three triangles or more */
} sp_edge_kind;

/* Half edge 3 t + k runs from corner k of triangle t to its next corner. */
typedef struct {
    uint32_t *opposite; /* [3 triangle_count], the other half edge of a paired edge, else SP_NONE */
    uint8_t *kind;      /* [3 triangle_count], sp_edge_kind */
    uint32_t *order;    /* [3 triangle_count], all half edges, those of one edge side by side, the lowest first */
} sp_half_edges;

bool sp_half_edges_create(const sp_mesh *mesh, sp_half_edges *half_edges, sp_error *error);
/* Accepts what was never created, if it is all zeros. */
void sp_half_edges_destroy(sp_half_edges *half_edges);
/* How many half edges from order[first] on are of the same edge. */
size_t sp_half_edges_of_edge(const sp_mesh *mesh, const sp_half_edges *half_edges, size_t first);

/* Where in `order` the half edges between two vertices begin; SIZE_MAX where there are none. */
size_t sp_half_edges_between(const sp_mesh *mesh, const sp_half_edges *half_edges, uint32_t a, uint32_t b);

static inline uint32_t sp_half_edge_from(const sp_mesh *mesh, uint32_t half_edge)
{
    return mesh->triangles[half_edge / 3][half_edge % 3];
}
static inline uint32_t sp_half_edge_to(const sp_mesh *mesh, uint32_t half_edge)
{
    return mesh->triangles[half_edge / 3][(half_edge % 3 + 1) % 3];
}

#endif
