/* The inverse evaluator: for every patch, the closed-form flights that reach it, the share of it that lies inside the
 * spray and the pattern's density there. */
#include "reach.h"

#include <stdlib.h>

/* All arrivals of one nozzle at one patch, `first` to `end`. */
static void lay_patch(const sp_emitter *emitter, double flow, const sp_arrival *first, const sp_arrival *end,
                      sp_deposits *deposits)
{
    const sp_setup *setup = &emitter->source.evaluator->setup;
    sp_wetting wetting = {0, 1, 0};
    /* no patch receives more than there is, however dense the flights are at its points */
    double counted = 0, left = flow / emitter->source.evaluator->patches.area[first->patch];
    for (const sp_arrival *arrival = first; arrival < end; arrival++) {
        double share = sp_emitter_share(emitter, arrival), flux = sp_emitter_flux(emitter, flow, arrival, share);
        double mean = fmin(arrival->part * share * flux, left);
        left -= mean;
        if (share > 0)
            sp_deposit(deposits, first->patch, mean, arrival->part, arrival->speed, arrival->incidence,
                       setup->liquid.density);
        if (!arrival->passes)
            continue;
        counted += mean;
        sp_wetting_add(&wetting, flux, setup->criterion.flux, arrival->part, share,
                       sp_emitter_holds(emitter, arrival->direction));
    }
    sp_count_wetting(emitter->source.evaluator, deposits, first->patch, counted, &wetting);
}

static bool lay_nozzle(const sp_emitter *emitter, double flow, sp_coverage *coverage, sp_error *error)
{
    sp_aim aim = sp_aim_at(emitter->frame.z, sp_spray_reach(&emitter->spray));
    aim.emitter = emitter;
    sp_reach *reach = sp_reach_create(&emitter->source, &aim, error);
    if (!reach)
        return false;
    for (size_t i = 0, end; i < reach->count; i = end) {
        for (end = i + 1; end < reach->count && reach->arrivals[end].patch == reach->arrivals[i].patch;)
            end++;
        lay_patch(emitter, flow, &reach->arrivals[i], &reach->arrivals[end], &coverage->deposits);
    }
    coverage->work.places += reach->work.places;
    coverage->work.rays += reach->work.rays;
    sp_reach_destroy(reach);
    return true;
}

sp_coverage *sp_evaluate_inverse(const sp_evaluator *evaluator, const sp_layout *layout, sp_error *error)
{
    if (!evaluator || !layout || !sp_evaluator_takes(evaluator, layout, error))
        return NULL;
    sp_coverage *coverage = sp_coverage_create(evaluator, error);
    if (!coverage)
        return NULL;
    bool done = true;
    for (size_t i = 0; done && i < layout->count; i++) {
        sp_emitter emitter = sp_emitter_of(evaluator, &layout->nozzles[i]);
        double flow = sp_nozzle_flow(&layout->nozzles[i], &evaluator->setup.liquid);
        done = !(flow > 0) || lay_nozzle(&emitter, flow, coverage, error);
    }
    if (!done || !sp_coverage_conclude(evaluator, layout, coverage, error)) {
        sp_coverage_destroy(coverage);
        return NULL;
    }
    return coverage;
}
