/* This work is based on: A. Bowyer, Computing Dirichlet tessellations, and D. F. Watson, Computing the n-dimensional
 * Delaunay tessellation, both in The Computer Journal 24 (1981). */
#include "delaunay.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    int corners[3];
    double x, y, square; /* circumscribed circle */
} triangle;

typedef struct {
    const double (*points)[2];
    int count; /* of the points; the three that follow are the corners of a triangle around all */
    double around[3][2];
    triangle *triangles;
    int triangle_count;
    int (*edges)[2]; /* of the hole that a new point opens */
    int edge_count;
} state;

static const double *point(const state *state, int i)
{
    return i < state->count ? state->points[i] : state->around[i - state->count];
}

static triangle circled(const state *state, int i, int j, int k)
{
    const double *a = point(state, i), *b = point(state, j), *c = point(state, k);
    double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
    double d = 2 * (bx * cy - by * cx), bb = bx * bx + by * by, cc = cx * cx + cy * cy;
    double x = (cy * bb - by * cc) / d, y = (bx * cc - cx * bb) / d;
    return (triangle){{i, j, k}, a[0] + x, a[1] + y, x * x + y * y};
}

/* An edge that comes back in the other direction was inside the hole. */
static void add_edge(state *state, int from, int to)
{
    for (int i = 0; i < state->edge_count; ++i)
        if (state->edges[i][0] == to && state->edges[i][1] == from) {
            memcpy(state->edges[i], state->edges[--state->edge_count], sizeof *state->edges);
            return;
        }
    state->edges[state->edge_count][0] = from;
    state->edges[state->edge_count++][1] = to;
}

static void insert(state *state, int p)
{
    const double *at = point(state, p);
    state->edge_count = 0;
    for (int i = 0; i < state->triangle_count;) {
        triangle *t = &state->triangles[i];
        double x = at[0] - t->x, y = at[1] - t->y;
        if (x * x + y * y < t->square) {
            for (int j = 0; j < 3; ++j)
                add_edge(state, t->corners[j], t->corners[(j + 1) % 3]);
            *t = state->triangles[--state->triangle_count];
        } else {
            ++i;
        }
    }
    for (int i = 0; i < state->edge_count; ++i)
        state->triangles[state->triangle_count++] = circled(state, state->edges[i][0], state->edges[i][1], p);
}

static int (*inner_triangles(const state *state, int *count))[3]
{
    int(*inner)[3] = malloc(((size_t)state->triangle_count + 1) * sizeof *inner);
    *count = 0;
    for (int i = 0; inner && i < state->triangle_count; ++i) {
        const int *c = state->triangles[i].corners;
        if (c[0] < state->count && c[1] < state->count && c[2] < state->count)
            memcpy(inner[(*count)++], c, sizeof *inner);
    }
    return inner;
}

int (*delaunay(const double (*points)[2], int count, int *triangle_count))[3]
{
    double far = 0;
    for (int i = 0; i < count; ++i)
        far = fmax(far, hypot(points[i][0], points[i][1]));
    far = 1000 * far + 1;
    /* A triangulation of n + 3 points has fewer than 2 n + 6 triangles, and a hole no more edges than points. */
    size_t most = 2 * (size_t)count + 8;
    state state = {.points = points, .count = count, .around = {{-far, -far}, {far, -far}, {0, far}}};
    state.triangles = malloc(most * sizeof *state.triangles);
    state.edges = malloc(3 * most * sizeof *state.edges);
    int(*result)[3] = NULL;
    if (state.triangles && state.edges) {
        state.triangles[state.triangle_count++] = circled(&state, count, count + 1, count + 2);
        for (int i = 0; i < count; ++i)
            insert(&state, i);
        result = inner_triangles(&state, triangle_count);
    }
    free(state.triangles);
    free(state.edges);
    return result;
}
