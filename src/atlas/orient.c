/* The least bounding box of a chart has a side along an edge of its convex hull (Freeman and Shapira, 1975). */
#include "atlas/orient.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
    double x, y;
} point;

/* The turn that takes (cosine, sine) to the x axis, and the box that results. */
typedef struct {
    double cosine, sine, width, height;
} turn;

static int by_place(const void *a, const void *b)
{
    const point *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return (p->y > q->y) - (p->y < q->y);
}

static double left_of(point o, point a, point b)
{
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/* The convex hull, anticlockwise (Andrew's monotone chain, 1979). `points` gets sorted; hull holds 2 count at most. */
static size_t convex_hull(point *points, size_t count, point *hull)
{
    qsort(points, count, sizeof *points, by_place);
    size_t size = 0;
    for (size_t i = 0; i < count; i++) {
        while (size >= 2 && left_of(hull[size - 2], hull[size - 1], points[i]) <= 0)
            size--;
        hull[size++] = points[i];
    }
    for (size_t i = count - 1, lower = size + 1; i-- > 0;) {
        while (size >= lower && left_of(hull[size - 2], hull[size - 1], points[i]) <= 0)
            size--;
        hull[size++] = points[i];
    }
    return size - 1;
}

static void measure(turn *t, const point *hull, size_t count)
{
    point low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++) {
        double x = t->cosine * hull[i].x + t->sine * hull[i].y, y = t->cosine * hull[i].y - t->sine * hull[i].x;
        low = (point){fmin(low.x, x), fmin(low.y, y)};
        high = (point){fmax(high.x, x), fmax(high.y, y)};
    }
    t->width = high.x - low.x;
    t->height = high.y - low.y;
}

#define EDGES_TRIED 1000 /* of a hull */

static turn best_turn(const point *hull, size_t count, double extent)
{
    turn best = {.cosine = 1};
    measure(&best, hull, count);
    for (size_t i = 0; i < count; i += 1 + count / EDGES_TRIED) {
        point p = hull[i], q = hull[(i + 1) % count];
        double length = hypot(q.x - p.x, q.y - p.y);
        if (!(length > 0))
            continue;
        turn t = {.cosine = (q.x - p.x) / length, .sine = (q.y - p.y) / length};
        measure(&t, hull, count);
        /* Clearly less, so that round-off does not choose among equals. */
        if (fmax(t.width, t.height) <= extent && t.width * t.height < best.width * best.height * (1 - 1e-9))
            best = t;
    }
    if (best.width >= best.height)
        return best;
    return (turn){-best.sine, best.cosine, best.height, best.width}; /* a quarter further */
}

static void apply(turn t, double flat[3][2])
{
    for (int i = 0; i < 3; i++) {
        double x = flat[i][0], y = flat[i][1];
        flat[i][0] = t.cosine * x + t.sine * y;
        flat[i][1] = t.cosine * y - t.sine * x;
    }
}

/* start [chart_count + 1] and members [triangle_count]: the triangles of each chart. */
static void list_members(const sp_charts *charts, uint32_t *start, uint32_t *members)
{
    for (size_t c = 0; c <= charts->chart_count; c++)
        start[c] = 0;
    for (size_t t = 0; t < charts->triangle_count; t++)
        start[charts->chart[t]]++;
    for (size_t c = 1; c <= charts->chart_count; c++)
        start[c] += start[c - 1];
    for (size_t t = charts->triangle_count; t-- > 0;)
        members[--start[charts->chart[t]]] = (uint32_t)t;
}

bool sp_orient_charts(sp_charts *charts, sp_error *error)
{
    size_t corners = 3 * charts->triangle_count;
    uint32_t *start = malloc((charts->chart_count + 1) * sizeof *start);
    uint32_t *members = malloc((corners + 1) * sizeof *members);
    point *points = malloc((corners + 1) * sizeof *points), *hull = malloc((corners + 1) * 2 * sizeof *hull);
    bool done = start && members && points && hull;
    if (done)
        list_members(charts, start, members);
    else
        sp_fail_memory(error);
    for (size_t c = 0; done && c < charts->chart_count; c++) {
        size_t count = 0;
        for (uint32_t i = start[c]; i < start[c + 1]; i++)
            for (int k = 0; k < 3; k++)
                points[count++] = (point){charts->flat[members[i]][k][0], charts->flat[members[i]][k][1]};
        turn t = best_turn(hull, convex_hull(points, count, hull), charts->extent);
        for (uint32_t i = start[c]; i < start[c + 1]; i++)
            apply(t, charts->flat[members[i]]);
    }
    free(start);
    free(members);
    free(points);
    free(hull);
    return done;
}
