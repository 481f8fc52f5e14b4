/* The certificate of a placement: how far the best layout could lie beyond what was found. */
#ifndef OPTIMIZER_CERTIFICATE_H
#define OPTIMIZER_CERTIFICATE_H

#include "search/front.h"

/* Bounds what any layout of the search's candidates and of the front's own nozzles could do, and notes it at every
 * point of the front too. Not computed where nothing may be placed or the run is cancelled before the first proof. */
bool sp_certify(const sp_search *search, sp_deadline *deadline, sp_front *front, sp_certificate *certificate,
                sp_error *error);

#endif
