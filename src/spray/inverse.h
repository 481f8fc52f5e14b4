/* What the arrivals of one pattern bring. */
#ifndef SPRAY_INVERSE_H
#define SPRAY_INVERSE_H

#include "reach.h"
#include "combination.h"

/* Adds what a pattern of this flow (m³/s) brings by arrivals that its aim takes, as sp_reach_create orders them, to
 * the combination of the nozzle in hand. */
void sp_lay_arrivals(const sp_emitter *emitter, double flow, const sp_arrival *arrivals, size_t count,
                     sp_combination *combination);

#endif
