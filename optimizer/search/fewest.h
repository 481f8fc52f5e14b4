/* Fewest: the most that one, two, three, ... nozzles cover, whatever their water. Every nozzle is a hole in the vessel.
 */
#ifndef OPTIMIZER_FEWEST_H
#define OPTIMIZER_FEWEST_H

#include "search/front.h"
#include "search/pool_gains.h"

/* Measures, for the front, the best layouts found of rising numbers of nozzles of the pool, within an outlay of
 * `budget` (m³/s), fewer than the front's best has. Each number starts from what was found for one less and from the
 * first of `greedy`. */
bool sp_find_fewest(const sp_search *search, sp_pool_gains *gains, const sp_partial *greedy, double budget,
                    sp_deadline *deadline, sp_front *front, sp_error *error);

#endif
