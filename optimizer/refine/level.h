/* What each arrival of a nozzle brings to its patch, softly, and how that changes with what refinement may set. */
#ifndef OPTIMIZER_LEVEL_H
#define OPTIMIZER_LEVEL_H

#include "refine/freedom.h"
#include "refine/sight.h"

/* How soft: the width (in logarithm of flux over threshold) of the step from dry to covered, and of the pattern's edge.
 */
typedef struct {
    double level;
    double edge; /* rad */
} sp_width;

/* Levels that add up are fluxes over threshold; others are covers, any of which suffices, but that those of one
 * nozzle's cells of a patch add up. */
static inline bool sp_levels_sum(const sp_search *search)
{
    return !search->single && search->threshold > 0;
}

/* The liquid that each arrival brings its patch, m³/s, [sight->count], and its derivatives, as slopes of levels;
 * `slope` may be NULL. Softened at the pattern's edge alone. */
typedef struct {
    double *amount, *slope;
} sp_brought;

/* At the freedom's values [SP_UNKNOWNS], visibility as in `sight`: level [sight->count] and, where `slope` is not NULL,
 * its derivatives by each value, [freedom->count][sight->count]. And what is brought, where that is asked for. */
void sp_levels(const sp_search *search, const sp_freedom *freedom, const sp_sight *sight, sp_width width,
               const double *values, double *level, double *slope, const sp_brought *brought);

/* Logistic function. */
static inline double sp_soft_step(double x)
{
    return 1 / (1 + exp(-x));
}

#endif
