#include "search/find.h"

#include "scoring/prepare.h"
#include "scoring/partial_packing.h"
#include "search/exhaustive_best.h"
#include "search/fewest.h"
#include "search/partial_enumeration.h"
#include "search/simulated_annealing.h"

#include <stdlib.h>

#define ROUNDS_MOST 4    /* corrections for what the coarse patches misjudge */
#define FRONT_BUDGETS 8  /* about as many points of the front are searched for */
#define FRONT_RATIO 1.15 /* between two outlays at which the front is searched, at most */
#define STARTS 2         /* of the search at one outlay */
#define STEPS_NOTED 12   /* layouts of a layout's first nozzles that are measured, about */
#define STEPS_SHARE 0.1  /* of the time left, for these */
#define ANNEALING 4e8    /* patches that annealing the better of these goes through */

typedef struct {
    const sp_search *search;
    sp_deadline *deadline;
    sp_front *front;
    sp_pool *pool;
    sp_pool_gains *gains; /* NULL: the pool is not yet filled */
    sp_error *error;
    double target; /* m² on the final patches; INFINITY: as much as possible */
    double budget; /* m³/s of outlay */
} sp_finding;

/* Greedy over everything; where the fine measure falls short of the target, on with a higher coarse one, unless a
 * smaller share is enough. */
static bool first_partial(const sp_finding *finding, double enough, sp_partial *partial)
{
    double coarse = enough * finding->target;
    sp_front_point point;
    /* out of time there is what was known before */
    if (finding->front->best.count && !sp_deadline_goes_on(finding->deadline, "greedy", 0))
        return true;
    for (int round = 0; round < ROUNDS_MOST; round++) {
        size_t before = partial->count;
        if (!sp_greedy(finding->search, 1, coarse, finding->budget, finding->deadline, partial, finding->pool,
                       finding->error) ||
            !sp_front_measure(finding->front, finding->search, partial, &point, finding->error))
            return false;
        if (point.area >= finding->target || enough < 1 || (round && partial->count == before))
            return true;
        coarse = partial->covered + (finding->target - point.area);
    }
    return true;
}

/* Greedy over the pool with another weight of outlay, improved within what is allowed. */
static bool other_partial(const sp_finding *finding, double power)
{
    sp_partial partial;
    if (!sp_partial_create(finding->search, &partial, finding->error))
        return false;
    double coarse = finding->target - finding->front->bias;
    bool done =
        sp_greedy_pool(finding->search, finding->gains, power, coarse, finding->budget, &partial, finding->error);
    double budget = partial.covered >= coarse ? partial.outlay * (1 + SP_ROUNDING) : finding->budget;
    done = done && sp_improve(finding->search, finding->gains, budget, finding->deadline, &partial, finding->error) &&
           sp_front_measure(finding->front, finding->search, &partial, NULL, finding->error);
    sp_partial_free(&partial);
    return done;
}

/* Less outlay at the same coverage, judged on the coarse patches and confirmed on the fine ones. */
static bool shrink_best(const sp_finding *finding)
{
    bool done = true;
    for (int round = 0; done && round < ROUNDS_MOST; round++) {
        sp_front *front = finding->front;
        sp_front_point before = front->measured, point;
        sp_partial partial;
        if (!sp_partial_copy(finding->search, &front->best, &partial, finding->error))
            return false;
        double target = before.area < finding->target ? before.area : finding->target;
        /* each round asks the coarse patches for a little more than the last one's miss */
        double coarse = target - front->bias + 0.001 * round * target;
        done = sp_shrink(finding->search, finding->gains, coarse, finding->deadline, &partial, finding->error);
        bool shrunk = done && partial.outlay < before.outlay;
        if (shrunk)
            done = sp_front_measure(front, finding->search, &partial, &point, finding->error);
        sp_partial_free(&partial);
        if (!shrunk || (done && point.area >= target))
            break;
    }
    return done;
}

/* Start number i of a search within a budget: the first of the greedy order, or what was found by partial enumeration.
 */
