/* Edges of the mesh on the pages. */
#include "atlas/texels/texels.h"
#include "mesh/min_max.h"

#include <math.h>
#include <stdlib.h>

#define COINCIDENT 1e-6 /* pixels: two sides of an edge nearer to each other than this are not cut apart */
#define CREASE 0.26     /* cosine of 75 degrees */

/* The next border that coordinate p + t (q - p) meets after its `k`-th, as t; beyond 1 where there is none. */
static double crossing(double p, double q, double k)
{
    if (p == q)
        return 2;
    double border = q > p ? floor(p) + 1 + k : ceil(p) - 1 - k;
    return (border - p) / (q - p);
}

bool sp_crossings_of(sp_crossings *crossings, const double p[2], const double q[2])
{
    size_t need = (size_t)(fabs(q[0] - p[0]) + fabs(q[1] - p[1])) + 6;
    if (need > crossings->capacity) {
        double *items = realloc(crossings->items, 2 * need * sizeof *items);
        if (!items)
            return false;
        crossings->items = items;
        crossings->capacity = 2 * need;
    }
    size_t count = 0;
    crossings->items[count++] = 0;
    double next[2] = {crossing(p[0], q[0], 0), crossing(p[1], q[1], 0)}, passed[2] = {0, 0};
    for (int k; k = next[1] < next[0], next[k] < 1 && count < need - 1;) {
        if (next[k] > crossings->items[count - 1])
            crossings->items[count++] = next[k];
        next[k] = crossing(p[k], q[k], ++passed[k]);
    }
    crossings->items[count++] = 1;
    crossings->count = count;
    return true;
}

void sp_edge_weights(uint32_t half_edge, double part, double *u, double *v)
{
    uint32_t i = half_edge % 3;
    *u = i == 0 ? part : i == 1 ? 1 - part : 0;
    *v = i == 1 ? part : i == 2 ? 1 - part : 0;
}

void sp_edge_point(const sp_atlas *atlas, uint32_t half_edge, double part, double point[2])
{
    const double *p = atlas->uv[half_edge / 3][half_edge % 3], *q = atlas->uv[half_edge / 3][(half_edge % 3 + 1) % 3];
    for (int k = 0; k < 2; k++)
        point[k] = p[k] + part * (q[k] - p[k]);
}

bool sp_edge_is_opposite(const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    return sp_half_edge_from(mesh, a) != sp_half_edge_from(mesh, b);
}

bool sp_edge_is_cut(const sp_atlas *atlas, const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    if (atlas->chart[a / 3] != atlas->chart[b / 3])
        return true;
    const double(*p)[2] = (const double(*)[2])atlas->uv[a / 3], (*q)[2] = (const double(*)[2])atlas->uv[b / 3];
    bool opposite = sp_edge_is_opposite(mesh, a, b);
    for (uint32_t end = 0; end < 2; end++) {
        const double *at_a = p[(a % 3 + end) % 3], *at_b = q[(b % 3 + (opposite ? 1 - end : end)) % 3];
        if (fabs(at_a[0] - at_b[0]) > COINCIDENT || fabs(at_a[1] - at_b[1]) > COINCIDENT)
            return true;
    }
    return false;
}

bool sp_edge_is_crease(const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    sp_vec3 here = sp_triangle_normal(mesh, a / 3), there = sp_triangle_normal(mesh, b / 3);
    bool face = sp_dot(here, here) > 0 && sp_dot(there, there) > 0; /* what has no area faces nowhere */
    return face && sp_dot(here, there) <= CREASE;
}
