/* Rasterization: which pixels a triangle covers, row by row, and how much of each. */
#ifndef ATLAS_RASTER_H
#define ATLAS_RASTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Strips thinner than this part of a pixel and of the triangle are round-off at a pixel's border and cover nothing. */
#define SP_SLIVER 1e-9

typedef enum {
    SP_RASTER_TOUCHED, /* every pixel within SP_RASTER_SLACK of the triangle */
    SP_RASTER_PIXELS,  /* every pixel that holds some of it, but for slivers */
    SP_RASTER_AREAS,   /* those, and how much of it each holds */
} sp_raster_kind;
#define SP_RASTER_SLACK 1e-6 /* pixels */

/* A triangle on its way through the rows. Starts as {0}; one can be used for many triangles. */
typedef struct {
    uint32_t y, x, count; /* the row in hand: pixels [x, x + count) */
    double *area;         /* [count], pixels²; of SP_RASTER_AREAS only */
    double corner[3][2];  /* by height, from the corner of the pixel where the triangle's box begins */
    double width, height, turn;
    double flat; /* the triangle's area, pixels²; not above 0 where rounding left none */
    sp_raster_kind kind;
    uint32_t base_x, base_y, columns, rows, row;
    double cut_at, cut_long, cut_short; /* the upper end of the row before: its height, and where it cuts the edges */
    size_t capacity;                    /* of area */
} sp_raster;

/* Begins with an anticlockwise triangle of finite corners, none below 0, with SP_RASTER_TOUCHED none below its slack.
 * Returns false when memory runs out. */
bool sp_raster_begin(sp_raster *raster, const double uv[3][2], sp_raster_kind kind);
/* The next row that the triangle covers, upwards; false after the last. A triangle has at least one. */
bool sp_raster_next(sp_raster *raster);
void sp_raster_free(sp_raster *raster);

#endif
