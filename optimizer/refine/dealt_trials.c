#include "refine/dealt_trials.h"

#include "scoring/partial_packing.h"

#include <stdlib.h>

static sp_ranks *ranks_of(const sp_local_search *local)
{
    return local->search->options->run.ranks;
}

/* Takes the step for trial i where it is this rank's, and all are asked for, or it is better. */
static void take(const sp_local_search *local, sp_trial *trials, size_t i, bool better, sp_trial_step step,
                 sp_error *failure)
{
    sp_error mine = {0};
    if (sp_ranks_mine(ranks_of(local), i) && (!better || trials[i].better) && !step(local, &trials[i], &mine)) {
#pragma omp critical(sp_local_search_failure)
        *failure = mine;
    }
}

bool sp_trials_for_each(const sp_local_search *local, sp_trial *trials, size_t count, bool better, sp_trial_step step,
                        sp_error *error)
{
    sp_error failure = {0};
    sp_ranks_part(ranks_of(local));
#pragma omp parallel for num_threads(local->threads) schedule(dynamic, 1)
    for (size_t k = 0; k < count; k++)
        take(local, trials, count - 1 - k, better, step, &failure);
    sp_ranks_rejoin(ranks_of(local));
    if (failure.kind == SP_OK)
        return true;
    return sp_fail(error, failure.kind, failure.file, failure.line, failure.column, "%s", failure.message);
}

bool sp_trials_share_merits(const sp_local_search *local, sp_trial *trials, size_t count, sp_error *error)
{
    sp_ranks *ranks = ranks_of(local);
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    for (size_t i = 0; i < count; i++)
        if (sp_ranks_mine(ranks, i)) {
            sp_pack(&outgoing, &trials[i].better, sizeof trials[i].better);
            sp_pack(&outgoing, &trials[i].covered, sizeof trials[i].covered);
        }
    if (!sp_ranks_gather(ranks, "merits", &outgoing, &gathered, error))
        return false;
    for (size_t i = 0; i < count; i++)
        if (!sp_ranks_mine(ranks, i) && sp_unpack(&gathered, sp_ranks_owner(ranks, i), &trials[i].better, sizeof(bool)))
            sp_unpack(&gathered, sp_ranks_owner(ranks, i), &trials[i].covered, sizeof(double));
    sp_gathered_free(&gathered);
    return true;
}

bool sp_trials_share_partials(const sp_local_search *local, sp_trial *trials, size_t count, bool better,
                              sp_error *error)
{
    const sp_search *search = local->search;
    sp_ranks *ranks = ranks_of(local);
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    for (size_t i = 0; sp_ranks_count(ranks) > 1 && i < count; i++)
        if (sp_ranks_mine(ranks, i) && (!better || trials[i].better))
            sp_pack_partial(search, &trials[i].partial, &outgoing);
    if (!sp_ranks_gather(ranks, "trials", &outgoing, &gathered, error))
        return false;
    bool done = true;
    for (size_t i = 0; done && i < count; i++)
        if (!sp_ranks_mine(ranks, i) && (!better || trials[i].better))
            done = sp_unpack_partial(search, &gathered, sp_ranks_owner(ranks, i), &trials[i].partial, error);
    sp_gathered_free(&gathered);
    return done;
}
