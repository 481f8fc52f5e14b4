/* The surface as it is drawn: wet sides alone, indexed vertices, in ranges of one part, page and side. */
#ifndef REPORT_SURFACE_H
#define REPORT_SURFACE_H

#include "layers.h"

/* Where the surface has a corner. */
typedef struct {
    uint32_t at; /* vertex of the mesh */
    float uv[2]; /* in parts of a page's edge, (0, 0) at the lower left of its picture */
} sp_drawn_vertex;

/* Triangles one after the other that are of one part, page and side. */
typedef struct {
    uint32_t part;
    uint32_t page; /* SP_NONE: needs no cleaning, grey */
    int layer;     /* of sp_layers */
    size_t first, count;
    size_t vertex_first, vertex_end; /* of the part's vertices: its first, and past the last that are used so far */
} sp_drawn_range;

typedef struct {
    size_t vertex_count, triangle_count, range_count;
    sp_drawn_vertex *vertices; /* [vertex_count], those of each part together; parts share none */
    uint32_t (*corners)[3];    /* [triangle_count], anticlockwise seen from the side that is drawn */
    uint32_t *triangles;       /* [triangle_count], of the mesh; one that is wet on both sides is there twice */
    sp_drawn_range *ranges;    /* [range_count], by part, page, layer; in each by triangle */
} sp_drawn_surface;

bool sp_drawn_surface_create(sp_drawn_surface *surface, const sp_layers *layers, sp_error *error);
/* Accepts what is all zeros. */
void sp_drawn_surface_free(sp_drawn_surface *surface);

#endif
