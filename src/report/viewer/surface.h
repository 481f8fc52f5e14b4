/* The surface as the viewer draws it: wet sides alone, places and texture coordinates in 16 bits. */
#ifndef REPORT_VIEWER_SURFACE_H
#define REPORT_VIEWER_SURFACE_H

#include "report/layers.h"

enum { SP_DRAWN_X, SP_DRAWN_Y, SP_DRAWN_Z, SP_DRAWN_U, SP_DRAWN_V, SP_DRAWN_NUMBERS };

/* Triangles one after the other that are of one part, page and side. */
typedef struct {
    uint32_t part;
    uint32_t page; /* SP_NONE: needs no cleaning, grey */
    int layer;     /* of sp_layers */
    size_t first, count;
} sp_drawn_range;

typedef struct {
    sp_vec3 low, high; /* m, in the setup's coordinates: what x, y and z of 0 and of 65535 mean */
    size_t vertex_count, triangle_count, range_count;
    uint16_t *numbers[SP_DRAWN_NUMBERS]; /* [vertex_count] each; u and v in parts of a page's edge */
    uint32_t (*corners)[3];              /* [triangle_count], anticlockwise seen from the side that is drawn */
    sp_drawn_range *ranges;              /* [range_count], by part, page, layer */
} sp_drawn_surface;

bool sp_drawn_surface_create(sp_drawn_surface *surface, const sp_layers *layers, sp_error *error);
/* Accepts what is all zeros. */
void sp_drawn_surface_free(sp_drawn_surface *surface);

#endif
