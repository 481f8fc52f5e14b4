/* Isometric unfolding: study 2008, 3.3.2.1. The border of a chart is kept as a queue, nearest to the seed first, so
 * that charts grow round, with folds put off, so that they spread over smooth surface before they turn corners. */
#include "atlas/unfold.h"

#include "atlas/overlap.h"

#include <math.h>
#include <stdlib.h>

/* A fold of 90 degrees counts as this many times the distance more. On stirred tanks it leads to a third of the charts
 * that distance alone does; on scans it makes little difference. */
#define FOLD_WEIGHT 5.0

/* A half-edge of a laid triangle, across which the chart may grow. */
typedef struct {
    double cost; /* distance of its middle from the chart's seed, m, in the plane, increased by its fold */
    uint32_t half_edge;
} candidate;

typedef struct {
    candidate *items; /* binary heap, nearest first */
    size_t count, capacity;
} border;

typedef struct {
    sp_charts *charts;
    const sp_mesh *mesh;
    const uint32_t *twin;
    sp_plane *plane;
    border border;
    double seed[2];
    double low[2], high[2]; /* of the chart being grown */
} growth;

static bool before(candidate a, candidate b)
{
    return a.cost < b.cost || (a.cost == b.cost && a.half_edge < b.half_edge);
}

static bool push(border *b, candidate item)
{
    if (b->count == b->capacity) {
        size_t capacity = b->capacity ? 2 * b->capacity : 1024;
        candidate *items = realloc(b->items, capacity * sizeof *items);
        if (!items)
            return false;
        b->items = items;
        b->capacity = capacity;
    }
    size_t at = b->count++;
    for (; at > 0 && before(item, b->items[(at - 1) / 2]); at = (at - 1) / 2)
        b->items[at] = b->items[(at - 1) / 2];
    b->items[at] = item;
    return true;
}

static candidate pop(border *b)
{
    candidate top = b->items[0], last = b->items[--b->count];
    size_t at = 0;
    for (size_t child; (child = 2 * at + 1) < b->count; at = child) {
        if (child + 1 < b->count && before(b->items[child + 1], b->items[child]))
            child++;
        if (!before(b->items[child], last))
            break;
        b->items[at] = b->items[child];
    }
    b->items[at] = last;
    return top;
}

/* Where the third corner lies when the edge from a to b is laid from p to q and the triangle is on its left: along the
 * edge and up from it (study's equations 3.24 to 3.26, the height by a cross product, which keeps thin triangles
 * exact). */
static void third_corner(sp_vec3 a, sp_vec3 b, sp_vec3 c, const double p[2], const double q[2], double corner[2])
{
    sp_vec3 edge = sp_sub(b, a), side = sp_sub(c, a);
    double length = sp_length(edge);
    double along = sp_dot(edge, side) / length, height = sp_length(sp_cross(edge, side)) / length;
    double x = q[0] - p[0], y = q[1] - p[1], laid = hypot(x, y);
    x /= laid;
    y /= laid;
    corner[0] = p[0] + along * x - height * y;
    corner[1] = p[1] + along * y + height * x;
}

static sp_vec3 corner_of(const growth *g, uint32_t triangle, uint32_t corner)
{
    return g->mesh->vertices[g->mesh->triangles[triangle][corner % 3]];
}

static bool fits_extent(const growth *g, const double flat[3][2])
{
    for (int k = 0; k < 2; k++) {
        double low = fmin(g->low[k], fmin(flat[0][k], fmin(flat[1][k], flat[2][k])));
        double high = fmax(g->high[k], fmax(flat[0][k], fmax(flat[1][k], flat[2][k])));
        if (high - low > g->charts->extent)
            return false;
    }
    return true;
}

static double cost_of(const growth *g, uint32_t half_edge)
{
    const double(*flat)[2] = (const double(*)[2])g->charts->flat[half_edge / 3];
    const double *p = flat[half_edge % 3], *q = flat[(half_edge % 3 + 1) % 3];
    double distance = hypot(0.5 * (p[0] + q[0]) - g->seed[0], 0.5 * (p[1] + q[1]) - g->seed[1]);
    sp_vec3 here = sp_triangle_normal(g->mesh, half_edge / 3),
            there = sp_triangle_normal(g->mesh, g->twin[half_edge] / 3);
    return distance * (1 + FOLD_WEIGHT * (1 - sp_dot(here, there)));
}

