#include "refine/more_water.h"

#include "candidates/ranges.h"
#include "scoring/mount_capacity.h"

#define RUNGS 6   /* amounts of water above the best layout's, evenly by their logarithm */
#define ROUNDS 3  /* of annealing the best layout */
#define GAIN 2e-3 /* more that is covered, for another round */

double sp_best_budget(const sp_refining *refining)
{
    const sp_front *front = refining->front;
    return sp_front_saves(front) ? front->best.outlay : sp_turned_up(refining->search, &front->best);
}

/* Nozzles that the mounts and max_nozzles leave room for; SIZE_MAX: any number. */
static size_t most_nozzles(const sp_search *search)
{
    const sp_place_options *options = search->options;
    size_t most = 0;
    for (size_t m = 0; m < options->mount_count; m++) {
        size_t left = sp_mount_left(search, (uint32_t)m);
        most = left < SIZE_MAX - most ? most + left : SIZE_MAX;
    }
    if (!options->max_nozzles)
        return most;
    size_t allowed = options->max_nozzles > search->kept_count ? options->max_nozzles - search->kept_count : 0;
    return allowed < most ? allowed : most;
}

/* The outlay of the dearest nozzle that may be mounted, turned up as far as it can be. */
static double dearest_nozzle(const sp_search *search)
{
    const sp_candidates *candidates = search->candidates;
    double dearest = 0, low, high;
    for (size_t k = 0; k < candidates->variant_count; k++) {
        const sp_variant *variant = &candidates->variants[k];
        sp_flow_range(search->options, sp_evaluator_setup(search->coarse), variant->type, variant->pressure, &low,
                      &high);
        for (size_t m = 0; m < search->options->mount_count; m++) {
            if (!sp_mount_left(search, (uint32_t)m) || !sp_candidates_axes(candidates, (uint32_t)m, k)->count)
                continue;
            dearest = fmax(dearest, sp_outlay_at(search, (uint32_t)m, high));
        }
    }
    return dearest;
}

/* The most that any layout may come to; what the best does with its nozzles turned up, where nothing limits it. */
static double most_outlay(const sp_refining *refining)
{
    const sp_search *search = refining->search;
    size_t number = most_nozzles(search);
    double dearest = dearest_nozzle(search), most = search->outlay_most;
    double turned = sp_turned_up(search, &refining->front->best);
    if (number < SIZE_MAX)
        most = fmin(most, search->kept_flow + (double)number * dearest);
    return isfinite(most) ? fmax(turned, most) : turned;
}

bool sp_ask_more(sp_refining *refining, sp_trials *trials)
{
    if (sp_front_saves(refining->front))
        return true;
    double outlay = refining->front->best.outlay, most = most_outlay(refining);
    for (int i = 1; i <= RUNGS && outlay > 0 && most > outlay * (1 + SP_GAIN_LEAST); i++)
        if (!sp_ask_other(refining, trials, outlay * pow(most / outlay, (double)i / RUNGS)))
            return false;
    return true;
}

bool sp_try_turned_up(sp_refining *refining, sp_trials *trials)
{
    const sp_front *front = refining->front;
    for (size_t i = 0; !sp_front_saves(front) && i < front->by_number.count; i++) {
        const sp_front_entry *entry = &front->by_number.entries[i];
        double most = sp_turned_up(refining->search, &entry->partial);
        if (most > entry->partial.outlay * (1 + SP_GAIN_LEAST) &&
            !sp_try_also(refining, trials, &entry->partial, most, SP_TRIAL_BY_TURNS))
            return false;
    }
    return true;
}

static bool anneal_best(sp_refining *refining)
{
    sp_trials trials = {0};
    bool done = sp_try_annealed(refining, &trials, &refining->front->best, sp_best_budget(refining)) &&
                sp_trials_carry_out(refining, &trials);
    sp_trials_free(&trials);
    return done;
}

bool sp_cover_more(sp_refining *refining)
{
    double before = 0;
    const sp_front_point *measured = &refining->front->measured;
    for (int round = 0; round < ROUNDS && measured->area > before * (1 + GAIN); round++) {
        before = measured->area;
        if (!anneal_best(refining))
            return false;
    }
    return true;
}
