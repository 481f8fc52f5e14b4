/* The least water with which a layout could cover what the proposal does. */
#ifndef OPTIMIZER_LEAST_WATER_H
#define OPTIMIZER_LEAST_WATER_H

#include "certificate/bound_at_water.h"

/* Lowers bounds between where they first allow to cover `area` (m²) and the proposal's water, `most`, the nearer to the
 * former the more trials have yielded nothing. */
bool sp_lower_water(sp_certifying *c, double area, size_t most, size_t trials, size_t rounds, sp_error *error);
/* Raises the water below which nothing covers `area` (m²), step by step. */
bool sp_raise_water(sp_certifying *c, double area, size_t most, sp_effort effort, sp_error *error);

#endif
