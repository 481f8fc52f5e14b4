#include "atlas/edges.h"

#include "atlas/order.h"

#include <stdlib.h>

uint64_t sp_edge_key(const sp_mesh *mesh, uint32_t half_edge)
{
    const uint32_t *corners = mesh->triangles[half_edge / 3];
    uint64_t a = corners[half_edge % 3], b = corners[(half_edge % 3 + 1) % 3];
    return a < b ? a << 32 | b : b << 32 | a;
}

uint32_t *sp_edges_in_order(const sp_mesh *mesh)
{
    size_t count = 3 * mesh->triangle_count;
    uint32_t *order = malloc((count + 1) * sizeof *order);
    uint64_t *keys = malloc((count + 1) * sizeof *keys);
    if (keys)
        for (size_t h = 0; h < count; h++)
            keys[h] = sp_edge_key(mesh, (uint32_t)h);
    if (!order || !keys || !sp_order_by_key(keys, count, order)) {
        free(order);
        order = NULL;
    }
    free(keys);
    return order;
}
