/* Exact areas by signed accumulation along the edges, as font rasterisers do: an edge gives every pixel that it passes
 * what lies to the right of it there, and what it climbs to all further pixels of the row (S. Barrett, "How the
 * stb_truetype anti-aliased software rasterizer v2 works", 2015). */
#include "atlas/texels/raster.h"
#include "mesh/min_max.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void sort_by_height(double corner[3][2])
{
    for (int i = 0; i < 3; i++) {
        int j = i == 2 ? 0 : i, k = j + 1; /* 0 1, 1 2, 0 1 */
        if (corner[k][1] < corner[j][1]) {
            double swap[2];
            memcpy(swap, corner[j], sizeof swap);
            memcpy(corner[j], corner[k], sizeof swap);
            memcpy(corner[k], swap, sizeof swap);
        }
    }
}

bool sp_raster_begin(sp_raster *raster, const double uv[3][2], sp_raster_kind kind)
{
    double slack = kind == SP_RASTER_TOUCHED ? SP_RASTER_SLACK : 0, low[2], high[2];
    for (int k = 0; k < 2; k++) {
        low[k] = floor(sp_lesser(uv[0][k], sp_lesser(uv[1][k], uv[2][k])) - slack);
        for (int i = 0; i < 3; i++)
            raster->corner[i][k] = uv[i][k] - low[k]; /* loses nothing */
        assert(low[k] >= 0);
        high[k] = sp_greater(raster->corner[0][k], sp_greater(raster->corner[1][k], raster->corner[2][k]));
    }
    double(*c)[2] = raster->corner;
    raster->kind = kind;
    raster->width = high[0] - sp_lesser(c[0][0], sp_lesser(c[1][0], c[2][0]));
    raster->base_x = (uint32_t)low[0];
    raster->base_y = (uint32_t)low[1];
    raster->columns = (uint32_t)sp_greater(ceil(high[0] + slack), 1);
    raster->rows = (uint32_t)sp_greater(ceil(high[1] + slack), 1);
    raster->row = 0;
    raster->cut_at = -1;
    raster->flat = 0.5 * ((c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) - (c[1][1] - c[0][1]) * (c[2][0] - c[0][0]));
    sort_by_height(c);
    raster->height = c[2][1] - c[0][1];
    /* Above 0 where the middle corner lies right of the edge from the lowest to the highest. */
    raster->turn = (c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) - (c[1][1] - c[0][1]) * (c[2][0] - c[0][0]);
    size_t need = (size_t)raster->columns + 1;
    if (kind == SP_RASTER_AREAS && need > raster->capacity) {
        double *area = realloc(raster->area, 2 * need * sizeof *area);
        if (!area)
            return false;
        raster->area = area;
        raster->capacity = 2 * need;
    }
    return true;
}

void sp_raster_free(sp_raster *raster)
{
    free(raster->area);
    *raster = (sp_raster){0};
}

static double at_height(const double p[2], const double q[2], double y)
{
    if (y <= p[1])
        return p[0];
    if (y >= q[1])
        return q[0];
    double x = p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
    return sp_lesser(sp_greater(x, sp_lesser(p[0], q[0])), sp_greater(p[0], q[0]));
}

/* Where a row cuts the triangle: the long edge, and the two short ones, which meet at the middle corner. */
typedef struct {
    double low, high;           /* heights */
    double long_low, long_high; /* x of the long edge there */
    double short_low, short_high;
    bool bent; /* the middle corner lies between them */
} strip;

static strip cut(sp_raster *raster, double low, double high)
{
    const double(*c)[2] = (const double(*)[2])raster->corner;
    strip s = {sp_greater(low, c[0][1]), sp_lesser(high, c[2][1]), 0, 0, 0, 0, false};
    if (s.low == raster->cut_at) {
        s.long_low = raster->cut_long;
        s.short_low = raster->cut_short;
    } else {
        s.long_low = at_height(c[0], c[2], s.low);
        s.short_low = s.low < c[1][1] ? at_height(c[0], c[1], s.low) : at_height(c[1], c[2], s.low);
    }
    s.long_high = at_height(c[0], c[2], s.high);
    s.short_high = s.high <= c[1][1] ? at_height(c[0], c[1], s.high) : at_height(c[1], c[2], s.high);
    raster->cut_at = s.high;
    raster->cut_long = s.long_high;
    raster->cut_short = s.short_high;
    s.bent = c[1][1] > s.low && c[1][1] < s.high;
    return s;
}

/* Adds what lies right of the edge from (xa, ya) up to (xb, yb), times `sign`, to area[0] and on, in such a way that
 * the sums from area[0] to area[k] are the pixels' areas. */
