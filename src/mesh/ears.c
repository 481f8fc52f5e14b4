/* Ear clipping: G. H. Meisters, "Polygons Have Ears" (1975). A corner is an ear, and its triangle is cut off, where no
 * other corner that is not convex lies in that triangle; these are found by a grid, as in M. Held, "FIST: Fast
 * Industrial-Strength Triangulation of Polygons" (2001). Corners in line are no ears, so that none is left lying on an
 * edge of a triangle, where neighbours would not fit. */
#include "mesh/ears.h"

#include "mesh/predicate.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#define NOBODY UINT32_MAX
#define MOST_STEPS 5000 /* for every corner: cells and corners that are looked at */

typedef enum { CONVEX, FLAT, REFLEX, GONE } kind;

typedef struct {
    const double (*points)[2];
    uint32_t count, left;
    uint32_t *before, *after; /* [count], neighbours of those that are left */
    uint8_t *kind;            /* [count] */
    uint32_t *queue;          /* [count], a ring of those to be tried */
    uint32_t queue_first, queue_size;
    bool *queued;            /* [count] */
    uint32_t edge;           /* of the grid, cells */
    double low[2], cells[2]; /* where it begins, cells per length */
    uint32_t *first, *next;  /* [edge * edge], [count]: lists of those in a cell that are not convex */
    bool lenient;            /* what lies on the rim of an ear is no matter */
    uint64_t steps;          /* that may still be made */
    uint32_t (*triangles)[3];
} clipping;

static bool is_same(const double a[2], const double b[2])
{
    return a[0] == b[0] && a[1] == b[1];
}

static double square(const double a[2], const double b[2])
{
    return (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]);
}

/* The orientation up to which the mesh would leave a triangle out. */
static double flatness(const double a[2], const double b[2], const double d[2])
{
    return 64 * DBL_EPSILON * fmax(square(a, b), fmax(square(b, d), square(d, a)));
}

static kind kind_of(const clipping *c, uint32_t corner)
{
    const double *a = c->points[c->before[corner]], *b = c->points[corner], *d = c->points[c->after[corner]];
    double turn = sp_orientation(a, b, d);
    return fabs(turn) <= flatness(a, b, d) ? FLAT : turn > 0 ? CONVEX : REFLEX;
}

static uint32_t cell_along(const clipping *c, double at, int axis)
{
    double cell = floor((at - c->low[axis]) * c->cells[axis]);
    return cell > 0 ? (uint32_t)fmin(cell, c->edge - 1.0) : 0;
}

/* Lists what is not convex: cutting makes no corner less convex. */
static void fill_grid(clipping *c)
{
    for (int axis = 0; axis < 2; axis++) {
        double high = -INFINITY;
        c->low[axis] = INFINITY;
        for (uint32_t i = 0; i < c->count; i++) {
            c->low[axis] = fmin(c->low[axis], c->points[i][axis]);
            high = fmax(high, c->points[i][axis]);
        }
        c->cells[axis] = high > c->low[axis] ? c->edge / (high - c->low[axis]) : 0;
    }
    for (size_t i = 0; i < (size_t)c->edge * c->edge; i++)
        c->first[i] = NOBODY;
    for (uint32_t i = c->count; i-- > 0;) {
        if (c->kind[i] == CONVEX)
            continue;
        size_t cell = cell_along(c, c->points[i][1], 1) * (size_t)c->edge + cell_along(c, c->points[i][0], 0);
        c->next[i] = c->first[cell];
        c->first[cell] = i;
    }
}

/* Whether an edge at `other`, which lies where corner k of the triangle does, runs into the triangle. */
static bool runs_in(const clipping *c, const double *const triangle[3], int k, uint32_t other)
{
    const double *at = triangle[k], *left = triangle[(k + 1) % 3], *right = triangle[(k + 2) % 3];
    const double *ends[2] = {c->points[c->before[other]], c->points[c->after[other]]};
    for (int i = 0; i < 2; i++)
        if (sp_orientation(at, left, ends[i]) > 0 && sp_orientation(at, ends[i], right) > 0)
            return true;
    return false;
}

