/* The best of every layout, where there are few: nothing that greedy orders, exchanges and annealing may have missed is
 * left out then. */
#ifndef OPTIMIZER_EXHAUSTIVE_BEST_H
#define OPTIMIZER_EXHAUSTIVE_BEST_H

#include "search/exhaustive.h"
#include "search/front.h"

/* Those worth measuring within an outlay of `budget` (m³/s): the front by water, by number of nozzles, and the best by
 * the objective. partials [*count], which the caller frees one by one and as a whole; none where layouts are many.
 * *whole: these are the best of all there are, which they need not be where a pose may be taken twice, or where what
 * all poses do on the front's own patches is too much to keep and those of the search are taken. */
bool sp_exhaustive_best(const sp_search *search, const sp_front *front, double budget, sp_deadline *deadline,
                        sp_partial **partials, size_t *count, bool *whole, sp_error *error);

#endif
