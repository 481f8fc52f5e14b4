/* Region growing with Lloyd's iteration, as in D. Cohen-Steiner, P. Alliez and M. Desbrun, "Variational Shape
 * Approximation" (2004): a first pass grows one region after another and so decides how many; then all grow together,
 * each from its own middle. Costs are rounded to a grid, so that triangles that cost the same do so however the surface
 * is turned or scaled, and are taken in the order of their numbers. */
#include "atlas/charts/regions.h"

#include "mesh/heap.h"

#include <math.h>
#include <stdlib.h>

#define WIDEST 0.3  /* 1 - cosine of the angle between a region's mean normal and a triangle's, in the first pass */
#define PASSES 2    /* of growing together */
#define SMOOTHING 3 /* passes of straightening borders */
#define STRAIGHTNESS 0.1 /* cost of a border that a triangle only lengthens, in the same measure */

typedef struct {
    sp_vec3 normal, centre; /* sums over the triangles, weighted by area, and their means once all are in */
    double area;
    uint32_t seed;
    double best; /* of the seed */
} proxy;

typedef struct {
    const sp_mesh *mesh;
    const uint32_t *twin;
    uint32_t *region;
    proxy *proxies;
    size_t count, capacity;
    sp_heap heap;
    sp_vec3 *normal; /* [triangle_count], not unit but of the length of twice the area */
} growth;

static sp_vec3 centre_of(const growth *g, uint32_t t)
{
    const uint32_t *c = g->mesh->triangles[t];
    const sp_vec3 *at = g->mesh->vertices;
    return sp_scale(sp_add(sp_add(at[c[0]], at[c[1]]), at[c[2]]), 1.0 / 3);
}

static double edge_length(const sp_mesh *mesh, uint32_t half_edge)
{
    const uint32_t *c = mesh->triangles[half_edge / 3];
    return sp_distance(mesh->vertices[c[half_edge % 3]], mesh->vertices[c[(half_edge % 3 + 1) % 3]]);
}

/* On a grid of 2^-20, a little off so that costs such as 0 or 1/2 do not fall on the edge of its cells. */
static uint64_t key_of(double cost, uint32_t half_edge)
{
    double cell = fmin(fmax((cost + 1) * 0x1p20 + 0.37, 0), 4294967295.0);
    return (uint64_t)(uint32_t)cell << 32 | half_edge;
}

static double deviation(const growth *g, sp_vec3 towards, uint32_t triangle)
{
    sp_vec3 n = g->normal[triangle];
    return 1 - sp_dot(n, towards) / sqrt(sp_dot(n, n) * sp_dot(towards, towards) + 1e-300);
}

/* What it costs to take the triangle across `half_edge` into the region on this side. */
static uint64_t cost_across(const growth *g, uint32_t half_edge)
{
    uint32_t r = g->region[half_edge / 3], other = g->twin[half_edge], triangle = other / 3;
    double inner = 0, all = 0;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t twin = g->twin[3 * triangle + k];
        double length = edge_length(g->mesh, 3 * triangle + k);
        all += length;
        inner += twin != SP_NONE && g->region[twin / 3] == r ? length : 0;
    }
    return key_of(deviation(g, g->proxies[r].normal, triangle) + STRAIGHTNESS * (1 - 2 * inner / all), half_edge);
}

static bool push_neighbours(growth *g, uint32_t triangle)
{
    for (uint32_t h = 3 * triangle; h < 3 * triangle + 3; h++)
        if (g->twin[h] != SP_NONE && g->region[g->twin[h] / 3] == SP_NONE && !sp_heap_push(&g->heap, cost_across(g, h)))
            return false;
    return true;
}

static bool add_proxy(growth *g, uint32_t seed)
{
    if (g->count == g->capacity) {
        size_t capacity = g->capacity ? 2 * g->capacity : 64;
        proxy *proxies = realloc(g->proxies, capacity * sizeof *proxies);
        if (!proxies)
            return false;
        g->proxies = proxies;
        g->capacity = capacity;
    }
    g->proxies[g->count++] = (proxy){.seed = seed, .normal = g->normal[seed]};
    return true;
}

/* Grows one region from each triangle that has none, as far as its mean normal reaches. */
static bool grow_each(growth *g, double widest)
{
    for (uint32_t t = 0; t < g->mesh->triangle_count; t++) {
        if (g->region[t] != SP_NONE)
            continue;
        uint32_t r = (uint32_t)g->count;
        if (!add_proxy(g, t))
            return false;
        g->region[t] = r;
        bool good = push_neighbours(g, t);
        while (good && g->heap.count) {
            uint32_t triangle = g->twin[(uint32_t)sp_heap_pop(&g->heap)] / 3;
            if (g->region[triangle] != SP_NONE || !(deviation(g, g->proxies[r].normal, triangle) <= widest))
                continue;
            g->region[triangle] = r;
            g->proxies[r].normal = sp_add(g->proxies[r].normal, g->normal[triangle]);
            good = push_neighbours(g, triangle);
        }
        if (!good)
            return false;
    }
    return true;
}

