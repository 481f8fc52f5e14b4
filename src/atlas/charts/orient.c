/* The least bounding box has a side along an edge of the convex hull (Freeman and Shapira, 1975). */
#include "atlas/charts/orient.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define EDGES_TRIED 1000 /* of a hull */

#define ALIKE 1e-9 /* relative differences of less are round-off, and what is chosen then does not depend on them */

typedef struct {
    double x, y;
    uint32_t vertex;
} point;

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

/* Whether the way from o over a to b turns left there, by more than round-off. */
static bool turns_left(point o, point a, point b)
{
    double ax = a.x - o.x, ay = a.y - o.y, bx = b.x - a.x, by = b.y - a.y;
    return ax * by - ay * bx > ALIKE * sqrt((ax * ax + ay * ay) * (bx * bx + by * by));
}

/* Keeps what may lie on the hull: all but what is inside of the box between the outermost points of the diagonals. */
static size_t outer_points(const double (*at)[2], size_t count, point *points)
{
    point out[4] = {{0}};
    double far[4] = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 4; k++) {
            double along = (k & 1 ? -at[i][0] : at[i][0]) + (k & 2 ? -at[i][1] : at[i][1]);
            if (along > far[k]) {
                far[k] = along;
                out[k] = (point){at[i][0], at[i][1], (uint32_t)i};
            }
        }
    double right = fmin(out[0].x, out[2].x), left = fmax(out[1].x, out[3].x);
    double top = fmin(out[0].y, out[1].y), bottom = fmax(out[2].y, out[3].y);
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (!(at[i][0] > left && at[i][0] < right && at[i][1] > bottom && at[i][1] < top))
            points[kept++] = (point){at[i][0], at[i][1], (uint32_t)i};
    return kept;
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

/* Keeps those corners of the hull that round-off could not have made. */
static size_t true_corners(point *hull, size_t size)
{
    double reach = fabs(hull[size / 2].x - hull[0].x) + fabs(hull[size / 2].y - hull[0].y);
    size_t apart = 0, corners = 0;
    for (size_t i = 0; i < size; i++) {
        point last = apart ? hull[apart - 1] : hull[size - 1];
        if (fabs(hull[i].x - last.x) + fabs(hull[i].y - last.y) > ALIKE * reach)
            hull[apart++] = hull[i];
    }
    point last = apart ? hull[apart - 1] : hull[0], first = hull[0];
    for (size_t i = 0; i < apart; i++) {
        point next = i + 1 < apart ? hull[i + 1] : first;
        if (!turns_left(last, hull[i], next))
            continue;
        last = hull[i];
        hull[corners++] = last;
    }
    return corners;
}

static void measure(sp_least_box *t, const point *hull, size_t count)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++) {
        double x = t->cosine * hull[i].x + t->sine * hull[i].y, y = t->cosine * hull[i].y - t->sine * hull[i].x;
        low[0] = fmin(low[0], x);
        low[1] = fmin(low[1], y);
        high[0] = fmax(high[0], x);
        high[1] = fmax(high[1], y);
    }
    t->width = high[0] - low[0];
    t->height = high[1] - low[1];
}

static sp_least_box best_turn(const point *hull, size_t count, double extent)
{
    sp_least_box best = {.memory = true};
    uint32_t vertex = 0; /* where the edge begins */
    for (size_t i = 0; i < count; i += 1 + count / EDGES_TRIED) {
        point p = hull[i], q = hull[(i + 1) % count];
        double length = hypot(q.x - p.x, q.y - p.y);
        if (!(length > 0))
            continue;
        sp_least_box t = {.cosine = (q.x - p.x) / length, .sine = (q.y - p.y) / length, .fits = true, .memory = true};
        measure(&t, hull, count);
        if (fmax(t.width, t.height) > extent)
            continue;
        double area = t.width * t.height, least = best.width * best.height;
        bool less = !best.fits || area < least * (1 - ALIKE);
        if (less || (area < least * (1 + ALIKE) && p.vertex < vertex)) {
            best = t;
            vertex = p.vertex;
        }
    }
    if (!best.fits || best.width >= best.height * (1 - ALIKE))
        return best;
    return (sp_least_box){-best.sine, best.cosine, best.height, best.width, true, true}; /* a quarter further */
}

sp_least_box sp_find_least_box(const sp_sheet *sheet, double extent)
{
    sp_least_box found = {0};
    point *points = malloc((sheet->vertex_count + 1) * sizeof *points);
    if (!points)
        return found;
    size_t count = outer_points((const double(*)[2])sheet->at, sheet->vertex_count, points);
    point *hull = malloc((count + 1) * 2 * sizeof *hull);
    if (hull)
        found = best_turn(hull, true_corners(hull, convex_hull(points, count, hull)), extent);
    free(hull);
    free(points);
    return found;
}

void sp_turn_sheet(sp_sheet *sheet, const sp_least_box *box)
{
    for (size_t v = 0; v < sheet->vertex_count; v++) {
        double x = sheet->at[v][0], y = sheet->at[v][1];
        sheet->at[v][0] = box->cosine * x + box->sine * y;
        sheet->at[v][1] = box->cosine * y - box->sine * x;
    }
}
