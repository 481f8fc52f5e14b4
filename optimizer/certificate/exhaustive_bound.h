/* Bounds where every layout of the candidates can be looked at: what the best of them does, no more. */
#ifndef OPTIMIZER_EXHAUSTIVE_BOUND_H
#define OPTIMIZER_EXHAUSTIVE_BOUND_H

#include "certificate/bound_at_water.h"

/* Lowers all bounds to what the best layouts within them cover; *known is false, and nothing lowered, where layouts are
 * too many, or the front has nozzles that are no candidates. */
bool sp_exhaustive_bound(sp_certifying *c, bool *known, sp_error *error);

#endif
