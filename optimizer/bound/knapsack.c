#include "bound/knapsack.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define UPWARDS (1 + 1e-12) /* more than all roundings of one table's sums */

bool sp_offers_create(size_t tier_count, const uint32_t *weight, size_t port_count, size_t most, bool repeats,
                      sp_offers *offers, sp_error *error)
{
    *offers = (sp_offers){.tier_count = tier_count,
                          .weight = weight,
                          .port_count = port_count,
                          .most = repeats ? 1 : most,
                          .repeats = repeats};
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

/* One nozzle at most out of a choice of prices by tier, on top of `value`. Downwards, so that what is read is still
 * without it. */
static void take_one(const sp_offers *offers, const double *prices, size_t nozzles, size_t water, double *value)
{
    size_t row = water + 1;
    for (size_t n = nozzles + 1; n-- > 0;)
        for (size_t w = row; w-- > 0;) {
            double best = value[n * row + w];
            for (size_t k = 0; n > 0 && k < offers->tier_count; k++)
                if (prices[k] > 0 && offers->weight[k] <= w)
                    best = fmax(best, prices[k] + value[(n - 1) * row + w - offers->weight[k]]);
            value[n * row + w] = best;
        }
}

/* Up to `times` nozzles of one price, on top of `value`: upwards in n what is read already holds some of them, so that
 * one pass is as many as there is room for. */
static void take_many(uint32_t weight, double price, size_t nozzles, size_t water, double *value)
{
    size_t row = water + 1;
    for (size_t n = 1; n <= nozzles; n++)
        for (size_t w = weight; w < row; w++)
            value[n * row + w] = fmax(value[n * row + w], price + value[(n - 1) * row + w - weight]);
}

static void take_once(uint32_t weight, double price, size_t nozzles, size_t water, double *value)
{
    size_t row = water + 1;
    for (size_t n = nozzles; n > 0; n--)
        for (size_t w = weight; w < row; w++)
            value[n * row + w] = fmax(value[n * row + w], price + value[(n - 1) * row + w - weight]);
}

void sp_knapsack(const sp_offers *offers, size_t nozzles, size_t water, double *value)
{
    memset(value, 0, (nozzles + 1) * (water + 1) * sizeof *value);
    for (size_t k = 0; k < offers->tier_count; k++) {
        const double *prices = &offers->free[k * offers->most];
        if (offers->repeats && prices[0] > 0)
            take_many(offers->weight[k], prices[0], nozzles, water, value);
        for (size_t i = 0; !offers->repeats && i < offers->most && prices[i] > 0; i++) {
            if ((i + 1) * offers->weight[k] > water)
                break;
            take_once(offers->weight[k], prices[i], nozzles, water, value);
        }
    }
    for (size_t p = 0; p < offers->port_count; p++)
        take_one(offers, &offers->port[p * offers->tier_count], nozzles, water, value);
    for (size_t i = 0; i < (nozzles + 1) * (water + 1); i++)
        value[i] *= UPWARDS;
}
