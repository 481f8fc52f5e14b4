/* Other layouts for as much water, from which the local search may come further. */
#ifndef OPTIMIZER_OTHER_LAYOUTS_H
#define OPTIMIZER_OTHER_LAYOUTS_H

#include "refine/trials.h"

/* Finds the trials' other layouts: of the pool at angles and flows that refinement may set, and of nozzles that the
 * front's layouts have already, put together anew. */
bool sp_find_others(sp_refining *refining, sp_trials *trials);
/* The same, and before these trials of runners-up to them. */
bool sp_find_others_and_runners_up(sp_refining *refining, sp_trials *trials);

#endif
