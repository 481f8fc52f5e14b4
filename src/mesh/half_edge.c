#include "mesh/half_edge.h"

#include "mesh/counting_sort.h"

#include <stdlib.h>

static uint32_t lower(const sp_mesh *mesh, uint32_t half_edge)
{
    uint32_t from = sp_half_edge_from(mesh, half_edge), to = sp_half_edge_to(mesh, half_edge);
    return from < to ? from : to;
}

static uint32_t higher(const sp_mesh *mesh, uint32_t half_edge)
{
    uint32_t from = sp_half_edge_from(mesh, half_edge), to = sp_half_edge_to(mesh, half_edge);
    return from < to ? to : from;
}

/* By lower end, then higher end, then number. */
static bool sort(const sp_mesh *mesh, uint32_t *order, size_t count, sp_error *error)
{
    uint32_t *keys = calloc(count + 1, sizeof *keys);
    if (!keys) {
        sp_fail_memory(error);
        return false;
    }
    for (size_t h = 0; h < count; h++) {
        order[h] = (uint32_t)h;
        keys[h] = higher(mesh, (uint32_t)h);
    }
    bool good = sp_counting_sort(order, count, keys, mesh->vertex_count, error);
    for (size_t h = 0; good && h < count; h++)
        keys[h] = lower(mesh, (uint32_t)h);
    good = good && sp_counting_sort(order, count, keys, mesh->vertex_count, error);
    free(keys);
    return good;
}

/* How many half edges from order[first] on have the same ends. */
static size_t count_alike(const sp_mesh *mesh, const sp_half_edges *half_edges, size_t first)
{
    uint32_t h = half_edges->order[first], from = lower(mesh, h), to = higher(mesh, h);
    size_t end = first + 1;
    while (end < 3 * mesh->triangle_count && lower(mesh, half_edges->order[end]) == from &&
           higher(mesh, half_edges->order[end]) == to)
        end++;
    return end - first;
}

size_t sp_half_edges_of_edge(const sp_mesh *mesh, const sp_half_edges *half_edges, size_t first)
{
    sp_edge_kind kind = half_edges->kind[half_edges->order[first]];
    if (kind == SP_EDGE_NON_MANIFOLD)
        return count_alike(mesh, half_edges, first);
    return kind == SP_EDGE_OPEN ? 1 : 2;
}

size_t sp_half_edges_between(const sp_mesh *mesh, const sp_half_edges *half_edges, uint32_t a, uint32_t b)
{
    uint32_t from = a < b ? a : b, to = a < b ? b : a;
    size_t count = 3 * mesh->triangle_count, low = 0, high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        uint32_t h = half_edges->order[middle], start = lower(mesh, h);
        if (start < from || (start == from && higher(mesh, h) < to))
            low = middle + 1;
        else
            high = middle;
    }
    bool found =
        low < count && lower(mesh, half_edges->order[low]) == from && higher(mesh, half_edges->order[low]) == to;
    return found ? low : SIZE_MAX;
}

static void pair(const sp_mesh *mesh, sp_half_edges *half_edges)
{
    size_t of_edge;
    for (size_t i = 0; i < 3 * mesh->triangle_count; i += of_edge) {
        of_edge = count_alike(mesh, half_edges, i);
        const uint32_t *edge = half_edges->order + i;
        sp_edge_kind kind = of_edge == 1 ? SP_EDGE_OPEN : SP_EDGE_NON_MANIFOLD;
        if (of_edge == 2)
            kind =
                sp_half_edge_from(mesh, edge[0]) == sp_half_edge_to(mesh, edge[1]) ? SP_EDGE_PAIRED : SP_EDGE_FLIPPED;
        for (size_t k = 0; k < of_edge; k++) {
            half_edges->kind[edge[k]] = (uint8_t)kind;
            half_edges->opposite[edge[k]] = kind == SP_EDGE_PAIRED ? edge[1 - k] : SP_NONE;
        }
    }
}

bool sp_half_edges_create(const sp_mesh *mesh, sp_half_edges *half_edges, sp_error *error)
{
    size_t count = 3 * mesh->triangle_count;
    half_edges->opposite = malloc((count + 1) * sizeof *half_edges->opposite);
    half_edges->kind = malloc(count + 1);
    half_edges->order = malloc((count + 1) * sizeof *half_edges->order);
    bool good = half_edges->opposite && half_edges->kind && half_edges->order;
    if (!good)
        sp_fail_memory(error);
    good = good && sort(mesh, half_edges->order, count, error);
    if (good)
        pair(mesh, half_edges);
    else
        sp_half_edges_destroy(half_edges);
    return good;
}

void sp_half_edges_destroy(sp_half_edges *half_edges)
{
    free(half_edges->opposite);
    free(half_edges->kind);
    free(half_edges->order);
    *half_edges = (sp_half_edges){0};
}
