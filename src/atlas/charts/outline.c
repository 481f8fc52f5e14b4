/* The sum of the outlines of anticlockwise triangles is the boundary, so a point lies in as many triangles as the
 * boundary winds around it. Chains that touch neither each other nor themselves are simple closed curves, which wind
 * once around what they enclose, forwards or backwards: where only one runs forwards, nothing is wound around more than
 * once, and no two triangles overlap. */
#include "atlas/charts/outline.h"

#include <sprayplan/mesh.h>

#include <math.h>
#include <stdlib.h>

#define LEAST_AREA 1e-13 /* twice what a chain encloses, over the box around all: less may be round-off */

/* Width times height of the box around the segments. */
static double area_around(const sp_segment *segments, size_t count)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], segments[i].p[k]);
            high[k] = fmax(high[k], segments[i].p[k]);
        }
    return (high[0] - low[0]) * (high[1] - low[1]);
}

/* How many of the closed chains run anticlockwise, those among them that enclose next to nothing; 2 where chains meet
 * in a vertex. `from` [vertex_count] is overwritten: the segment that begins at each vertex. */
static size_t count_forward(const sp_segment *segments, size_t count, uint32_t *from)
{
    size_t forward = 0;
    for (size_t i = 0; i < count; i++) {
        forward = from[segments[i].from] == SP_NONE ? forward : 2;
        from[segments[i].from] = (uint32_t)i;
    }
    double least = LEAST_AREA * area_around(segments, count);
    for (size_t i = 0; i < count && forward < 2; i++) {
        if (from[segments[i].from] == SP_NONE)
            continue;
        double twice = 0;
        const double *o = segments[i].p;
        for (uint32_t at = segments[i].from, next; (next = from[at]) != SP_NONE; at = segments[next].to) {
            const double *p = segments[next].p, *q = segments[next].q;
            twice += (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
            from[at] = SP_NONE;
        }
        forward += !(twice < -least);
    }
    return forward;
}

sp_boundary_test sp_test_boundary(const sp_segment *segments, size_t count, size_t vertex_count)
{
    uint32_t *from = malloc((vertex_count + 1) * sizeof *from);
    if (!from)
        return (sp_boundary_test){0};
    for (size_t v = 0; v < vertex_count; v++)
        from[v] = SP_NONE;
    size_t forward = count_forward(segments, count, from);
    free(from);
    if (forward != 1)
        return (sp_boundary_test){.memory = true};
    sp_crossing found = sp_segments_cross(segments, count);
    return (sp_boundary_test){.simple = !found.crossing, .memory = found.memory, .tests = found.tests};
}
