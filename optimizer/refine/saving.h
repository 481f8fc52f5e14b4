/* Less water at the coverage asked for. */
#ifndef OPTIMIZER_SAVING_H
#define OPTIMIZER_SAVING_H

#include "refine/trials.h"

/* Turns a layout's adjustable nozzles down while it reaches the target, and measures what comes of it. */
bool sp_save_flow(sp_refining *refining, const sp_partial *full);
/* Gives the best layout ever less water, as long as exchange and refinement make up for that. */
bool sp_save_water(sp_refining *refining);

/* Whether layout i of the front by water takes less than the best and all but reaches the target; and what it may take
 * to reach it, m³/s of outlay. */
bool sp_is_near_target(const sp_front *front, size_t i);
double sp_near_budget(const sp_front *front, size_t i);
/* Anneals such layouts for what they lack, as long as the best gets better. */
bool sp_reach_target(sp_refining *refining);

#endif
