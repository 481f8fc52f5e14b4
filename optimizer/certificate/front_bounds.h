/* The bounds at the points of a front. */
#ifndef OPTIMIZER_FRONT_BOUNDS_H
#define OPTIMIZER_FRONT_BOUNDS_H

#include "certificate/bound_at_water.h"

/* Takes the points in turn, those first where few nozzles leave much open: prices for each, and looks at its layouts.
 */
bool sp_lower_front(sp_certifying *c, sp_effort most, sp_error *error);
/* Prices for points whose bound comes from prices for far more water, or far less, and would come down most by its own:
 * where there are many nozzles, turns come to the first points alone. */
bool sp_lower_gaps(sp_certifying *c, sp_error *error);

#endif
