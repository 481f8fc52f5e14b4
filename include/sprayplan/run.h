/* How work is carried out: threads, progress, cancelling. */
#ifndef SPRAYPLAN_RUN_H
#define SPRAYPLAN_RUN_H

#include <sprayplan/ranks.h>

#include <stdbool.h>

#define SP_THREADS 1024 /* at most */

/* {0} is a sensible default: all cores, silent, never cancelled, no time limit. */
typedef struct {
    int threads; /* 1 to SP_THREADS; 0: one per core. The answer does not depend on it. */
    /* Called now and then, from one thread at a time, with the stage's name and how much of it is done (0 to 1).
     * Returning false cancels: sp_place then returns its best so far, anything else fails with SP_ERROR_INTERRUPTED;
     * also what sp_place asks of its evaluator, so that the evaluator's own had better go on. Evaluations that a caller
     * begins within a parallel region of OpenMP ask nobody. May be NULL. */
    bool (*progress)(void *user, const char *stage, double done);
    void *user; /* handed to progress */
    /* s of wall time for sp_place, 0 or more; 0: none. Where an evaluator chooses settings for a layout, it tries no
     * others once a quarter of it is over. */
    double time_limit;
    sp_ranks *ranks; /* with which sp_place shares its work; NULL: none. The answer does not depend on it. */
} sp_run;

#endif
