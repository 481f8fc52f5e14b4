#include "search/tuned.h"

#include <stdlib.h>
#include <string.h>

#define ANGLES 3         /* a variant's own, and one to each side */
#define FLOWS 5          /* evenly over what refinement may set */
#define FLOW_APART 0.001 /* share by which two flows differ */
#define SETTINGS (ANGLES * (FLOWS + 1))

/* The variant's own angle, and of one at its type's own those halfway to the ends of what refinement may set, where the
 * candidates are; returns how many. */
static size_t list_angles(const sp_search *search, const sp_variant *own, double angles[ANGLES])
{
    double low, high, rated = own->type->angle;
    size_t count = 0;
    angles[count++] = own->angle;
    sp_angle_range(search->options, own->type, &low, &high);
    if (own->angle == rated && low < rated)
        angles[count++] = 0.5 * (low + rated);
    if (own->angle == rated && high > rated)
        angles[count++] = 0.5 * (high + rated);
    return count;
}

/* The variant's own flow, and others that refinement may set; returns how many. */
static size_t list_flows(const sp_search *search, const sp_variant *own, double flows[FLOWS + 1])
{
    double low, high;
    size_t count = 0;
    flows[count++] = own->flow;
    sp_flow_range(search->options, sp_evaluator_setup(search->coarse), own->type, own->pressure, &low, &high);
    for (size_t i = 0; i < FLOWS && high > low * (1 + FLOW_APART); i++) {
        double flow = low + (high - low) * (double)i / (FLOWS - 1);
        if (fabs(flow - own->flow) > FLOW_APART * flow)
            flows[count++] = flow;
    }
    return count;
}

/* Behind the others those that variant k becomes at other angles and flows. */
static void add_settings(const sp_search *search, size_t k, sp_candidates *candidates, size_t *base)
{
    const sp_variant *own = &search->candidates->variants[k];
    double angles[ANGLES], flows[FLOWS + 1];
    size_t angle_count = list_angles(search, own, angles), flow_count = list_flows(search, own, flows);
    for (size_t a = 0; a < angle_count; a++)
        for (size_t f = a == 0; f < flow_count; f++) {
            sp_variant variant = *own;
            variant.angle = angles[a];
            variant.flow = flows[f];
            variant.spray = sp_spray_create(own->type, angles[a]);
            variant.reach = sp_type_reach(own->type, angles[a]);
            base[candidates->variant_count] = k;
            candidates->variants[candidates->variant_count++] = variant;
        }
}

/* The original's variants and behind them the adjustable ones at other settings; base[i]: the original of variant i. */
static bool list_variants(const sp_search *search, sp_candidates *candidates, size_t *base)
{
    const sp_candidates *from = search->candidates;
    candidates->variants = malloc(SETTINGS * from->variant_count * sizeof *candidates->variants);
    if (!candidates->variants)
        return false;
    memcpy(candidates->variants, from->variants, from->variant_count * sizeof *from->variants);
    for (size_t k = 0; k < from->variant_count; k++)
        base[k] = k;
    for (size_t k = 0; k < from->variant_count; k++)
        add_settings(search, k, candidates, base);
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
    size_t *base = malloc(SETTINGS * from->variant_count * sizeof *base);
    *tuned = (sp_tuned){.candidates = *from, .search = *search, .base = base};
    tuned->candidates.variants = NULL;
    tuned->candidates.axes = NULL;
    tuned->candidates.pose_start = NULL;
    tuned->search.candidates = &tuned->candidates;
    bool done =
        (base && list_variants(search, &tuned->candidates, base) && list_axes(from, base, &tuned->candidates)) ||
        sp_fail_memory(error);
    done = done && list_poses(pool, base, tuned, error);
    if (!done)
        sp_tuned_free(tuned);
    return done;
}

void sp_tuned_free(sp_tuned *tuned)
{
    free(tuned->candidates.variants);
    free(tuned->candidates.axes);
    sp_pool_free(&tuned->pool);
    free(tuned->base);
    *tuned = (sp_tuned){0};
}

/* The candidate that a pose at other settings comes of; `origin` is at that pose. */
static void go_back(const sp_tuned *tuned, sp_placed *placed)
{
    placed->pose.variant = (uint32_t)tuned->base[placed->pose.variant];
    const sp_variant *original = &tuned->candidates.variants[placed->pose.variant];
    placed->origin.angle = original->angle == original->type->angle ? 0 : original->angle;
}

void sp_tuned_settle(const sp_tuned *tuned, sp_partial *partial)
{
    const sp_fluid *liquid = &sp_evaluator_setup(tuned->search.coarse)->liquid;
    for (size_t i = 0; i < partial->count; i++) {
        sp_placed *placed = &partial->items[i];
        if (fabs(sp_nozzle_flow(&placed->nozzle, liquid) - placed->flow) > 1e-9 * placed->flow)
            placed->nozzle.flow = placed->flow;
        if (placed->pose.site != SP_NONE && tuned->base[placed->pose.variant] != placed->pose.variant)
            go_back(tuned, placed);
    }
}
