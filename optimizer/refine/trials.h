/* Trials: layouts that local search refines, many at a time, and where it looks for others in their place. */
#ifndef OPTIMIZER_TRIALS_H
#define OPTIMIZER_TRIALS_H

#include "refine/local_search.h"
#include "search/front.h"

typedef struct {
    const sp_search *search;
    const sp_pool *pool;
    sp_deadline *deadline;
    sp_front *front;
    sp_local_search local_search;
    uint64_t seeds; /* used so far */
    sp_error *error;
} sp_refining;

/* Trials in the making. */
typedef struct {
    size_t count, capacity;
    sp_trial *items;
} sp_trials;

/* Another trial of a copy of the layout, within a budget (m³/s of outlay). */
bool sp_try_also(sp_refining *refining, sp_trials *trials, const sp_partial *partial, double budget,
                 sp_trial_kind kind);
/* Trials of it by annealing, from several seeds: which of many layouts that are all but equal it ends at is its luck.
 */
bool sp_try_annealed(sp_refining *refining, sp_trials *trials, const sp_partial *partial, double budget);
/* A trial of another layout for so much water, to be better than what the front has for no more. */
bool sp_ask_other(sp_refining *refining, sp_trials *trials, double outlay);
/* Searches locally from the trials and lets the front have them. */
bool sp_trials_carry_out(sp_refining *refining, sp_trials *trials);
/* What the trials' layouts are measured as, all at once (see sp_front_measure_ahead); `better`: of those that got
 * better and may count. [trials->count], the caller frees; NULL on error. */
sp_front_point *sp_trials_measure_ahead(sp_refining *refining, const sp_trials *trials, bool better);
/* Keeps those of which `kept` [count] is true, in their order. */
void sp_trials_keep(sp_trials *trials, const bool *kept);
void sp_trials_free(sp_trials *trials);

#endif
