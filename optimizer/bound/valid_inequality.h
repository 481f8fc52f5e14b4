/* Valid inequalities Σ g(share) x >= 1 that are stronger than Σ share x >= 1, where liquid adds up: functions g of a
 * candidate's share of what a texel needs for which the g of any nozzles that together suffice still come to 1. The
 * share itself, min(1, f), is one; others see that few nozzles cannot make much of many small shares, or that two of
 * 0.9 count no more than two of 0.5. */
#ifndef OPTIMIZER_VALID_INEQUALITY_H
#define OPTIMIZER_VALID_INEQUALITY_H

#include <math.h>
#include <stddef.h>

#define SP_INEQUALITY_KINDS 24
#define SP_INEQUALITY_LEVELS 512
/* The kind that, where one nozzle is all there is, sees nothing but whole shares. */
#define SP_INEQUALITY_ALL_OR_NOTHING 4

/* value[kind][level]: g of shares up to level / SP_INEQUALITY_LEVELS, none below the one before it. */
typedef struct {
    size_t nozzles; /* valid for layouts of at most so many */
    size_t kinds;
    float value[SP_INEQUALITY_KINDS][SP_INEQUALITY_LEVELS + 1];
    float steep[SP_INEQUALITY_KINDS]; /* most that g is above a level's share, times it */
} sp_valid_inequalities;

/* Functions for layouts of at most `nozzles`; all hold for fewer as well. */
void sp_valid_inequalities_create(size_t nozzles, sp_valid_inequalities *inequalities);

/* g of a share in [0, 1], rounded upwards. */
static inline float sp_strengthen(const sp_valid_inequalities *inequalities, size_t kind, float share)
{
    float scaled = share * SP_INEQUALITY_LEVELS;
    size_t level = (size_t)scaled;
    return inequalities->value[kind][level + ((float)level < scaled)];
}
/* Of a share that is one of several that a candidate has of one texel, so much that with the others' it comes to their
 * sum strengthened. */
static inline float sp_strengthen_portion(const sp_valid_inequalities *inequalities, size_t kind, float share)
{
    return fminf(1, inequalities->steep[kind] * (share + 1.0f / SP_INEQUALITY_LEVELS));
}

#endif
