/* How the liquid of one impact is shared. */
#ifndef SPRAY_SPLAT_H
#define SPRAY_SPLAT_H

#include "spray/state/state.h"

#define SP_SPLAT_CORNERS 4 /* pixels whose centres are around a point */
#define SP_SPLAT_SIDES 4   /* charts, or sides of a cut, on which it may lie */

typedef struct {
    uint32_t patch[SP_SPLAT_CORNERS * SP_SPLAT_SIDES]; /* [count], all different */
    double share[SP_SPLAT_CORNERS * SP_SPLAT_SIDES];   /* [count], they sum to 1 */
    int count;
} sp_shares;

/* Shares an impact on `patch`, at `hit`, among the patches whose texels' centres are nearest, the nearer the more (the
 * study's weighted average, 3.3.1), and in proportion to their area: an even flux stays even at the rim of a chart.
 * Across a seam that is as if the chart went on, unless its texels are of another length there. */
void sp_share_linearly(const sp_evaluator *evaluator, const sp_hit *hit, bool back, uint32_t patch, sp_shares *shares);

#endif
