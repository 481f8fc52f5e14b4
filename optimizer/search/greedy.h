/* Greedy next-best-view placement over all candidate poses, and the pool of poses worth another look. */
#ifndef OPTIMIZER_GREEDY_H
#define OPTIMIZER_GREEDY_H

#include "scoring/scoring.h"

/* Poses that were among the best of their mounting point and variant at some moment of the search; ascending, distinct.
 */
typedef struct {
    size_t count, capacity;
    sp_pose *items;
} sp_pool;

bool sp_pool_add(sp_pool *pool, sp_pose pose, sp_error *error);
/* Sorts and drops duplicates. */
void sp_pool_settle(sp_pool *pool);
void sp_pool_free(sp_pool *pool);

/* What scoring a pool takes. */
typedef struct {
    double *scores; /* [pool->count] */
    int threads;
    sp_sweeper *sweepers; /* [threads] */
} sp_bench;

bool sp_bench_create(const sp_search *search, const sp_pool *pool, sp_bench *bench, sp_error *error);
void sp_bench_free(sp_bench *bench);

/* Adds nozzles to the partial layout, each the pose of most gain per outlay^power, the first of equals, until it covers
 * `target` (m² of coarse patches) or nothing more is gained or allowed within an outlay of `budget` (m³/s). The poses
 * that came near go to `pool`. */
bool sp_greedy(const sp_search *search, double power, double target, double budget, sp_deadline *deadline,
               sp_partial *partial, sp_pool *pool, sp_error *error);
/* The same over the pool's poses alone. */
bool sp_greedy_pool(const sp_search *search, const sp_pool *pool, double power, double target, double budget,
                    sp_bench *bench, sp_partial *partial, sp_error *error);
/* The pool's pose of most gain per outlay^power, the first of equals, that the partial layout may still take within the
 * budget; *gain in m², 0 for none that gains at least `least`. */
bool sp_pool_best(const sp_search *search, const sp_pool *pool, const sp_partial *partial, double power, double budget,
                  double least, sp_bench *bench, sp_pose *best, double *gain, sp_error *error);

#endif
