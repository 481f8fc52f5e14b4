/* Cracks: corners on open edges that lie nearly where others do, as where faces were cut into triangles each for
 * itself. Nearer than half of either's shortest edge, so that no fine mesh is taken for one. */
#include "mesh/box_pairs.h"
#include "mesh/diagnosis/flaw.h"

#include <stdlib.h>

typedef struct {
    const sp_mesh *mesh;
    const double *radius; /* [vertex_count], m: half of how far a corner looks */
    bool *found;          /* [vertex_count] */
    size_t left;          /* pairs that may be looked at */
    sp_flaw *flaw;
} crack_search;

/* A box visitor. */
static bool look_at(void *user, uint32_t a, uint32_t b)
{
    crack_search *search = user;
    const sp_vec3 *at = search->mesh->vertices;
    search->flaw->more = search->left == 0;
    if (search->flaw->more)
        return false;
    search->left--;
    if (sp_distance(at[a], at[b]) <= 2 * fmin(search->radius[a], search->radius[b]))
        search->found[a] = search->found[b] = true;
    return true;
}

size_t sp_crack_corners(const sp_mesh *mesh, const sp_half_edges *edges, double crack, double *radius, uint32_t *list)
{
    size_t count = 0, half_edges = 3 * mesh->triangle_count;
    for (size_t v = 0; v < mesh->vertex_count; v++)
        radius[v] = -1;
    for (uint32_t h = 0; h < half_edges; h++)
        if (edges->kind[h] == SP_EDGE_OPEN)
            radius[sp_half_edge_from(mesh, h)] = radius[sp_half_edge_to(mesh, h)] = 0.5 * crack;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        if (radius[v] > 0)
            list[count++] = v;
    for (uint32_t h = 0; h < half_edges; h++) {
        uint32_t from = sp_half_edge_from(mesh, h), to = sp_half_edge_to(mesh, h);
        double most = 0.25 * sp_distance(mesh->vertices[from], mesh->vertices[to]);
        radius[from] = fmin(radius[from], most);
        radius[to] = fmin(radius[to], most);
    }
    return count;
}

bool sp_diagnose_cracks(const sp_mesh *mesh, const sp_half_edges *edges, sp_mesh_diagnosis *diagnosis, sp_error *error)
{
    size_t room = mesh->vertex_count + 1;
    sp_box *boxes = malloc(room * sizeof *boxes);
    uint32_t *list = malloc(room * sizeof *list);
    double *radius = malloc(room * sizeof *radius);
    bool *found = calloc(room, sizeof *found);
    bool good = (boxes && list && radius && found) || sp_fail_memory(error);
    if (good) {
        size_t count = sp_crack_corners(mesh, edges, diagnosis->crack, radius, list);
        crack_search search = {mesh, radius, found, SP_PAIRS_MOST(count), &diagnosis->cracks};
        for (size_t i = 0; i < count; i++)
            boxes[list[i]] = sp_box_around(mesh->vertices[list[i]], radius[list[i]]);
        good = sp_box_pairs(boxes, list, count, look_at, &search, error) || search.flaw->more;
        for (size_t i = 0; i < count; i++)
            if (found[list[i]])
                sp_flaw_add(search.flaw, mesh->vertices[list[i]]);
    }
    free(boxes);
    free(list);
    free(radius);
    free(found);
    return good;
}
