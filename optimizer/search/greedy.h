/* Greedy next-best-view placement over all candidate poses, or over those of the pool. */
#ifndef OPTIMIZER_GREEDY_H
#define OPTIMIZER_GREEDY_H

#include "scoring/scoring.h"
#include "search/pool_gains.h"

/* Adds nozzles to the partial layout, each the pose of most gain per outlay^power, the first of equals, until it covers
 * `target` (m² of coarse patches) or nothing more is gained or allowed within an outlay of `budget` (m³/s). The poses
 * that came near go to `pool`. Out of time it ends within a round, with the best that this has come to, and with a
 * first nozzle where there is one. */
bool sp_greedy(const sp_search *search, double power, double target, double budget, sp_deadline *deadline,
               sp_partial *partial, sp_pool *pool, sp_error *error);
/* The same over the pool's poses alone. */
bool sp_greedy_pool(const sp_search *search, sp_pool_gains *gains, double power, double target, double budget,
                    sp_partial *partial, sp_error *error);

#endif
