/* Which texels touch: inside a triangle, and across the edges of the mesh whether or not the atlas is cut there. Two
 * lips of a cut that merely lie side by side on the page do not touch. */
#include "atlas/order.h"
#include "atlas/texels.h"
#include "mesh/half_edge.h"

#include <math.h>
#include <stdlib.h>

#define SAMPLES_PER_TEXEL 2 /* along an edge */

typedef struct {
    uint64_t *items; /* first texel in the upper half, second in the lower; both ways round */
    size_t count, capacity;
} pairs;

static bool add_pair(pairs *p, uint32_t a, uint32_t b)
{
    if (a == b)
        return true;
    if (p->capacity - p->count < 2) {
        size_t capacity = p->capacity ? 2 * p->capacity : 4096;
        uint64_t *items = realloc(p->items, capacity * sizeof *items);
        if (!items)
            return false;
        p->items = items;
        p->capacity = capacity;
    }
    p->items[p->count++] = (uint64_t)a << 32 | b;
    p->items[p->count++] = (uint64_t)b << 32 | a;
    return true;
}

/* Pairs the triangle's own texels that share a side: a triangle is convex, so it passes through that side. */
static bool pair_inside(pairs *p, const sp_atlas *atlas, uint32_t triangle)
{
    const uint32_t *own = atlas->triangle_texels, *x = atlas->texel_x, *y = atlas->texel_y;
    uint32_t end = atlas->triangle_start[triangle + 1], above = atlas->triangle_start[triangle];
    for (uint32_t i = above; i < end; i++) {
        uint32_t here = own[i];
        if (i + 1 < end && y[own[i + 1]] == y[here] && x[own[i + 1]] == x[here] + 1 && !add_pair(p, here, own[i + 1]))
            return false;
        while (above < end &&
               (y[own[above]] < y[here] + 1 || (y[own[above]] == y[here] + 1 && x[own[above]] < x[here])))
            above++;
        if (above < end && y[own[above]] == y[here] + 1 && x[own[above]] == x[here] && !add_pair(p, here, own[above]))
            return false;
    }
    return true;
}

/* A point at `t` along half-edge `i` of a triangle, as weights of the second and third corner. */
static void edge_weights(uint32_t i, double t, double *u, double *v)
{
    *u = i == 0 ? t : i == 1 ? 1 - t : 0;
    *v = i == 1 ? t : i == 2 ? 1 - t : 0;
}

static void edge_point(const sp_atlas *atlas, uint32_t half_edge, double t, double point[2])
{
    const double *p = atlas->uv[half_edge / 3][half_edge % 3], *q = atlas->uv[half_edge / 3][(half_edge % 3 + 1) % 3];
    for (int k = 0; k < 2; k++)
        point[k] = p[k] + t * (q[k] - p[k]);
}

/* Where two sides of an edge that is not cut meet a corner of the texels, round-off may name two texels across it. */
static bool only_diagonal(const sp_atlas *atlas, uint32_t a, uint32_t b, const double at_a[2], const double at_b[2])
{
    return atlas->texel_chart[a] == atlas->texel_chart[b] && fabs(at_a[0] - at_b[0]) + fabs(at_a[1] - at_b[1]) < 1e-6 &&
           atlas->texel_x[a] != atlas->texel_x[b] && atlas->texel_y[a] != atlas->texel_y[b];
}

/* Pairs the texels on both sides of an edge of the mesh, point by point along it. */
static bool pair_across(pairs *p, const sp_atlas *atlas, const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    const uint32_t *corners_a = mesh->triangles[a / 3], *corners_b = mesh->triangles[b / 3];
    bool opposite = corners_a[a % 3] != corners_b[b % 3];
    double length = sp_distance(mesh->vertices[corners_a[a % 3]], mesh->vertices[corners_a[(a % 3 + 1) % 3]]);
    uint32_t samples = (uint32_t)ceil(SAMPLES_PER_TEXEL * length / atlas->texel) + 1;
    for (uint32_t i = 0; i < samples; i++) {
        double t = (i + 0.5) / samples, s = opposite ? 1 - t : t, u, v, at_a[2], at_b[2];
        edge_weights(a % 3, t, &u, &v);
        uint32_t texel_a = sp_atlas_texel(atlas, a / 3, u, v);
        edge_weights(b % 3, s, &u, &v);
        uint32_t texel_b = sp_atlas_texel(atlas, b / 3, u, v);
        edge_point(atlas, a, t, at_a);
        edge_point(atlas, b, s, at_b);
        if (!only_diagonal(atlas, texel_a, texel_b, at_a, at_b) && !add_pair(p, texel_a, texel_b))
            return false;
    }
    return true;
}

/* Pairs across every edge that two or more triangles share, whichever way they face. */
static bool pair_edges(pairs *p, const sp_atlas *atlas, const sp_mesh *mesh, sp_error *error)
{
    sp_half_edges edges = {0};
    bool done = sp_half_edges_create(mesh, &edges, error);
    for (size_t i = 0, of_edge; done && i < 3 * mesh->triangle_count; i += of_edge) {
        of_edge = sp_half_edges_of_edge(mesh, &edges, i);
        for (size_t k = 1; done && k < of_edge; k++)
            done = pair_across(p, atlas, mesh, edges.order[i + k - 1], edges.order[i + k]);
    }
    sp_half_edges_destroy(&edges);
    return done;
}

static bool collect(sp_atlas *atlas, pairs *p)
{
    if (p->count && !sp_sort_keys(p->items, p->count))
        return false;
    size_t unique = 0;
    for (size_t i = 0; i < p->count; i++)
        if (i == 0 || p->items[i] != p->items[i - 1])
            p->items[unique++] = p->items[i];
    atlas->neighbour_start = calloc(atlas->texel_count + 1, sizeof *atlas->neighbour_start);
    atlas->neighbours = malloc((unique + !unique) * sizeof *atlas->neighbours);
    if (!atlas->neighbour_start || !atlas->neighbours)
        return false;
    for (size_t i = 0; i < unique; i++) {
        atlas->neighbour_start[(p->items[i] >> 32) + 1]++;
        atlas->neighbours[i] = (uint32_t)p->items[i];
    }
    for (size_t i = 0; i < atlas->texel_count; i++)
        atlas->neighbour_start[i + 1] += atlas->neighbour_start[i];
    return true;
}

bool sp_atlas_connect(sp_atlas *atlas, const sp_mesh *mesh, sp_error *error)
{
    pairs p = {0};
    bool done = true;
    for (uint32_t t = 0; t < mesh->triangle_count && done; t++)
        done = pair_inside(&p, atlas, t);
    done = done && pair_edges(&p, atlas, mesh, error) && collect(atlas, &p);
    free(p.items);
    if (!done)
        sp_fail_memory(error);
    return done;
}
