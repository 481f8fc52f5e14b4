#include "mesh/adjacent.h"

#include <math.h>

#define MOST 8           /* triangles at an edge that are looked at */
#define LEAST_COSINE 0.1 /* between the normals of two that go on in each other */
#define ALIKE 1e-6       /* cosines that differ by less are equal but for round-off */

/* Pairs the two of the half-edges of one edge that run against each other and bend least, if any go on in each other.
 */
static bool pair_smoothest(const sp_mesh *mesh, sp_half_edges *edges, const uint32_t *of_edge, size_t count)
{
    double most = LEAST_COSINE;
    uint32_t best[2] = {SP_NONE, SP_NONE};
    for (size_t i = 0; i < count; i++)
        for (size_t k = i + 1; k < count; k++) {
            uint32_t a = of_edge[i], b = of_edge[k];
            if (edges->opposite[a] != SP_NONE || edges->opposite[b] != SP_NONE ||
                sp_half_edge_from(mesh, a) != sp_half_edge_to(mesh, b))
                continue;
            double cosine = sp_dot(sp_triangle_normal(mesh, a / 3), sp_triangle_normal(mesh, b / 3));
            if (!(cosine > most + ALIKE))
                continue;
            most = cosine;
            best[0] = a;
            best[1] = b;
        }
    if (best[0] == SP_NONE)
        return false;
    edges->opposite[best[0]] = best[1];
    edges->opposite[best[1]] = best[0];
    return true;
}

bool sp_adjacent_create(const sp_mesh *mesh, sp_half_edges *edges, sp_error *error)
{
    if (!sp_half_edges_create(mesh, edges, error))
        return false;
    for (size_t i = 0, count; i < 3 * mesh->triangle_count; i += count) {
        count = sp_half_edges_of_edge(mesh, edges, i);
        while (count >= 3 && count <= MOST && pair_smoothest(mesh, edges, edges->order + i, count)) {
        }
    }
    return true;
}
