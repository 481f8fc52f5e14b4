#include <sprayplan/atlas.h>

#include "atlas/edges.h"
#include "atlas/orient.h"
#include "atlas/unfold.h"

#include <math.h>
#include <stdlib.h>

/* twin [3 triangle_count]: the half-edge across each half-edge. SP_NONE at open edges, at edges of three or more
 * triangles and where the two triangles do not agree which side is the front. */
static bool find_twins(const sp_mesh *mesh, uint32_t *twin)
{
    size_t count = 3 * mesh->triangle_count;
    uint32_t *order = sp_edges_in_order(mesh);
    if (!order)
        return false;
    for (size_t h = 0; h < count; h++)
        twin[h] = SP_NONE;
    for (size_t i = 0, end; i < count; i = end) {
        uint64_t key = sp_edge_key(mesh, order[i]);
        for (end = i + 1; end < count && sp_edge_key(mesh, order[end]) == key;)
            end++;
        uint32_t a = order[i], b = order[end - 1];
        if (end - i != 2 || mesh->triangles[a / 3][a % 3] == mesh->triangles[b / 3][b % 3])
            continue;
        twin[a] = b;
        twin[b] = a;
    }
    free(order);
    return true;
}

sp_charts *sp_charts_create(const sp_mesh *mesh, double extent, sp_error *error)
{
    if (!mesh)
        return NULL;
    if (!(extent > 0)) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "charts of at most %g m; expected a length above 0", extent);
        return NULL;
    }
    if (mesh->triangle_count >= SP_NONE / 3) {
        sp_fail(error, SP_ERROR_UNSUPPORTED, NULL, 0, 0, "an atlas of %zu triangles; at most %u are possible",
                mesh->triangle_count, SP_NONE / 3 - 1);
        return NULL;
    }
    sp_charts *charts = calloc(1, sizeof *charts);
    if (!charts)
        return sp_fail_memory(error);
    size_t count = mesh->triangle_count;
    charts->triangle_count = count;
    charts->extent = extent;
    charts->chart = malloc((count + 1) * sizeof *charts->chart);
    charts->flat = malloc((count + 1) * sizeof *charts->flat);
    uint32_t *twin = malloc((count + 1) * 3 * sizeof *twin);
    bool done = charts->chart && charts->flat && twin && find_twins(mesh, twin);
    if (!done)
        sp_fail_memory(error);
    done = done && sp_unfold(charts, mesh, twin, error) && sp_orient_charts(charts, error);
    free(twin);
    if (done)
        return charts;
    sp_charts_destroy(charts);
    return NULL;
}

void sp_charts_destroy(sp_charts *charts)
{
    if (!charts)
        return;
    free(charts->chart);
    free(charts->flat);
    free(charts);
}