/* Whether the point is certainly outside, so that most are told without an exact determinant. */
static bool is_off(const double *const triangle[3], const double p[2])
{
    for (int k = 0; k < 3; k++) {
        const double *a = triangle[k], *b = triangle[(k + 1) % 3];
        double left = (b[0] - a[0]) * (p[1] - a[1]), right = (b[1] - a[1]) * (p[0] - a[0]);
        if (left - right < -128 * DBL_EPSILON * (fabs(left) + fabs(right) + square(a, b)))
            return true;
    }
    return false;
}

static bool is_in_the_way(const clipping *c, const double *const triangle[3], uint32_t other)
{
    const double *p = c->points[other];
    if (is_off(triangle, p))
        return false;
    for (int k = 0; k < 3; k++)
        if (is_same(p, triangle[k]))
            return runs_in(c, triangle, k, other);
    for (int k = 0; k < 2; k++) {
        double side = sp_orientation(triangle[k], triangle[k + 1], p);
        if (side < 0 || (c->lenient && !(side > 0)))
            return false;
    }
    double side = sp_orientation(triangle[2], triangle[0], p), flat = flatness(triangle[2], triangle[0], p);
    return c->lenient ? side > flat : side >= -flat;
}

/* Looks through one cell, and forgets there what has become convex or gone. */
static bool is_free_of(clipping *c, const double *const triangle[3], const uint32_t corners[3], uint32_t *list)
{
    while (*list != NOBODY && c->steps > 0) {
        uint32_t other = *list;
        c->steps--;
        if (c->kind[other] == CONVEX || c->kind[other] == GONE) {
            *list = c->next[other];
            continue;
        }
        if (other != corners[0] && other != corners[1] && other != corners[2] && is_in_the_way(c, triangle, other))
            return false;
        list = &c->next[other];
    }
    return true;
}

static bool is_free(clipping *c, const uint32_t corners[3])
{
    const double *const triangle[3] = {c->points[corners[0]], c->points[corners[1]], c->points[corners[2]]};
    uint32_t from[2], to[2];
    for (int axis = 0; axis < 2; axis++) {
        double a = triangle[0][axis], b = triangle[1][axis], d = triangle[2][axis];
        from[axis] = cell_along(c, fmin(a, fmin(b, d)), axis);
        to[axis] = cell_along(c, fmax(a, fmax(b, d)), axis);
    }
    for (uint32_t y = from[1]; y <= to[1]; y++)
        for (uint32_t x = from[0]; x <= to[0] && c->steps > 0; x++) {
            c->steps--;
            if (!is_free_of(c, triangle, corners, &c->first[(size_t)y * c->edge + x]))
                return false;
        }
    return c->steps > 0;
}

/* Also what turns back on itself, such as what is left of an edge there and back: its triangle has no area. */
static bool is_ear(clipping *c, uint32_t corner)
{
    const uint32_t corners[3] = {c->before[corner], corner, c->after[corner]};
    const double *a = c->points[corners[0]], *b = c->points[corner], *d = c->points[corners[2]];
    if (c->kind[corner] == FLAT)
        return (a[0] - b[0]) * (d[0] - b[0]) + (a[1] - b[1]) * (d[1] - b[1]) > 0 || is_same(a, b) || is_same(b, d);
    return c->kind[corner] == CONVEX && is_free(c, corners);
}

static void enqueue(clipping *c, uint32_t corner)
{
    if (c->queued[corner])
        return;
    c->queued[corner] = true;
    c->queue[((uint64_t)c->queue_first + c->queue_size++) % c->count] = corner;
}

static uint32_t dequeue(clipping *c)
{
    uint32_t corner = c->queue[c->queue_first];
    c->queue_first = (c->queue_first + 1) % c->count;
    c->queue_size--;
    c->queued[corner] = false;
    return corner;
}

