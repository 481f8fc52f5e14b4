/* The search among the candidate poses: greedy, exchange, and the front as it goes. */
#ifndef OPTIMIZER_FIND_H
#define OPTIMIZER_FIND_H

#include "search/exchange.h"
#include "search/front.h"

/* Leaves the first layout, which reaches the target, or the share `enough` of it, if that is allowed, in *first, which
 * the caller frees, what it has measured in `front` and the poses worth another look in `pool`. */
bool sp_find_first(const sp_search *search, double enough, sp_deadline *deadline, sp_front *front, sp_pool *pool,
                   sp_partial *first, sp_error *error);
/* Notes in `front` what the first layout's first nozzles do, up to about a dozen of their numbers, as far as time
 * allows. */
bool sp_find_steps(const sp_search *search, const sp_partial *first, sp_deadline *deadline, sp_front *front,
                   sp_error *error);
/* Finds better ones, and those for other amounts of water and numbers of nozzles. */
bool sp_find_more(const sp_search *search, sp_deadline *deadline, sp_front *front, sp_pool *pool,
                  const sp_partial *first, sp_error *error);

#endif
