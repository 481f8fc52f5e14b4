#include "scoring/gain.h"

#include "scoring/footprints.h"

double sp_field_gain(const sp_search *search, const sp_partial *partial, const float *field)
{
    double gain = 0;
    if (partial->film)
        return sp_field_score(search, partial, field).gain;
    for (size_t p = 0; p < search->patch_count; p++)
        if (field[p] != 0 && partial->wet[p] < SP_ENOUGH) {
            float wet = partial->wet[p], dry = partial->dry[p];
            sp_pour(search, field[p], &wet, &dry);
            gain += (double)(search->area[p] *
                             (sp_worth(search, wet, dry) - sp_worth(search, partial->wet[p], partial->dry[p])));
        }
    return gain * search->all;
}

sp_score sp_field_score(const sp_search *search, const sp_partial *partial, const float *field)
{
    sp_credit credit = {search->single, search->credit, 0};
    sp_wetted wetted = {search->patch_count, search->area, partial->hit, partial->film, partial->wet, partial->dry};
    double sums[2];
    search->kernels->score(&credit, &wetted, field, field + search->patch_count, sums);
    return (sp_score){sums[0] * search->all, sums[1] * search->all};
}

/* The worth of a patch after more has come to it, less that before. */
static double rise(const sp_search *search, const sp_partial *partial, size_t p, float hit, float more_film, float dry)
{
    float wet = partial->film ? fmaxf(hit, partial->film[p] + more_film) : hit;
    return (double)(search->area[p] *
                    (sp_worth(search, wet, dry) - sp_worth(search, partial->wet[p], partial->dry[p])));
}

/* What one more adds whose edges this nozzle has, and that sprays `flow` times as much: what falls on all of a patch,
 * by its prints or its field. Without another look at a view, of which a thread has one at a time. */
static double shared_gain(const sp_search *search, const sp_partial *partial, const sp_placed *item, float flow)
{
    double gain = 0;
    const sp_footprint *footprint = sp_type_is_uniform(item->nozzle.type) ? NULL : sp_placed_footprint(search, item);
    for (size_t i = 0; footprint && i < footprint->count; i++) {
        const sp_print *print = &footprint->prints[i];
        float hit = partial->hit[print->patch], dry = partial->dry[print->patch];
        sp_pour(search, flow * print->hit, &hit, &dry);
        gain += rise(search, partial, print->patch, hit, flow * print->film, dry);
    }
    for (size_t p = 0; !footprint && p < search->patch_count; p++) {
        float hit = partial->hit[p], dry = partial->dry[p];
        sp_pour(search, flow * sp_without_edge(item->field[p]), &hit, &dry);
        gain += rise(search, partial, p, hit, partial->film ? flow * item->field[search->patch_count + p] : 0, dry);
    }
    return gain * search->all;
}

double sp_gain_at(const sp_search *search, const sp_partial *partial, sp_pose pose, double gain)
{
    const sp_placed *there = gain > 0 ? sp_partial_edges_at(search, partial, pose) : NULL;
    if (!there || !(there->flow > 0))
        return gain;
    double flow = search->candidates->variants[pose.variant].flow / there->flow;
    return fmin(gain, shared_gain(search, partial, there, (float)flow));
}

sp_score sp_footprint_score(const sp_search *search, const sp_partial *partial, const sp_footprint *footprint)
{
    sp_score score = {0, 0};
    for (size_t i = 0; i < footprint->count; i++) {
        const sp_print *print = &footprint->prints[i];
        uint32_t p = print->patch;
        float before = sp_worth(search, partial->wet[p], partial->dry[p]), hit = partial->hit[p], dry = partial->dry[p];
        if (partial->wet[p] >= SP_ENOUGH || search->area[p] <= 0)
            continue;
        sp_pour(search, print->hit, &hit, &dry);
        sp_pour(search, -print->edge, &hit, &dry);
        float wet = partial->film ? fmaxf(hit, partial->film[p] + print->film) : hit;
        score.gain += (double)(search->area[p] * (sp_worth(search, wet, dry) - before));
        score.room += (double)(search->area[p] * (1 - before));
    }
    score.gain *= search->all;
    score.room *= search->all;
    return score;
}
