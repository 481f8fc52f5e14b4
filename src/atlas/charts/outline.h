/* Whether triangles lie apart, told by their boundary alone. */
#ifndef ATLAS_OUTLINE_H
#define ATLAS_OUTLINE_H

#include "atlas/charts/crossing.h"

typedef struct {
    bool simple;  /* no two of the triangles overlap or, but for edges that they share, touch */
    bool memory;  /* false: it ran out, and nothing is known */
    size_t tests; /* pairs of segments that were looked at */
} sp_boundary_test;

/* `segments` are the edges that anticlockwise triangles, which hang together, do not share with each other, each
 * running as its triangle does; their ends' numbers are below `vertex_count`. Time about linear in `count`. */
sp_boundary_test sp_test_boundary(const sp_segment *segments, size_t count, size_t vertex_count);

#endif
