/* The inverse evaluator: for every patch, the closed-form flights that reach it and the pattern's density there. */
#include "reach.h"

#include <stdlib.h>

/* Adds what one nozzle brings a patch, all its flights together, to what the criterion counts. */
static void count_liquid(const sp_evaluator *evaluator, sp_deposits *deposits, uint32_t patch, double flux)
{
    double *counted = &deposits->counted[patch];
    *counted = evaluator->setup.criterion.combine == SP_COMBINE_SINGLE ? fmax(*counted, flux) : *counted + flux;
}

/* Patches across which the spray hardly changes, judged at their points. */
static bool lay_points(const sp_emitter *emitter, double flow, sp_deposits *deposits, sp_error *error)
{
    const sp_source *source = &emitter->source;
    const sp_setup *setup = &source->evaluator->setup;
    sp_aim aim = sp_aim_at(emitter->frame.z, sp_spray_reach(&emitter->spray));
    aim.emitter = emitter;
    sp_reach *reach = sp_reach_create(source, &aim, error);
    if (!reach)
        return false;
    for (size_t i = 0; i < reach->count;) {
        uint32_t patch = reach->arrivals[i].patch;
        double passing = 0;
        for (; i < reach->count && reach->arrivals[i].patch == patch; i++) {
            const sp_arrival *arrival = &reach->arrivals[i];
            double intensity = sp_spray_intensity(&emitter->spray, sp_emitter_local(emitter, arrival->direction));
            double flux = flow * intensity * arrival->transfer;
            sp_deposit(deposits, patch, flux, 1, arrival->speed, arrival->incidence, setup->liquid.density);
            passing += arrival->passes ? flux : 0;
        }
        count_liquid(source->evaluator, deposits, patch, passing);
    }
    sp_reach_destroy(reach);
    return true;
}

/* Patches across which it does, integrated. */
static bool lay_footprints(const sp_emitter *emitter, double flow, sp_deposits *deposits, sp_error *error)
{
    const sp_evaluator *evaluator = emitter->source.evaluator;
    size_t count = 0;
    sp_footprint *footprints = sp_footprints(emitter, &count, error);
    if (!footprints)
        return false;
    for (size_t i = 0; i < count; i++) {
        const sp_footprint *footprint = &footprints[i];
        sp_deposit(deposits, footprint->patch, flow * footprint->gain, footprint->arcs, footprint->speed,
                   footprint->incidence, evaluator->setup.liquid.density);
        count_liquid(evaluator, deposits, footprint->patch, flow * footprint->passing);
    }
    free(footprints);
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
        done = lay_points(&emitter, flow, &coverage->deposits, error) &&
               lay_footprints(&emitter, flow, &coverage->deposits, error);
    }
    if (!done || !sp_coverage_conclude(evaluator, layout, coverage, error)) {
        sp_coverage_destroy(coverage);
        return NULL;
    }
    return coverage;
}
