#include "search/table.h"

#include "mesh/grow.h"
#include "scoring/field.h"

#include <stdlib.h>
#include <string.h>

#define SAMPLE 3000      /* patches: what is found on them is improved on all afterwards */
#define FILM_LEAST 1e-3f /* of what is asked for: less in a row is no help */

void sp_table_free(sp_table *table)
{
    free(table->area);
    free(table->kept_hit);
    free(table->kept_film);
    free(table->kept_dry);
    free(table->start);
    free(table->patch);
    free(table->field);
    free(table->film);
    free(table->column_start);
    free(table->column_row);
    free(table->column_field);
    free(table->column_film);
    *table = (sp_table){0};
}

/* The patch in the middle of each run of neighbours in the patches' order, with the area of all of the run. */
static void draw_sample(const sp_search *search, size_t *sample, sp_table *table)
{
    for (size_t i = 0; i < table->patch_count; i++) {
        size_t from = search->patch_count * i / table->patch_count,
               to = search->patch_count * (i + 1) / table->patch_count;
        sample[i] = (from + to) / 2;
        table->kept_hit[i] = search->kept_hit[sample[i]];
        if (table->kept_film)
            table->kept_film[i] = search->kept_film[sample[i]];
        table->kept_dry[i] = search->kept_dry[sample[i]];
        for (size_t p = from; p < to; p++)
            table->area[i] += search->area[p];
    }
}

/* Appends row r's field; returns how many entries there are then. */
static size_t add_row(const size_t *sample, size_t r, const float *field, sp_table *table)
{
    const float *film = table->kept_film ? field + table->search->patch_count : NULL;
    size_t used = table->start[r];
    for (size_t i = 0; i < table->patch_count; i++)
        if (field[sample[i]] != 0 || (film && film[sample[i]] > FILM_LEAST)) {
            table->patch[used] = (uint32_t)i;
            if (film)
                table->film[used] = film[sample[i]];
            table->field[used++] = field[sample[i]];
        }
    table->start[r + 1] = used;
    return used;
}

static bool make_room(size_t room, sp_table *table)
{
    return sp_reallocate(&table->patch, room, sizeof *table->patch) &&
           sp_reallocate(&table->field, room, sizeof *table->field) &&
           (!table->kept_film || sp_reallocate(&table->film, room, sizeof *table->film));
}

static bool add_rows(const size_t *sample, float *field, sp_table *table, sp_error *error)
{
    for (size_t r = 0, used = 0, room = 0; r < table->row_count; r++) {
        const float *from = field;
        if (used + table->patch_count > room) {
            room = 2 * (used + table->patch_count);
            if (!make_room(room, table))
                return sp_fail_memory(error);
        }
        if (r < table->pool->count)
            sp_field_pose(table->search, table->pool->items[r], field);
        else
            from = table->others[r - table->pool->count]->field;
        used = add_row(sample, r, from, table);
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
    table->column_film = table->film ? malloc((used + 1) * sizeof *table->column_film) : NULL;
    if (!table->column_start || !table->column_row || !table->column_field || (table->film && !table->column_film))
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
            if (table->film)
                table->column_film[at] = table->film[i];
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
    float *field = malloc((search->field_count + 1) * sizeof *field);
    table->area = calloc(table->patch_count + 1, sizeof *table->area);
    table->kept_hit = calloc(table->patch_count + 1, sizeof *table->kept_hit);
    table->kept_film = search->kept_film ? calloc(table->patch_count + 1, sizeof *table->kept_film) : NULL;
    table->kept_dry = calloc(table->patch_count + 1, sizeof *table->kept_dry);
    table->start = calloc(table->row_count + 1, sizeof *table->start);
    bool done = sample && field && table->area && table->kept_hit && table->kept_dry && table->start &&
                (table->kept_film || !search->kept_film);
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
