/* From what refinement likes best to what ports and types can be set to. */
#ifndef OPTIMIZER_SETTINGS_H
#define OPTIMIZER_SETTINGS_H

#include "search/front.h"

/* Brings every layout of the front (once cancelled the best alone) to settings, measures it anew and forgets what it
 * was; front->best becomes the best of these, and then of the settings beside it, while there is time. Does nothing
 * where no mount and no type has steps. */
bool sp_set_front(const sp_search *search, sp_deadline *deadline, sp_front *front, sp_error *error);

#endif
