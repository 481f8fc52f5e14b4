#include "search/table.h"

#include "scoring/scoring.h"

#include <stdlib.h>
#include <string.h>

#define SAMPLE 3000 /* patches: what is found on them is improved on all afterwards */

void sp_table_free(sp_table *table)
{
    free(table->area);
    free(table->kept_wet);
    free(table->kept_dry);
    free(table->start);
    free(table->patch);
    free(table->field);
    free(table->column_start);
    free(table->column_row);
    free(table->column_field);
    *table = (sp_table){0};
}

/* The patch in the middle of each run of neighbours in the patches' order, with the area of all of the run. */
static void draw_sample(const sp_search *search, size_t *sample, sp_table *table)
{
    for (size_t i = 0; i < table->patch_count; i++) {
        size_t from = search->patch_count * i / table->patch_count,
               to = search->patch_count * (i + 1) / table->patch_count;
        sample[i] = (from + to) / 2;
        table->kept_wet[i] = search->kept_wet[sample[i]];
        table->kept_dry[i] = search->kept_dry[sample[i]];
        for (size_t p = from; p < to; p++)
            table->area[i] += search->area[p];
    }
}

static bool add_rows(const size_t *sample, float *field, sp_table *table, sp_error *error)
{
    size_t used = 0, room = 0;
    for (size_t r = 0; r < table->row_count; r++) {
        const float *from = field;
        if (used + table->patch_count > room) {
            room = 2 * (used + table->patch_count);
            uint32_t *patch = realloc(table->patch, room * sizeof *patch);
            if (patch)
                table->patch = patch;
            float *fields = realloc(table->field, room * sizeof *fields);
            if (fields)
                table->field = fields;
            if (!patch || !fields)
                return sp_fail_memory(error);
        }
        if (r < table->pool->count)
            sp_field_pose(table->search, table->pool->items[r], field);
        else
            from = table->others[r - table->pool->count]->field;
        for (size_t i = 0; i < table->patch_count; i++)
            if (from[sample[i]] != 0) {
                table->patch[used] = (uint32_t)i;
                table->field[used++] = from[sample[i]];
            }
        table->start[r + 1] = used;
    }
    return true;
}

/* The rows' entries by patch. */
static bool add_columns(sp_table *table, sp_error *error)
{
    size_t rows = table->row_count, used = table->start[rows];
    table->column_start = calloc(table->patch_count + 2, sizeof *table->column_start);
    table->column_row = malloc((used + 1) * sizeof *table->column_row);
    table->column_field = malloc((used + 1) * sizeof *table->column_field);
    if (!table->column_start || !table->column_row || !table->column_field)
        return sp_fail_memory(error);
    /* counted two places on, so that filling moves each start to its own place */
    for (size_t i = 0; i < used; i++)
        table->column_start[table->patch[i] + 2]++;
    for (size_t p = 0; p < table->patch_count; p++)
        table->column_start[p + 2] += table->column_start[p + 1];
    for (size_t r = 0; r < rows; r++)
        for (size_t i = table->start[r]; i < table->start[r + 1]; i++) {
            size_t at = table->column_start[table->patch[i] + 1]++;
            table->column_row[at] = (uint32_t)r;
            table->column_field[at] = table->field[i];
        }
    return true;
}

bool sp_table_create(const sp_search *search, const sp_pool *pool, const sp_placed *const *others, size_t other_count,
                     sp_table *table, sp_error *error)
{
    *table = (sp_table){.search = search,
                        .pool = pool,
                        .row_count = pool->count + other_count,
                        .others = others,
                        .patch_count = search->patch_count < 2 * SAMPLE ? search->patch_count : SAMPLE};
    size_t *sample = malloc((table->patch_count + 1) * sizeof *sample);
    float *field = malloc((search->patch_count + 1) * sizeof *field);
    table->area = calloc(table->patch_count + 1, sizeof *table->area);
    table->kept_wet = calloc(table->patch_count + 1, sizeof *table->kept_wet);
    table->kept_dry = calloc(table->patch_count + 1, sizeof *table->kept_dry);
    table->start = calloc(table->row_count + 1, sizeof *table->start);
    bool done = sample && field && table->area && table->kept_wet && table->kept_dry && table->start;
    if (done) {
        draw_sample(search, sample, table);
        done = add_rows(sample, field, table, error) && add_columns(table, error);
    } else {
        sp_fail_memory(error);
    }
    free(sample);
    free(field);
    if (!done)
        sp_table_free(table);
    return done;
}
