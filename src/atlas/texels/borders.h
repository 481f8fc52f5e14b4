/* The borders of texels on the surface. */
#ifndef ATLAS_BORDERS_H
#define ATLAS_BORDERS_H

#include <sprayplan/atlas.h>

/* A piece of a texel's border, in one triangle and seen from one side of the surface. */
typedef struct {
    uint32_t texel, triangle; /* of which it is the border, and in whose plane it lies */
    uint32_t other;           /* the texel that the surface goes on in; SP_NONE where it ends */
    uint8_t side, other_side; /* of triangle and of what lies beyond: 0 front, 1 back */
    sp_vec3 outward; /* m, as long as the border: out of the texel, across the border, in the triangle's plane */
} sp_border;

typedef bool sp_border_visitor(void *user, const sp_border *border);

/* Visits all borders, from both of the texels that share one and from both sides of the surface, always in the same
 * order. Where three triangles or more meet in an edge, either side of one goes on in the next about that edge. The
 * outward vectors of a texel sum to 0 where it lies in one triangle, or in several of one plane; edges of the mesh
 * inside a texel are no borders. False, with the error set, where memory runs out or the visitor returns false. */
bool sp_atlas_visit_borders(const sp_atlas *atlas, const sp_mesh *mesh, sp_border_visitor *visit, void *user,
                            sp_error *error);

#endif
