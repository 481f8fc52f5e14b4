/* Every layout of the candidate poses, where these are as few as some types in some ports. */
#ifndef OPTIMIZER_EXHAUSTIVE_H
#define OPTIMIZER_EXHAUSTIVE_H

#include "search/poses_alone.h"

#define SP_EVERY_NOZZLES 17 /* that none of them has */

/* A layout besides the kept nozzles, its poses rising. */
typedef struct {
    double outlay, flow, area; /* m³/s, m³/s, with the kept nozzles; m² */
    uint8_t count, pose[SP_EVERY_NOZZLES];
} sp_exhaustive_record;

typedef struct {
    sp_poses_alone poses;
    sp_exhaustive_record *records; /* [count], the cheapest first, of equals what covers more */
    size_t count;                  /* 0: too many, jets would have to be flown for each pose, or time ran out */
    bool whole;                    /* there is no other: a pose could not be taken twice, or not to any avail */
} sp_exhaustive;

/* m³/s that a layout takes at most, with the kept nozzles. Where mounts cost something the two are limits of their own:
 * what costs less outlay than another may take more water. */
typedef struct {
    double outlay, water;
} sp_exhaustive_limits;

/* All within the limits, on the patches of `evaluator`, in which no pose is taken twice. Freed by the caller, after
 * failure too. */
bool sp_exhaustive_create(const sp_search *search, const sp_evaluator *evaluator, sp_exhaustive_limits limits,
                          sp_deadline *deadline, const char *stage, sp_exhaustive *every, sp_error *error);
void sp_exhaustive_free(sp_exhaustive *every);

#endif
