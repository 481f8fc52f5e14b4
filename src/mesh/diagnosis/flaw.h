/* Flaws, each found in a file of its own. */
#ifndef MESH_FLAW_H
#define MESH_FLAW_H

#include "mesh/half_edge.h"

static inline void sp_flaw_add(sp_flaw *flaw, sp_vec3 place)
{
    if (flaw->count < SP_PLACES)
        flaw->place[flaw->count] = place;
    flaw->count++;
}

/* Pairs of boxes that are looked at, so that a crowd that strangers made ends. */
#define SP_PAIRS_MOST(boxes) (100 * (boxes) + 100000000)

#define SP_CRACK 1e-4 /* of the diagonal: how near corners on open edges are taken for ends of a crack */
/* Lists the corners on open edges, list[vertex_count] at most; returns how many. Two of them are ends of a crack where
 * they are no further apart than twice the lesser radius[vertex_count] (m; of others below 0): `crack`, or half of
 * the shortest edge that ends there. */
size_t sp_crack_corners(const sp_mesh *mesh, const sp_half_edges *edges, double crack, double *radius, uint32_t *list);

/* Where a triangle's middle is, m. */
static inline sp_vec3 sp_judged_point_of(const sp_mesh *mesh, const uint32_t corners[3])
{
    sp_vec3 sum = sp_add(sp_add(mesh->vertices[corners[0]], mesh->vertices[corners[1]]), mesh->vertices[corners[2]]);
    return sp_scale(sum, 1.0 / 3);
}

/* edges.c: the edges' flaws, and what hangs together by edges. shell [triangle_count]: the least triangle of a
 * triangle's shell. closed [triangle_count]: of the shell whose least triangle it is. */
void sp_diagnose_edges(const sp_mesh *mesh, const sp_half_edges *edges, sp_mesh_diagnosis *diagnosis, uint32_t *shell,
                       bool *closed);
/* The rest, a file each. False only when memory runs out. */
bool sp_diagnose_triangles(const sp_mesh *mesh, sp_mesh_diagnosis *diagnosis, sp_error *error);
bool sp_diagnose_cracks(const sp_mesh *mesh, const sp_half_edges *edges, sp_mesh_diagnosis *diagnosis, sp_error *error);
bool sp_diagnose_shells(const sp_mesh *mesh, const uint32_t *shell, const bool *closed, sp_mesh_diagnosis *diagnosis,
                        sp_error *error);
/* Pairs of triangles that run through each other, within each shell or, with NULL, anywhere. `found` [triangle_count],
 * all false, gets those that do; NULL where nobody asks. */
bool sp_find_crossings(const sp_mesh *mesh, const uint32_t *shell, sp_flaw *flaw, bool *found, sp_error *error);

#endif
