/* The borders of texels on the surface. */
#ifndef ATLAS_BORDERS_H
#define ATLAS_BORDERS_H

#include <sprayplan/atlas.h>

/* A piece of the border of two texels. */
typedef struct {
    uint32_t texel[2];    /* that share it; the second SP_NONE where the surface ends */
    uint32_t triangle[2]; /* in whose plane it lies, to either */
    sp_vec3 at[2];        /* m, from where to where it runs; only where the surface ends */
    sp_vec3 outward[2]; /* m, as long as the border: out of either texel, across the border, in its triangle's plane */
    bool on_front, on_back; /* of the first texel's triangle: on which sides of the surface the texels share it */
    bool turned;            /* the front goes on in the back */
} sp_border;

typedef bool sp_border_visitor(void *user, const sp_border *border);

/* Visits all borders, always in the same order. Across a crack of the mesh no wider than `crack` (m) texels share one
 * as if it were joined (see mesh/cracks.h). Where three triangles or more meet in an edge, either side of one goes
 * on in the next about that edge. The outward vectors of a texel sum to 0 where it lies in one triangle, or in several
 * of one plane; edges of the mesh inside a texel are no borders. False, with the error set, where memory runs out or
 * the visitor returns false.
 * asked: [chart_count], of which charts; borders with others come too. normals: sp_triangle_normal of each triangle. */
bool sp_atlas_visit_borders(const sp_atlas *atlas, const sp_mesh *mesh, double crack, const bool *asked,
                            const sp_vec3 *normals, sp_border_visitor *visit, void *user, sp_error *error);

#endif
