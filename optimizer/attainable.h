/* Attainable area: what the mounts, types and limits could cover at all. */
#ifndef OPTIMIZER_ATTAINABLE_H
#define OPTIMIZER_ATTAINABLE_H

#include "design.h"

/* Per patch of `fine`, [patches], calloc'd by the caller: whether some pose that the mounts allow (its axis anywhere
 * within the tilt, angle and flow as refinement may set them) reaches it with passing speed and incidence, and the kept
 * nozzles with as many of its best poses as number, water and ports allow could together cover it; with `single` one
 * pose alone. Ends early, the rest false, where the run is cancelled. */
bool sp_attainable(const sp_evaluator *fine, const sp_search *search, sp_watch *watch, bool *attainable,
                   sp_error *error);

#endif
