#include "search/pool.h"

#include "mesh/grow.h"

#include <stdlib.h>

bool sp_pool_add(sp_pool *pool, sp_pose pose, sp_error *error)
{
    if (!sp_grow(&pool->items, &pool->capacity, pool->count + 1, sizeof *pool->items))
        return sp_fail_memory(error);
    pool->items[pool->count++] = pose;
    return true;
}

static int compare_poses(const void *a, const void *b)
{
    const sp_pose *p = a, *q = b;
    const uint32_t left[4] = {p->site, p->variant, p->axis, p->roll},
                   right[4] = {q->site, q->variant, q->axis, q->roll};
    for (int i = 0; i < 4; i++)
        if (left[i] != right[i])
            return left[i] < right[i] ? -1 : 1;
    return 0;
}

void sp_pool_settle(sp_pool *pool)
{
    if (!pool->count)
        return;
    qsort(pool->items, pool->count, sizeof *pool->items, compare_poses);
    size_t kept = 1;
    for (size_t i = 1; i < pool->count; i++)
        if (compare_poses(&pool->items[i], &pool->items[kept - 1]))
            pool->items[kept++] = pool->items[i];
    pool->count = kept;
}

void sp_pool_free(sp_pool *pool)
{
    free(pool->items);
    *pool = (sp_pool){0};
}
