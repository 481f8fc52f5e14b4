#include "mesh/counting_sort.h"
#include "mesh/disjoint_sets.h"
#include "mesh/half_edge.h"

#include <stdlib.h>

static void count_edges(const sp_mesh *mesh, const sp_half_edges *half_edges, uint32_t *parent, sp_mesh_diagnosis *d)
{
    size_t of_edge;
    for (size_t i = 0; i < 3 * mesh->triangle_count; i += of_edge) {
        const uint32_t *edge = half_edges->order + i;
        of_edge = sp_half_edges_of_edge(mesh, half_edges, i);
        d->open_edges += half_edges->kind[edge[0]] == SP_EDGE_OPEN;
        d->flipped_edges += half_edges->kind[edge[0]] == SP_EDGE_FLIPPED;
        d->non_manifold_edges += half_edges->kind[edge[0]] == SP_EDGE_NON_MANIFOLD;
        for (size_t k = 1; k < of_edge; k++)
            sp_set_join(parent, edge[k] / 3, edge[0] / 3);
    }
}

static bool count_shells(const sp_mesh *mesh, const sp_half_edges *half_edges, uint32_t *parent, sp_mesh_diagnosis *d,
                         sp_error *error)
{
    bool *closed = malloc(mesh->triangle_count + 1); /* of the shell whose representative it is */
    if (!closed)
        return sp_fail_memory(error);
    for (size_t t = 0; t < mesh->triangle_count; t++)
        closed[t] = true;
    for (size_t h = 0; h < 3 * mesh->triangle_count; h++)
        if (half_edges->kind[h] != SP_EDGE_PAIRED)
            closed[sp_set_root(parent, (uint32_t)(h / 3))] = false;
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        d->shells += parent[t] == t;
        d->closed_shells += parent[t] == t && closed[t];
    }
    free(closed);
    return true;
}

static bool diagnose_surface(const sp_mesh *mesh, sp_mesh_diagnosis *d, sp_error *error)
{
    sp_half_edges half_edges = {0};
    if (!sp_half_edges_create(mesh, &half_edges, error))
        return false;
    uint32_t *parent = malloc((mesh->triangle_count + 1) * sizeof *parent);
    for (size_t t = 0; parent && t < mesh->triangle_count; t++)
        parent[t] = (uint32_t)t;
    bool good = parent != NULL;
    if (good) {
        count_edges(mesh, &half_edges, parent, d);
        good = count_shells(mesh, &half_edges, parent, d, error);
    } else {
        sp_fail_memory(error);
    }
    free(parent);
    sp_half_edges_destroy(&half_edges);
    return good;
}

/* The k-th smallest corner. */
static uint32_t ranked_corner(const uint32_t corners[3], int k)
{
    uint32_t a = corners[0], b = corners[1], c = corners[2];
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    if (k == 0)
        return low < c ? low : c;
    if (k == 2)
        return high > c ? high : c;
    return c < low ? low : c > high ? high : c;
}

static bool same_corners(const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    for (int k = 0; k < 3; k++)
        if (ranked_corner(mesh->triangles[a], k) != ranked_corner(mesh->triangles[b], k))
            return false;
    return true;
}

static bool count_duplicates(const sp_mesh *mesh, sp_mesh_diagnosis *d, sp_error *error)
{
    size_t count = mesh->triangle_count;
    uint32_t *order = calloc(count + 1, sizeof *order), *keys = calloc(count + 1, sizeof *keys);
    bool good = order && keys;
    if (!good)
        sp_fail_memory(error);
    for (size_t t = 0; good && t < count; t++)
        order[t] = (uint32_t)t;
    for (int k = 2; good && k >= 0; k--) {
        for (size_t t = 0; t < count; t++)
            keys[t] = ranked_corner(mesh->triangles[t], k);
        good = sp_counting_sort(order, count, keys, mesh->vertex_count, error);
    }
    for (size_t i = 1; good && i < count; i++)
        d->duplicate_triangles += same_corners(mesh, order[i - 1], order[i]);
    free(order);
    free(keys);
    return good;
}

bool sp_mesh_diagnose(const sp_mesh *mesh, sp_mesh_diagnosis *diagnosis, sp_error *error)
{
    *diagnosis = (sp_mesh_diagnosis){.degenerate = mesh->source_triangle_count - mesh->triangle_count};
    sp_mesh_box(mesh, &diagnosis->minimum, &diagnosis->maximum);
    diagnosis->area = sp_mesh_area(mesh);
    return diagnose_surface(mesh, diagnosis, error) && count_duplicates(mesh, diagnosis, error);
}
