#include "bound/knapsack.h"
#include "bound/rounding.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool sp_offers_create(size_t tier_count, const uint32_t *weight, size_t port_count, size_t most, bool repeats,
                      sp_offers *offers, sp_error *error)
{
    *offers = (sp_offers){.tier_count = tier_count,
                          .weight = weight,
                          .port_count = port_count,
                          .most = repeats ? 1 : most,
                          .repeats = repeats};
    assert(offers->most > 0);
    offers->port = calloc(port_count * tier_count + 1, sizeof *offers->port);
    offers->free = calloc(tier_count * offers->most + 1, sizeof *offers->free);
    if (offers->port && offers->free)
        return true;
    sp_offers_free(offers);
    return sp_fail_memory(error);
}

void sp_offers_free(sp_offers *offers)
{
    free(offers->port);
    free(offers->free);
    *offers = (sp_offers){0};
}

void sp_offers_clear(sp_offers *offers)
{
    memset(offers->port, 0, offers->port_count * offers->tier_count * sizeof *offers->port);
    memset(offers->free, 0, offers->tier_count * offers->most * sizeof *offers->free);
}

void sp_offers_add(sp_offers *offers, size_t port, size_t tier, double price)
{
    assert(tier < offers->tier_count && (port == SIZE_MAX || port < offers->port_count));
    assert(!isnan(price)); /* which every comparison would leave out */
    if (port != SIZE_MAX) {
        double *best = &offers->port[port * offers->tier_count + tier];
        *best = fmax(*best, price);
        return;
    }
    double *prices = &offers->free[tier * offers->most];
    size_t at = offers->most;
    while (at > 0 && prices[at - 1] < price) {
        if (at < offers->most)
            prices[at] = prices[at - 1];
        at--;
    }
    if (at < offers->most)
        prices[at] = price;
}

bool sp_knapsack_create(size_t nozzles, size_t water, sp_knapsack *knapsack, sp_error *error)
{
    size_t rows = nozzles <= SP_KNAPSACK_COUNTED ? nozzles + 1 : 1;
    *knapsack = (sp_knapsack){.nozzles = nozzles, .water = water, .rows = rows};
    if (water < SIZE_MAX / sizeof(double) / rows - 1)
        knapsack->value = malloc(rows * (water + 1) * sizeof *knapsack->value);
    return knapsack->value || sp_fail_memory(error);
}

void sp_knapsack_free(sp_knapsack *knapsack)
{
    free(knapsack->value);
    *knapsack = (sp_knapsack){0};
}

/* What is worth `value[w]` with n nozzles, from one fewer: where nozzles are not counted the same row. */
static double *fewer(const sp_knapsack *knapsack, size_t n)
{
    return knapsack->value + (knapsack->rows > 1 ? n - 1 : 0) * (knapsack->water + 1);
}

/* One nozzle at most out of a choice of prices by tier, on top of `value`. Downwards, so that what is read is still
 * without it. */
static void take_one(sp_knapsack *knapsack, const sp_offers *offers, const double *prices, size_t water)
{
    for (size_t n = knapsack->rows; n-- > (knapsack->rows > 1);) {
        double *value = knapsack->value + n * (knapsack->water + 1);
        const double *less = fewer(knapsack, n);
        for (size_t w = water + 1; w-- > 0;) {
            double best = value[w];
            for (size_t k = 0; k < offers->tier_count; k++)
                if (prices[k] > 0 && offers->weight[k] <= w)
                    best = fmax(best, prices[k] + less[w - offers->weight[k]]);
            value[w] = best;
        }
    }
}

/* As many nozzles of one price as there is room for, on top of `value`: upwards what is read already holds some. */
static void take_many(sp_knapsack *knapsack, uint32_t weight, double price, size_t water)
{
    for (size_t n = knapsack->rows > 1; n < knapsack->rows; n++) {
        double *value = knapsack->value + n * (knapsack->water + 1);
        const double *less = fewer(knapsack, n);
        for (size_t w = weight; w <= water; w++)
            value[w] = fmax(value[w], price + less[w - weight]);
    }
}

/* One of them. */
static void take_once(sp_knapsack *knapsack, uint32_t weight, double price, size_t water)
{
    for (size_t n = knapsack->rows; n-- > (knapsack->rows > 1);) {
        double *value = knapsack->value + n * (knapsack->water + 1);
        const double *less = fewer(knapsack, n);
        for (size_t w = water + 1; w-- > weight;)
            value[w] = fmax(value[w], price + less[w - weight]);
    }
}

static double best_of(const sp_offers *offers)
{
    double best = 0;
    for (size_t k = 0; k < offers->tier_count; k++)
        best = fmax(best, offers->free[k * offers->most]);
    for (size_t i = 0; i < offers->port_count * offers->tier_count; i++)
        best = fmax(best, offers->port[i]);
    return best;
}

void sp_knapsack_fill(sp_knapsack *knapsack, const sp_offers *offers, size_t water)
{
    size_t row = knapsack->water + 1;
    assert(water <= knapsack->water);
    for (size_t n = 0; n < knapsack->rows; n++)
        memset(knapsack->value + n * row, 0, (water + 1) * sizeof *knapsack->value);
    for (size_t k = 0; k < offers->tier_count; k++) {
        const double *prices = &offers->free[k * offers->most];
        assert(offers->weight[k] > 0 && prices[0] >= prices[offers->most - 1]);
        if (offers->repeats && prices[0] > 0)
            take_many(knapsack, offers->weight[k], prices[0], water);
        for (size_t i = 0; !offers->repeats && i < offers->most && prices[i] > 0; i++) {
            if ((i + 1) * offers->weight[k] > water)
                break;
            take_once(knapsack, offers->weight[k], prices[i], water);
        }
    }
    for (size_t p = 0; p < offers->port_count; p++)
        take_one(knapsack, offers, &offers->port[p * offers->tier_count], water);
    for (size_t n = 0; n < knapsack->rows; n++)
        for (size_t w = 0; w <= water; w++)
            knapsack->value[n * row + w] *= SP_UPWARDS_TABLE;
    knapsack->best = best_of(offers) * SP_UPWARDS_TABLE;
}

/* One nozzle of this price on top of any choice that leaves room for it comes to no more than the best choice with as
 * many nozzles and as much water: all values stay as they were, and so they do with the next one. */
double sp_knapsack_idle(const sp_knapsack *knapsack, uint32_t weight)
{
    const double *most = knapsack->value + (knapsack->rows - 1) * (knapsack->water + 1);
    double least = knapsack->rows > 1 ? INFINITY : knapsack->best;
    if (weight > knapsack->water)
        return INFINITY;
    for (size_t n = knapsack->rows > 1; n < knapsack->rows; n++) {
        const double *value = knapsack->value + n * (knapsack->water + 1), *less = fewer(knapsack, n);
        for (size_t w = weight; w <= knapsack->water; w++)
            least = fmin(least, value[w] - less[w - weight]);
    }
    /* more than the difference is rounded off by */
    return fmax(0, least - 2 * (SP_UPWARDS_TABLE - 1) * most[knapsack->water]);
}

double sp_knapsack_value(const sp_knapsack *knapsack, size_t nozzles, size_t water)
{
    assert(nozzles <= knapsack->nozzles && water <= knapsack->water);
    if (knapsack->rows > 1)
        return knapsack->value[nozzles * (knapsack->water + 1) + water];
    return fmin(knapsack->value[water], (double)nozzles * knapsack->best);
}
