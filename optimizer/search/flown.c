#include "search/flown.h"

#include "mesh/grow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BYTES_MOST 0x1p29 /* of all that are kept at a time */

static bool is_the_same(const sp_nozzle *a, const sp_nozzle *b)
{
    return a->jets == b->jets && sp_nozzles_spray_alike(a, b);
}

static void forget_first(sp_flown *flown)
{
    sp_alone_free(&flown->nozzles[0].alone);
    memmove(flown->nozzles, flown->nozzles + 1, --flown->count * sizeof *flown->nozzles);
}

static bool fly(sp_flown *flown, const sp_evaluator *evaluator, uint64_t jets, int reflections, sp_nozzle *nozzle,
                sp_error *error)
{
    const sp_layout one = {.count = 1, .nozzles = nozzle};
    double most = fmin(SP_FLOWN_MOST, BYTES_MOST / (double)(sp_alone_size(evaluator) + 1));
    while (flown->count && (double)(flown->count + 1) > most)
        forget_first(flown);
    if (!sp_grow(&flown->nozzles, &flown->capacity, flown->count + 1, sizeof *flown->nozzles))
        return sp_fail_memory(error);
    sp_coverage *coverage =
        jets > 0 ? sp_evaluate_forward(evaluator, &one, reflections, jets, error) : sp_evaluate(evaluator, &one, error);
    sp_flown_nozzle *last = &flown->nozzles[flown->count];
    last->nozzle = *nozzle;
    bool done = coverage && sp_alone_create(evaluator, coverage, &last->alone, error);
    flown->count += done;
    sp_coverage_destroy(coverage);
    return done;
}

/* Brings the nozzle to the end, flown. */
static bool find(sp_flown *flown, const sp_evaluator *evaluator, uint64_t jets, int reflections, sp_nozzle *nozzle,
                 sp_error *error)
{
    for (size_t i = flown->count; i-- > 0;)
        if (is_the_same(&flown->nozzles[i].nozzle, nozzle)) {
            sp_flown_nozzle found = flown->nozzles[i];
            memmove(flown->nozzles + i, flown->nozzles + i + 1, (flown->count - i - 1) * sizeof found);
            flown->nozzles[flown->count - 1] = found;
            return true;
        }
    return fly(flown, evaluator, jets, reflections, nozzle, error);
}

bool sp_flown_area(sp_flown *flown, const sp_evaluator *evaluator, uint64_t jets, int reflections,
                   const sp_layout *layout, double *area, sp_error *error)
{
    sp_alone all;
    if (!sp_alone_create(evaluator, NULL, &all, error))
        return false;
    bool done = true;
    for (size_t i = 0; done && i < layout->count; i++) {
        done = find(flown, evaluator, jets, reflections, &layout->nozzles[i], error);
        if (done)
            sp_alone_join(evaluator, &all, &flown->nozzles[flown->count - 1].alone, !sp_layout_repeats(layout, i));
    }
    *area = done ? sp_alone_covered(evaluator, &all) : 0;
    sp_alone_free(&all);
    return done;
}

void sp_flown_free(sp_flown *flown)
{
    for (size_t i = 0; i < flown->count; i++)
        sp_alone_free(&flown->nozzles[i].alone);
    free(flown->nozzles);
    *flown = (sp_flown){0};
}
