/* Stronger shares where liquid adds up: functions g of a candidate's share of what a texel needs for which the g of any
 * nozzles that together suffice still come to 1. The share itself, min(1, f), is one; others see that few nozzles
 * cannot make much of many small shares, or that two of 0.9 count no more than two of 0.5. */
#ifndef OPTIMIZER_LIFT_H
#define OPTIMIZER_LIFT_H

#include <math.h>
#include <stddef.h>

#define SP_LIFT_KINDS 24
#define SP_LIFT_LEVELS 512
#define SP_LIFT_ALL_OR_NOTHING 4 /* the kind that, where one nozzle is all there is, sees nothing but whole shares */

/* value[kind][level]: g of shares up to level / SP_LIFT_LEVELS, none below the one before it. */
typedef struct {
    size_t nozzles; /* valid for layouts of at most so many */
    size_t kinds;
    float value[SP_LIFT_KINDS][SP_LIFT_LEVELS + 1];
    float steep[SP_LIFT_KINDS]; /* most that g is above a level's share, times it */
} sp_lifts;

/* Functions for layouts of at most `nozzles`; all hold for fewer as well. */
void sp_lifts_create(size_t nozzles, sp_lifts *lifts);

/* g of a share in [0, 1], rounded upwards. */
static inline float sp_lift(const sp_lifts *lifts, size_t kind, float share)
{
    float scaled = share * SP_LIFT_LEVELS;
    size_t level = (size_t)scaled;
    return lifts->value[kind][level + ((float)level < scaled)];
}
/* Of a share that is one of several that a candidate has of one texel, so much that with the others' it comes to their
 * sum's lift. */
static inline float sp_lift_portion(const sp_lifts *lifts, size_t kind, float share)
{
    return fminf(1, lifts->steep[kind] * (share + 1.0f / SP_LIFT_LEVELS));
}

#endif
