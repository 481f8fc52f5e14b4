/* Edges that do not lie between two triangles of one front, and what hangs together by edges. */
#include "mesh/diagnosis/flaw.h"
#include "mesh/disjoint_sets.h"

static sp_vec3 middle_of(const sp_mesh *mesh, uint32_t half_edge)
{
    sp_vec3 from = mesh->vertices[sp_half_edge_from(mesh, half_edge)];
    sp_vec3 to = mesh->vertices[sp_half_edge_to(mesh, half_edge)];
    return sp_scale(sp_add(from, to), 0.5);
}

static void count_edge(const sp_mesh *mesh, sp_edge_kind kind, uint32_t half_edge, sp_mesh_diagnosis *diagnosis)
{
    if (kind == SP_EDGE_OPEN)
        sp_flaw_add(&diagnosis->open_edges, middle_of(mesh, half_edge));
    else if (kind == SP_EDGE_FLIPPED)
        sp_flaw_add(&diagnosis->flipped_edges, middle_of(mesh, half_edge));
    else if (kind == SP_EDGE_NON_MANIFOLD)
        sp_flaw_add(&diagnosis->non_manifold_edges, middle_of(mesh, half_edge));
}

void sp_diagnose_edges(const sp_mesh *mesh, const sp_half_edges *edges, sp_mesh_diagnosis *diagnosis, uint32_t *shell,
                       bool *closed)
{
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        shell[t] = t;
        closed[t] = true;
    }
    size_t of_edge;
    for (size_t i = 0; i < 3 * mesh->triangle_count; i += of_edge) {
        const uint32_t *edge = edges->order + i;
        of_edge = sp_half_edges_of_edge(mesh, edges, i);
        count_edge(mesh, edges->kind[edge[0]], edge[0], diagnosis);
        for (size_t k = 1; k < of_edge; k++)
            sp_set_join(shell, edge[k] / 3, edge[0] / 3);
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        shell[t] = sp_set_root(shell, t);
    for (size_t h = 0; h < 3 * mesh->triangle_count; h++)
        if (edges->kind[h] != SP_EDGE_PAIRED)
            closed[shell[h / 3]] = false;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        diagnosis->shells += shell[t] == t;
        diagnosis->closed_shells += shell[t] == t && closed[t];
    }
}
