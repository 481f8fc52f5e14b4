/* Work in parts, in any order, shared out among threads.
 *
 * A few long pieces of work side by side (the iterations of a parallel loop) leave threads idle that have none, or
 * whose own was short. What such a piece does in parts goes to these: within a parallel region the parts are tasks,
 * which the region's threads take up that wait at its end.
 *
 * Results are the same bytes for any number of threads. Parts therefore write to places of their own, and sums of
 * floating-point numbers are made over parts whose number the threads do not decide, added up in their order
 * (refine/smooth_sum.h), or of each patch by one thread in the order of the jets (spray/forward.c). */
#ifndef SPRAYPLAN_TEAM_H
#define SPRAYPLAN_TEAM_H

#include <omp.h>
#include <stddef.h>

/* Does one part. No two are done on a thread at a time. */
typedef void (*sp_part_work)(void *user, size_t part);

/* How many threads may do parts, where `threads` are asked for: omp_get_thread_num() is below that. At least 1. */
static inline int sp_team_size(size_t parts, int threads)
{
    if (omp_in_parallel())
        return omp_get_num_threads();
    return parts < (size_t)threads ? (parts ? (int)parts : 1) : threads;
}

/* Does parts 0 to parts - 1, and returns when all are done. */
static inline void sp_team_do(size_t parts, int threads, sp_part_work work, void *user)
{
    if (parts == 1) {
        work(user, 0);
    } else if (omp_in_parallel()) {
#pragma omp taskgroup
        for (size_t part = 0; part < parts; part++) {
#pragma omp task firstprivate(part)
            work(user, part);
        }
    } else {
        int size = sp_team_size(parts, threads);
#pragma omp parallel for num_threads(size) schedule(dynamic, 1)
        for (size_t part = 0; part < parts; part++)
            work(user, part);
    }
}

#endif
