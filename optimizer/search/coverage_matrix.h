/* The coverage matrix: the pool's poses, and nozzles of partial layouts beside them, as sparse rows over a sample of
 * the patches, small enough to try thousands of layouts on. */
#ifndef OPTIMIZER_COVERAGE_MATRIX_H
#define OPTIMIZER_COVERAGE_MATRIX_H

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
} sp_coverage_matrix;

/* Borrows all; `others` are nozzles of partial layouts of the same search, or NULL. */
bool sp_coverage_matrix_create(const sp_search *search, const sp_pool *pool, const sp_placed *const *others,
                               size_t other_count, sp_coverage_matrix *matrix, sp_error *error);
void sp_coverage_matrix_free(sp_coverage_matrix *matrix);

static inline uint32_t sp_coverage_matrix_mount(const sp_coverage_matrix *matrix, size_t row)
{
    return row < matrix->pool->count ? matrix->search->sites->items[matrix->pool->items[row].site].mount
                                     : matrix->others[row - matrix->pool->count]->site.mount;
}

static inline double sp_coverage_matrix_flow(const sp_coverage_matrix *matrix, size_t row)
{
    return row < matrix->pool->count ? matrix->search->candidates->variants[matrix->pool->items[row].variant].flow
                                     : matrix->others[row - matrix->pool->count]->flow;
}

static inline double sp_coverage_matrix_outlay(const sp_coverage_matrix *matrix, size_t row)
{
    return sp_outlay_at(matrix->search, sp_coverage_matrix_mount(matrix, row), sp_coverage_matrix_flow(matrix, row));
}

#endif
