/* Jets of nozzles that were flown, kept: layouts that are measured one after the other have most of their nozzles in
 * common, and what they cover follows from what each nozzle does alone. */
#ifndef OPTIMIZER_JET_CACHE_H
#define OPTIMIZER_JET_CACHE_H

#include "spray/alone.h"

#define SP_JET_CACHE_MOST 500 /* nozzles that are kept at a time */

typedef struct {
    sp_nozzle nozzle;
    sp_alone alone;
} sp_cached_nozzle;

/* Of one evaluator and number of jets; none kept: {0}. */
typedef struct {
    size_t count, capacity;
    sp_cached_nozzle *nozzles; /* the one that was asked for last comes last */
} sp_jet_cache;

/* m² that the layout covers, by so many jets of each nozzle, as they are reflected there; by those that the scene gives
 * them where `jets` is 0. A nozzle that is not kept is flown. */
bool sp_jet_cache_area(sp_jet_cache *cache, const sp_evaluator *evaluator, uint64_t jets, int reflections,
                       const sp_layout *layout, double *area, sp_error *error);
void sp_jet_cache_free(sp_jet_cache *cache);

#endif
