#include "search/jet_fields.h"

#include <stdlib.h>
#include <string.h>

#define JETS 3e6            /* of all nozzles together */
#define JETS_LEAST 3e4      /* of each: fewer tell little of what falls on a patch */
#define JETS_EACH_PATCH 100 /* more tell little more */

/* The first that sprays as nozzle i does. */
static size_t first_like(const sp_placed *const *nozzles, size_t i)
{
    size_t first = 0;
    while (!sp_nozzles_spray_alike(&nozzles[first]->nozzle, &nozzles[i]->nozzle))
        first++;
    return first;
}

static size_t count_distinct(const sp_placed *const *nozzles, size_t count)
{
    size_t distinct = 0;
    for (size_t i = 0; i < count; i++)
        distinct += first_like(nozzles, i) == i;
    return distinct;
}

/* What these nozzles together bring to a patch (see sp_placed), hit [patch_count]. */
static bool fly(const sp_search *search, sp_nozzle *nozzles, size_t count, int reflections, double jets, float *hit,
                sp_error *error)
{
    const sp_layout layout = {.count = count, .nozzles = nozzles};
    sp_coverage *coverage =
        sp_evaluate_forward(search->coarse, &layout, reflections, (uint64_t)(jets * (double)count), error);
    for (size_t p = 0; coverage && p < search->patch_count; p++) {
        double even = coverage->deposits.even[p];
        hit[p] = even > 0 ? search->threshold > 0 ? (float)(even / search->threshold) : INFINITY : 0;
    }
    bool done = coverage != NULL;
    sp_coverage_destroy(coverage);
    return done;
}

static bool allocate(const sp_search *search, size_t count, size_t distinct, sp_jet_fields *fields, sp_error *error)
{
    *fields = (sp_jet_fields){.search = *search,
                              .items = calloc(count + 1, sizeof *fields->items),
                              .flown = calloc(count + 1, sizeof *fields->flown),
                              .fields = malloc((distinct * search->field_count + 1) * sizeof *fields->fields),
                              .kept_hit = calloc(search->patch_count + 1, sizeof *fields->kept_hit),
                              .kept_dry = malloc((search->patch_count + 1) * sizeof *fields->kept_dry)};
    if (!fields->items || !fields->flown || !fields->fields || !fields->kept_hit || !fields->kept_dry)
        return sp_fail_memory(error);
    for (size_t p = 0; p < search->patch_count; p++)
        fields->kept_dry[p] = 1;
    fields->search.kept_hit = fields->kept_hit;
    fields->search.kept_dry = fields->kept_dry;
    return true;
}

/* Every nozzle once; fields->count stays 0 where time ends before the last. */
static bool fly_all(const sp_placed *const *nozzles, size_t count, int reflections, double jets, sp_deadline *deadline,
                    sp_jet_fields *fields, sp_error *error)
{
    const sp_search *search = &fields->search;
    float *next = fields->fields;
    if (search->kept_count &&
        !fly(search, search->kept, search->kept_count, reflections, jets, fields->kept_hit, error))
        return false;
    for (size_t i = 0; i < count; i++) {
        size_t first = first_like(nozzles, i);
        sp_placed *item = &fields->items[i];
        *item = *nozzles[i];
        item->field = fields->items[first].field;
        fields->flown[i] = item;
        if (first < i)
            continue;
        if (!sp_deadline_goes_on(deadline, "fill", 0.5))
            return true;
        item->field = next;
        next += search->field_count;
        memcpy(item->field, nozzles[i]->field, search->field_count * sizeof *item->field);
        if (!fly(search, &item->nozzle, 1, reflections, jets, item->field, error))
            return false;
    }
    fields->count = count;
    return true;
}

bool sp_jet_fields_create(const sp_search *search, const sp_evaluator *fine, const sp_placed *const *nozzles,
                          size_t count, sp_deadline *deadline, sp_jet_fields *fields, sp_error *error)
{
    int reflections = sp_evaluator_fidelity(fine)->reflections;
    size_t distinct = count_distinct(nozzles, count);
    double enough = JETS_EACH_PATCH * (double)search->patch_count;
    double jets = fmax(JETS_LEAST, fmin(enough, JETS / (double)distinct));
    sp_error failure = {0};
    if (!allocate(search, count, distinct, fields, error))
        return false;
    /* who is interrupted has what was found without this */
    if (fly_all(nozzles, count, reflections, jets, deadline, fields, &failure) || failure.kind == SP_ERROR_INTERRUPTED)
        return true;
    if (error)
        *error = failure;
    return false;
}

void sp_jet_fields_free(sp_jet_fields *fields)
{
    free(fields->items);
    free(fields->flown);
    free(fields->fields);
    free(fields->kept_hit);
    free(fields->kept_dry);
    *fields = (sp_jet_fields){0};
}
