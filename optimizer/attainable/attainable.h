/* Attainable area: what the mounts, types and limits could cover at all. */
#ifndef OPTIMIZER_ATTAINABLE_H
#define OPTIMIZER_ATTAINABLE_H

#include "scoring/partial.h"

/* Per patch of `fine`, [patches], the caller's: whether some pose that the mounts allow (at a candidates' mounting
 * point, its axis anywhere within the tilt, any roll, angle and flow as refinement may set them: more than the
 * candidate poses are) reaches its point with passing speed and incidence, and the kept nozzles with as many of its
 * best poses as number, water and ports allow could together cover it; with `single` one pose alone; and where not,
 * why. A patch of which less than half is reached, its point not, is SP_REASON_NO_LINE; one that the kept nozzles cover
 * half of is attained. Of film, of types that do not spray as densely all over and of goods that move candidate poses
 * are asked as they stand, on the search's patches. Where `fine` counts what walls throw back, all that any liquid
 * gets to is taken to be attainable. Ends early, the rest unknown, where the run is cancelled; where a time limit
 * leaves out candidate poses, what these might bring is unknown, too. */
bool sp_attainable(const sp_evaluator *fine, const sp_search *search, sp_deadline *deadline, sp_reason *reasons,
                   sp_error *error);

#endif
