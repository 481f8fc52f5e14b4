/* What each nozzle does by itself, and what is lost without it. Liquid of one does not depend on the others, whichever
 * way it flies or runs down: what any of them do together follows from what each does alone. */
#include "spray/criterion.h"
#include "spray/state/state.h"

#include <stdlib.h>
#include <string.h>

/* What decides whether a patch is covered, of each nozzle alone: as sp_deposits, [nozzles][patches]. */
typedef struct {
    const sp_evaluator *evaluator;
    size_t count, patches;
    double *even, *dry;
    double *film; /* NULL where the criterion does not ask for it */
    bool *edges;  /* [nozzles], whether its edges count, of those that are looked at: no other repeats it */
} shares;

static bool shares_create(const sp_evaluator *evaluator, size_t count, shares *each, sp_error *error)
{
    bool film = evaluator->setup.criterion.film > 0;
    size_t patches = evaluator->patches.count, room = count * patches + 1;
    *each = (shares){.evaluator = evaluator,
                     .count = count,
                     .patches = patches,
                     .even = malloc(room * sizeof *each->even),
                     .dry = malloc(room * sizeof *each->dry),
                     .film = film ? malloc(room * sizeof *each->film) : NULL,
                     .edges = malloc(count + 1)};
    return (each->even && each->dry && (each->film || !film) && each->edges) || sp_fail_memory(error);
}

static void shares_free(shares *each)
{
    free(each->even);
    free(each->dry);
    free(each->film);
    free(each->edges);
}

static void keep(const sp_coverage *alone, size_t nozzle, shares *each, sp_contributions *made)
{
    const sp_deposits *deposits = &alone->deposits;
    size_t first = nozzle * each->patches;
    made->alone[nozzle] = alone->covered_area;
    for (size_t i = 0; i < each->patches; i++) {
        made->flux[first + i] = (float)deposits->flux[i];
        each->even[first + i] = deposits->even[i];
        each->dry[first + i] = deposits->dry[i];
        if (each->film)
            each->film[first + i] = deposits->film[i];
    }
}

static bool evaluate_alone(const sp_layout *layout, const sp_coverage *coverage, shares *each, sp_contributions *made,
                           sp_error *error)
{
    if (layout->count == 1) {
        keep(coverage, 0, each, made);
        return true;
    }
    bool done = true;
    for (size_t i = 0; done && i < layout->count; i++) {
        const sp_layout one = {.count = 1, .nozzles = &layout->nozzles[i]};
        sp_coverage *alone = sp_evaluate(each->evaluator, &one, error);
        done = alone != NULL;
        if (alone)
            keep(alone, i, each, made);
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
        size_t at = i * each->patches + patch;
        if (i == nozzle)
            continue;
        others.even = sp_combined(criterion, others.even, each->even[at]);
        if (each->edges[i])
            others.dry *= each->dry[at];
        film += each->film ? each->film[at] : 0;
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
        each->edges[i < nozzle ? i : i + 1] = !sp_layout_repeats(others, i);
    sp_layout_destroy(others);
    return true;
}

/* Nothing is lost where it brings nothing that counts. */
static double lost_without(const shares *each, size_t nozzle, const sp_coverage *coverage)
{
    double lost = 0;
    for (size_t i = 0; i < each->patches; i++) {
        size_t at = nozzle * each->patches + i;
        if (each->even[at] > 0 || each->dry[at] < 1 || (each->film && each->film[at] > 0))
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
