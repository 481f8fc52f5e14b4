/* Compass search: one unknown at a time, forth and back, in ever smaller steps, by what is really covered. */
#ifndef OPTIMIZER_COMPASS_H
#define OPTIMIZER_COMPASS_H

#include "refine/sight.h"

/* Raises what the layout covers on the coarse patches, every place traced anew, within `water` (m³/s). It sees what
 * frozen visibility hides from Ceres: a move that lights up what lay in shadow. Steps go from `first` to above `least`,
 * shares of half an unknown's range. */
bool sp_compass(sp_sights *sights, double first, double least, double water, sp_deadline *deadline, sp_partial *partial,
                sp_error *error);

#endif