/* Adds a triangle whose `flat` is set to the chart, and its free edges to the border. */
static bool lay(growth *g, uint32_t triangle, sp_error *error)
{
    double(*flat)[2] = g->charts->flat[triangle];
    g->charts->chart[triangle] = (uint32_t)g->charts->chart_count;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++) {
            if (!isfinite(flat[i][k]))
                return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                               "triangle %u is too large or too thin to be laid flat", triangle);
            g->low[k] = fmin(g->low[k], flat[i][k]);
            g->high[k] = fmax(g->high[k], flat[i][k]);
        }
    }
    if (!sp_plane_add(g->plane, triangle, error))
        return false;
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t twin = g->twin[3 * triangle + i];
        if (twin == SP_NONE || g->charts->chart[twin / 3] != SP_NONE)
            continue;
        if (!push(&g->border, (candidate){cost_of(g, 3 * triangle + i), 3 * triangle + i})) {
            sp_fail_memory(error);
            return false;
        }
    }
    return true;
}

/* Lays the first triangle of a chart with its first edge on the x axis. */
static bool lay_seed(growth *g, uint32_t triangle, sp_error *error)
{
    double(*flat)[2] = g->charts->flat[triangle];
    sp_vec3 a = corner_of(g, triangle, 0), b = corner_of(g, triangle, 1), c = corner_of(g, triangle, 2);
    flat[0][0] = flat[0][1] = flat[1][1] = 0;
    flat[1][0] = sp_distance(a, b);
    third_corner(a, b, c, flat[0], flat[1], flat[2]);
    for (int k = 0; k < 2; k++) {
        g->seed[k] = (flat[0][k] + flat[1][k] + flat[2][k]) / 3;
        g->low[k] = INFINITY;
        g->high[k] = -INFINITY;
    }
    sp_plane_clear(g->plane);
    return lay(g, triangle, error);
}

/* Unfolds the triangle across a half-edge of the border into the chart, unless it overlaps the chart or exceeds the
 * extent. */
static bool grow_across(growth *g, uint32_t half_edge, sp_error *error)
{
    uint32_t twin = g->twin[half_edge], triangle = twin / 3, i = twin % 3;
    if (g->charts->chart[triangle] != SP_NONE)
        return true;
    const double(*parent)[2] = (const double(*)[2])g->charts->flat[half_edge / 3];
    double flat[3][2];
    for (int k = 0; k < 2; k++) {
        flat[i][k] = parent[(half_edge % 3 + 1) % 3][k];
        flat[(i + 1) % 3][k] = parent[half_edge % 3][k];
    }
    third_corner(corner_of(g, triangle, i), corner_of(g, triangle, i + 1), corner_of(g, triangle, i + 2), flat[i],
                 flat[(i + 1) % 3], flat[(i + 2) % 3]);
    if (!fits_extent(g, (const double(*)[2])flat) || sp_plane_overlaps(g->plane, (const double(*)[2])flat, 1))
        return true;
    for (int corner = 0; corner < 3; corner++)
        for (int k = 0; k < 2; k++)
            g->charts->flat[triangle][corner][k] = flat[corner][k];
    return lay(g, triangle, error);
}

static bool grow_all(growth *g, sp_error *error)
{
    for (uint32_t seed = 0; seed < g->mesh->triangle_count; seed++) {
        if (g->charts->chart[seed] != SP_NONE)
            continue;
        if (!lay_seed(g, seed, error))
            return false;
        while (g->border.count)
            if (!grow_across(g, pop(&g->border).half_edge, error))
                return false;
        g->charts->chart_count++;
    }
    return true;
}

bool sp_unfold(sp_charts *charts, const sp_mesh *mesh, const uint32_t *twin, sp_error *error)
{
    growth g = {.charts = charts, .mesh = mesh, .twin = twin};
    for (size_t t = 0; t < mesh->triangle_count; t++)
        charts->chart[t] = SP_NONE;
    charts->chart_count = 0;
    g.plane = sp_plane_create((const double(*)[3][2])charts->flat, mesh->triangle_count, error);
    bool done = g.plane && grow_all(&g, error);
    sp_plane_destroy(g.plane);
    free(g.border.items);
    return done;
}
