/* Exchange: improving a partial layout by taking nozzles out and putting better ones in. */
#ifndef OPTIMIZER_EXCHANGE_H
#define OPTIMIZER_EXCHANGE_H

#include "search/greedy.h"

/* Raises the partial layout's value within an outlay of `budget` (m³/s): adds what that allows, then replaces one
 * nozzle at a time by the pool's best for its place, until nothing changes. */
bool sp_improve(const sp_search *search, sp_pool_gains *gains, double budget, sp_deadline *deadline,
                sp_partial *partial, sp_error *error);
/* Lowers the partial layout's outlay while it covers `target` (m² of coarse patches): leaves out one nozzle and
 * improves the rest within less than before. */
bool sp_shrink(const sp_search *search, sp_pool_gains *gains, double target, sp_deadline *deadline, sp_partial *partial,
               sp_error *error);
/* Of the partial layouts that `partial` without one nozzle improves to within `budget`, the one that covers most;
 * *found is false where there is none. The caller frees *reduced. */
bool sp_reduce(const sp_search *search, sp_pool_gains *gains, const sp_partial *partial, double budget, double enough,
               sp_deadline *deadline, sp_partial *reduced, bool *found, sp_error *error);

#endif
