#include <sprayplan/atlas.h>

#include "atlas/orient.h"
#include "atlas/unfold.h"
#include "mesh/half_edge.h"

#include <math.h>
#include <stdlib.h>

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
    sp_half_edges edges = {0};
    bool done = charts->chart && charts->flat;
    if (!done)
        sp_fail_memory(error);
    done = done && sp_half_edges_create(mesh, &edges, error) && sp_unfold(charts, mesh, edges.opposite, error) &&
           sp_orient_charts(charts, error);
    sp_half_edges_destroy(&edges);
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
