/* Continuation of a layout's poses with Ceres from a smooth objective to a sharp one, with visibility frozen for each
 * step and traced again. */
#ifndef OPTIMIZER_CONTINUATION_H
#define OPTIMIZER_CONTINUATION_H

#include "refine/smooth_objective.h"

/* The widths of a continuation, from the smoothest. From SP_CAREFUL on a step must improve what it starts from. */
#define SP_WIDTHS 7
#define SP_CAREFUL 3

/* Continues from width `start` to before width `end` within `water` (m³/s), and leaves the layout at the best of its
 * steps by what is covered. */
bool sp_continuation(sp_sights *sights, size_t start, size_t end, double water, sp_deadline *deadline,
                     sp_partial *partial, sp_error *error);

/* The flow that a nozzle may be turned down to, and up to; its own where that is fixed. */
double sp_least_flow(const sp_search *search, const sp_placed *placed);
double sp_most_flow(const sp_search *search, const sp_placed *placed);
/* The outlay (m³/s) of the layout with all of its nozzles turned up as far as they can be, within what is allowed. */
double sp_turned_up(const sp_search *search, const sp_partial *partial);
/* Turns adjustable nozzles down by the same share of what they have above their least, to a total of `water` (m³/s) if
 * that can be. The fields stay as they are. */
void sp_turn_down(const sp_search *search, sp_partial *partial, double water);
/* The fields anew, from where the nozzles are, and what follows from them. */
bool sp_partial_look(sp_sights *sights, sp_partial *partial, sp_error *error);

#endif
