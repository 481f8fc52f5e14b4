/* What each nozzle does by itself, and what is lost without it. */
#include <sprayplan/evaluator.h>

#include <stdlib.h>
#include <string.h>

static bool take_alone(const sp_evaluator *evaluator, const sp_nozzle *nozzle, double *area, float *flux,
                       sp_error *error)
{
    sp_layout *alone = sp_layout_create(nozzle, 1, error);
    sp_coverage *coverage = alone ? sp_evaluate(evaluator, alone, error) : NULL;
    if (coverage) {
        *area = coverage->covered_area;
        for (size_t i = 0; i < coverage->deposits.count; i++)
            flux[i] = (float)coverage->deposits.flux[i];
    }
    bool done = coverage != NULL;
    sp_coverage_destroy(coverage);
    sp_layout_destroy(alone);
    return done;
}

static bool take_away(const sp_evaluator *evaluator, const sp_layout *layout, size_t nozzle, double whole, double *lost,
                      sp_error *error)
{
    *lost = whole;
    if (layout->count == 1)
        return true;
    sp_layout *others = sp_layout_create(layout->nozzles, layout->count, error);
    if (!others)
        return false;
    others->count--;
    memmove(&others->nozzles[nozzle], &others->nozzles[nozzle + 1], (others->count - nozzle) * sizeof *others->nozzles);
    sp_coverage *coverage = sp_evaluate(evaluator, others, error);
    bool done = coverage != NULL;
    *lost -= done ? coverage->covered_area : 0;
    sp_coverage_destroy(coverage);
    sp_layout_destroy(others);
    return done;
}

sp_contributions *sp_contributions_create(const sp_evaluator *evaluator, const sp_layout *layout,
                                          const sp_coverage *coverage, sp_error *error)
{
    sp_contributions *made = calloc(1, sizeof *made);
    if (!made)
        return sp_fail_memory(error);
    made->count = layout->count;
    made->patches = sp_evaluator_patches(evaluator)->count;
    made->alone = calloc(made->count + 1, sizeof *made->alone);
    made->lost = calloc(made->count + 1, sizeof *made->lost);
    made->flux = calloc(made->count * made->patches + 1, sizeof *made->flux);
    bool done = (made->alone && made->lost && made->flux) || sp_fail_memory(error);
    for (size_t i = 0; done && i < made->count; i++)
        done = take_alone(evaluator, &layout->nozzles[i], &made->alone[i], made->flux + i * made->patches, error) &&
               take_away(evaluator, layout, i, coverage->covered_area, &made->lost[i], error);
    if (done)
        return made;
    sp_contributions_destroy(made);
    return NULL;
}

void sp_contributions_destroy(sp_contributions *contributions)
{
    if (!contributions)
        return;
    free(contributions->alone);
    free(contributions->lost);
    free(contributions->flux);
    free(contributions);
}
