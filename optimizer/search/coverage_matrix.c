#include "search/coverage_matrix.h"

#include "scoring/field.h"
#include "scoring/scoring.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLE 3000      /* patches: what is found on them is improved on all afterwards */
#define FILM_LEAST 1e-3f /* of what is asked for: less in a row is no help */

void sp_coverage_matrix_free(sp_coverage_matrix *matrix)
{
    free(matrix->area);
    free(matrix->kept_hit);
    free(matrix->kept_film);
    free(matrix->kept_dry);
    free(matrix->start);
    free(matrix->patch);
    free(matrix->field);
    free(matrix->film);
    free(matrix->column_start);
    free(matrix->column_row);
    free(matrix->column_field);
    free(matrix->column_film);
    *matrix = (sp_coverage_matrix){0};
}

/* The patch in the middle of each run of neighbours in the patches' order, with the area of all of the run. */
static void draw_sample(const sp_search *search, size_t *sample, sp_coverage_matrix *matrix)
{
    for (size_t i = 0; i < matrix->patch_count; i++) {
        size_t from = search->patch_count * i / matrix->patch_count,
               to = search->patch_count * (i + 1) / matrix->patch_count;
        assert(from < to); /* every run has a patch of its own */
        sample[i] = (from + to) / 2;
        matrix->kept_hit[i] = search->kept_hit[sample[i]];
        if (matrix->kept_film)
            matrix->kept_film[i] = search->kept_film[sample[i]];
        matrix->kept_dry[i] = search->kept_dry[sample[i]];
        for (size_t p = from; p < to; p++)
            matrix->area[i] += search->area[p];
    }
}

/* One row's entries, malloc'd in one block. */
typedef struct {
    size_t count;
    uint32_t *patch;
    float *field, *film;
} entries;

/* Picks the sample's entries out of a field; false where memory ran out. */
static bool pick(const size_t *sample, const float *field, const sp_coverage_matrix *matrix, entries *row)
{
    const float *film = matrix->kept_film ? field + matrix->search->patch_count : NULL;
    size_t count = 0;
    for (size_t i = 0; i < matrix->patch_count; i++)
        count += field[sample[i]] != 0 || (film && film[sample[i]] > FILM_LEAST);
    *row = (entries){.patch = malloc(count * (sizeof *row->patch + 2 * sizeof *row->field) + 1)};
    if (!row->patch)
        return false;
    row->field = (float *)(row->patch + count);
    row->film = row->field + count;
    for (size_t i = 0; i < matrix->patch_count; i++)
        if (field[sample[i]] != 0 || (film && film[sample[i]] > FILM_LEAST)) {
            row->patch[row->count] = (uint32_t)i;
            if (film)
                row->film[row->count] = film[sample[i]];
            row->field[row->count++] = field[sample[i]];
        }
    return true;
}

/* All rows' entries. */
static bool find_rows(const size_t *sample, const sp_coverage_matrix *matrix, entries *rows, sp_error *error)
{
    size_t fields = matrix->search->field_count + 1, lacking = 0;
    int threads = sp_scorer_threads(matrix->search);
    float *scratch = malloc((size_t)threads * fields * sizeof *scratch);
    if (!scratch)
        return sp_fail_memory(error);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 16) reduction(+ : lacking)
    for (size_t r = 0; r < matrix->row_count; r++) {
        float *own = scratch + (size_t)omp_get_thread_num() * fields;
        bool pool = r < matrix->pool->count;
        if (pool)
            sp_field_pose(matrix->search, matrix->pool->items[r], own);
        lacking += !pick(sample, pool ? own : matrix->others[r - matrix->pool->count]->field, matrix, &rows[r]);
    }
    free(scratch);
    return !lacking || sp_fail_memory(error);
}

