/* Water in whole units, so that sums of flows can be told apart exactly. */
#ifndef OPTIMIZER_WATER_UNITS_H
#define OPTIMIZER_WATER_UNITS_H

#include <sprayplan/error.h>

#include <stddef.h>
#include <stdint.h>

#define SP_NOZZLES_MOST 4096 /* of a layout that is bounded */

/* Flows are rounded down to units and budgets up to the next that differs, so that what is within a budget in flows is
 * so in units. */
typedef struct {
    double unit;  /* m³/s; where the flows have a common measure, a whole part of it */
    double slack; /* of a unit, by which rounding may be off */
} sp_water_units;

/* For layouts of at most `nozzles` of these flows (m³/s, above 0) and of others no smaller than `least`, `most` in all.
 */
sp_water_units sp_water_units_create(const double *flows, size_t count, double least, size_t nozzles, double most);
/* A nozzle's flow, 1 at least. */
uint32_t sp_water_weight(const sp_water_units *units, double flow);
size_t sp_water_budget(const sp_water_units *units, double flow);
/* The least flow that has a budget of so many units, rounded downwards. */
double sp_water_least(const sp_water_units *units, size_t budget);

#endif