/* Every second one first, so that triangles do not all meet in one corner. */
static void enqueue_all(clipping *c)
{
    for (uint32_t parity = 0; parity < 2; parity++)
        for (uint32_t i = parity; i < c->count; i += 2)
            if (c->kind[i] != GONE)
                enqueue(c, i);
    c->steps -= c->steps < c->count ? c->steps : c->count;
}

static void clip(clipping *c, uint32_t corner)
{
    uint32_t before = c->before[corner], after = c->after[corner], *triangle = c->triangles[c->count - c->left--];
    triangle[0] = before;
    triangle[1] = corner;
    triangle[2] = after;
    c->kind[corner] = GONE;
    c->after[before] = after;
    c->before[after] = before;
    c->kind[before] = (uint8_t)kind_of(c, before);
    c->kind[after] = (uint8_t)kind_of(c, after);
    enqueue(c, before);
    enqueue(c, after);
}

/* Where there is no ear: a corner in line is given up. */
static bool clip_flat(clipping *c)
{
    for (uint32_t i = 0; i < c->count; i++)
        if (c->kind[i] == FLAT) {
            clip(c, i);
            return true;
        }
    return false;
}

/* Once the queue is empty; `any`: whether there was an ear since it was filled. False: there is none, in any way. */
static bool try_again(clipping *c, bool *any)
{
    if (!*any && c->lenient && !clip_flat(c))
        return false;
    c->lenient = c->lenient || !*any;
    *any = false;
    enqueue_all(c);
    return true;
}

static bool clip_all(clipping *c)
{
    bool any = true;
    while (c->left > 3) {
        if (!c->steps || (!c->queue_size && !try_again(c, &any)))
            return false;
        uint32_t corner = dequeue(c);
        if (c->left > 3 && c->kind[corner] != GONE && is_ear(c, corner)) {
            clip(c, corner);
            any = true;
        }
    }
    uint32_t last = 0;
    while (c->kind[last] == GONE)
        last++;
    bool good = c->kind[last] != REFLEX;
    clip(c, c->after[last]); /* corners stay in their order */
    return good;
}

static uint32_t start(clipping *c)
{
    uint32_t hindering = 0;
    c->left = c->count;
    for (uint32_t i = 0; i < c->count; i++) {
        c->before[i] = i ? i - 1 : c->count - 1;
        c->after[i] = i + 1 < c->count ? i + 1 : 0;
        c->queued[i] = false;
    }
    for (uint32_t i = 0; i < c->count; i++) {
        c->kind[i] = (uint8_t)kind_of(c, i);
        hindering += c->kind[i] != CONVEX;
    }
    return hindering;
}

bool sp_clip_ears(const double (*points)[2], uint32_t count, uint32_t (*triangles)[3], bool *done, sp_error *error)
{
    size_t room = count;
    clipping c = {.points = points,
                  .count = count,
                  .before = malloc(room * sizeof *c.before),
                  .after = malloc(room * sizeof *c.after),
                  .kind = malloc(room),
                  .queue = malloc(room * sizeof *c.queue),
                  .queued = malloc(room),
                  .next = malloc(room * sizeof *c.next),
                  .steps = (uint64_t)MOST_STEPS * count,
                  .triangles = triangles};
    bool good = c.before && c.after && c.kind && c.queue && c.queued && c.next;
    if (good) {
        c.edge = (uint32_t)sqrt(start(&c)) + 1;
        c.first = malloc((size_t)c.edge * c.edge * sizeof *c.first);
    }
    good = (good && c.first) || sp_fail_memory(error);
    if (good) {
        fill_grid(&c);
        *done = clip_all(&c);
    }
    free(c.before);
    free(c.after);
    free(c.kind);
    free(c.queue);
    free(c.queued);
    free(c.next);
    free(c.first);
    return good;
}