static bool start_from(const sp_finding *finding, const sp_partial *greedy, const sp_selection *enumerated,
                       double budget, size_t i, sp_partial *partial)
{
    if (i == 1)
        return sp_selection_partial(enumerated, finding->search, NULL, partial, finding->error);
    if (!sp_partial_copy(finding->search, greedy, partial, finding->error))
        return false;
    while (partial->count && partial->outlay > budget)
        sp_partial_remove(finding->search, partial, partial->count - 1);
    return true;
}

/* The better of what the starts improve to within a budget; *best, which holds a layout, becomes it. */
static bool start_at(const sp_finding *finding, const sp_partial *greedy, const sp_selection *enumerated, double budget,
                     sp_partial *best)
{
    for (size_t i = 0; i < STARTS && sp_deadline_goes_on(finding->deadline, "front", 0); i++) {
        sp_partial partial;
        if (!start_from(finding, greedy, enumerated, budget, i, &partial))
            return false;
        bool done = sp_improve(finding->search, finding->gains, budget, finding->deadline, &partial, finding->error);
        bool better = done && sp_covers_more(finding->search, &partial, best);
        sp_partial_free(better ? best : &partial);
        if (better)
            *best = partial;
        if (!done)
            return false;
    }
    return true;
}

static sp_ranks *ranks_of(const sp_finding *finding)
{
    return finding->search->options->run.ranks;
}

/* Anneals every layout that is this rank's within its budget, many at a time. */
static bool anneal_all(const sp_finding *finding, const double *budgets, sp_partial *partials, size_t count)
{
    sp_error failure = {0};
    int threads = sp_scorer_threads(finding->search);
    /* the last have most nozzles, so that no thread is left alone with one of these */
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
    for (size_t k = 0; k < count; k++) {
        size_t i = count - 1 - k;
        sp_error mine = {0};
        if (sp_ranks_mine(ranks_of(finding), i) &&
            !sp_simulated_annealing(finding->search, budgets[i], ANNEALING, i + 1, finding->deadline, &partials[i],
                                    &mine)) {
#pragma omp critical(sp_find_failure)
            failure = mine;
        }
    }
    if (failure.kind == SP_OK)
        return true;
    return sp_fail(finding->error, failure.kind, failure.file, failure.line, failure.column, "%s", failure.message);
}

/* What the others have found. */
static bool share_partials(const sp_finding *finding, sp_partial *partials, size_t count)
{
    sp_ranks *ranks = ranks_of(finding);
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    for (size_t i = 0; sp_ranks_count(ranks) > 1 && i < count; i++)
        if (sp_ranks_mine(ranks, i))
            sp_pack_partial(finding->search, &partials[i], &outgoing);
    if (!sp_ranks_gather(ranks, "annealing", &outgoing, &gathered, finding->error))
        return false;
    bool done = true;
    for (size_t i = 0; done && i < count; i++)
        if (!sp_ranks_mine(ranks, i))
            done =
                sp_unpack_partial(finding->search, &gathered, sp_ranks_owner(ranks, i), &partials[i], finding->error);
    sp_gathered_free(&gathered);
    return done;
}

