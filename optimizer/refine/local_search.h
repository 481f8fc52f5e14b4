/* Local search: refining many layouts at once, each by continuation and then by compass. */
#ifndef OPTIMIZER_LOCAL_SEARCH_H
#define OPTIMIZER_LOCAL_SEARCH_H

#include "refine/trial.h"

bool sp_local_search_create(const sp_search *search, const sp_pool *pool, const sp_evaluator *fine,
                            sp_deadline *deadline, sp_local_search *local, sp_error *error);
void sp_local_search_free(sp_local_search *local);

/* Searches locally from every trial on few patches, and the best for each amount of water on the search's own. Trials
 * are dealt out to ranks. What comes out does not depend on the number of threads or ranks. */
bool sp_local_search_run(sp_local_search *local, sp_trial *trials, size_t count, sp_error *error);
/* Refines every trial's layout sharply on the final patches, where it never gets worse. */
bool sp_sharpen(sp_local_search *local, sp_trial *trials, size_t count, sp_error *error);

#endif
