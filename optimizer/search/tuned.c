#include "search/tuned.h"

#include <stdlib.h>
#include <string.h>

#define FLOWS 5          /* evenly over what refinement may set */
#define FLOW_APART 0.001 /* share by which two flows differ */

/* The original's variants and behind them the adjustable ones at other flows; base[i]: the original of variant i. */
static bool list_variants(const sp_search *search, sp_candidates *candidates, size_t *base)
{
    const sp_candidates *from = search->candidates;
    candidates->variants = malloc((FLOWS + 1) * from->variant_count * sizeof *candidates->variants);
    if (!candidates->variants)
        return false;
    memcpy(candidates->variants, from->variants, from->variant_count * sizeof *from->variants);
    for (size_t k = 0; k < from->variant_count; k++)
        base[k] = k;
    for (size_t k = 0; k < from->variant_count; k++) {
        double low, high;
        sp_variant variant = from->variants[k];
        sp_flow_range(search->options, sp_evaluator_setup(search->coarse), variant.type, variant.pressure, &low, &high);
        for (size_t i = 0; i < FLOWS && high > low * (1 + FLOW_APART); i++) {
            variant.flow = low + (high - low) * (double)i / (FLOWS - 1);
            if (fabs(variant.flow - from->variants[k].flow) <= FLOW_APART * variant.flow)
                continue;
            base[candidates->variant_count] = k;
            candidates->variants[candidates->variant_count++] = variant;
        }
    }
    return true;
}

static bool list_axes(const sp_candidates *from, const size_t *base, sp_candidates *candidates)
{
    size_t variants = candidates->variant_count;
    candidates->axes = malloc(from->mount_count * variants * sizeof *candidates->axes);
    for (size_t i = 0; candidates->axes && i < from->mount_count * variants; i++)
        candidates->axes[i] = from->axes[i / variants * from->variant_count + base[i % variants]];
    return candidates->axes;
}

static bool list_poses(const sp_pool *from, const size_t *base, sp_tuned *tuned, sp_error *error)
{
    for (size_t i = 0; i < from->count; i++)
        for (size_t k = 0; k < tuned->candidates.variant_count; k++) {
            sp_pose pose = from->items[i];
            if (base[k] != pose.variant)
                continue;
            pose.variant = (uint32_t)k;
            if (!sp_pool_add(&tuned->pool, pose, error))
                return false;
        }
    sp_pool_settle(&tuned->pool);
    return true;
}

bool sp_tuned_create(const sp_search *search, const sp_pool *pool, sp_tuned *tuned, sp_error *error)
{
    const sp_candidates *from = search->candidates;
    size_t *base = malloc((FLOWS + 1) * from->variant_count * sizeof *base);
    *tuned = (sp_tuned){.candidates = *from, .search = *search};
    tuned->candidates.variants = NULL;
    tuned->candidates.axes = NULL;
    tuned->candidates.pose_start = NULL;
    tuned->search.candidates = &tuned->candidates;
    bool done =
        (base && list_variants(search, &tuned->candidates, base) && list_axes(from, base, &tuned->candidates)) ||
        sp_fail_memory(error);
    done = done && list_poses(pool, base, tuned, error);
    free(base);
    if (!done)
        sp_tuned_free(tuned);
    return done;
}

void sp_tuned_free(sp_tuned *tuned)
{
    free(tuned->candidates.variants);
    free(tuned->candidates.axes);
    sp_pool_free(&tuned->pool);
    *tuned = (sp_tuned){0};
}

void sp_tuned_settle(const sp_tuned *tuned, sp_partial *partial)
{
    const sp_fluid *liquid = &sp_evaluator_setup(tuned->search.coarse)->liquid;
    for (size_t i = 0; i < partial->count; i++) {
        sp_placed *placed = &partial->items[i];
        if (fabs(sp_nozzle_flow(&placed->nozzle, liquid) - placed->flow) > 1e-9 * placed->flow)
            placed->nozzle.flow = placed->flow;
    }
}
