/* Packing of charts by their very pixels into square pages. */
#ifndef ATLAS_NEST_H
#define ATLAS_NEST_H

#include "atlas/packing/shape.h"

/* Where a chart's frame was put. */
typedef struct {
    uint32_t page, x, y;
    int turns; /* quarter turns, anticlockwise */
} sp_spot;

/* Puts every shape on a page, quarter-turned as it fits best, one free pixel between any two. `limit` is the largest
 * page edge; page_edge becomes the edge chosen and page_count the number of pages. Returns false when memory runs out.
 */
bool sp_nest(const sp_shape *shapes, size_t count, uint32_t limit, sp_spot *spots, uint32_t *page_edge,
             size_t *page_count, sp_error *error);

#endif
