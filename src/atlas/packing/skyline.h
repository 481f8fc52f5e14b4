/* Packing of rectangles of whole texels into square pages. */
#ifndef ATLAS_SKYLINE_H
#define ATLAS_SKYLINE_H

#include <sprayplan/error.h>

#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint32_t width, height; /* texels, 1 to the page limit */
    uint32_t page, x, y;    /* where it was put */
} sp_rectangle;

/* Puts every rectangle on a page, one texel between any two. `limit` is the largest page edge; page_edge becomes the
 * edge chosen and page_count the number of pages. Returns false when memory runs out. */
bool sp_skyline(sp_rectangle *rectangles, size_t count, uint32_t limit, uint32_t *page_edge, size_t *page_count,
                sp_error *error);

#endif
