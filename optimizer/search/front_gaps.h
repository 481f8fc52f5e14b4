/* The front's holes: amounts of water between those that layouts were searched for. */
#ifndef OPTIMIZER_FRONT_GAPS_H
#define OPTIMIZER_FRONT_GAPS_H

#include "search/front.h"
#include "search/pool.h"

/* Puts the pool's poses and the nozzles of the front's layouts together anew for every amount of water, and measures
 * what covers clearly more than the front has for as much. */
bool sp_fill_front(const sp_search *search, const sp_pool *pool, sp_deadline *deadline, sp_front *front,
                   sp_error *error);
/* The same of the front's nozzles, and of the pool's where they are few, where walls throw back liquid that the search
 * knows nothing of: as jets find it, layouts of fewer nozzles, or of others, may do. */
bool sp_fill_front_by_jets(const sp_search *search, const sp_pool *pool, sp_deadline *deadline, sp_front *front,
                           sp_error *error);

#endif
