/* Polygons, cut into triangles. */
#ifndef MESH_POLYGON_H
#define MESH_POLYGON_H

#include <sprayplan/mesh.h>

/* Two triangles fewer than corners. */
typedef struct {
    uint32_t (*triangles)[3]; /* numbers of corners from 0, owned; NULL: a fan from corner 0 */
    bool tangled; /* a fan for want of better, which may cover what the polygon does not: its outline crosses itself, or
                   * is too intricate */
} sp_facets;

/* Cuts the polygon of `count` >= 3 corners, each a number of a vertex; all coordinates finite. The first corner's fan
 * where that is right, as of every convex polygon; else inside the outline, seen along Newell's normal, whichever
 * corner is the first and whichever way it runs. Corners may repeat and lie in line; holes are joined to the rim by
 * edges there and back. The time is bounded by a constant for every corner. The cut does not depend on a power of two
 * by which all coordinates are multiplied. False only when memory runs out: then there is nothing to free. */
bool sp_polygon_cut(const sp_vec3 *vertices, const uint32_t *corners, size_t count, sp_facets *cut, sp_error *error);
void sp_facets_free(sp_facets *cut);

/* Triangle i of the cut. */
static inline void sp_facets_triangle(const sp_facets *cut, size_t i, uint32_t triangle[3])
{
    for (uint32_t k = 0; k < 3; k++)
        triangle[k] = cut->triangles ? cut->triangles[i][k] : k ? (uint32_t)i + k : 0;
}

#endif
