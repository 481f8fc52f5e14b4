/* The last of refinement: other types in the places that it found. */
#ifndef OPTIMIZER_OTHER_TYPES_H
#define OPTIMIZER_OTHER_TYPES_H

#include "search/front.h"

/* Tries every nozzle of the best layout as each other type and pressure that its mount allows, where it stands and
 * aimed as it is, that takes no more: with the rated flow, and set to as much of the nozzle's own as refinement may
 * set. What comes of them the front decides. As far as time goes. Nothing where refinement may change nothing. */
bool sp_try_other_types(const sp_search *search, sp_deadline *deadline, sp_front *front, sp_error *error);

#endif