static void accumulate(double *area, double xa, double ya, double xb, double yb, double sign)
{
    double rise = sign * (yb - ya), left = sp_lesser(xa, xb), right = sp_greater(xa, xb);
    uint32_t first = (uint32_t)left, last = (uint32_t)right;
    if (first == last) {
        double here = rise * (first + 1 - 0.5 * (left + right));
        area[first] += here;
        area[first + 1] += rise - here;
        return;
    }
    double slope = rise / (right - left), part = slope * (first + 1 - left);
    double here = 0.5 * part * (first + 1 - left);
    area[first] += here;
    double carried = part - here; /* what goes to the pixel in hand from those before */
    for (uint32_t k = first + 1; k < last; k++) {
        area[k] += carried + 0.5 * slope;
        carried = 0.5 * slope;
    }
    part = slope * (right - last);
    here = part * (1 - 0.5 * (right - last));
    area[last] += carried + here;
    area[last + 1] += part - here;
}

static double within(double x, double low, double high)
{
    return sp_lesser(sp_greater(x - low, 0), high - low);
}

/* `first` and `end` are the strip's columns. What was dropped as slivers beyond them goes to the outermost. */
static void measure(sp_raster *raster, const strip *s, uint32_t first, uint32_t end)
{
    const double *middle = raster->corner[1];
    double sign = raster->turn >= 0 ? 1 : -1, width_low = sign * (s->short_low - s->long_low),
           width_high = sign * (s->short_high - s->long_high);
    if (end - first == 1) { /* trapezes from their widths, which keeps needles exact */
        if (!s->bent) {
            raster->area[0] = 0.5 * (s->high - s->low) * (width_low + width_high);
            return;
        }
        double bend = sign * (middle[0] - at_height(raster->corner[0], raster->corner[2], middle[1]));
        raster->area[0] =
            0.5 * ((middle[1] - s->low) * (width_low + bend) + (s->high - middle[1]) * (bend + width_high));
        return;
    }
    memset(raster->area, 0, (end - first + 1) * sizeof *raster->area);
    double a = first, b = nextafter(end, 0);
    accumulate(raster->area, within(s->long_low, a, b), s->low, within(s->long_high, a, b), s->high, sign);
    if (s->bent) {
        double x = within(middle[0], a, b);
        accumulate(raster->area, within(s->short_low, a, b), s->low, x, middle[1], -sign);
        accumulate(raster->area, x, middle[1], within(s->short_high, a, b), s->high, -sign);
    } else {
        accumulate(raster->area, within(s->short_low, a, b), s->low, within(s->short_high, a, b), s->high, -sign);
    }
    for (uint32_t k = 1; k < end - first; k++)
        raster->area[k] += raster->area[k - 1];
}

/* The strip's columns; false where the row holds but a sliver. */
static bool take_row(sp_raster *raster, uint32_t row)
{
    double slack = raster->kind == SP_RASTER_TOUCHED ? SP_RASTER_SLACK : 0;
    strip s = cut(raster, row - slack, row + 1 + slack);
    if (s.high - s.low < (slack > 0 ? 0 : SP_SLIVER * sp_lesser(1, raster->height)))
        return false;
    double left = sp_lesser(sp_lesser(s.long_low, s.long_high), sp_lesser(s.short_low, s.short_high));
    double right = sp_greater(sp_greater(s.long_low, s.long_high), sp_greater(s.short_low, s.short_high));
    if (s.bent) {
        left = sp_lesser(left, raster->corner[1][0]);
        right = sp_greater(right, raster->corner[1][0]);
    }
    double shrink = slack > 0 ? -slack : SP_SLIVER * sp_lesser(1, raster->width);
    double first = floor(left + shrink), end = ceil(right - shrink);
    if (!(end > first)) {
        first = floor(0.5 * (left + right));
        end = first + 1;
    }
    first = sp_lesser(first, raster->columns - 1.0);
    end = sp_greater(sp_lesser(end, raster->columns), first + 1);
    raster->y = raster->base_y + row;
    raster->x = raster->base_x + (uint32_t)first;
    raster->count = (uint32_t)(end - first);
    assert(first >= 0 && first < end && end <= raster->columns);
    if (raster->kind == SP_RASTER_AREAS)
        measure(raster, &s, (uint32_t)first, (uint32_t)end);
    return true;
}

/* A triangle that rounding left without area lies in the pixel of its middle. */
static bool take_middle(sp_raster *raster)
{
    const double(*c)[2] = (const double(*)[2])raster->corner;
    double x = (c[0][0] + c[1][0] + c[2][0]) / 3, y = (c[0][1] + c[1][1] + c[2][1]) / 3;
    raster->x = raster->base_x + (uint32_t)sp_lesser(x, raster->columns - 1.0);
    raster->y = raster->base_y + (uint32_t)sp_lesser(y, raster->rows - 1.0);
    raster->count = 1;
    if (raster->kind == SP_RASTER_AREAS)
        raster->area[0] = 0;
    raster->row = raster->rows;
    return true;
}

bool sp_raster_next(sp_raster *raster)
{
    if (!(raster->flat > 0) && raster->kind != SP_RASTER_TOUCHED && raster->row == 0)
        return take_middle(raster);
    while (raster->row < raster->rows)
        if (take_row(raster, raster->row++))
            return true;
    return false;
}
