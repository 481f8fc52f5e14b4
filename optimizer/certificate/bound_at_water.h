/* A certificate in the making, and how the bound at one water is lowered. Its files: this one, the points of the front
 * (front_bounds.h), and the order in which all is done (certificate.c). */
#ifndef OPTIMIZER_BOUND_AT_WATER_H
#define OPTIMIZER_BOUND_AT_WATER_H

#include "certificate/proved_waters.h"
#include "certificate/problem.h"

/* A layout of the front, or the proposal. */
typedef struct {
    size_t water;   /* units that it may take */
    double found;   /* m² that a layout found with no more water covers */
    bool had_turn;  /* in this pass */
    bool looked_at; /* its layouts, in this turn */
} sp_certified_point;

/* How much may be done for bounds. Work is counted in words of 64 texels, as sp_tuples counts it. */
typedef struct {
    double work;       /* for all points together */
    double each;       /* for branch and bound at one point */
    size_t rounds;     /* pricings of all candidates at one point */
    size_t candidates; /* that the layouts of branch and bound are made of, at one point */
} sp_effort;

typedef struct {
    sp_problem problem;
    sp_deadline *deadline;
    sp_bound bound;
    sp_proved_waters proved_waters;
    size_t point_count;
    sp_certified_point *points;
    double done; /* how far it all is, 0 to 1 */
} sp_certifying;

/* For a problem that was created and is taken over, also on error. */
bool sp_certifying_prepare(sp_certifying *c, sp_error *error);
void sp_certifying_free(sp_certifying *c);

/* False once cancelled or out of time, which leaves the proposal as good as it is. `done`: how far the certificate is.
 */
bool sp_certifying_has_time(sp_certifying *c, double done);
/* The work (see sp_effort) that pricing all candidates so often takes. */
double sp_pricing_work(const sp_certifying *c, size_t rounds);

/* Solves at this water and prices all candidates, `rounds` times. */
bool sp_lower_bound(sp_certifying *c, size_t water, size_t rounds, sp_error *error);
/* The same if there is time. `done`: how far the certificate is. */
bool sp_lower_bound_in_time(sp_certifying *c, size_t water, size_t rounds, double done, sp_error *error);
/* The same where the bound is `open` m² above the best layout found. Where that gap is wide, the solve begins on groups
 * of texels: iterations on these get further in as much time, but cannot tell what makes up a narrow gap. */
bool sp_lower_open_bound(sp_certifying *c, size_t water, double open, size_t rounds, sp_error *error);
/* Looks at the layouts of so much water one by one, by the multipliers that the bound was last proved with, for those
 * that cover more than `found`, as long as the bound is more than `least` (share) above it: for the lowest targets that
 * a few candidates come up to, then more, while there is work left. */
bool sp_look_at_layouts(sp_certifying *c, size_t water, double found, double least, sp_effort most, double *work,
                        sp_error *error);

#endif
