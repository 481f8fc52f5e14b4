/* The pool's poses, and nozzles of partial layouts beside them, as sparse rows over a sample of the patches: small
 * enough to try thousands of layouts on. */
#ifndef OPTIMIZER_TABLE_H
#define OPTIMIZER_TABLE_H

#include "search/greedy.h"

typedef struct {
    const sp_search *search;
    const sp_pool *pool; /* row i is its pose i */
    size_t row_count;
    const sp_placed *const *others;         /* the rows behind the pool's */
    size_t patch_count;                     /* of the sample */
    float *area;                            /* [patch_count], share of all: each stands for its neighbours, too */
    float *kept_hit, *kept_film, *kept_dry; /* [patch_count]; kept_film, as `film`, NULL where film is not asked for */
    size_t *start;                          /* [row_count + 1] */
    uint32_t *patch;
    float *field, *film;  /* as sp_placed's */
    size_t *column_start; /* [patch_count + 1]; the same by patch */
    uint32_t *column_row;
    float *column_field, *column_film;
} sp_table;

/* Borrows all; `others` are nozzles of partial layouts of the same search, or NULL. */
bool sp_table_create(const sp_search *search, const sp_pool *pool, const sp_placed *const *others, size_t other_count,
                     sp_table *table, sp_error *error);
void sp_table_free(sp_table *table);

static inline uint32_t sp_table_mount(const sp_table *table, size_t row)
{
    return row < table->pool->count ? table->search->sites->items[table->pool->items[row].site].mount
                                    : table->others[row - table->pool->count]->site.mount;
}

static inline double sp_table_flow(const sp_table *table, size_t row)
{
    return row < table->pool->count ? table->search->candidates->variants[table->pool->items[row].variant].flow
                                    : table->others[row - table->pool->count]->flow;
}

static inline double sp_table_outlay(const sp_table *table, size_t row)
{
    return sp_outlay_at(table->search, sp_table_mount(table, row), sp_table_flow(table, row));
}

#endif
