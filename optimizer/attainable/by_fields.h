/* What fields of candidates reach that closed forms do not tell: film, footprints, and what goods that move take. */
#ifndef OPTIMIZER_BY_FIELDS_H
#define OPTIMIZER_BY_FIELDS_H

#include "attainable/offers.h"
#include "scoring/partial.h"
#include "deadline/deadline.h"

/* Makes SP_REASON_ATTAINABLE of any other reason where the films of as many poses as number, water and ports allow,
 * and of the kept nozzles, could together suffice, on the search's patches; and where what hits could of poses that no
 * sums. `scopes` by variant; `reasons` of the patches of `fine`. Ends early, *whole false, where the run is
 * cancelled, and takes three tenths of the time left at most. */
bool sp_attain_by_fields(const sp_evaluator *fine, const sp_search *search, const sp_scope *scopes,
                         sp_deadline *deadline, sp_reason *reasons, bool *whole, sp_error *error);

#endif
