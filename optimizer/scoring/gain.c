#include "scoring/gain.h"

#include "scoring/field.h"
#include "scoring/footprints.h"

#include <stdlib.h>

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
    search->sweeps->score(&credit, &wetted, field, field + search->patch_count, sums);
    return (sp_score){sums[0] * search->all, sums[1] * search->all};
}

/* The worth of a patch after more has come to it, less that before. */
static double rise(const sp_search *search, const sp_partial *partial, size_t p, float hit, float more_film, float dry)
{
    float wet = partial->film ? fmaxf(hit, partial->film[p] + more_film) : hit;
    return (double)(search->area[p] *
                    (sp_worth(search, wet, dry) - sp_worth(search, partial->wet[p], partial->dry[p])));
}

/* What one more adds by its footprint without edges. */
static double footprint_rise(const sp_search *search, const sp_partial *partial, const sp_footprint *footprint)
{
    double gain = 0;
    for (size_t i = 0; i < footprint->count; i++) {
        const sp_print *print = &footprint->prints[i];
        float hit = partial->hit[print->patch], dry = partial->dry[print->patch];
        sp_pour(search, print->hit, &hit, &dry);
        gain += rise(search, partial, print->patch, hit, print->film, dry);
    }
    return gain * search->all;
}

/* What one more adds by its field, whose edges count where `there`, which shares them, is too weak to have any. */
static double field_rise(const sp_search *search, const sp_partial *partial, const float *field, const float *there)
{
    double gain = 0;
    for (size_t p = 0; p < search->patch_count; p++) {
        float hit = partial->hit[p], dry = partial->dry[p];
        sp_pour(search, there[p] < 0 ? sp_without_edge(field[p]) : field[p], &hit, &dry);
        gain += rise(search, partial, p, hit, partial->film ? field[search->patch_count + p] : 0, dry);
    }
    return gain * search->all;
}

double sp_gain_at(const sp_search *search, const sp_partial *partial, sp_pose pose, double gain)
{
    const sp_placed *there = gain > 0 ? sp_partial_edges_at(search, partial, pose) : NULL;
    if (!there)
        return gain;
    if (!sp_type_is_uniform(there->nozzle.type))
        return footprint_rise(search, partial, sp_footprints_look(search->footprints, pose));
    float *field = malloc((search->field_count + 1) * sizeof *field);
    if (!field)
        return gain;
    sp_field_pose(search, pose, field);
    gain = field_rise(search, partial, field, there->field);
    free(field);
    return gain;
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
