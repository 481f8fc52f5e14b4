/* The pool: candidate poses worth another look. */
#ifndef OPTIMIZER_POOL_H
#define OPTIMIZER_POOL_H

#include "candidates/candidates.h"

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

#endif
