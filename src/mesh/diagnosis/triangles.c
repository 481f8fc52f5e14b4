/* Triangles that are there twice, and those that have no area. */
#include "mesh/counting_sort.h"
#include "mesh/diagnosis/flaw.h"

#include <stdlib.h>

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

static bool find_duplicates(const sp_mesh *mesh, sp_flaw *flaw, sp_error *error)
{
    size_t count = mesh->triangle_count;
    uint32_t *order = calloc(count + 1, sizeof *order), *keys = calloc(count + 1, sizeof *keys);
    bool good = (order && keys) || sp_fail_memory(error);
    for (size_t t = 0; good && t < count; t++)
        order[t] = (uint32_t)t;
    for (int k = 2; good && k >= 0; k--) {
        for (size_t t = 0; t < count; t++)
            keys[t] = ranked_corner(mesh->triangles[t], k);
        good = sp_counting_sort(order, count, keys, mesh->vertex_count, error);
    }
    for (size_t i = 1; good && i < count; i++)
        if (same_corners(mesh, order[i - 1], order[i]))
            sp_flaw_add(flaw, sp_middle_of(mesh, mesh->triangles[order[i]]));
    free(order);
    free(keys);
    return good;
}

static void find_degenerate(const sp_mesh *mesh, sp_flaw *flaw)
{
    size_t kept = 0;
    for (size_t s = 0; s < mesh->source_triangle_count; s++)
        if (kept < mesh->triangle_count && mesh->source[kept] == s)
            kept++;
        else
            sp_flaw_add(flaw, sp_middle_of(mesh, mesh->source_triangles[s]));
}

bool sp_diagnose_triangles(const sp_mesh *mesh, sp_mesh_diagnosis *diagnosis, sp_error *error)
{
    find_degenerate(mesh, &diagnosis->degenerate);
    return find_duplicates(mesh, &diagnosis->duplicate_triangles, error);
}
