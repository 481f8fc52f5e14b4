/* The inverse evaluator: for every patch, the closed-form flights that reach it, the share of it that lies inside the
 * spray and the pattern's density there. */
#include "inverse.h"

#include "nozzle_bodies.h"

#include <assert.h>
#include <stdlib.h>

/* All arrivals of one pattern at one patch, `first` to `end`. */
static void lay_patch(const sp_emitter *emitter, double flow, const sp_arrival *first, const sp_arrival *end,
                      sp_combination *combination)
{
    const sp_setup *setup = &emitter->source.evaluator->setup;
    sp_wetting wetting = {0, 1, 0};
    sp_edge_samples samples = sp_edge_samples_dark();
    /* no patch receives more than there is, however dense the flights are at its points */
    double counted = 0, left = flow / emitter->source.evaluator->patches.area[first->patch];
    for (const sp_arrival *arrival = first; arrival < end; arrival++) {
        double share = sp_emitter_share(emitter, arrival), flux = sp_emitter_flux(emitter, flow, arrival, share);
        double mean = fmin(arrival->part * share * flux, left);
        assert(mean >= 0 && share <= 1);
        left -= mean;
        if (share > 0)
            sp_deposit(combination->deposits, first->patch, mean, arrival->part, arrival->speed,
                       sp_arrival_incidence(arrival), setup->liquid.density);
        if (!arrival->passes)
            continue;
        counted += mean;
        bool alone = sp_flux_suffices(flux, setup->criterion.flux);
        if (emitter->source.evaluator->movers)
            wetting.even = counted; /* what passes by adds up */
        else
            sp_wetting_add(&wetting, flux, setup->criterion.flux, arrival->part, share,
                           !alone && sp_emitter_holds(emitter, arrival->direction));
        if (alone)
            sp_edges_sample(&combination->edges, arrival, share, &samples);
    }
    sp_combination_add(combination, first->patch, counted, &wetting, samples);
}

void sp_lay_arrivals(const sp_emitter *emitter, double flow, const sp_arrival *arrivals, size_t count,
                     sp_combination *combination)
{
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i + 1; end < count && arrivals[end].patch == arrivals[i].patch;)
            end++;
        lay_patch(emitter, flow, &arrivals[i], &arrivals[end], combination);
    }
}

static bool lay_pattern(const sp_emitter *emitter, double flow, sp_watch *watch, sp_combination *combination,
                        sp_work *work, sp_error *error)
{
    sp_aim aim = sp_aim_at(emitter->frame.z, sp_spray_reach(&emitter->spray));
    aim.emitter = emitter;
    aim.watch = watch;
    sp_reach *reach = sp_reach_create(&emitter->source, &aim, error);
    if (!reach)
        return false;
    sp_lay_arrivals(emitter, flow, reach->arrivals, reach->count, combination);
    work->places += reach->work.places;
    work->rays += reach->work.rays;
    sp_reach_destroy(reach);
    return true;
}

static bool lay_bodies(const sp_evaluator *evaluator, const sp_bodies *bodies, sp_combination *combination,
                       sp_work *work, sp_error *error)
{
    sp_watch watch = sp_watch_start(evaluator, "patches", bodies->patterns->count * evaluator->patches.count);
    for (size_t b = 0; b < bodies->layout->count; b++) {
        sp_combination_begin_nozzle(combination, bodies->layout, b);
        const sp_nozzle *patterns = &bodies->patterns->nozzles[bodies->first[b]];
        size_t count = bodies->first[b + 1] - bodies->first[b];
        for (size_t i = 0; i < count; i++) {
            sp_emitter emitter = sp_bodies_emitter(evaluator, bodies, bodies->first[b] + i);
            double flow = sp_nozzle_flow(&patterns[i], &evaluator->setup.liquid);
            sp_combination_begin_pattern(combination, patterns, i, count);
            if (flow > 0 && !lay_pattern(&emitter, flow, &watch, combination, work, error))
                return false;
            sp_combination_end_pattern(combination, patterns, i, count);
        }
        sp_combination_end_nozzle(combination);
    }
    return sp_watch_end(&watch, error);
}

sp_coverage *sp_evaluate_inverse(const sp_evaluator *evaluator, const sp_layout *layout, sp_error *error)
{
    if (!evaluator || !layout)
        return NULL;
    sp_bodies bodies;
    sp_combination combination = {0};
    sp_coverage *coverage =
        sp_bodies_create(evaluator, layout, &bodies, error) && sp_bodies_fly(evaluator, &bodies, error)
            ? sp_coverage_create(evaluator, error)
            : NULL;
    bool done = coverage && sp_combination_create(evaluator, &coverage->deposits, &combination, error) &&
                lay_bodies(evaluator, &bodies, &combination, &coverage->work, error) &&
                sp_coverage_conclude(evaluator, &bodies, coverage, error);
    sp_combination_free(&combination);
    sp_bodies_free(&bodies);
    if (done)
        return coverage;
    sp_coverage_destroy(coverage);
    return NULL;
}
