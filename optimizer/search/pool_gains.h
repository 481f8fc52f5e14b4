/* What the pool's poses would add to a partial layout: kept up from one layout to the next, as most change a few
 * patches only. */
#ifndef OPTIMIZER_POOL_GAINS_H
#define OPTIMIZER_POOL_GAINS_H

#include "scoring/partial.h"
#include "search/kept_gains.h"
#include "search/pool.h"

/* Some of the pool's poses, as columns: which of them bring something to a patch, and what. */
typedef struct {
    size_t first, count; /* poses */
    size_t *start;       /* [patch_count + 1] */
    uint32_t *pose;      /* from the first on */
    float *field, *film; /* as sp_placed's; film NULL: none is asked for */
    float *edge;         /* share of the patch that edges cover where the field is a hit; NULL: none has both */
} sp_pool_part;

typedef struct {
    uint32_t patch;
    sp_left_over was, is;
} sp_pool_change;

typedef struct {
    const sp_pool *pool;
    size_t part_count;
    sp_pool_part *parts;
    sp_kept_gains known[2];  /* without and with credit for what is on the way; 0 of the poses of other ranks' sites */
    sp_pool_change *changes; /* [patch_count], scratch */
    double *score;           /* [pool->count], m², of those that are allowed */
} sp_pool_gains;

/* Borrows the pool, which is not to change. For this search and copies of it with other options or without credit. */
bool sp_pool_gains_create(const sp_search *search, const sp_pool *pool, sp_pool_gains *gains, sp_error *error);
void sp_pool_gains_free(sp_pool_gains *gains);
/* The pool's pose of most gain per outlay^power, the first of equals, that the partial layout may still take within the
 * budget; *gain in m², 0 for none. */
bool sp_pool_best(const sp_search *search, sp_pool_gains *gains, const sp_partial *partial, double power, double budget,
                  sp_pose *best, double *gain, sp_error *error);

#endif
