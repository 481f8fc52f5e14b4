/* Do closed chains of segments touch each other? */
#ifndef ATLAS_CROSSING_H
#define ATLAS_CROSSING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A boundary edge: its ends' numbers and places. Segments that share a number share that end. */
typedef struct {
    uint32_t from, to;
    const double *p, *q;
} sp_segment;

typedef struct {
    bool crossing; /* two segments have a point in common that is not a shared end */
    bool memory;   /* false: it ran out, and nothing is known */
    size_t tests;  /* pairs of segments that were looked at */
} sp_crossing;

/* Exact for the coordinates as they stand. Time about linear in `count`. */
sp_crossing sp_segments_cross(const sp_segment *segments, size_t count);

#endif
