#include "search/jet_cache.h"

#include "mesh/grow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BYTES_MOST 0x1p29 /* of all that are kept at a time */

static bool is_the_same(const sp_nozzle *a, const sp_nozzle *b)
{
    return a->jets == b->jets && sp_nozzles_spray_alike(a, b);
}

static void forget_first(sp_jet_cache *cache)
{
    sp_alone_free(&cache->nozzles[0].alone);
    memmove(cache->nozzles, cache->nozzles + 1, --cache->count * sizeof *cache->nozzles);
}

static bool fly(sp_jet_cache *cache, const sp_evaluator *evaluator, uint64_t jets, int reflections, sp_nozzle *nozzle,
                sp_error *error)
{
    const sp_layout one = {.count = 1, .nozzles = nozzle};
    double most = fmin(SP_JET_CACHE_MOST, BYTES_MOST / (double)(sp_alone_size(evaluator) + 1));
    while (cache->count && (double)(cache->count + 1) > most)
        forget_first(cache);
    if (!sp_grow(&cache->nozzles, &cache->capacity, cache->count + 1, sizeof *cache->nozzles))
        return sp_fail_memory(error);
    sp_coverage *coverage =
        jets > 0 ? sp_evaluate_forward(evaluator, &one, reflections, jets, error) : sp_evaluate(evaluator, &one, error);
    sp_cached_nozzle *last = &cache->nozzles[cache->count];
    last->nozzle = *nozzle;
    bool done = coverage && sp_alone_create(evaluator, coverage, &last->alone, error);
    cache->count += done;
    sp_coverage_destroy(coverage);
    return done;
}

/* Brings the nozzle to the end, flown. */
static bool find(sp_jet_cache *cache, const sp_evaluator *evaluator, uint64_t jets, int reflections, sp_nozzle *nozzle,
                 sp_error *error)
{
    for (size_t i = cache->count; i-- > 0;)
        if (is_the_same(&cache->nozzles[i].nozzle, nozzle)) {
            sp_cached_nozzle found = cache->nozzles[i];
            memmove(cache->nozzles + i, cache->nozzles + i + 1, (cache->count - i - 1) * sizeof found);
            cache->nozzles[cache->count - 1] = found;
            return true;
        }
    return fly(cache, evaluator, jets, reflections, nozzle, error);
}

bool sp_jet_cache_area(sp_jet_cache *cache, const sp_evaluator *evaluator, uint64_t jets, int reflections,
                       const sp_layout *layout, double *area, sp_error *error)
{
    sp_alone all;
    if (!sp_alone_create(evaluator, NULL, &all, error))
        return false;
    bool done = true;
    for (size_t i = 0; done && i < layout->count; i++) {
        done = find(cache, evaluator, jets, reflections, &layout->nozzles[i], error);
        if (done)
            sp_alone_join(evaluator, &all, &cache->nozzles[cache->count - 1].alone,
                          !sp_layout_repeats(layout, i, &sp_evaluator_setup(evaluator)->liquid));
    }
    *area = done ? sp_alone_covered(evaluator, &all) : 0;
    sp_alone_free(&all);
    return done;
}

void sp_jet_cache_free(sp_jet_cache *cache)
{
    for (size_t i = 0; i < cache->count; i++)
        sp_alone_free(&cache->nozzles[i].alone);
    free(cache->nozzles);
    *cache = (sp_jet_cache){0};
}
