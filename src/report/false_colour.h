/* What colour a patch has: by a quantity and its scale, hatched where it is not covered. */
#ifndef REPORT_FALSE_COLOUR_H
#define REPORT_FALSE_COLOUR_H

#include <sprayplan/result.h>

/* What readers see of a quantity. */
typedef struct {
    const char *name, *unit; /* plain text; "" */
    double to_unit;          /* times a value in SI */
} sp_quantity_words;
extern const sp_quantity_words sp_quantity_words_of[SP_QUANTITIES];

#define SP_COLOUR_THRESHOLDS 6 /* of more that differ, the least */

/* How a quantity is shown; SI. */
typedef struct {
    sp_picture_style style; /* its shades are not left to auto */
    double low, high;       /* at the ends of the colour map; all 0 of charts */
    bool below, above;      /* some of the area that is shown lies beyond that end */
    /* What the designs' criteria ask for, each once, the least first: where a stepped scale has its steps. */
    double thresholds[SP_COLOUR_THRESHOLDS];
    int threshold_count;
} sp_colour_scale;

/* One scale for all designs, so that their pictures compare. Logarithmic: from the least criterion's flux, or the 1st
 * percentile of the area, to the 99th, rounded outwards to 1, 2 or 5 times a power of ten, of three decades at most.
 * Linear: from 0 to the 99th percentile, rounded up; angles to 90 degrees, shares to 1. The area is that which is
 * covered by impact for flux, else that where liquid arrives. */
sp_colour_scale sp_colour_scale_of(const sp_design *designs, size_t count, sp_picture_style style);
/* What a design's criterion asks of a quantity; 0: nothing. */
double sp_colour_threshold(const sp_design *design, sp_quantity quantity);
/* The same of all designs, each value once, the least first; how many. */
int sp_colour_thresholds(const sp_design *designs, size_t count, sp_quantity quantity,
                         double thresholds[SP_COLOUR_THRESHOLDS]);
/* Where on the colour map, 0 to 1. */
double sp_colour_scale_place(const sp_colour_scale *scale, double value);
/* The same of a value that is up so many steps of a stepped scale. */
double sp_colour_scale_step(const sp_colour_scale *scale, int steps);
/* A patch's value; 0 of charts. */
double sp_quantity_value(const sp_deposits *deposits, sp_quantity quantity, size_t patch);

/* Uncovered patches are hatched white and red: told from the colour maps by any eye, and in black and white. */
extern const uint8_t sp_colour_hatch[2][3];
extern const uint8_t sp_colour_obstacle[3];
extern const uint8_t sp_colour_film[3]; /* covered by film and not by impact */

/* `stripe` picks the hatch's colour, 0 or 1. Flux is shown where it covers; other quantities wherever liquid arrives,
 * with the hatch's stripes where it does not cover. Not of charts. */
void sp_false_colour(const sp_colour_scale *scale, const sp_deposits *deposits, uint32_t patch, int stripe,
                     uint8_t rgb[3]);

#endif
