/* The outline of a posed pattern that is swept, in single precision, from which shares of patches follow without
 * trigonometric functions (outline_lanes.h). */
#ifndef NOZZLE_OUTLINE_H
#define NOZZLE_OUTLINE_H

#include <sprayplan/nozzle.h>

#define SP_LANES 16 /* patches that are asked about at a time */
/* Of a patch's breadth, each a little more than in sp_spray_share, for round-off: so far beyond a pattern's edge it may
 * have a share; so far beyond a fan's corner; so far from the axis of a cone too narrow to be told from a spot; and the
 * chord to the edge of the widest of these. */
#define SP_OUTLINE_BLUR (0.505 * SP_SPRAY_BLUR)
#define SP_OUTLINE_CORNER (0.72 * SP_SPRAY_BLUR)
#define SP_OUTLINE_FRINGE (1.423 * SP_SPRAY_BLUR)
#define SP_OUTLINE_SPOT (1.004 * SP_SPRAY_BLUR)

/* A polar angle about the axis at which a cone or its hole ends, as squared chords. */
typedef struct {
    float edge2; /* from the axis to the edge; 4: none */
    float steep; /* by how much the share's argument grows per squared chord, for a patch 1 rad broad */
} sp_rim;

typedef struct {
    bool flat;                  /* a fan, else a cone */
    float z[3];                 /* cones: the axis in world coordinates */
    sp_rim outer, inner;        /* cones; inner.edge2 0: no hole */
    float y[3];                 /* fans: across the fan's plane */
    float height;               /* fans: sine of the half-thickness; 2: it has no such edge */
    float rise;                 /* fans: as sp_rim's, per height */
    float end[2][3];            /* fans: normals of the planes through its ends, inwards */
    bool wide, all_round;       /* fans of more than half a turn; of a whole one */
    float end_cosine, end_sine; /* fans: of the half-width */
    float narrowest;            /* cones widened: chord to the edge of the narrowest that is meant */
} sp_outline;

/* A circle about the axis at `angle` (rad), `beyond` (chord) farther out. */
sp_rim sp_rim_at(double angle, double beyond);
/* Brings it into another frame. */
void sp_outline_turn(sp_outline *outline, const sp_frame *frame);

#endif
