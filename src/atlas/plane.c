/* A loose quadtree: a triangle hangs in the smallest square that is as wide as its bounding box and holds the box's
 * centre, so it reaches at most half a square beyond. Triangles of any mix of sizes are found in logarithmic time.
 * Follows T. Ulrich, "Loose Octrees", Game Programming Gems (2000). */
#include "atlas/plane.h"

#include <sprayplan/mesh.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    double x, y, half;
    uint32_t child[4]; /* SP_NONE where there is none */
    uint32_t first;    /* triangle, SP_NONE where there is none */
} node;

struct sp_plane {
    const double (*flat)[3][2];
    uint32_t *next; /* [triangle_count], the next triangle in the same node */
    node *nodes;
    size_t count, capacity;
    uint32_t root;
};

typedef struct {
    double low[2], high[2];
} box;

static box box_around(const double t[3][2])
{
    box b;
    for (int k = 0; k < 2; k++) {
        b.low[k] = fmin(t[0][k], fmin(t[1][k], t[2][k]));
        b.high[k] = fmax(t[0][k], fmax(t[1][k], t[2][k]));
    }
    return b;
}

/* The longest edge and the height above it. */
static void edge_and_height(const double t[3][2], double *edge, double *height)
{
    double longest = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        longest = fmax(longest, hypot(t[j][0] - t[i][0], t[j][1] - t[i][1]));
    }
    double twice = (t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[1][1] - t[0][1]) * (t[2][0] - t[0][0]);
    *edge = longest;
    *height = longest > 0 ? fabs(twice) / longest : 0;
}

/* Round-off grows with the length of the edges, however thin the triangles are. */
static double tolerance_of(const double a[3][2], const double b[3][2])
{
    double edge_a, height_a, edge_b, height_b;
    edge_and_height(a, &edge_a, &height_a);
    edge_and_height(b, &edge_b, &height_b);
    return SP_OVERLAP_TOLERANCE * fmin(height_a, height_b) + 1e-9 * fmin(edge_a, edge_b);
}

/* True where an edge of `a` has all of `b` on its outer side, but for `tolerance`. */
static bool separated_by_edge(const double a[3][2], const double b[3][2], double tolerance)
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        double dx = a[j][0] - a[i][0], dy = a[j][1] - a[i][1];
        double bound = -tolerance * sqrt(dx * dx + dy * dy);
        int outside = 0;
        for (int k = 0; k < 3; k++)
            outside += dy * (b[k][0] - a[i][0]) - dx * (b[k][1] - a[i][1]) >= bound;
        if (outside == 3)
            return true;
    }
    return false;
}

bool sp_triangles_overlap(const double a[3][2], const double b[3][2])
{
    /* Separating axes: two convex polygons are apart where an edge of one has the other outside (Ericson 5.2.1). */
    double tolerance = tolerance_of(a, b);
    return !separated_by_edge(a, b, tolerance) && !separated_by_edge(b, a, tolerance);
}

sp_plane *sp_plane_create(const double (*flat)[3][2], size_t triangle_count, sp_error *error)
{
    sp_plane *plane = calloc(1, sizeof *plane);
    if (!plane)
        return sp_fail_memory(error);
    plane->flat = flat;
    plane->root = SP_NONE;
    plane->next = malloc((triangle_count + !triangle_count) * sizeof *plane->next);
    if (!plane->next) {
        sp_plane_destroy(plane);
        return sp_fail_memory(error);
    }
    return plane;
}

void sp_plane_destroy(sp_plane *plane)
{
    if (!plane)
        return;
    free(plane->next);
    free(plane->nodes);
    free(plane);
}

void sp_plane_clear(sp_plane *plane)
{
    plane->count = 0;
    plane->root = SP_NONE;
}

