#include "atlas/charts/renumber.h"

#include <assert.h>
#include <stdlib.h>

/* Lists the triangles in `old`, and gives them their numbers. */
static void list_triangles(size_t count, const uint32_t *twin, uint32_t *number, uint32_t *old)
{
    uint32_t listed = 0;
    for (size_t t = 0; t < count; t++)
        number[t] = SP_NONE;
    for (uint32_t seed = 0; seed < count; seed++) {
        if (number[seed] != SP_NONE)
            continue;
        uint32_t next = listed;
        number[seed] = listed;
        old[listed++] = seed;
        for (; next < listed; next++)
            for (uint32_t h = 3 * old[next]; h < 3 * old[next] + 3; h++) {
                uint32_t other = twin[h] / 3;
                if (twin[h] == SP_NONE || number[other] != SP_NONE)
                    continue;
                number[other] = listed;
                old[listed++] = other;
            }
    }
    assert(listed == count);
}

/* Vertices are numbered as triangles come to them; those of no triangle are left out. */
static void copy_mesh(const sp_mesh *mesh, const uint32_t *twin, const uint32_t *number, uint32_t *vertex,
                      sp_renumbered *r)
{
    for (size_t v = 0; v < mesh->vertex_count; v++)
        vertex[v] = SP_NONE;
    r->mesh.triangle_count = mesh->triangle_count;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t corner = mesh->triangles[r->old[t]][k], other = twin[3 * r->old[t] + (uint32_t)k];
            if (vertex[corner] == SP_NONE) {
                vertex[corner] = (uint32_t)r->mesh.vertex_count;
                r->mesh.vertices[r->mesh.vertex_count++] = mesh->vertices[corner];
            }
            r->mesh.triangles[t][k] = vertex[corner];
            r->twin[3 * t + (size_t)k] = other == SP_NONE ? SP_NONE : 3 * number[other / 3] + other % 3;
        }
}

bool sp_renumber(const sp_mesh *mesh, const uint32_t *twin, sp_renumbered *renumbered)
{
    size_t count = mesh->triangle_count;
    *renumbered = (sp_renumbered){0};
    renumbered->mesh.vertices = malloc((mesh->vertex_count + 1) * sizeof *renumbered->mesh.vertices);
    renumbered->mesh.triangles = malloc((count + 1) * sizeof *renumbered->mesh.triangles);
    renumbered->twin = malloc((3 * count + 1) * sizeof *renumbered->twin);
    renumbered->old = malloc((count + 1) * sizeof *renumbered->old);
    uint32_t *number = malloc((count + 1) * sizeof *number);
    uint32_t *vertex = malloc((mesh->vertex_count + 1) * sizeof *vertex);
    bool good = renumbered->mesh.vertices && renumbered->mesh.triangles && renumbered->twin && renumbered->old &&
                number && vertex;
    if (good) {
        list_triangles(count, twin, number, renumbered->old);
        copy_mesh(mesh, twin, number, vertex, renumbered);
    } else {
        sp_renumbered_free(renumbered);
    }
    free(number);
    free(vertex);
    return good;
}

void sp_renumbered_free(sp_renumbered *renumbered)
{
    free(renumbered->mesh.vertices);
    free(renumbered->mesh.triangles);
    free(renumbered->twin);
    free(renumbered->old);
    *renumbered = (sp_renumbered){0};
}
