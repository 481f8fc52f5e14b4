/* From what refinement likes best to what ports and types can be set to. */
#ifndef OPTIMIZER_SETTABLE_H
#define OPTIMIZER_SETTABLE_H

#include "search/front.h"

/* Makes the front anew of its layouts as they can be set: those that are at settings stay as they are, the others are
 * brought to the nearest and measured anew while there is time: the best in any case, those next that will reach the
 * target once they are set. front->best becomes the best of these, and then of the settings beside it. Does nothing
 * where no mount and no type has steps. */
bool sp_set_front(const sp_search *search, sp_deadline *deadline, sp_front *front, sp_error *error);

#endif
