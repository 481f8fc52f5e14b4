/* Fewest: the most that one, two, three, ... nozzles cover, whatever their water. Every nozzle is a hole in the vessel.
 */
#ifndef OPTIMIZER_FEWEST_H
#define OPTIMIZER_FEWEST_H

#include "search/front.h"
#include "search/greedy.h"

/* Measures, for the front, the best drafts found of rising numbers of nozzles of the pool, within `budget` (m³/s), up
 * to as many as the front's best has. */
bool sp_find_fewest(const sp_search *search, const sp_pool *pool, double budget, sp_watch *watch, sp_front *front,
                    sp_error *error);

#endif
