/* A triangle cut by the squares of a grid. */
#ifndef ATLAS_CLIP_H
#define ATLAS_CLIP_H

#include <stddef.h>
#include <stdint.h>

#define CLIP_POINTS 16 /* 7 for a triangle; more only where round-off bends a needle */

typedef struct {
    int count;
    double point[CLIP_POINTS][2];
} sp_polygon;

/* The triangle's part with y in [row, row + 1], and that part's with x in [column, column + 1]. */
void sp_clip_row(const double triangle[3][2], uint32_t row, sp_polygon *strip);
void sp_clip_column(const sp_polygon *strip, uint32_t column, sp_polygon *cell);
/* The area, positive for anticlockwise. */
double sp_polygon_area(const sp_polygon *polygon);

#endif
