/* Refinement of a layout's poses with Ceres, accepted only where the scene's own measure improves. */
#ifndef OPTIMIZER_REFINE_H
#define OPTIMIZER_REFINE_H

#include "search/exchange.h"
#include "search/front.h"

/* Whether refinement may change anything. */
bool sp_refine_asked(const sp_refine *refine);
/* Finds and refines layouts for ever less water from the first one's, for a proposal in a small part of the time that
 * refining all of the front takes. */
bool sp_refine_first(const sp_search *search, const sp_pool *pool, sp_deadline *deadline, sp_front *front,
                     sp_error *error);
/* Refines front->best in place: poses, then less water at the coverage asked for. */
bool sp_refine_best(const sp_search *search, const sp_pool *pool, sp_deadline *deadline, sp_front *front,
                    sp_error *error);

#endif
