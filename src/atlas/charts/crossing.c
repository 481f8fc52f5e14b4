/* Segments are spread over a grid of about as many cells as there are segments; a cell that gets many is spread over a
 * grid of its own. Within a cell each pair is tested with exact orientations. */
#include "atlas/charts/crossing.h"

#include "mesh/predicate.h"

#include <math.h>
#include <stdlib.h>

#define FEW 12          /* segments of a cell that are tested pair by pair */
#define MOST_CELLS 4096 /* along one side of a grid */

typedef struct {
    double low[2], high[2];
} box;

/* Two segments from one point run into each other where they lie on one ray, or nearly. */
static bool same_ray(const double shared[2], const double a[2], const double b[2])
{
    double x = a[0] - shared[0], y = a[1] - shared[1], z = b[0] - shared[0], w = b[1] - shared[1];
    double along = x * z + y * w, across = fabs(x * w - y * z);
    return along > 0 && across <= SP_CLEARANCE * along;
}

static double squared_length(const sp_segment *s)
{
    return (s->q[0] - s->p[0]) * (s->q[0] - s->p[0]) + (s->q[1] - s->p[1]) * (s->q[1] - s->p[1]);
}

static double squared_distance(const sp_segment *s, const double point[2])
{
    double dx = s->q[0] - s->p[0], dy = s->q[1] - s->p[1], x = point[0] - s->p[0], y = point[1] - s->p[1];
    double length = dx * dx + dy * dy, t = length > 0 ? fmin(fmax((x * dx + y * dy) / length, 0), 1) : 0;
    return (x - t * dx) * (x - t * dx) + (y - t * dy) * (y - t * dy);
}

static bool cross(const sp_segment *s, const sp_segment *t)
{
    double a = sp_orientation(s->p, s->q, t->p), b = sp_orientation(s->p, s->q, t->q);
    if (!((a > 0 && b < 0) || (a < 0 && b > 0)))
        return false;
    double c = sp_orientation(t->p, t->q, s->p), d = sp_orientation(t->p, t->q, s->q);
    return (c > 0 && d < 0) || (c < 0 && d > 0);
}

/* Segments that do not cross are nearest at an end of one. */
static bool touch(const sp_segment *s, const sp_segment *t)
{
    int shared = (s->from == t->from) + (s->from == t->to) + (s->to == t->from) + (s->to == t->to);
    if (shared >= 2)
        return true;
    if (s->from == t->from || s->from == t->to)
        return same_ray(s->p, s->q, s->from == t->from ? t->q : t->p);
    if (s->to == t->from || s->to == t->to)
        return same_ray(s->q, s->p, s->to == t->from ? t->q : t->p);
    double near = SP_CLEARANCE * SP_CLEARANCE * fmin(squared_length(s), squared_length(t));
    return squared_distance(s, t->p) <= near || squared_distance(s, t->q) <= near ||
           squared_distance(t, s->p) <= near || squared_distance(t, s->q) <= near || cross(s, t);
}

static bool apart(const sp_segment *s, const sp_segment *t)
{
    double gap = SP_CLEARANCE * (fabs(s->q[0] - s->p[0]) + fabs(s->q[1] - s->p[1]));
    for (int k = 0; k < 2; k++)
        if (fmax(s->p[k], s->q[k]) < fmin(t->p[k], t->q[k]) - gap ||
            fmax(t->p[k], t->q[k]) < fmin(s->p[k], s->q[k]) - gap)
            return true;
    return false;
}

typedef struct {
    box around;
    double cell[2];
    uint32_t columns, rows;
} grid;

/* The rows that a segment may touch within one column of the grid, widened against round-off. */
static bool rows_in_column(const grid *g, const sp_segment *s, uint32_t column, uint32_t rows[2])
{
    double left = g->around.low[0] + column * g->cell[0], right = left + g->cell[0], slack = 1e-5 * g->cell[0];
    const double *p = s->p[0] <= s->q[0] ? s->p : s->q, *q = p == s->p ? s->q : s->p;
    if (q[0] < left - slack || p[0] > right + slack)
        return false;
    double width = q[0] - p[0], low = p[1], high = q[1];
    if (width > 4 * slack) {
        low = p[1] + (q[1] - p[1]) * fmin(fmax((left - slack - p[0]) / width, 0), 1);
        high = p[1] + (q[1] - p[1]) * fmin(fmax((right + slack - p[0]) / width, 0), 1);
    }
    double first = floor((fmin(low, high) - g->around.low[1]) / g->cell[1] - 1e-5);
    double last = floor((fmax(low, high) - g->around.low[1]) / g->cell[1] + 1e-5);
    if (last < 0 || first >= g->rows)
        return false;
    rows[0] = (uint32_t)fmax(first, 0);
    rows[1] = (uint32_t)fmin(last, g->rows - 1.0);
    return true;
}

