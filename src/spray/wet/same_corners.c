/* Faces of one body that were reckoned one by one may differ in a corner's last digits. Corners are sorted along a
 * direction that no drawing uses, and compared with those that follow close by. */
#include "spray/wet/same_corners.h"

#include <stdlib.h>

typedef struct {
    double place; /* m, along the direction */
    uint32_t vertex;
} placed_vertex;

static int by_place(const void *left, const void *right)
{
    const placed_vertex *p = left, *q = right;
    if (p->place != q->place)
        return p->place < q->place ? -1 : 1;
    return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

/* same[v] becomes the first vertex, in sorted order, that v is nearer to than the bound. */
static void find_same(const sp_mesh *mesh, const placed_vertex *sorted, double bound, uint32_t *same)
{
    for (size_t i = 0; i < mesh->vertex_count; i++)
        same[i] = (uint32_t)i;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        uint32_t v = sorted[i].vertex;
        for (size_t k = i + 1; k < mesh->vertex_count && sorted[k].place - sorted[i].place <= bound; k++) {
            uint32_t other = sorted[k].vertex;
            if (same[other] == other && sp_distance(mesh->vertices[v], mesh->vertices[other]) <= bound)
                same[other] = same[v];
        }
    }
}

uint32_t (*sp_same_corners(const sp_mesh *mesh, double same_bound, sp_error *error))[3]
{
    const sp_vec3 direction = sp_unit(sp_v(0.5310872941, 0.6180339887, 0.5797115327));
    placed_vertex *sorted = malloc((mesh->vertex_count + 1) * sizeof *sorted);
    uint32_t *same = malloc((mesh->vertex_count + 1) * sizeof *same);
    uint32_t(*triangles)[3] = malloc((mesh->triangle_count + 1) * sizeof *triangles);
    if (!sorted || !same || !triangles) {
        free(sorted);
        free(same);
        free(triangles);
        return sp_fail_memory(error);
    }
    for (size_t i = 0; i < mesh->vertex_count; i++)
        sorted[i] = (placed_vertex){sp_dot(mesh->vertices[i], direction), (uint32_t)i};
    qsort(sorted, mesh->vertex_count, sizeof *sorted, by_place);
    find_same(mesh, sorted, same_bound, same);
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        const uint32_t *own = mesh->triangles[t];
        uint32_t a = same[own[0]], b = same[own[1]], c = same[own[2]];
        bool whole = a != b && b != c && c != a;
        triangles[t][0] = whole ? a : own[0];
        triangles[t][1] = whole ? b : own[1];
        triangles[t][2] = whole ? c : own[2];
    }
    free(sorted);
    free(same);
    return triangles;
}
