/* What film reaches that no spray does. */
#ifndef OPTIMIZER_RUNS_H
#define OPTIMIZER_RUNS_H

#include "attainable/offers.h"
#include "scoring/draft.h"
#include "watch.h"

/* Makes SP_REASON_ATTAINABLE of any other reason where the films of as many poses as number, water and ports allow,
 * and of the kept nozzles, could together suffice, on the search's patches. `scopes` by make; `reasons` of the patches
 * of `fine`. Does nothing where film is not asked for, and ends early where the run is cancelled. */
bool sp_runs(const sp_evaluator *fine, const sp_search *search, const sp_scope *scopes, sp_watch *watch,
             sp_reason *reasons, sp_error *error);

#endif
