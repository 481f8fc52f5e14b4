/* A mesh with its triangles and vertices in an order in which neighbours are near each other in memory. */
#ifndef ATLAS_RENUMBER_H
#define ATLAS_RENUMBER_H

#include <sprayplan/mesh.h>

typedef struct {
    sp_mesh mesh;   /* its vertices and triangles only; each triangle begins at the corner that it had */
    uint32_t *twin; /* [3 triangle_count], as in sp_sheets */
    uint32_t *old;  /* [triangle_count], the number that each triangle had */
} sp_renumbered;

/* Breadth first from the first triangle on, so the order is one of the surface's own and no matter of its pose. False
 * when memory runs out. */
bool sp_renumber(const sp_mesh *mesh, const uint32_t *twin, sp_renumbered *renumbered);
/* Accepts what was never made, if it is all zeros. */
void sp_renumbered_free(sp_renumbered *renumbered);

#endif
