/* The girth of what a chart lies on: how far it is around it. The edges of a mesh hold all of its curvature: each edge
 * turns the surface by the angle between its two triangles, about its own direction, over its length. Summed over a
 * chart as a tensor in the chart's plane (D. Cohen-Steiner and J.-M. Morvan, "Restricted Delaunay Triangulations and
 * Normal Cycle", 2003) this tells a rod from a sheet that is merely wavy or rough, where bends of opposite sense cancel
 * out. */
#include "mesh/adjacent.h"

#include <sprayplan/atlas.h>

#include <math.h>
#include <stdlib.h>

typedef struct {
    double area, xx, xy, yy; /* m², m rad */
} turning;

/* The angle from one triangle to the next about the edge between them, above 0 where the surface is convex. */
static double angle_at(const sp_mesh *mesh, uint32_t half_edge, uint32_t opposite)
{
    sp_vec3 here = sp_triangle_normal(mesh, half_edge / 3), there = sp_triangle_normal(mesh, opposite / 3);
    sp_vec3 along =
        sp_sub(mesh->vertices[sp_half_edge_to(mesh, half_edge)], mesh->vertices[sp_half_edge_from(mesh, half_edge)]);
    return atan2(sp_dot(sp_cross(here, there), sp_unit(along)), sp_dot(here, there));
}

/* A half-edge has half of its edge's turning, whether or not the other half is in the same chart. */
static void add_half(turning *to, const double flat[3][2], uint32_t corner, double angle)
{
    const double *p = flat[corner], *q = flat[(corner + 1) % 3];
    double x = q[0] - p[0], y = q[1] - p[1], length = hypot(x, y);
    if (!(length > 0))
        return;
    double weight = 0.5 * angle / length;
    to->xx += weight * x * x;
    to->xy += weight * x * y;
    to->yy += weight * y * y;
}

static double girth_of(const turning *chart)
{
    double most = fabs(0.5 * (chart->xx + chart->yy)) + hypot(0.5 * (chart->xx - chart->yy), chart->xy);
    return most > 0 ? 2 * M_PI * chart->area / most : INFINITY;
}

double *sp_charts_girth(const sp_charts *charts, const sp_mesh *mesh, sp_error *error)
{
    if (!charts || !mesh)
        return NULL;
    sp_half_edges edges = {0};
    turning *all = calloc(charts->chart_count + 1, sizeof *all);
    double *girth = malloc((charts->chart_count + 1) * sizeof *girth);
    bool done = all && girth;
    if (!done)
        sp_fail_memory(error);
    done = done && sp_adjacent_create(mesh, &edges, error);
    for (uint32_t t = 0; done && t < mesh->triangle_count; t++) {
        turning *chart = &all[charts->chart[t]];
        chart->area += sp_triangle_area(mesh, t);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t opposite = edges.opposite[3 * t + k];
            if (opposite != SP_NONE)
                add_half(chart, (const double(*)[2])charts->flat[t], k, angle_at(mesh, 3 * t + k, opposite));
        }
    }
    for (size_t c = 0; done && c < charts->chart_count; c++)
        girth[c] = girth_of(&all[c]);
    sp_half_edges_destroy(&edges);
    free(all);
    if (done)
        return girth;
    free(girth);
    return NULL;
}
