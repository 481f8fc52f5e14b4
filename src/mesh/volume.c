/* What closed parts enclose. */
#include "mesh/half_edge.h"

#include <stdlib.h>

/* Marks parts with an edge at which not as many of their own triangles run one way as the other. Edges that parts share
 * are each part's own. */
static void find_open(const sp_mesh *mesh, const sp_half_edges *edges, int *balance, bool *open)
{
    size_t count = 3 * mesh->triangle_count;
    for (size_t first = 0, end; first < count; first = end) {
        uint32_t from = sp_half_edge_from(mesh, edges->order[first]);
        end = first + sp_half_edges_of_edge(mesh, edges, first);
        for (size_t i = first; i < end; i++) {
            uint32_t h = edges->order[i];
            balance[mesh->part[h / 3]] += sp_half_edge_from(mesh, h) == from ? 1 : -1;
        }
        for (size_t i = first; i < end; i++) {
            uint32_t part = mesh->part[edges->order[i] / 3];
            open[part] |= balance[part] != 0;
        }
        for (size_t i = first; i < end; i++)
            balance[mesh->part[edges->order[i] / 3]] = 0;
    }
}

/* Sum of the tetrahedra from the middle of the box. */
static void add_up(const sp_mesh *mesh, double *volumes)
{
    sp_vec3 low, high;
    sp_mesh_box(mesh, &low, &high);
    sp_vec3 middle = sp_scale(sp_add(low, high), 0.5);
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        const uint32_t *corner = mesh->triangles[t];
        sp_vec3 a = sp_sub(mesh->vertices[corner[0]], middle), b = sp_sub(mesh->vertices[corner[1]], middle),
                c = sp_sub(mesh->vertices[corner[2]], middle);
        volumes[mesh->part[t]] += sp_dot(a, sp_cross(b, c)) / 6;
    }
}

bool sp_mesh_volumes(const sp_mesh *mesh, double *volumes, sp_error *error)
{
    if (!mesh)
        return false;
    sp_half_edges edges = {0};
    bool *open = calloc(mesh->part_count + 1, sizeof *open);
    int *balance = calloc(mesh->part_count + 1, sizeof *balance);
    bool good = (open && balance) || sp_fail_memory(error);
    good = good && sp_half_edges_create(mesh, &edges, error);
    for (size_t i = 0; i < mesh->part_count; i++)
        volumes[i] = 0;
    if (good) {
        find_open(mesh, &edges, balance, open);
        add_up(mesh, volumes);
    }
    for (size_t i = 0; good && i < mesh->part_count; i++)
        if (open[i])
            volumes[i] = 0;
    sp_half_edges_destroy(&edges);
    free(open);
    free(balance);
    return good;
}
