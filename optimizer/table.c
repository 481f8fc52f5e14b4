#include "table.h"

#include "scoring.h"

#include <stdlib.h>
#include <string.h>

#define SAMPLE 3000 /* patches: what is found on them is improved on all afterwards */

void sp_table_free(sp_table *table)
{
    free(table->area);
    free(table->kept_wet);
    free(table->start);
    free(table->patch);
    free(table->field);
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
        for (size_t p = from; p < to; p++)
            table->area[i] += search->area[p];
    }
}

static bool add_rows(const size_t *sample, float *field, sp_table *table, sp_error *error)
{
    size_t used = 0, room = 0;
    for (size_t r = 0; r < table->pool->count; r++) {
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
        sp_field_pose(table->search, table->pool->items[r], field);
        for (size_t i = 0; i < table->patch_count; i++)
            if (field[sample[i]] > 0) {
                table->patch[used] = (uint32_t)i;
                table->field[used++] = field[sample[i]];
            }
        table->start[r + 1] = used;
    }
    return true;
}

bool sp_table_create(const sp_search *search, const sp_pool *pool, sp_table *table, sp_error *error)
{
    *table = (sp_table){
        .search = search, .pool = pool, .patch_count = search->patch_count < 2 * SAMPLE ? search->patch_count : SAMPLE};
    size_t *sample = malloc((table->patch_count + 1) * sizeof *sample);
    float *field = malloc((search->patch_count + 1) * sizeof *field);
    table->area = calloc(table->patch_count + 1, sizeof *table->area);
    table->kept_wet = calloc(table->patch_count + 1, sizeof *table->kept_wet);
    table->start = calloc(pool->count + 1, sizeof *table->start);
    bool done = sample && field && table->area && table->kept_wet && table->start;
    if (done) {
        draw_sample(search, sample, table);
        done = add_rows(sample, field, table, error);
    } else {
        sp_fail_memory(error);
    }
    free(sample);
    free(field);
    if (!done)
        sp_table_free(table);
    return done;
}
