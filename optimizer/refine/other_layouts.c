#include "refine/other_layouts.h"

#include "search/partial_enumeration.h"
#include "search/runners_up.h"

#include <stdlib.h>
#include <string.h>

#define FEWEST 2 /* nozzles of layouts whose runners-up are refined from every start: that takes little */

/* The matrix that other layouts are found in, what is found for each trial's outlay, and the nozzles of its rows behind
 * the pool's, as the front has them. */
typedef struct {
    sp_coverage_matrix matrix;
    double *budgets;         /* [count] m³/s */
    sp_selection *best;      /* [count] */
    sp_runner_up *runner_up; /* [count * SP_RUNNERS_UP] */
    const sp_placed **nozzles;
    size_t count, nozzle_count;
} others;

static bool others_create(sp_refining *refining, const sp_trials *trials, others *o)
{
    const sp_tuned *tuned = &refining->local_search.tuned;
    *o = (others){.count = trials->count,
                  .budgets = malloc((trials->count + 1) * sizeof *o->budgets),
                  .best = calloc(trials->count + 1, sizeof *o->best),
                  .runner_up = calloc(trials->count * SP_RUNNERS_UP + 1, sizeof *o->runner_up)};
    o->nozzles = sp_front_nozzles(refining->front, &o->nozzle_count);
    if (!o->budgets || !o->best || !o->runner_up || !o->nozzles)
        return sp_fail_memory(refining->error);
    for (size_t i = 0; i < o->count; i++)
        o->budgets[i] = trials->items[i].budget * (1 + SP_ROUNDING);
    return sp_coverage_matrix_create(&tuned->search, &tuned->pool, o->nozzles, o->nozzle_count, &o->matrix,
                                     refining->error) &&
           sp_enumerate_partially(&o->matrix, o->budgets, o->count, refining->deadline, o->best, refining->error);
}

static void others_free(others *o)
{
    for (size_t i = 0; o->best && i < o->count; i++)
        sp_selection_free(&o->best[i]);
    free(o->budgets);
    free(o->best);
    free(o->runner_up);
    free(o->nozzles);
    sp_coverage_matrix_free(&o->matrix);
}

static bool take_best(sp_refining *refining, const others *o, sp_trials *trials)
{
    const sp_search *tuned = &refining->local_search.tuned.search;
    bool done = true;
    for (size_t i = 0; done && i < o->count; i++)
        done = sp_selection_partial(&o->best[i], tuned, o->nozzles, &trials->items[i].other, refining->error);
    return done;
}

/* A trial of other rows in the place of a layout. */
static bool take_rows(sp_refining *refining, const others *o, const sp_partial *partial, double budget,
                      const uint32_t *rows, size_t count, sp_trials *trials)
{
    const sp_search *tuned = &refining->local_search.tuned.search;
    return sp_try_also(refining, trials, partial, budget, SP_TRIAL_RUNNER_UP) &&
           sp_rows_partial(&o->matrix, rows, count, tuned, o->nozzles, &trials->items[trials->count - 1].other,
                           refining->error);
}

/* From every start where nozzles are fewest, else from one. */
static bool take_often(sp_refining *refining, const others *o, const sp_partial *partial, double budget,
                       const uint32_t *rows, size_t count, sp_trials *trials)
{
    bool done = true;
    if (count > FEWEST)
        return take_rows(refining, o, partial, budget, rows, count, trials);
    for (size_t turn = 0; done && turn <= SP_STARTS; turn++) {
        done = take_rows(refining, o, partial, budget, rows, count, trials);
        if (done)
            trials->items[trials->count - 1].turn = turn;
    }
    return done;
}

/* Those from `first` on before the others: trials are carried out from the last one on, and where time runs out the
 * best are to be among them. */
static bool put_first(sp_trials *trials, size_t first, sp_error *error)
{
    size_t count = trials->count - first;
    sp_trial *moved = malloc((count + 1) * sizeof *moved);
    if (!moved)
        return sp_fail_memory(error);
    memcpy(moved, &trials->items[first], count * sizeof *moved);
    memmove(&trials->items[count], trials->items, first * sizeof *moved);
    memcpy(trials->items, moved, count * sizeof *moved);
    free(moved);
    return true;
}

static bool take_all(sp_refining *refining, const others *o, const sp_partial *partial, double budget,
                     const sp_runner_up *found, sp_trials *trials)
{
    bool done = true;
    for (size_t k = 0; done && k < SP_RUNNERS_UP && found[k].count; k++)
        done = take_often(refining, o, partial, budget, found[k].row, found[k].count, trials);
    return done;
}

/* The front's layout of one nozzle; NULL: it has none. */
static const sp_partial *single_of(const sp_front *front)
{
    for (size_t i = 0; i < front->by_number.count; i++)
        if (front->by_number.entries[i].partial.count == 1)
            return &front->by_number.entries[i].partial;
    return NULL;
}

/* Trials of single nozzles of any water, also where several cover far more: the front has the best of each number. */
static bool add_singles(sp_refining *refining, const others *o, sp_trials *trials)
{
    const sp_partial *single = single_of(refining->front);
    const double most = refining->search->outlay_most;
    sp_runner_up found[SP_RUNNERS_UP];
    return !single || (sp_find_singles(&o->matrix, most, refining->deadline, found, refining->error) &&
                       take_all(refining, o, single, most, found, trials));
}

static bool add_runners_up(sp_refining *refining, others *o, sp_trials *trials)
{
    uint64_t seeds = refining->seeds; /* what else is tried does not depend on these */
    bool done = sp_find_runners_up(o->best, o->budgets, o->count, refining->deadline, o->runner_up, refining->error);
    for (size_t i = 0; done && i < o->count; i++) {
        const sp_selection *best = &o->best[i];
        sp_trial asked = trials->items[i];
        done = !best->count || best->count > FEWEST ||
               take_often(refining, o, &asked.partial, asked.budget, best->row, best->count, trials);
        done = done && take_all(refining, o, &asked.partial, asked.budget, &o->runner_up[i * SP_RUNNERS_UP], trials);
    }
    done = done && add_singles(refining, o, trials);
    refining->seeds = seeds;
    return done && put_first(trials, o->count, refining->error);
}

static bool find_others(sp_refining *refining, sp_trials *trials, bool runners_up)
{
    others o;
    bool done = others_create(refining, trials, &o) && take_best(refining, &o, trials) &&
                (!runners_up || add_runners_up(refining, &o, trials));
    others_free(&o);
    return done;
}

bool sp_find_others(sp_refining *refining, sp_trials *trials)
{
    return find_others(refining, trials, false);
}

bool sp_find_others_and_runners_up(sp_refining *refining, sp_trials *trials)
{
    return find_others(refining, trials, true);
}
