/* What each arrival of a nozzle brings to its patch, smoothed, and how that changes with what refinement may set. */
#ifndef OPTIMIZER_SMOOTH_ARRIVALS_H
#define OPTIMIZER_SMOOTH_ARRIVALS_H

#include "refine/pose_parameters.h"
#include "refine/sight.h"

/* How smooth: the width (in logarithm of flux over threshold) of the step from dry to covered, and of the pattern's
 * edge. */
typedef struct {
    double coverage;
    double edge; /* rad */
} sp_width;

/* What each arrival brings its patch, as the measure has it, but smoothed (see sp_wetting): the share of the patch that
 * it covers by itself, and the flux over threshold that it brings towards what several cover together. Derivatives by
 * each value of the pose parameters, [parameters->count][sight->count]. */
typedef struct {
    double *alone, *alone_slope; /* [sight->count]; slopes NULL where they are not asked for */
    double *flux, *flux_slope;
} sp_smooth_arrivals;

/* The liquid that each arrival brings its patch, m³/s, [sight->count], and its derivatives, as slopes of smooth
 * arrivals; `slope` may be NULL. Smoothed at the pattern's edge alone. */
typedef struct {
    double *amount, *slope;
} sp_brought;

/* Sets those of the sight's arrivals from `first` to before `end`, at these values of the pose parameters
 * [SP_UNKNOWNS], visibility as in `sight`. And what is brought, where that is asked for. */
void sp_smooth_arrivals_set(const sp_search *search, const sp_pose_parameters *parameters, const sp_sight *sight,
                            sp_width width, const double *values, size_t first, size_t end,
                            const sp_smooth_arrivals *arrivals, const sp_brought *brought);

/* Logistic function. */
static inline double sp_smooth_step(double x)
{
    return 1 / (1 + exp(-x));
}

#endif
