#include "atlas/packing/shape.h"

#include "mesh/bits.h"
#include "atlas/texels/raster.h"
#include "mesh/min_max.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#define MARGIN (1.0 / 64) /* pixels between a chart and its frame */
#define ROUNDED_UP 1.001  /* so that what is printed in four digits is no less */
#define WHOLE 1e-6        /* pixels: a chart this near to a whole number of them is laid along their borders */

/* A picture of one shape in the making. */
typedef struct {
    uint64_t *bits;
    size_t row_words, capacity; /* words */
} canvas;

static bool clear(canvas *c, uint32_t width, uint32_t height)
{
    c->row_words = sp_bits_words(width);
    size_t need = c->row_words * height;
    if (need > c->capacity) {
        free(c->bits);
        c->capacity = 0;
        c->bits = malloc(need * sizeof *c->bits);
        if (!c->bits)
            return false;
        c->capacity = need;
    }
    for (size_t i = 0; i < need; i++)
        c->bits[i] = 0;
    return true;
}

/* The runs of what was painted; false when memory runs out. */
static bool take_runs(const canvas *c, sp_shape *shape)
{
    for (int pass = 0; pass < 2; pass++) {
        size_t count = 0;
        for (uint32_t y = 0; y < shape->height; y++) {
            const uint64_t *row = c->bits + y * c->row_words;
            for (size_t x = 0, end; (x = sp_bits_find(row, x, shape->width, true)) < shape->width; x = end) {
                end = sp_bits_find(row, x, shape->width, false);
                if (pass) {
                    shape->runs[count] = (sp_shape_run){y, (uint32_t)x, (uint32_t)(end - x)};
                    shape->area += end - x;
                }
                count++;
            }
        }
        if (pass)
            break;
        shape->run_count = (uint32_t)count;
        shape->area = 0;
        shape->runs = malloc((count + !count) * sizeof *shape->runs);
        if (!shape->runs)
            return false;
    }
    return true;
}

/* start [chart_count + 1] and members [triangle_count]: the triangles of each chart, ascending. */
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
    assert(start[0] == 0 && start[charts->chart_count] == charts->triangle_count);
}

typedef struct {
    const sp_charts *charts;
    const uint32_t *members;
    uint32_t count;
    double texel;
} chart;

/* The frame and the chart's place on it. */
static bool frame(const chart *c, uint32_t limit, sp_shape *shape, sp_error *error)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, place[2];
    uint32_t size[2];
    for (uint32_t i = 0; i < c->count; i++)
        for (int corner = 0; corner < 3; corner++)
            for (int k = 0; k < 2; k++) {
                low[k] = sp_lesser(low[k], c->charts->flat[c->members[i]][corner][k]);
                high[k] = sp_greater(high[k], c->charts->flat[c->members[i]][corner][k]);
            }
    for (int k = 0; k < 2; k++) {
        double extent = (high[k] - low[k]) / c->texel, whole = round(extent);
        bool fitting = whole >= 1 && fabs(extent - whole) < WHOLE;
        double pixels = sp_lesser(fitting ? whole + 2 : floor(extent + 2 * MARGIN) + 1, limit);
        /* Less a part in 10^9: a chart of a whole number of texels is not too large for round-off. */
        if (!(extent * (1 - 1e-9) <= limit))
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                           "a flat piece of the surface of %g m by %g m does not fit a page of %u texels of %g m; "
                           "expected a texel of at least %.4g m",
                           high[0] - low[0], high[1] - low[1], limit, c->texel,
                           ROUNDED_UP * sp_greater(high[0] - low[0], high[1] - low[1]) / limit);
        size[k] = (uint32_t)pixels;
        place[k] = (pixels == whole + 2 ? 1 : sp_greater(0, 0.5 * (pixels - extent))) - low[k] / c->texel;
    }
    shape->width = size[0];
    shape->height = size[1];
    shape->left = place[0];
    shape->low = place[1];
    return true;
}

