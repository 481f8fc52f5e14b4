#include "search/coverage_matrix.h"

#include "mesh/grow.h"
#include "scoring/field.h"

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

/* Appends row r's field; returns how many entries there are then. */
static size_t add_row(const size_t *sample, size_t r, const float *field, sp_coverage_matrix *matrix)
{
    const float *film = matrix->kept_film ? field + matrix->search->patch_count : NULL;
    size_t used = matrix->start[r];
    for (size_t i = 0; i < matrix->patch_count; i++)
        if (field[sample[i]] != 0 || (film && film[sample[i]] > FILM_LEAST)) {
            matrix->patch[used] = (uint32_t)i;
            if (film)
                matrix->film[used] = film[sample[i]];
            matrix->field[used++] = field[sample[i]];
        }
    matrix->start[r + 1] = used;
    return used;
}

static bool make_room(size_t room, sp_coverage_matrix *matrix)
{
    return sp_reallocate(&matrix->patch, room, sizeof *matrix->patch) &&
           sp_reallocate(&matrix->field, room, sizeof *matrix->field) &&
           (!matrix->kept_film || sp_reallocate(&matrix->film, room, sizeof *matrix->film));
}

static bool add_rows(const size_t *sample, float *field, sp_coverage_matrix *matrix, sp_error *error)
{
    for (size_t r = 0, used = 0, room = 0; r < matrix->row_count; r++) {
        const float *from = field;
        if (used + matrix->patch_count > room) {
            room = 2 * (used + matrix->patch_count);
            if (!make_room(room, matrix))
                return sp_fail_memory(error);
        }
        if (r < matrix->pool->count)
            sp_field_pose(matrix->search, matrix->pool->items[r], field);
        else
            from = matrix->others[r - matrix->pool->count]->field;
        used = add_row(sample, r, from, matrix);
    }
    return true;
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
    float *field = malloc((search->field_count + 1) * sizeof *field);
    matrix->area = calloc(matrix->patch_count + 1, sizeof *matrix->area);
    matrix->kept_hit = calloc(matrix->patch_count + 1, sizeof *matrix->kept_hit);
    matrix->kept_film = search->kept_film ? calloc(matrix->patch_count + 1, sizeof *matrix->kept_film) : NULL;
    matrix->kept_dry = calloc(matrix->patch_count + 1, sizeof *matrix->kept_dry);
    matrix->start = calloc(matrix->row_count + 1, sizeof *matrix->start);
    bool done = sample && field && matrix->area && matrix->kept_hit && matrix->kept_dry && matrix->start &&
                (matrix->kept_film || !search->kept_film);
    if (done) {
        draw_sample(search, sample, matrix);
        done = add_rows(sample, field, matrix, error) && add_columns(matrix, error);
    } else {
        sp_fail_memory(error);
    }
    free(sample);
    free(field);
    if (!done)
        sp_coverage_matrix_free(matrix);
    return done;
}
