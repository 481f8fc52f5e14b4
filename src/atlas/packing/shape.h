/* Charts as bitmaps of pixels. */
#ifndef ATLAS_SHAPE_H
#define ATLAS_SHAPE_H

#include <sprayplan/atlas.h>

/* Pixels in a row that a shape takes. */
typedef struct {
    uint32_t y, x, length;
} sp_shape_run;

/* A chart on a frame of whole pixels, in the order of rows, left to right. */
typedef struct {
    uint32_t width, height; /* of the frame, 1 or more */
    double left, low;       /* where the chart's own origin lies on the frame, pixels */
    size_t area;            /* pixels taken */
    uint32_t run_count;
    sp_shape_run *runs;
} sp_shape;

/* The pixels that each chart touches at its texel [chart_count] (m), [chart_count]. A chart stands in the middle of its
 * frame and keeps off the frame's border, where round-off could push it over; one of a whole number of pixels lies
 * along their borders, with a pixel more on either side; if only then it fits, a chart fills its `limit` pixels. Fails
 * with SP_ERROR_INPUT where a chart is larger than that. */
sp_shape *sp_shapes_create(const sp_charts *charts, const double *texel, uint32_t limit, sp_error *error);
void sp_shapes_destroy(sp_shape *shapes, size_t count);

/* The shape a quarter turn on, anticlockwise: what was at (x, y) is at (height - y, x). left and low stay those of the
 * chart before the turn. False when memory runs out. */
bool sp_shape_turn(const sp_shape *shape, sp_shape *turned);
/* The shape with all pixels that touch it, on a frame larger by one on every side. False when memory runs out. */
bool sp_shape_grow(const sp_shape *shape, sp_shape *grown);

#endif