static void columns_of(const grid *g, const sp_segment *s, uint32_t columns[2])
{
    double first = floor((fmin(s->p[0], s->q[0]) - g->around.low[0]) / g->cell[0] - 1e-5);
    double last = floor((fmax(s->p[0], s->q[0]) - g->around.low[0]) / g->cell[0] + 1e-5);
    columns[0] = (uint32_t)fmin(fmax(first, 0), g->columns - 1.0);
    columns[1] = (uint32_t)fmin(fmax(last, 0), g->columns - 1.0);
}

/* Counts each segment in each of its cells, or enters it there: `start` [cells + 1], filled from the end of each. */
static void spread(const grid *g, const sp_segment *all, const uint32_t *list, size_t count, uint32_t *start,
                   uint32_t *members)
{
    for (size_t i = 0; i < count; i++) {
        const sp_segment *s = &all[list[i]];
        uint32_t columns[2], rows[2];
        columns_of(g, s, columns);
        for (uint32_t column = columns[0]; column <= columns[1]; column++) {
            if (!rows_in_column(g, s, column, rows))
                continue;
            for (uint32_t row = rows[0]; row <= rows[1]; row++) {
                size_t cell = (size_t)column * g->rows + row;
                if (members)
                    members[--start[cell]] = list[i];
                else
                    start[cell]++;
            }
        }
    }
}

static grid grid_for(box around, size_t count)
{
    grid g = {.around = around};
    double width = around.high[0] - around.low[0], height = around.high[1] - around.low[1];
    double size = fmax(sqrt(width * height / (double)count), fmax(width, height) / fmin((double)count, MOST_CELLS));
    g.columns = size > 0 ? (uint32_t)fmin(fmax(ceil(width / size), 1), MOST_CELLS) : 1;
    g.rows = size > 0 ? (uint32_t)fmin(fmax(ceil(height / size), 1), MOST_CELLS) : 1;
    g.cell[0] = width > 0 ? width / g.columns : 1;
    g.cell[1] = height > 0 ? height / g.rows : 1;
    return g;
}

static void test_pairs(const sp_segment *all, const uint32_t *list, size_t count, sp_crossing *found)
{
    for (size_t i = 0; i < count && !found->crossing; i++)
        for (size_t j = i + 1; j < count && !found->crossing; j++) {
            found->tests++;
            if (!apart(&all[list[i]], &all[list[j]]))
                found->crossing = touch(&all[list[i]], &all[list[j]]);
        }
}

/* Spreads the segments and finds where each cell's begin; NULL when memory runs out. */
static uint32_t *spread_all(const grid *g, const sp_segment *all, const uint32_t *list, size_t count,
                            uint32_t **members)
{
    size_t cells = (size_t)g->columns * g->rows;
    uint32_t *start = calloc(cells + 1, sizeof *start);
    if (!start)
        return NULL;
    spread(g, all, list, count, start, NULL);
    for (size_t i = 1; i <= cells; i++)
        start[i] += start[i - 1];
    *members = malloc((start[cells] + 1) * sizeof **members);
    if (*members) {
        spread(g, all, list, count, start, *members);
        return start;
    }
    free(start);
    return NULL;
}

/* Looks through one cell; each grid within it at least halves the pairs to be tested, or is not made. */
static void search(const sp_segment *all, const uint32_t *list, size_t count, box around, sp_crossing *found)
{
    if (count <= FEW) {
        test_pairs(all, list, count, found);
        return;
    }
    grid g = grid_for(around, count);
    size_t cells = (size_t)g.columns * g.rows;
    uint32_t *members, *start = spread_all(&g, all, list, count, &members);
    if (!start) {
        found->memory = false;
        return;
    }
    double pairs = 0;
    for (size_t i = 0; i < cells; i++)
        pairs += (double)(start[i + 1] - start[i]) * (start[i + 1] - start[i]);
    if (pairs > 0.5 * (double)count * (double)count)
        test_pairs(all, list, count, found);
    else
        for (size_t i = 0; i < cells && !found->crossing && found->memory; i++) {
            size_t column = i / g.rows, row = i % g.rows;
            double left = around.low[0] + (double)column * g.cell[0], low = around.low[1] + (double)row * g.cell[1];
            box cell = {{left, low}, {left + g.cell[0], low + g.cell[1]}};
            if (start[i + 1] - start[i] > 1)
                search(all, members + start[i], start[i + 1] - start[i], cell, found);
        }
    free(start);
    free(members);
}

sp_crossing sp_segments_cross(const sp_segment *segments, size_t count)
{
    sp_crossing found = {.memory = true};
    box around = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    uint32_t *list = malloc((count + 1) * sizeof *list);
    if (!list)
        return (sp_crossing){0};
    for (size_t i = 0; i < count; i++) {
        list[i] = (uint32_t)i;
        for (int k = 0; k < 2; k++) {
            around.low[k] = fmin(around.low[k], fmin(segments[i].p[k], segments[i].q[k]));
            around.high[k] = fmax(around.high[k], fmax(segments[i].p[k], segments[i].q[k]));
        }
    }
    search(segments, list, count, around, &found);
    free(list);
    return found;
}