static bool paint(const chart *c, sp_shape *shape, canvas *picture, sp_raster *raster)
{
    if (!clear(picture, shape->width, shape->height))
        return false;
    for (uint32_t i = 0; i < c->count; i++) {
        const double(*flat)[2] = (const double(*)[2])c->charts->flat[c->members[i]];
        double uv[3][2];
        for (int k = 0; k < 3; k++) { /* two pixels on, so that no corner is below 0 */
            uv[k][0] = flat[k][0] / c->texel + shape->left + 2;
            uv[k][1] = flat[k][1] / c->texel + shape->low + 2;
        }
        if (!sp_raster_begin(raster, (const double(*)[2])uv, SP_RASTER_TOUCHED))
            return false;
        while (sp_raster_next(raster)) {
            uint32_t y = raster->y < 2 ? 0 : raster->y - 2, x = raster->x < 2 ? 0 : raster->x - 2,
                     end = raster->x + raster->count - 2;
            if (y < shape->height && x < shape->width)
                sp_bits_fill(picture->bits + y * picture->row_words, x, (end < shape->width ? end : shape->width) - x);
        }
    }
    return take_runs(picture, shape);
}

sp_shape *sp_shapes_create(const sp_charts *charts, const double *texel, uint32_t limit, sp_error *error)
{
    size_t count = charts->chart_count;
    uint32_t *start = malloc((count + 1) * sizeof *start);
    uint32_t *members = malloc((charts->triangle_count + 1) * sizeof *members);
    sp_shape *shapes = calloc(count + 1, sizeof *shapes);
    canvas picture = {0};
    sp_raster raster = {0};
    bool memory = start && members && shapes, done = memory;
    if (done)
        list_members(charts, start, members);
    for (size_t i = 0; done && i < count; i++) {
        chart c = {charts, members + start[i], start[i + 1] - start[i], texel[i]};
        done = frame(&c, limit, &shapes[i], error);
        memory = !done || paint(&c, &shapes[i], &picture, &raster);
        done = done && memory;
    }
    if (!memory)
        sp_fail_memory(error);
    free(start);
    free(members);
    free(picture.bits);
    sp_raster_free(&raster);
    if (done)
        return shapes;
    sp_shapes_destroy(shapes, count);
    return NULL;
}

void sp_shapes_destroy(sp_shape *shapes, size_t count)
{
    for (size_t i = 0; shapes && i < count; i++)
        free(shapes[i].runs);
    free(shapes);
}

bool sp_shape_turn(const sp_shape *shape, sp_shape *turned)
{
    *turned = (sp_shape){.width = shape->height, .height = shape->width, .left = shape->left, .low = shape->low};
    canvas picture = {0};
    bool done = clear(&picture, turned->width, turned->height);
    for (uint32_t i = 0; done && i < shape->run_count; i++) {
        size_t x = shape->height - 1 - shape->runs[i].y;
        for (uint32_t y = shape->runs[i].x; y < shape->runs[i].x + shape->runs[i].length; y++)
            picture.bits[y * picture.row_words + x / 64] |= 1ull << (x % 64);
    }
    done = done && take_runs(&picture, turned);
    free(picture.bits);
    return done;
}

bool sp_shape_grow(const sp_shape *shape, sp_shape *grown)
{
    *grown = (sp_shape){.width = shape->width + 2, .height = shape->height + 2};
    canvas picture = {0};
    bool done = clear(&picture, grown->width, grown->height);
    for (uint32_t i = 0; done && i < shape->run_count; i++)
        for (uint32_t y = shape->runs[i].y; y < shape->runs[i].y + 3; y++)
            sp_bits_fill(picture.bits + y * picture.row_words, shape->runs[i].x, shape->runs[i].length + 2);
    done = done && take_runs(&picture, grown);
    free(picture.bits);
    return done;
}
