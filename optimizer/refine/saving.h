/* Less water at the coverage asked for. */
#ifndef OPTIMIZER_SAVING_H
#define OPTIMIZER_SAVING_H

#include "refine/trials.h"

/* Turns a layout's adjustable nozzles down while it reaches the target, and measures what comes of it. */
bool sp_save_flow(sp_refining *refining, const sp_partial *full);
/* Gives the best layout ever less water, as long as exchange and refinement make up for that. */
bool sp_save_water(sp_refining *refining);

#endif