/* The best found within each budget, measured. */
static bool search_budgets(const sp_finding *finding, const sp_partial *greedy, const sp_selection *enumerated,
                           const double *budgets, size_t count)
{
    sp_partial *partials = calloc(count + 1, sizeof *partials);
    bool done = partials || sp_fail_memory(finding->error);
    for (size_t i = 0; done && i < count; i++)
        done = sp_partial_create(finding->search, &partials[i], finding->error) &&
               start_at(finding, greedy, &enumerated[i], budgets[i], &partials[i]);
    sp_ranks_part(ranks_of(finding));
    done = done && anneal_all(finding, budgets, partials, count);
    sp_ranks_rejoin(ranks_of(finding));
    done = done && share_partials(finding, partials, count);
    done = done && sp_front_measure_all(finding->front, finding->search, partials, count, finding->error);
    for (size_t i = 0; partials && i < count; i++)
        sp_partial_free(&partials[i]);
    free(partials);
    return done;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts and drops what the front is not searched for: no more than the kept nozzles take, too much, or twice the same.
 * Returns how many are left. */
static size_t sift(const sp_finding *finding, double *budgets, size_t count)
{
    size_t unique = 0;
    qsort(budgets, count, sizeof *budgets, by_size);
    for (size_t i = 0; i < count; i++)
        if (budgets[i] > finding->search->kept_flow && budgets[i] <= finding->budget &&
            (!unique || budgets[i] > budgets[unique - 1] * (1 + 1e-9)))
            budgets[unique++] = budgets[i];
    return unique;
}

/* Puts amounts between those that lie further apart than FRONT_RATIO; NULL when memory runs out. */
static double *densify(double *budgets, size_t *count)
{
    double most = *count ? log(budgets[*count - 1] / budgets[0]) / log(FRONT_RATIO) : 0;
    double *dense = malloc((2 * *count + (size_t)most + 1) * sizeof *dense);
    size_t found = 0;
    for (size_t i = 0; dense && i < *count; i++) {
        double gap = i ? log(budgets[i] / budgets[i - 1]) : 0;
        size_t steps = i ? (size_t)ceil(gap / log(FRONT_RATIO) * (1 - 1e-9)) : 1;
        for (size_t k = 1; k < steps; k++)
            dense[found++] = budgets[i - 1] * exp(gap * (double)k / (double)steps);
        dense[found++] = budgets[i];
    }
    free(budgets);
    *count = found;
    return dense;
}

/* What one nozzle of each variant takes, in each of the mounts that cost differently; returns how many. */
static size_t list_singles(const sp_search *search, double *budgets)
{
    const sp_place_options *options = search->options;
    size_t found = 0;
    for (size_t k = 0; k < options->mount_count; k++) {
        bool known = false;
        for (size_t i = 0; i < k; i++)
            known |= options->mounts[i].cost == options->mounts[k].cost;
        for (size_t m = 0; !known && m < search->candidates->variant_count; m++)
            budgets[found++] =
                search->kept_flow + sp_outlay_at(search, (uint32_t)k, search->candidates->variants[m].flow);
    }
    return found;
}

/* The outlays at which the front is searched: what the greedy order used as it went, all that is allowed where that
 * falls short of the target, what one nozzle of each variant takes, that of the scene's own layout, with which the
 * proposal will be compared, and enough between. Rising; malloc'd, NULL when memory runs out. */
static double *list_budgets(const sp_finding *finding, const sp_partial *greedy, size_t *count)
{
    const sp_search *search = finding->search;
    size_t singles = search->candidates->variant_count * search->options->mount_count;
    double *budgets = malloc((greedy->count + singles + 2) * sizeof *budgets);
    if (!budgets)
        return NULL;
    size_t found = 0, stride = greedy->count / (FRONT_BUDGETS + 1) + 1;
    double outlay = search->kept_flow;
    for (size_t i = 0; i + 1 < greedy->count; i++) {
        outlay += sp_placed_outlay(search, &greedy->items[i]);
        if ((i + 1) % stride == 0)
            budgets[found++] = outlay;
    }
    if (!(finding->front->measured.area >= finding->target))
        budgets[found++] = isfinite(search->outlay_most) ? search->outlay_most : greedy->outlay;
    found += list_singles(search, budgets + found);
    if (search->options->kept)
        budgets[found++] = sp_own_outlay(search);
    *count = sift(finding, budgets, found);
    return densify(budgets, count);
}

/* The front besides the best. */
static bool fill_front(const sp_finding *finding, const sp_partial *greedy)
{
    size_t count = 0;
    double *budgets = list_budgets(finding, greedy, &count);
    if (!budgets)
        return sp_fail_memory(finding->error);
    for (size_t i = 0; i < count; i++)
        budgets[i] *= 1 + SP_ROUNDING;
    sp_coverage_matrix matrix = {0};
    sp_selection *enumerated = calloc(count + 1, sizeof *enumerated);
    bool done = enumerated || sp_fail_memory(finding->error);
    done = done && sp_coverage_matrix_create(finding->search, finding->pool, NULL, 0, &matrix, finding->error) &&
           sp_enumerate_partially(&matrix, budgets, count, finding->deadline, enumerated, finding->error);
    done = done && search_budgets(finding, greedy, enumerated, budgets, count);
    for (size_t i = 0; enumerated && i < count; i++)
        sp_selection_free(&enumerated[i]);
    sp_coverage_matrix_free(&matrix);
    free(enumerated);
    free(budgets);
    return done;
}

/* The best of all layouts where they are few; *whole: nothing betters these. */
static bool try_every_layout(const sp_finding *finding, bool *whole)
{
    sp_partial *partials;
    size_t count;
    bool done = sp_exhaustive_best(finding->search, finding->front, finding->budget, finding->deadline, &partials,
                                   &count, whole, finding->error) &&
                sp_front_measure_all(finding->front, finding->search, partials, count, finding->error);
    for (size_t i = 0; i < count; i++)
        sp_partial_free(&partials[i]);
    free(partials);
    return done;
}

static sp_finding finding_of(const sp_search *search, sp_deadline *deadline, sp_front *front, sp_pool *pool,
                             sp_error *error)
{
    bool most = front->objective == SP_OBJECTIVE_MAX_COVERAGE;
    return (sp_finding){.search = search,
                        .deadline = deadline,
                        .front = front,
                        .pool = pool,
                        .error = error,
                        .target = most ? INFINITY : front->target,
                        .budget = search->outlay_most * (1 + SP_ROUNDING)};
}

bool sp_find_first(const sp_search *search, double enough, sp_deadline *deadline, sp_front *front, sp_pool *pool,
                   sp_partial *first, sp_error *error)
{
    sp_finding finding = finding_of(search, deadline, front, pool, error);
    if (!sp_partial_create(search, first, error))
        return false;
    if (sp_front_measure(front, search, first, NULL, error) && first_partial(&finding, enough, first) &&
        sp_deadline_stage(deadline, "greedy", error))
        return true;
    sp_partial_free(first);
    return false;
}

/* Measures the first `count` nozzles of a layout. */
static bool measure_first(const sp_search *search, const sp_partial *whole, size_t count, sp_front *front,
                          sp_error *error)
{
    sp_partial partial;
    if (!sp_partial_copy(search, whole, &partial, error))
        return false;
    while (partial.count > count)
        sp_partial_remove(search, &partial, partial.count - 1);
    bool done = sp_front_measure(front, search, &partial, NULL, error);
    sp_partial_free(&partial);
    return done;
}

bool sp_find_steps(const sp_search *search, const sp_partial *first, sp_deadline *deadline, sp_front *front,
                   sp_error *error)
{
    size_t stride = (first->count + STEPS_NOTED - 1) / STEPS_NOTED;
    double until = (1 - STEPS_SHARE) * sp_deadline_left(deadline);
    for (size_t count = stride; count < first->count && sp_deadline_left(deadline) >= until; count += stride)
        if (!measure_first(search, first, count, front, error))
            return false;
    return true;
}

/* What other greedy orders and exchanges make of the pool. */
static bool search_pool(sp_finding *finding, const sp_partial *first)
{
    sp_deadline *deadline = finding->deadline;
    sp_pool_gains gains;
    if (!sp_deadline_goes_on(deadline, "exchange", 0))
        return true;
    if (!sp_pool_gains_create(finding->search, finding->pool, &gains, finding->error))
        return false;
    bool done = true;
    finding->gains = &gains;
    for (int i = 0; done && i < 2 && sp_deadline_goes_on(deadline, "exchange", 0); i++)
        done = other_partial(finding, i == 0 ? 0.5 : 0);
    done = done && shrink_best(finding) && sp_deadline_stage(deadline, "exchange", finding->error) &&
           fill_front(finding, first) &&
           sp_find_fewest(finding->search, &gains, first, finding->budget, deadline, finding->front, finding->error);
    sp_pool_gains_free(&gains);
    return done;
}

bool sp_find_more(const sp_search *search, sp_deadline *deadline, sp_front *front, sp_pool *pool,
                  const sp_partial *first, sp_error *error)
{
    sp_finding finding = finding_of(search, deadline, front, pool, error);
    bool whole = false;
    return try_every_layout(&finding, &whole) && (whole || search_pool(&finding, first)) &&
           sp_deadline_stage(deadline, "front", error);
}
