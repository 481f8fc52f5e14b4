/* Kicks: a nozzle or two of a draft put elsewhere, where something is dry, for refinement to settle anew. */
#ifndef OPTIMIZER_KICK_H
#define OPTIMIZER_KICK_H

#include "search/greedy.h"

/* Takes one or two nozzles out at random, puts poses of the pool in that reach dry patches chosen at random, and then
 * whatever gains most, within `budget` (m³/s) and at most as many nozzles as before and one. */
bool sp_kick(const sp_search *search, const sp_pool *pool, double budget, uint64_t seed, sp_draft *draft,
             sp_error *error);

#endif
