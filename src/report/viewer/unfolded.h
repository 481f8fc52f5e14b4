/* Where triangles lie on the pages of the atlas, told to the last bit in few: each corner as what it is off from where
 * its triangle, turned into the page at the edge that is known, has it. */
#ifndef REPORT_VIEWER_UNFOLDED_H
#define REPORT_VIEWER_UNFOLDED_H

#include <sprayplan/evaluator.h>

/* Charts on which nothing is cleaned are rounded to parts of a pixel: nobody asks where on them. */
#define SP_UNFOLDED_PARTS 16

/* Triangles are told when two corners of their chart are known, sweep after sweep up and down their numbers; where that
 * tells none the first that is left is told from nothing; after so many sweeps all that are left are. */
#define SP_UNFOLDED_SWEEPS 64

typedef struct {
    uint8_t *rounded; /* [chart_count] */
    size_t count;
    int64_t *apart; /* [count], x and y of three corners a triangle, in the order in which triangles are told: bits off,
                     * or parts of a pixel on charts that are rounded */
} sp_unfolded;

/* For sp_unfolded_free whatever the outcome. False where memory runs out. */
bool sp_unfolded_create(sp_unfolded *unfolded, const sp_evaluator *evaluator);
void sp_unfolded_free(sp_unfolded *unfolded);

#endif
