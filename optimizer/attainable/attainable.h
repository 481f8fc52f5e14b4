/* Attainable area: what the mounts, types and limits could cover at all. */
#ifndef OPTIMIZER_ATTAINABLE_H
#define OPTIMIZER_ATTAINABLE_H

#include "scoring/partial.h"

/* Per patch of `fine`, [patches], the caller's: whether some pose that the mounts allow (its axis anywhere within the
 * tilt, angle and flow as refinement may set them) reaches it with passing speed and incidence, and the kept nozzles
 * with as many of its best poses as number, water and ports allow could together cover it; with `single` one pose
 * alone; and where not, why. Of goods that move candidate poses are asked as they stand, on the search's patches. Ends
 * early, the rest unknown, where the run is cancelled. */
bool sp_attainable(const sp_evaluator *fine, const sp_search *search, sp_deadline *deadline, sp_reason *reasons,
                   sp_error *error);

#endif
