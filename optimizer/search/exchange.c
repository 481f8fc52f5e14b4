#include "search/exchange.h"

#include <stdlib.h>

#define ROUNDS_MOST 8
#define GAIN_LEAST 1e-5  /* of the area, for a replacement: an exchange must end */
#define OUTLAY_STEP 0.02 /* share of the outlay that a reduction must save */

/* Replaces item i where the pool holds something better for its place. The item then stands last. */
static bool replace(const sp_search *search, sp_pool_gains *gains, double budget, sp_partial *partial, size_t i,
                    bool *changed, sp_error *error)
{
    double before = partial->value;
    sp_placed own = sp_partial_take(search, partial, i);
    double step = GAIN_LEAST * search->all;
    double least = sp_field_gain(search, partial, own.field) + step;
    double gain;
    sp_pose pose;
    if (!sp_pool_best(search, gains, partial, 0, budget, &pose, &gain, error)) {
        free(own.field);
        return false;
    }
    if (gain <= least)
        return sp_partial_add(search, partial, own, error);
    if (!sp_partial_add_pose(search, partial, pose, error)) {
        free(own.field);
        return false;
    }
    /* scores only rank: what counts is the field */
    if (partial->value <= before + step) {
        sp_partial_remove(search, partial, partial->count - 1);
        return sp_partial_add(search, partial, own, error);
    }
    free(own.field);
    *changed = true;
    return true;
}

static bool exchange_rounds(const sp_search *search, sp_pool_gains *gains, double budget, sp_deadline *deadline,
                            sp_partial *partial, sp_error *error)
{
    bool done = true, changed = true;
    sp_partial_refresh(search, partial);
    for (int i = 0; done && changed && i < ROUNDS_MOST && sp_deadline_goes_on(deadline, "exchange", 0); i++) {
        changed = false;
        done = sp_greedy_pool(search, gains, 1, INFINITY, budget, partial, error);
        /* what is replaced or put back goes to the end, so that the first is always the next */
        for (size_t k = 0; done && k < partial->count; k++)
            done = replace(search, gains, budget, partial, 0, &changed, error);
    }
    return done;
}

bool sp_improve(const sp_search *search, sp_pool_gains *gains, double budget, sp_deadline *deadline,
                sp_partial *partial, sp_error *error)
{
    /* credit leads to where nozzles complete one another; in the end only what is covered counts */
    sp_search exact = *search;
    exact.credit = 0;
    bool done = exchange_rounds(search, gains, budget, deadline, partial, error) &&
                exchange_rounds(&exact, gains, budget, deadline, partial, error);
    sp_partial_refresh(search, partial);
    return done;
}

/* Items in the order of what the partial layout would lose with them, least first. The caller frees. */
static size_t *by_loss(const sp_search *search, const sp_partial *partial, sp_error *error)
{
    size_t *order = malloc((partial->count ? partial->count : 1) * sizeof *order);
    double *loss = malloc((partial->count ? partial->count : 1) * sizeof *loss);
    sp_partial rest = {0};
    if (!order || !loss)
        sp_fail_memory(error);
    if (!order || !loss || !sp_partial_copy(search, partial, &rest, error)) {
        free(order);
        free(loss);
        return NULL;
    }
    for (size_t i = 0; i < partial->count; i++) {
        /* the first goes out and comes back last, so that after all turns the order is as before */
        sp_placed placed = sp_partial_take(search, &rest, 0);
        loss[i] = partial->value - rest.value;
        if (!sp_partial_add(search, &rest, placed, error)) {
            free(order);
            order = NULL;
            break;
        }
        size_t at = i;
        for (; at > 0 && loss[order[at - 1]] > loss[i] + SP_TIE * search->all; at--)
            order[at] = order[at - 1];
        order[at] = i;
    }
    sp_partial_free(&rest);
    free(loss);
    return order;
}

bool sp_reduce(const sp_search *search, sp_pool_gains *gains, const sp_partial *partial, double budget, double enough,
               sp_deadline *deadline, sp_partial *reduced, bool *found, sp_error *error)
{
    *found = false;
    size_t *order = by_loss(search, partial, error);
    bool done = order != NULL;
    for (size_t i = 0; done && i < partial->count && (!*found || reduced->covered < enough) &&
                       sp_deadline_goes_on(deadline, "exchange", 0);
         i++) {
        sp_partial trial;
        done = sp_partial_copy(search, partial, &trial, error);
        if (!done)
            break;
        sp_partial_remove(search, &trial, order[i]);
        /* one nozzle may not be enough to leave out: then the smallest remaining follow */
        while (trial.count && trial.outlay > budget)
            sp_partial_remove(search, &trial, trial.count - 1);
        done = sp_improve(search, gains, budget, deadline, &trial, error);
        if (done && trial.outlay <= budget && (!*found || sp_covers_more(search, &trial, reduced))) {
            if (*found)
                sp_partial_free(reduced);
            *reduced = trial;
            *found = true;
        } else {
            sp_partial_free(&trial);
        }
    }
    free(order);
    if (!done && *found) {
        sp_partial_free(reduced);
        *found = false;
    }
    return done;
}

bool sp_shrink(const sp_search *search, sp_pool_gains *gains, double target, sp_deadline *deadline, sp_partial *partial,
               sp_error *error)
{
    for (;;) {
        sp_partial reduced;
        bool found;
        if (partial->count == 0 || !sp_deadline_goes_on(deadline, "exchange", 0))
            return true;
        if (!sp_reduce(search, gains, partial, partial->outlay * (1 - OUTLAY_STEP), target, deadline, &reduced, &found,
                       error))
            return false;
        if (!found || reduced.covered < target) {
            if (found)
                sp_partial_free(&reduced);
            return true;
        }
        sp_partial_free(partial);
        *partial = reduced;
    }
}
