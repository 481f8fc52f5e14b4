/* Layouts that go from one placement to another: written down at the end of one, taken up at the beginning of the next,
 * which may allow other mounts, types and limits. */
#ifndef OPTIMIZER_KNOWN_H
#define OPTIMIZER_KNOWN_H

#include "search/front.h"

/* The best and all of the fronts, best first; `counted_again`: their areas are not those of the evaluator that the
 * placement was given. NULL on error. */
sp_found *sp_found_create(const sp_front *front, const sp_search *search, bool counted_again, sp_error *error);
/* Accepts NULL. */
void sp_found_destroy(sp_found *found);

/* Enters into a front the layouts that the options' `known` found, as far as this placement allows them and none of
 * them is better in everything, at the prices of its own mounts. */
bool sp_take_known(sp_front *front, const sp_search *search, sp_error *error);

#endif
