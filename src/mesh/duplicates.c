#include "mesh/duplicates.h"

#include "mesh/counting_sort.h"

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

bool sp_are_duplicates(const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    for (int k = 0; k < 3; k++)
        if (ranked_corner(mesh->triangles[a], k) != ranked_corner(mesh->triangles[b], k))
            return false;
    return true;
}

bool sp_sort_duplicates(const sp_mesh *mesh, uint32_t *order, sp_error *error)
{
    size_t count = mesh->triangle_count;
    uint32_t *keys = calloc(count + 1, sizeof *keys);
    bool good = keys || sp_fail_memory(error);
    for (size_t t = 0; good && t < count; t++)
        order[t] = (uint32_t)t;
    for (int k = 2; good && k >= 0; k--) {
        for (size_t t = 0; t < count; t++)
            keys[t] = ranked_corner(mesh->triangles[t], k);
        good = sp_counting_sort(order, count, keys, mesh->vertex_count, error);
    }
    free(keys);
    return good;
}
