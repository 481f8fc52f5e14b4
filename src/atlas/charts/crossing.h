/* Do closed chains of segments cross or touch each other? */
#ifndef ATLAS_CROSSING_H
#define ATLAS_CROSSING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Segments nearer to each other than this, in parts of the shorter, touch: so that moving or turning a chart, which
 * rounds, changes no answer where chains lie on each other. */
#define SP_CLEARANCE 5e-10

/* A boundary edge: its ends' numbers and places. Segments that share a number share that end. */
typedef struct {
    uint32_t from, to;
    const double *p, *q;
} sp_segment;

typedef struct {
    bool crossing; /* two segments cross or touch other than in a shared end */
    bool memory;   /* false: it ran out, and nothing is known */
    size_t tests;  /* pairs of segments that were looked at */
} sp_crossing;

/* Whether segments cross is decided exactly for their coordinates as they stand. Time about linear in `count`. */
sp_crossing sp_segments_cross(const sp_segment *segments, size_t count);

#endif
