/* The order in which a page encodes the triangles of a surface: chart by chart, each over an edge of one that is
 * encoded, so that two of its corners need no words. Vertices come in the order in which that asks for them. Where a
 * triangle begins stays; which number it has does not. */
#ifndef REPORT_VIEWER_TRIANGLE_ORDER_H
#define REPORT_VIEWER_TRIANGLE_ORDER_H

#include "coder.h"

#include <sprayplan/atlas.h>

typedef struct {
    size_t count, vertex_count;
    uint32_t *triangle;     /* [count], of the mesh */
    uint32_t *vertex;       /* [vertex_count], of the mesh; those that no triangle has come last */
    uint32_t (*corners)[3]; /* [count], by encoded vertices */
    uint32_t *chart;        /* [count], of the atlas */
    uint32_t *gate; /* [count], 3 t + i: over the edge of encoded triangle t behind its corner i; SP_NONE: over none */
    uint8_t *far;   /* [count], the corner opposite to that edge; 0 where there is none */
} sp_triangle_order;

/* Corner `i` of an encoded triangle that was reached over its gate where its own corners are `far` + 1 and + 2: they
 * are the gate's end and its start. Encodes the walk. For sp_triangle_order_free whatever the outcome; false where
 * memory runs out. */
bool sp_triangle_order_create(sp_triangle_order *walk, const sp_mesh *mesh, const sp_atlas *atlas, sp_coder *coder);
void sp_triangle_order_free(sp_triangle_order *walk);

#endif
