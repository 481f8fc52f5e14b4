/* The dose of one point of goods that move, or that goods move past. */
#ifndef SPRAY_DOSE_H
#define SPRAY_DOSE_H

#include "emitter.h"

#include <sprayplan/points.h>

/* What of a pattern's flow (m³/s) arrives there and passes the criterion's speed and incidence, its mean over the pass
 * (m³/s per m²). */
double sp_point_dose(const sp_emitter *emitter, double flow, const sp_point *point);

#endif
