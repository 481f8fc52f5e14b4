/* The least bounding box has a side along an edge of the convex hull (Freeman and Shapira, 1975). */
#include "atlas/orient.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define EDGES_TRIED 1000 /* of a hull */

typedef struct {
    double x, y;
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

/* Keeps what may lie on the hull: all but what is inside of the box between the outermost points of the diagonals. */
static size_t outer_points(const double (*at)[2], size_t count, point *points)
{
    point out[4] = {{0, 0}};
    double far[4] = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 4; k++) {
            double along = (k & 1 ? -at[i][0] : at[i][0]) + (k & 2 ? -at[i][1] : at[i][1]);
            if (along > far[k]) {
                far[k] = along;
                out[k] = (point){at[i][0], at[i][1]};
            }
        }
    double right = fmin(out[0].x, out[2].x), left = fmax(out[1].x, out[3].x);
    double top = fmin(out[0].y, out[1].y), bottom = fmax(out[2].y, out[3].y);
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (!(at[i][0] > left && at[i][0] < right && at[i][1] > bottom && at[i][1] < top))
            points[kept++] = (point){at[i][0], at[i][1]};
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

static void measure(sp_least_box *t, const point *hull, size_t count)
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

static sp_least_box best_turn(const point *hull, size_t count, double extent)
{
    sp_least_box best = {.memory = true};
    for (size_t i = 0; i < count; i += 1 + count / EDGES_TRIED) {
        point p = hull[i], q = hull[(i + 1) % count];
        double length = hypot(q.x - p.x, q.y - p.y);
        if (!(length > 0))
            continue;
        sp_least_box t = {.cosine = (q.x - p.x) / length, .sine = (q.y - p.y) / length, .fits = true, .memory = true};
        measure(&t, hull, count);
        /* Clearly less, so that round-off does not choose among equals. */
        if (fmax(t.width, t.height) <= extent &&
            (!best.fits || t.width * t.height < best.width * best.height * (1 - 1e-9)))
            best = t;
    }
    if (!best.fits || best.width >= best.height)
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
        found = best_turn(hull, convex_hull(points, count, hull), extent);
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
