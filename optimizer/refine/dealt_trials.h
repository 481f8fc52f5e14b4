/* Trials dealt out to threads and ranks. */
#ifndef OPTIMIZER_DEALT_TRIALS_H
#define OPTIMIZER_DEALT_TRIALS_H

#include "refine/trial.h"

/* On a thread of its own, with that thread's sights. */
typedef bool (*sp_trial_step)(const sp_local_search *local, sp_trial *trial, sp_error *error);

/* This rank's trials, all or those that are better; the last, which have most nozzles, first, so that no thread is left
 * alone with one of these. Threads that are left without any take parts of the others' (team.h). */
bool sp_trials_for_each(const sp_local_search *local, sp_trial *trials, size_t count, bool better, sp_trial_step step,
                        sp_error *error);
/* What the other ranks' trials came to on few patches: nothing where that does not come. */
bool sp_trials_share_merits(const sp_local_search *local, sp_trial *trials, size_t count, sp_error *error);
/* The other ranks' layouts, of all trials or of those that are better. */
bool sp_trials_share_partials(const sp_local_search *local, sp_trial *trials, size_t count, bool better,
                              sp_error *error);

#endif
