#include "bound/bound.h"

#include "bound/solve.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ITERATIONS 150    /* of a solve, at most */
#define TOLERANCE 5e-4    /* at which a solve ends, as a share of the bound */
#define ROWS_MOST 600     /* of the few */
#define IDLE_SHARE 0.98   /* of what could be left out if there were the few alone */
#define CHOICE_LEAST 1e-6 /* a row that the linear program takes less of than this may go */

bool sp_bound_create(const sp_cover *cover, const sp_pricer *pricer, sp_bound *bound, sp_error *error)
{
    *bound = (sp_bound){.cover = cover, .pricer = pricer, .iterations = ITERATIONS, .tolerance = TOLERANCE, .reach = 1};
    if (!sp_dual_create(cover, &bound->dual, error) ||
        !sp_offers_create(cover->tier_count, cover->weight, cover->port_count, cover->nozzles, cover->repeats,
                          &bound->offers, error)) {
        sp_bound_free(bound);
        return false;
    }
    bound->by_water = malloc((cover->water + 1) * sizeof *bound->by_water);
    bound->needed = malloc(cover->tier_count * sizeof *bound->needed);
    bound->guess = calloc(cover->tier_count, sizeof *bound->guess);
    bool done = (bound->by_water && bound->needed && bound->guess) || sp_fail_memory(error);
    if (!done || !sp_knapsack_create(cover->nozzles, cover->water, &bound->knapsack, error)) {
        sp_bound_free(bound);
        return false;
    }
    bound->lightest = UINT32_MAX;
    for (size_t k = 0; k < cover->tier_count; k++)
        bound->lightest = cover->weight[k] < bound->lightest ? cover->weight[k] : bound->lightest;
    assert(bound->lightest > 0); /* it divides water into numbers of nozzles */
    double whole = cover->base;
    for (size_t t = 0; t < cover->texel_count; t++)
        whole += (double)cover->area[t];
    for (size_t w = 0; w <= cover->water; w++)
        bound->by_water[w] = (w < bound->lightest ? cover->base : whole) * (1 + 1e-11);
    return true;
}

void sp_bound_free(sp_bound *bound)
{
    sp_rows_free(&bound->rows);
    sp_dual_free(&bound->dual);
    sp_offers_free(&bound->offers);
    free(bound->by_water);
    free(bound->needed);
    free(bound->guess);
    sp_knapsack_free(&bound->knapsack);
    *bound = (sp_bound){0};
}

/* These alone. */
static void offer_rows(sp_bound *bound)
{
    const sp_rows *rows = &bound->rows;
    sp_offers_clear(&bound->offers);
    for (size_t c = 0; c < rows->count; c++)
        sp_offers_add(&bound->offers, rows->port[c], rows->tier[c], sp_rows_price(rows, c, &bound->dual.multipliers));
}

/* What a candidate must be worth to raise the bound at this water. */
static void find_needed(sp_bound *bound, size_t water)
{
    const sp_cover *cover = bound->cover;
    offer_rows(bound);
    sp_knapsack_fill(&bound->knapsack, &bound->offers, water);
    double most = sp_knapsack_value(&bound->knapsack, cover->nozzles, water);
    for (size_t k = 0; k < cover->tier_count; k++)
        bound->needed[k] = cover->weight[k] > water ? INFINITY
                                                    : most - sp_knapsack_value(&bound->knapsack, cover->nozzles - 1,
                                                                               water - cover->weight[k]);
}

void sp_bound_settle(sp_bound *bound)
{
    const sp_cover *cover = bound->cover;
    for (size_t w = 1; cover->sums && w <= cover->water; w++)
        if (!cover->sums[w])
            bound->by_water[w] = fmin(bound->by_water[w], bound->by_water[w - 1]);
}

/* As high as the few alone let it be; 0 where all will be offered. */
static void guess_idle(sp_bound *bound)
{
    if (!bound->pricer->leaves_idle)
        return;
    sp_knapsack_fill(&bound->knapsack, &bound->offers, bound->cover->water);
    for (size_t k = 0; k < bound->cover->tier_count; k++)
        bound->guess[k] = IDLE_SHARE * sp_knapsack_idle(&bound->knapsack, bound->cover->weight[k]);
}

/* Whether it is as was guessed; where not, nothing is to be left out the next time. */
static bool confirm_idle(sp_bound *bound)
{
    bool confirmed = true;
    sp_knapsack_fill(&bound->knapsack, &bound->offers, bound->cover->water);
    for (size_t k = 0; k < bound->cover->tier_count; k++)
        confirmed = confirmed && bound->guess[k] <= sp_knapsack_idle(&bound->knapsack, bound->cover->weight[k]);
    if (!confirmed) {
        memset(bound->guess, 0, bound->cover->tier_count * sizeof *bound->guess);
        offer_rows(bound);
    }
    return confirmed;
}

/* Prices all candidates on top of the few, and fills the knapsack by what they are worth; *whole: it was not broken
 * off. What may be left out is known once all else is on offer: the few let guess it, and where the guess was too high
 * all are priced again. The few are extended once: the second time the best are the same. */
static bool price_all(sp_bound *bound, bool *whole, sp_error *error)
{
    sp_pricing_task task = {&bound->dual.multipliers, bound->needed, bound->guess, .all = true, .extend = true};
    guess_idle(bound);
    *whole = false;
    for (bool confirmed = false; !confirmed; task.extend = false) {
        if (!sp_cover_goes_on(bound->cover))
            return true;
        if (!bound->pricer->price(bound->pricer->user, &task, &bound->offers, &bound->rows, error))
            return false;
        if (!sp_cover_goes_on(bound->cover))
            return true;
        confirmed = confirm_idle(bound);
    }
    *whole = true;
    return true;
}