static uint32_t add_node(sp_plane *plane, double x, double y, double half)
{
    if (plane->count == plane->capacity) {
        size_t capacity = plane->capacity ? 2 * plane->capacity : 256;
        node *nodes = capacity < SP_NONE ? realloc(plane->nodes, capacity * sizeof *nodes) : NULL;
        if (!nodes)
            return SP_NONE;
        plane->nodes = nodes;
        plane->capacity = capacity;
    }
    plane->nodes[plane->count] = (node){x, y, half, {SP_NONE, SP_NONE, SP_NONE, SP_NONE}, SP_NONE};
    return (uint32_t)plane->count++;
}

/* Doubles the root towards (x, y) until it holds that point and a box of `size`. */
static bool grow_root(sp_plane *plane, double x, double y, double size)
{
    if (plane->root == SP_NONE) {
        plane->root = add_node(plane, x, y, size);
        return plane->root != SP_NONE;
    }
    for (;;) {
        node old = plane->nodes[plane->root];
        if (fabs(x - old.x) <= old.half && fabs(y - old.y) <= old.half && size <= 2 * old.half)
            return true;
        int right = x >= old.x, up = y >= old.y;
        uint32_t root =
            add_node(plane, old.x + (right ? old.half : -old.half), old.y + (up ? old.half : -old.half), 2 * old.half);
        if (root == SP_NONE)
            return false;
        plane->nodes[root].child[(right ? 0 : 1) + (up ? 0 : 2)] = plane->root;
        plane->root = root;
    }
}

bool sp_plane_add(sp_plane *plane, uint32_t triangle, sp_error *error)
{
    box b = box_around(plane->flat[triangle]);
    double x = 0.5 * (b.low[0] + b.high[0]), y = 0.5 * (b.low[1] + b.high[1]);
    double size = fmax(fmax(b.high[0] - b.low[0], b.high[1] - b.low[1]), 1e-12 * (fabs(x) + fabs(y)) + 1e-300);
    if (!grow_root(plane, x, y, size)) {
        sp_fail_memory(error);
        return false;
    }
    uint32_t at = plane->root;
    while (plane->nodes[at].half >= size) {
        node here = plane->nodes[at];
        int right = x >= here.x, up = y >= here.y, quarter = right + 2 * up;
        uint32_t child = here.child[quarter];
        if (child == SP_NONE) {
            double half = 0.5 * here.half;
            child = add_node(plane, here.x + (right ? half : -half), here.y + (up ? half : -half), half);
            if (child == SP_NONE) {
                sp_fail_memory(error);
                return false;
            }
            plane->nodes[at].child[quarter] = child;
        }
        at = child;
    }
    plane->next[triangle] = plane->nodes[at].first;
    plane->nodes[at].first = triangle;
    return true;
}

static size_t overlaps_below(const sp_plane *plane, uint32_t at, const double triangle[3][2], const box *b,
                             size_t limit, size_t *tests)
{
    const node *here = &plane->nodes[at];
    double reach = 2.000001 * here->half;
    if (b->low[0] > here->x + reach || b->high[0] < here->x - reach || b->low[1] > here->y + reach ||
        b->high[1] < here->y - reach)
        return 0;
    size_t count = 0;
    for (uint32_t t = here->first; t != SP_NONE && count < limit; t = plane->next[t]) {
        box other = box_around(plane->flat[t]);
        ++*tests;
        if (b->low[0] < other.high[0] && b->high[0] > other.low[0] && b->low[1] < other.high[1] &&
            b->high[1] > other.low[1])
            count += sp_triangles_overlap(triangle, plane->flat[t]);
    }
    for (int k = 0; k < 4 && count < limit; k++)
        if (here->child[k] != SP_NONE)
            count += overlaps_below(plane, here->child[k], triangle, b, limit - count, tests);
    return count;
}

size_t sp_plane_overlaps(const sp_plane *plane, const double triangle[3][2], size_t limit, size_t *tests)
{
    if (plane->root == SP_NONE)
        return 0;
    box b = box_around(triangle);
    return overlaps_below(plane, plane->root, triangle, &b, limit, tests);
}