/* Mean normal and middle of each region, and the triangle nearest to both, from which it grows anew. */
static void find_seeds(growth *g)
{
    for (size_t r = 0; r < g->count; r++)
        g->proxies[r] = (proxy){.seed = SP_NONE, .best = INFINITY};
    for (uint32_t t = 0; t < g->mesh->triangle_count; t++) {
        proxy *p = &g->proxies[g->region[t]];
        double area = sp_length(g->normal[t]);
        p->normal = sp_add(p->normal, g->normal[t]);
        p->centre = sp_along(p->centre, area, centre_of(g, t));
        p->area += area;
    }
    for (size_t r = 0; r < g->count; r++)
        g->proxies[r].centre = sp_scale(g->proxies[r].centre, 1 / g->proxies[r].area);
    for (uint32_t t = 0; t < g->mesh->triangle_count; t++) {
        proxy *p = &g->proxies[g->region[t]];
        sp_vec3 away = sp_sub(centre_of(g, t), p->centre);
        double score = rint(0x1p30 * (deviation(g, p->normal, t) + sp_dot(away, away) / p->area));
        if (p->seed == SP_NONE || score < p->best) {
            p->best = score;
            p->seed = t;
        }
    }
}

static bool grow_together(growth *g)
{
    for (size_t t = 0; t < g->mesh->triangle_count; t++)
        g->region[t] = SP_NONE;
    for (size_t r = 0; r < g->count; r++)
        g->region[g->proxies[r].seed] = (uint32_t)r;
    for (size_t r = 0; r < g->count; r++)
        if (!push_neighbours(g, g->proxies[r].seed))
            return false;
    while (g->heap.count) {
        uint32_t half_edge = (uint32_t)sp_heap_pop(&g->heap), triangle = g->twin[half_edge] / 3;
        if (g->region[triangle] != SP_NONE)
            continue;
        g->region[triangle] = g->region[half_edge / 3];
        if (!push_neighbours(g, triangle))
            return false;
    }
    return true;
}

/* The region on two sides of a triangle that is not its own, or its own. */
static uint32_t region_around(const uint32_t *twin, const uint32_t *region, uint32_t t)
{
    uint32_t sides[3];
    for (uint32_t k = 0; k < 3; k++)
        sides[k] = twin[3 * t + k] == SP_NONE ? SP_NONE : region[twin[3 * t + k] / 3];
    for (int k = 0; k < 3; k++)
        if (sides[k] != SP_NONE && sides[k] != region[t] && sides[k] == sides[(k + 1) % 3])
            return sides[k];
    return region[t];
}

/* The length of a triangle's border with region `r`. */
static double border_with(const sp_mesh *mesh, const uint32_t *twin, const uint32_t *region, uint32_t t, uint32_t r)
{
    double length = 0;
    for (uint32_t h = 3 * t; h < 3 * t + 3; h++)
        if (twin[h] != SP_NONE && region[twin[h] / 3] == r)
            length += edge_length(mesh, h);
    return length;
}

void sp_regions_straighten(const sp_mesh *mesh, const uint32_t *twin, const uint32_t *list, size_t count,
                           uint32_t first, uint32_t *region)
{
    for (int pass = 0; pass < SMOOTHING; pass++)
        for (size_t i = 0; i < count; i++) {
            uint32_t t = list ? list[i] : (uint32_t)i, other = region_around(twin, region, t);
            if (other == region[t] || other < first)
                continue;
            double own = border_with(mesh, twin, region, t, region[t]);
            if (border_with(mesh, twin, region, t, other) > own * (1 + 1e-6))
                region[t] = other;
        }
}

bool sp_regions_grow(const sp_mesh *mesh, const uint32_t *twin, uint32_t *region, size_t *count, sp_error *error)
{
    growth g = {.mesh = mesh, .twin = twin, .region = region};
    g.normal = malloc((mesh->triangle_count + 1) * sizeof *g.normal);
    bool good = g.normal;
    for (uint32_t t = 0; good && t < mesh->triangle_count; t++) {
        const uint32_t *c = mesh->triangles[t];
        g.normal[t] = sp_cross(sp_sub(mesh->vertices[c[1]], mesh->vertices[c[0]]),
                               sp_sub(mesh->vertices[c[2]], mesh->vertices[c[0]]));
        region[t] = SP_NONE;
    }
    good = good && grow_each(&g, WIDEST);
    for (int pass = 0; good && pass < PASSES; pass++) {
        find_seeds(&g);
        good = grow_together(&g);
    }
    if (good)
        sp_regions_straighten(mesh, twin, NULL, mesh->triangle_count, 0, region);
    *count = g.count;
    free(g.normal);
    free(g.proxies);
    free(g.heap.keys);
    if (!good)
        sp_fail_memory(error);
    return good;
}
