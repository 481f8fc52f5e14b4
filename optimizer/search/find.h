/* The search among the candidate poses: greedy, exchange, and the front as it goes. */
#ifndef OPTIMIZER_FIND_H
#define OPTIMIZER_FIND_H

#include "search/exchange.h"
#include "search/front.h"

/* Leaves the best draft in front->best and the poses worth another look in `pool`. */
bool sp_find(const sp_search *search, sp_watch *watch, sp_front *front, sp_pool *pool, sp_error *error);

#endif
