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

#define SP_KNAPSACK_COUNTED 256 /* nozzles, up to which number and water are counted together */

/* The highest total price of at most so many nozzles of so much weight, rounded upwards. Of more nozzles than are
 * counted only the water is, and the best price times their number: no less, and the same where water is what limits
 * them. */
typedef struct {
    size_t nozzles, water; /* at most */
    size_t rows;           /* nozzles + 1, or 1 where they are not counted */
    double best;           /* of all prices */
    double *value;         /* [rows][water + 1] */
} sp_knapsack;

bool sp_knapsack_create(size_t nozzles, size_t water, sp_knapsack *knapsack, sp_error *error);
void sp_knapsack_free(sp_knapsack *knapsack);
/* Dynamic programming: Martello and Toth, Knapsack Problems, 1990, chapter 2. Up to `water`, no more than created for:
 * less takes less time. */
void sp_knapsack_fill(sp_knapsack *knapsack, const sp_offers *offers, size_t water);
/* The price (m²) up to which further nozzles of this weight, however many and in whatever ports, raise no value;
 * INFINITY for one that is too heavy. Of what was filled up to all the water. */
double sp_knapsack_idle(const sp_knapsack *knapsack, uint32_t weight);
/* Of what was filled. */
double sp_knapsack_value(const sp_knapsack *knapsack, size_t nozzles, size_t water);

#endif
