/* What each nozzle does by itself, and what is lost without it. */
#include "spray/alone.h"
#include "spray/criterion.h"
#include "spray/state/state.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    const sp_evaluator *evaluator;
    size_t count, patches;
    sp_alone *alone; /* [nozzles] */
    bool *edges;     /* [nozzles], whether its edges count, of those that are looked at: no other repeats it */
} shares;

static bool shares_create(const sp_evaluator *evaluator, size_t count, shares *each, sp_error *error)
{
    *each = (shares){.evaluator = evaluator,
                     .count = count,
                     .patches = evaluator->patches.count,
                     .alone = calloc(count + 1, sizeof *each->alone),
                     .edges = malloc(count + 1)};
    return (each->alone && each->edges) || sp_fail_memory(error);
}

static void shares_free(shares *each)
{
    for (size_t i = 0; each->alone && i < each->count; i++)
        sp_alone_free(&each->alone[i]);
    free(each->alone);
    free(each->edges);
}

static bool keep(const sp_coverage *coverage, size_t nozzle, shares *each, sp_contributions *made, sp_error *error)
{
    made->alone[nozzle] = coverage->covered_area;
    for (size_t i = 0; i < each->patches; i++)
        made->flux[nozzle * each->patches + i] = (float)coverage->deposits.flux[i];
    return sp_alone_create(each->evaluator, coverage, &each->alone[nozzle], error);
}

static bool evaluate_alone(const sp_layout *layout, const sp_coverage *coverage, shares *each, sp_contributions *made,
                           sp_error *error)
{
    if (layout->count == 1)
        return keep(coverage, 0, each, made, error);
    bool done = true;
    for (size_t i = 0; done && i < layout->count; i++) {
        const sp_layout one = {.count = 1, .nozzles = &layout->nozzles[i]};
        sp_coverage *alone = sp_evaluate(each->evaluator, &one, error);
        done = alone && keep(alone, i, each, made, error);
        sp_coverage_destroy(alone);
    }
    return done;
}

/* The share of a patch that all but one nozzle cover together. */
static double share_without(const shares *each, size_t nozzle, size_t patch)
{
    const sp_criterion *criterion = &each->evaluator->setup.criterion;
    sp_wetting others = {0, 1, 0};
    double film = 0;
    for (size_t i = 0; i < each->count; i++) {
        const sp_alone *alone = &each->alone[i];
        if (i == nozzle)
            continue;
        others.even = sp_combined(criterion, others.even, alone->even[patch]);
        if (each->edges[i])
            others.dry *= alone->dry[patch];
        film += alone->film ? alone->film[patch] : 0;
    }
    return sp_share_covered(criterion, others.even, others.dry, film);
}

/* Whose edges count without a nozzle: of those that repeat each other one's. */
static bool find_edges(const sp_layout *layout, size_t nozzle, shares *each, sp_error *error)
{
    sp_layout *others = sp_layout_create(layout->nozzles, layout->count, error);
    if (!others)
        return false;
    others->count--;
    memmove(&others->nozzles[nozzle], &others->nozzles[nozzle + 1], (others->count - nozzle) * sizeof *others->nozzles);
    for (size_t i = 0; i < others->count; i++)
        each->edges[i < nozzle ? i : i + 1] =
            !sp_layout_repeats(others, i, &sp_evaluator_setup(each->evaluator)->liquid);
    sp_layout_destroy(others);
    return true;
}

/* Nothing is lost where it brings nothing that counts. */
static double lost_without(const shares *each, size_t nozzle, const sp_coverage *coverage)
{
    const sp_alone *alone = &each->alone[nozzle];
    double lost = 0;
    for (size_t i = 0; i < each->patches; i++) {
        if (alone->even[i] > 0 || alone->dry[i] < 1 || (alone->film && alone->film[i] > 0))
            lost += (coverage->deposits.share[i] - share_without(each, nozzle, i)) *
                    sp_evaluator_counted(each->evaluator, (uint32_t)i);
    }
    return lost;
}

sp_contributions *sp_contributions_create(const sp_evaluator *evaluator, const sp_layout *layout,
                                          const sp_coverage *coverage, sp_error *error)
{
    if (!evaluator || !layout || !coverage)
        return NULL;
    sp_contributions *made = calloc(1, sizeof *made);
    if (!made)
        return sp_fail_memory(error);
    made->count = layout->count;
    made->patches = evaluator->patches.count;
    made->alone = calloc(made->count + 1, sizeof *made->alone);
    made->lost = calloc(made->count + 1, sizeof *made->lost);
    made->flux = malloc((made->count * made->patches + 1) * sizeof *made->flux);
    shares each;
    bool done = shares_create(evaluator, made->count, &each, error) &&
                ((made->alone && made->lost && made->flux) || sp_fail_memory(error)) &&
                evaluate_alone(layout, coverage, &each, made, error);
    for (size_t i = 0; done && i < made->count; i++) {
        done = find_edges(layout, i, &each, error);
        made->lost[i] = done ? lost_without(&each, i, coverage) : 0;
    }
    shares_free(&each);
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
