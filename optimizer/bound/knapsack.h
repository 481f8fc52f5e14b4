/* The knapsack of a layout: how much the nozzles that number, water and ports allow could bring at given prices. */
#ifndef OPTIMIZER_KNAPSACK_H
#define OPTIMIZER_KNAPSACK_H

#include <sprayplan/error.h>

#include <stddef.h>
#include <stdint.h>

/* The best prices on offer. A tier is a weight: water in whole units. */
typedef struct {
    size_t tier_count;
    const uint32_t *weight; /* [tier_count], above 0; borrowed */
    size_t port_count;
    size_t most;  /* free nozzles that could be taken at all */
    bool repeats; /* a free nozzle may be taken again and again */
    double *port; /* [port_count x tier_count], the best that fits the port, which takes one; 0: none */
    double *free; /* [tier_count x most] falling; with `repeats` [tier_count], the best; 0: none */
} sp_offers;

bool sp_offers_create(size_t tier_count, const uint32_t *weight, size_t port_count, size_t most, bool repeats,
                      sp_offers *offers, sp_error *error);
void sp_offers_free(sp_offers *offers);
void sp_offers_clear(sp_offers *offers);
/* One candidate's price; `port` SIZE_MAX: a free one. */
void sp_offers_add(sp_offers *offers, size_t port, size_t tier, double price);

/* value[n * (water + 1) + w], [nozzles + 1][water + 1]: the highest total price of at most n nozzles of weight at most
 * w, rounded upwards. Dynamic programming: Martello and Toth, Knapsack Problems, 1990, chapter 2. */
void sp_knapsack(const sp_offers *offers, size_t nozzles, size_t water, double *value);

#endif
