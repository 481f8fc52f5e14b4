/* The criterion on patches: what hits and edges come to, when that covers, and what it is worth on the way. */
#ifndef OPTIMIZER_WETNESS_H
#define OPTIMIZER_WETNESS_H

#include "scoring/search.h"

/* Flux over threshold that covers: so much more than 1 that what was rounded up to it in single precision is no less
 * than the threshold. Refinement would else stop where the search sees a patch covered and the evaluator does not. */
#define SP_ENOUGH (1 + 0x1p-20f)

/* What a patch's field and one more flight to `part` of it come to (see sp_wetting_settle). */
static inline float sp_field_join(float a, float b, float part)
{
    if (part < 1 && (b < 0 || b >= 1))
        return fmaxf(fminf(a, 0) - part * fminf(fabsf(b), 1), -1);
    if (part < 1)
        return a < 0 ? a : a + part * b;
    if (a < 0 && b < 0)
        return a + b + a * b;
    if (a >= 0 && b >= 0)
        return a + b;
    return fmaxf(a, b) >= 1 ? fmaxf(a, b) : fminf(a, b);
}

/* Adds a nozzle's field value to what hits a patch and what is left dry of it; without a branch, so that loops over
 * patches can take several at a time. */
static inline void sp_pour(const sp_search *search, float field, float *hit, float *dry)
{
    float more = field > 0 ? field : 0, edge = field < 0 ? 1 + field : 1, sum = *hit + more;
    *dry *= edge;
    *hit = !search->single ? sum : more > *hit ? more : *hit;
}
/* The field value of a nozzle that repeats another: its edges lie where the other's do, and count once. */
static inline float sp_without_edge(float field)
{
    return field > 0 ? field : 0;
}
/* The share of a patch that is covered. */
static inline float sp_covered(float wet, float dry)
{
    return wet >= SP_ENOUGH ? 1 : 1 - dry;
}
/* The worth of a patch per m² at this flux over threshold on all of it, `dry` of it being beyond what edges cover. */
static inline float sp_worth(const sp_search *search, float wet, float dry)
{
    return wet >= SP_ENOUGH ? 1 : 1 - dry * (1 - search->credit * wet);
}

#endif
