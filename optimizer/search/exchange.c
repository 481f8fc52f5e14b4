#include "search/exchange.h"

#include <stdlib.h>

#define SWEEPS_MOST 8
#define GAIN_LEAST 1e-5  /* of the area, for a replacement: an exchange must end */
#define OUTLAY_STEP 0.02 /* share of the outlay that a reduction must save */

/* Replaces item i where the pool holds something better for its place. The item then stands last. */
static bool replace(const sp_search *search, const sp_pool *pool, double budget, sp_bench *bench, sp_draft *draft,
                    size_t i, bool *changed, sp_error *error)
{
    double before = draft->value;
    sp_placed own = sp_draft_take(search, draft, i);
    double step = GAIN_LEAST * search->all;
    double least = sp_field_gain(search, draft, own.field) + step;
    double gain;
    sp_pose pose;
    if (!sp_pool_best(search, pool, draft, 0, budget, least, bench, &pose, &gain, error)) {
        free(own.field);
        return false;
    }
    if (gain <= least)
        return sp_draft_add(search, draft, own, error);
    if (!sp_draft_add_pose(search, draft, pose, error)) {
        free(own.field);
        return false;
    }
    /* scores only rank: what counts is the field */
    if (draft->value <= before + step) {
        sp_draft_remove(search, draft, draft->count - 1);
        return sp_draft_add(search, draft, own, error);
    }
    free(own.field);
    *changed = true;
    return true;
}

static bool sweep(const sp_search *search, const sp_pool *pool, double budget, sp_bench *bench, sp_deadline *deadline,
                  sp_draft *draft, sp_error *error)
{
    bool done = true, changed = true;
    sp_draft_refresh(search, draft);
    for (int i = 0; done && changed && i < SWEEPS_MOST && sp_deadline_goes_on(deadline, "exchange", 0); i++) {
        changed = false;
        done = sp_greedy_pool(search, pool, 1, INFINITY, budget, bench, draft, error);
        /* what is replaced or put back goes to the end, so that the first is always the next */
        for (size_t k = 0; done && k < draft->count; k++)
            done = replace(search, pool, budget, bench, draft, 0, &changed, error);
    }
    return done;
}

bool sp_improve(const sp_search *search, const sp_pool *pool, double budget, sp_deadline *deadline, sp_draft *draft,
                sp_error *error)
{
    sp_bench bench;
    if (!sp_bench_create(search, pool, &bench, error))
        return false;
    /* credit leads to where nozzles complete one another; in the end only what is covered counts */
    sp_search exact = *search;
    exact.credit = 0;
    bool done = sweep(search, pool, budget, &bench, deadline, draft, error) &&
                sweep(&exact, pool, budget, &bench, deadline, draft, error);
    sp_draft_refresh(search, draft);
    sp_bench_free(&bench);
    return done;
}

/* Items in the order of what the draft would lose with them, least first. The caller frees. */
static size_t *by_loss(const sp_search *search, const sp_draft *draft, sp_error *error)
{
    size_t *order = malloc((draft->count ? draft->count : 1) * sizeof *order);
    double *loss = malloc((draft->count ? draft->count : 1) * sizeof *loss);
    sp_draft rest = {0};
    if (!order || !loss)
        sp_fail_memory(error);
    if (!order || !loss || !sp_draft_copy(search, draft, &rest, error)) {
        free(order);
        free(loss);
        return NULL;
    }
    for (size_t i = 0; i < draft->count; i++) {
        /* the first goes out and comes back last, so that after all turns the order is as before */
        sp_placed placed = sp_draft_take(search, &rest, 0);
        loss[i] = draft->value - rest.value;
        if (!sp_draft_add(search, &rest, placed, error)) {
            free(order);
            order = NULL;
            break;
        }
        size_t at = i;
        for (; at > 0 && loss[order[at - 1]] > loss[i] + SP_TIE * search->all; at--)
            order[at] = order[at - 1];
        order[at] = i;
    }
    sp_draft_free(&rest);
    free(loss);
    return order;
}

bool sp_reduce(const sp_search *search, const sp_pool *pool, const sp_draft *draft, double budget, double enough,
               sp_deadline *deadline, sp_draft *reduced, bool *found, sp_error *error)
{
    *found = false;
    size_t *order = by_loss(search, draft, error);
    bool done = order != NULL;
    for (size_t i = 0; done && i < draft->count && (!*found || reduced->covered < enough) &&
                       sp_deadline_goes_on(deadline, "exchange", 0);
         i++) {
        sp_draft trial;
        done = sp_draft_copy(search, draft, &trial, error);
        if (!done)
            break;
        sp_draft_remove(search, &trial, order[i]);
        /* one nozzle may not be enough to leave out: then the smallest remaining follow */
        while (trial.count && trial.outlay > budget)
            sp_draft_remove(search, &trial, trial.count - 1);
        done = sp_improve(search, pool, budget, deadline, &trial, error);
        if (done && trial.outlay <= budget && (!*found || sp_covers_more(search, &trial, reduced))) {
            if (*found)
                sp_draft_free(reduced);
            *reduced = trial;
            *found = true;
        } else {
            sp_draft_free(&trial);
        }
    }
    free(order);
    if (!done && *found) {
        sp_draft_free(reduced);
        *found = false;
    }
    return done;
}

bool sp_shrink(const sp_search *search, const sp_pool *pool, double target, sp_deadline *deadline, sp_draft *draft,
               sp_error *error)
{
    for (;;) {
        sp_draft reduced;
        bool found;
        if (draft->count == 0 || !sp_deadline_goes_on(deadline, "exchange", 0))
            return true;
        if (!sp_reduce(search, pool, draft, draft->outlay * (1 - OUTLAY_STEP), target, deadline, &reduced, &found,
                       error))
            return false;
        if (!found || reduced.covered < target) {
            if (found)
                sp_draft_free(&reduced);
            return true;
        }
        sp_draft_free(draft);
        *draft = reduced;
    }
}
