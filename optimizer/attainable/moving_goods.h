/* Why goods that move are not attained. */
#ifndef OPTIMIZER_MOVING_GOODS_H
#define OPTIMIZER_MOVING_GOODS_H

#include "scoring/partial.h"
#include "deadline/deadline.h"

/* Finds for every patch of `fine` that is not attained how near a flight from any mounting point brings it at any time
 * of the pass, on the search's patches, within what the mounts let nozzles reach. Ends early, *whole false and nothing
 * found, where the run is cancelled, and takes a tenth of the time left at most. */
bool sp_moving_goods_reasons(const sp_evaluator *fine, const sp_search *search, sp_deadline *deadline,
                             sp_reason *reasons, bool *whole, sp_error *error);

#endif
