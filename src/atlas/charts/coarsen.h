/* A coarser mesh in place of a fine one, and what of the fine one each part of it stands for. */
#ifndef ATLAS_COARSEN_H
#define ATLAS_COARSEN_H

#include "atlas/charts/sheets.h"

/* Every triangle of the fine mesh belongs to one of the coarse mesh, every vertex to one of its vertices, and a
 * triangle's corners belong to corners of its coarse triangle. What belongs to a vertex hangs together, and so does
 * what belongs to a triangle. */
typedef struct {
    sp_mesh mesh;     /* its vertices and triangles only */
    uint32_t *twin;   /* [3 mesh.triangle_count], as in sp_sheets */
    uint32_t *parent; /* [fine triangle_count], the coarse triangle */
    uint32_t *vertex; /* [fine vertex_count], the coarse vertex */
} sp_coarse;

/* Takes vertices out of the mesh of `fine` until about `target` triangles are left, or no more can go. What lies flat,
 * and what is open or non-manifold, stays as it is. False when memory runs out. */
bool sp_coarsen(const sp_sheets *fine, size_t target, sp_coarse *coarse);
/* Accepts what was never made, if it is all zeros. */
void sp_coarse_free(sp_coarse *coarse);

#endif
