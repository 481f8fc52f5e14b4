#include "search/tuned.h"

#include <stdlib.h>
#include <string.h>

#define FLOWS 5          /* evenly over what refinement may set */
#define FLOW_APART 0.001 /* share by which two flows differ */

/* The original's makes and behind them the adjustable ones at other flows; base[i]: the original of make i. */
static bool list_makes(const sp_search *search, sp_candidates *candidates, size_t *base)
{
    const sp_candidates *from = search->candidates;
    candidates->makes = malloc((FLOWS + 1) * from->make_count * sizeof *candidates->makes);
    if (!candidates->makes)
        return false;
    memcpy(candidates->makes, from->makes, from->make_count * sizeof *from->makes);
    for (size_t k = 0; k < from->make_count; k++)
        base[k] = k;
    for (size_t k = 0; k < from->make_count; k++) {
        double low, high;
        sp_make make = from->makes[k];
        sp_flow_range(search->options, sp_evaluator_setup(search->coarse), make.type, make.pressure, &low, &high);
        for (size_t i = 0; i < FLOWS && high > low * (1 + FLOW_APART); i++) {
            make.flow = low + (high - low) * (double)i / (FLOWS - 1);
            if (fabs(make.flow - from->makes[k].flow) <= FLOW_APART * make.flow)
                continue;
            base[candidates->make_count] = k;
            candidates->makes[candidates->make_count++] = make;
        }
    }
    return true;
}

static bool list_axes(const sp_candidates *from, const size_t *base, sp_candidates *candidates)
{
    size_t makes = candidates->make_count;
    candidates->axes = malloc(from->mount_count * makes * sizeof *candidates->axes);
    for (size_t i = 0; candidates->axes && i < from->mount_count * makes; i++)
        candidates->axes[i] = from->axes[i / makes * from->make_count + base[i % makes]];
    return candidates->axes;
}

static bool list_poses(const sp_pool *from, const size_t *base, sp_tuned *tuned, sp_error *error)
{
    for (size_t i = 0; i < from->count; i++)
        for (size_t k = 0; k < tuned->candidates.make_count; k++) {
            sp_pose pose = from->items[i];
            if (base[k] != pose.make)
                continue;
            pose.make = (uint32_t)k;
            if (!sp_pool_add(&tuned->pool, pose, error))
                return false;
        }
    sp_pool_settle(&tuned->pool);
    return true;
}

bool sp_tuned_create(const sp_search *search, const sp_pool *pool, sp_tuned *tuned, sp_error *error)
{
    const sp_candidates *from = search->candidates;
    size_t *base = malloc((FLOWS + 1) * from->make_count * sizeof *base);
    *tuned = (sp_tuned){.candidates = *from, .search = *search};
    tuned->candidates.makes = NULL;
    tuned->candidates.axes = NULL;
    tuned->candidates.pose_start = NULL;
    tuned->search.candidates = &tuned->candidates;
    bool done = (base && list_makes(search, &tuned->candidates, base) && list_axes(from, base, &tuned->candidates)) ||
                sp_fail_memory(error);
    done = done && list_poses(pool, base, tuned, error);
    free(base);
    if (!done)
        sp_tuned_free(tuned);
    return done;
}

void sp_tuned_free(sp_tuned *tuned)
{
    free(tuned->candidates.makes);
    free(tuned->candidates.axes);
    sp_pool_free(&tuned->pool);
    *tuned = (sp_tuned){0};
}

void sp_tuned_settle(const sp_tuned *tuned, sp_draft *draft)
{
    const sp_fluid *liquid = &sp_evaluator_setup(tuned->search.coarse)->liquid;
    for (size_t i = 0; i < draft->count; i++) {
        sp_placed *placed = &draft->items[i];
        if (fabs(sp_nozzle_flow(&placed->nozzle, liquid) - placed->flow) > 1e-9 * placed->flow)
            placed->nozzle.flow = placed->flow;
    }
}