/* Puts the rows' entries one after the other. */
static bool join_rows(const entries *rows, sp_coverage_matrix *matrix, sp_error *error)
{
    for (size_t r = 0; r < matrix->row_count; r++)
        matrix->start[r + 1] = matrix->start[r] + rows[r].count;
    size_t used = matrix->start[matrix->row_count];
    matrix->patch = malloc((used + 1) * sizeof *matrix->patch);
    matrix->field = malloc((used + 1) * sizeof *matrix->field);
    matrix->film = matrix->kept_film ? malloc((used + 1) * sizeof *matrix->film) : NULL;
    if (!matrix->patch || !matrix->field || (matrix->kept_film && !matrix->film))
        return sp_fail_memory(error);
    for (size_t r = 0; r < matrix->row_count; r++) {
        size_t at = matrix->start[r];
        memcpy(matrix->patch + at, rows[r].patch, rows[r].count * sizeof *matrix->patch);
        memcpy(matrix->field + at, rows[r].field, rows[r].count * sizeof *matrix->field);
        if (matrix->film)
            memcpy(matrix->film + at, rows[r].film, rows[r].count * sizeof *matrix->film);
    }
    return true;
}

static bool add_rows(const size_t *sample, sp_coverage_matrix *matrix, sp_error *error)
{
    entries *rows = calloc(matrix->row_count + 1, sizeof *rows);
    bool done =
        (rows || sp_fail_memory(error)) && find_rows(sample, matrix, rows, error) && join_rows(rows, matrix, error);
    for (size_t r = 0; rows && r < matrix->row_count; r++)
        free(rows[r].patch);
    free(rows);
    return done;
}

/* The rows' entries by patch. */
static bool add_columns(sp_coverage_matrix *matrix, sp_error *error)
{
    size_t rows = matrix->row_count, used = matrix->start[rows];
    matrix->column_start = calloc(matrix->patch_count + 2, sizeof *matrix->column_start);
    matrix->column_row = malloc((used + 1) * sizeof *matrix->column_row);
    matrix->column_field = malloc((used + 1) * sizeof *matrix->column_field);
    matrix->column_film = matrix->film ? malloc((used + 1) * sizeof *matrix->column_film) : NULL;
    if (!matrix->column_start || !matrix->column_row || !matrix->column_field || (matrix->film && !matrix->column_film))
        return sp_fail_memory(error);
    /* counted two places on, so that filling moves each start to its own place */
    for (size_t i = 0; i < used; i++)
        matrix->column_start[matrix->patch[i] + 2]++;
    for (size_t p = 0; p < matrix->patch_count; p++)
        matrix->column_start[p + 2] += matrix->column_start[p + 1];
    for (size_t r = 0; r < rows; r++)
        for (size_t i = matrix->start[r]; i < matrix->start[r + 1]; i++) {
            size_t at = matrix->column_start[matrix->patch[i] + 1]++;
            matrix->column_row[at] = (uint32_t)r;
            matrix->column_field[at] = matrix->field[i];
            if (matrix->film)
                matrix->column_film[at] = matrix->film[i];
        }
    assert(matrix->column_start[0] == 0 && matrix->column_start[matrix->patch_count] == used);
    return true;
}

bool sp_coverage_matrix_create(const sp_search *search, const sp_pool *pool, const sp_placed *const *others,
                               size_t other_count, sp_coverage_matrix *matrix, sp_error *error)
{
    *matrix = (sp_coverage_matrix){.search = search,
                                   .pool = pool,
                                   .row_count = pool->count + other_count,
                                   .others = others,
                                   .patch_count = search->patch_count < 2 * SAMPLE ? search->patch_count : SAMPLE};
    size_t *sample = malloc((matrix->patch_count + 1) * sizeof *sample);
    matrix->area = calloc(matrix->patch_count + 1, sizeof *matrix->area);
    matrix->kept_hit = calloc(matrix->patch_count + 1, sizeof *matrix->kept_hit);
    matrix->kept_film = search->kept_film ? calloc(matrix->patch_count + 1, sizeof *matrix->kept_film) : NULL;
    matrix->kept_dry = calloc(matrix->patch_count + 1, sizeof *matrix->kept_dry);
    matrix->start = calloc(matrix->row_count + 1, sizeof *matrix->start);
    bool done = sample && matrix->area && matrix->kept_hit && matrix->kept_dry && matrix->start &&
                (matrix->kept_film || !search->kept_film);
    if (done) {
        draw_sample(search, sample, matrix);
        done = add_rows(sample, matrix, error) && add_columns(matrix, error);
    } else {
        sp_fail_memory(error);
    }
    free(sample);
    if (!done)
        sp_coverage_matrix_free(matrix);
    return done;
}