/* Prices all candidates on top of the few and lowers every bound that these multipliers lower; `proved` is the one at
 * `water`. */
static bool prove(sp_bound *bound, size_t water, sp_error *error)
{
    const sp_cover *cover = bound->cover;
    size_t row = cover->water + 1;
    if (!price_all(bound, &bound->complete, error))
        return false;
    if (!bound->complete)
        return true;
    bound->proofs++;
    double rest = (cover->base + sp_cover_rest(cover, &bound->dual.multipliers)) * (1 + 1e-12);
    size_t nozzles = bound->dual.multipliers.inequalities ? bound->inequalities.nozzles : cover->nozzles;
    for (size_t w = 0; w < row && (nozzles == cover->nozzles || w / bound->lightest <= nozzles); w++)
        bound->by_water[w] = fmin(bound->by_water[w], rest + sp_knapsack_value(&bound->knapsack, cover->nozzles, w));
    bound->proved = rest + sp_knapsack_value(&bound->knapsack, cover->nozzles, water);
    sp_bound_settle(bound);
    return true;
}

/* Lets go of rows that the linear program has no use for, the oldest first. */
static bool thin_out(sp_bound *bound, sp_error *error)
{
    sp_rows *rows = &bound->rows;
    if (rows->count <= ROWS_MOST)
        return true;
    bool *marked = malloc(rows->count * sizeof *marked);
    if (!marked)
        return sp_fail_memory(error);
    size_t excess = rows->count - ROWS_MOST;
    for (size_t c = 0; c < rows->count; c++) {
        marked[c] = !excess || rows->key[c] == SP_OWN_KEY || sp_dual_choice(&bound->dual, c) >= CHOICE_LEAST;
        excess -= !marked[c];
    }
    size_t count = rows->count;
    sp_rows_keep(rows, marked);
    sp_dual_keep(&bound->dual, count, marked);
    free(marked);
    return true;
}

bool sp_bound_lower_single(sp_bound *bound, sp_error *error)
{
    const sp_cover *cover = bound->cover;
    sp_multipliers *multipliers = &bound->dual.multipliers;
    sp_valid_inequalities_create(1, &bound->inequalities);
    multipliers->inequalities = cover->whole ? NULL : &bound->inequalities;
    for (size_t t = 0; t < cover->texel_count; t++) {
        /* all that counts is whether one nozzle brings all */
        multipliers->plain[t] = cover->whole ? cover->area[t] : 0;
        multipliers->strengthened[t] = cover->whole ? 0 : cover->area[t];
        multipliers->kind[t] = SP_INEQUALITY_ALL_OR_NOTHING;
    }
    for (size_t k = 0; k < cover->tier_count; k++)
        bound->needed[k] = INFINITY;
    offer_rows(bound);
    return prove(bound, bound->lightest < cover->water ? bound->lightest : cover->water, error);
}

/* Solves on the few, and finds what a candidate must be worth to join them. */
static bool solve(sp_bound *bound, size_t water, sp_error *error)
{
    const sp_cover *cover = bound->cover;
    size_t fit = (size_t)(bound->reach * (double)water) / bound->lightest;
    assert(bound->reach >= 1 && fit > 0 && water <= cover->water);
    sp_valid_inequalities_create(fit < cover->nozzles ? fit : cover->nozzles, &bound->inequalities);
    sp_dual_task task = {.nozzles = cover->nozzles,
                         .water = water,
                         .iterations = bound->iterations,
                         .tolerance = bound->tolerance,
                         .inequalities = bound->strengthening ? &bound->inequalities : NULL,
                         .coarse = bound->coarse};
    if (bound->strengthening && !sp_dual_strengthen(&bound->dual, &bound->rows, &bound->inequalities, error))
        return false;
    if (!thin_out(bound, error) || !sp_dual_solve(&bound->dual, &bound->rows, &task, error))
        return false;
    find_needed(bound, water);
    return true;
}

bool sp_bound_lower(sp_bound *bound, size_t water, sp_error *error)
{
    const sp_cover *cover = bound->cover;
    if (water < bound->lightest) {
        bound->proved = bound->by_water[water];
        bound->closed = bound->complete = true;
        return true;
    }
    if (!solve(bound, water, error) || !prove(bound, water, error))
        return false;
    bound->closed = bound->complete && (bound->strengthening || cover->whole) &&
                    bound->proved <= bound->dual.bound * (1 + bound->tolerance);
    bound->strengthening = !cover->whole;
    return true;
}

bool sp_bound_explore(sp_bound *bound, size_t water, sp_error *error)
{
    if (water < bound->lightest)
        return true;
    /* with nothing on offer, what is not needed is idle */
    sp_pricing_task task = {&bound->dual.multipliers, bound->needed, bound->needed, .extend = true};
    if (!solve(bound, water, error) ||
        !bound->pricer->price(bound->pricer->user, &task, &bound->offers, &bound->rows, error))
        return false;
    bound->strengthening = !bound->cover->whole;
    return true;
}

size_t sp_bound_water(const sp_bound *bound, double area)
{
    for (size_t w = 0; w <= bound->cover->water; w++) {
        assert(w == 0 || bound->by_water[w] >= bound->by_water[w - 1]);
        if (bound->by_water[w] >= area)
            return w;
    }
    return SIZE_MAX;
}
