/* The pool's poses as sparse rows over a sample of the patches: small enough to try thousands of layouts on. */
#ifndef OPTIMIZER_TABLE_H
#define OPTIMIZER_TABLE_H

#include "greedy.h"

typedef struct {
    const sp_search *search;
    const sp_pool *pool; /* row i is its pose i */
    size_t patch_count;  /* of the sample */
    float *area;         /* [patch_count], m²: each stands for its neighbours, too */
    float *kept_wet;     /* [patch_count] */
    size_t *start;       /* [pool->count + 1] */
    uint32_t *patch;
    float *field; /* flux over threshold */
} sp_table;

/* Borrows both. */
bool sp_table_create(const sp_search *search, const sp_pool *pool, sp_table *table, sp_error *error);
void sp_table_free(sp_table *table);

static inline double sp_table_flow(const sp_table *table, size_t row)
{
    return table->search->candidates->makes[table->pool->items[row].make].flow;
}

static inline uint32_t sp_table_mount(const sp_table *table, size_t row)
{
    return table->search->sites->items[table->pool->items[row].site].mount;
}

#endif
