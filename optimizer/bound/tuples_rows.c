#include "bound/tuples_work.h"

#include <assert.h>
#include <stdlib.h>

#define BYTES_MOST 4e8         /* of sets */
#define ROWS_AT_A_TIME 256     /* by all threads */
#define SHARE_LEAST (1 - 1e-5) /* of weight / W: more than shares, and their sums, are rounded by */

/* The rows of those able, from `first` on, that have no sets yet. */
static bool find_rows(const sp_tuples *o, size_t first, size_t end, sp_rows *rows, sp_error *error)
{
    sp_error failure = {0};
    int threads = o->list->threads;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
    for (size_t i = first; i < end; i++) {
        const sp_tuple_item *own = &o->items[o->able[i]];
        sp_rows *row = &rows[i - first];
        sp_error mine = {0};
        row->count = row->used = 0;
        if (own->set == NO_SET && !o->list->row(o->list->user, own->position, row, &mine)) {
#pragma omp critical(sp_tuples_rows)
            failure = mine;
        }
    }
    return failure.kind == SP_OK ||
           sp_fail(error, failure.kind, failure.file, failure.line, failure.column, "%s", failure.message);
}

/* The sets of these rows. */
static bool add_sets(sp_tuples *o, size_t first, size_t end, const sp_rows *rows, const uint64_t *none, sp_error *error)
{
    for (size_t i = first; i < end; i++) {
        sp_tuple_item *own = &o->items[o->able[i]];
        double least = SHARE_LEAST * (double)own->weight / (double)o->water;
        if (own->set != NO_SET)
            continue;
        if (!sp_bit_rows_add(&o->sets, o->cover, &rows[i - first], 0, least, error))
            return false;
        own->set = (uint32_t)(o->sets.count - 1);
        own->alone = (sp_bit_rows_gain(&o->sets, own->set, none) + o->sets.edge[own->set]) * SP_UPWARDS_SETS;
    }
    o->over = sp_bit_rows_bytes(&o->sets) > BYTES_MOST;
    return true;
}

static bool build_sets(sp_tuples *o, sp_error *error)
{
    uint64_t *none = calloc(o->sets.words + 1, sizeof *none);
    sp_rows *rows = calloc(ROWS_AT_A_TIME, sizeof *rows);
    bool done = (none && rows) || sp_fail_memory(error);
    for (size_t i = 0; done && i < o->able_count && !o->over && sp_cover_goes_on(o->cover); i += ROWS_AT_A_TIME) {
        size_t end = i + ROWS_AT_A_TIME < o->able_count ? i + ROWS_AT_A_TIME : o->able_count;
        done = find_rows(o, i, end, rows, error) && add_sets(o, i, end, rows, none, error);
    }
    for (size_t i = 0; rows && i < ROWS_AT_A_TIME; i++)
        sp_rows_free(&rows[i]);
    free(rows);
    free(none);
    return done;
}

bool sp_tuples_list_able(sp_tuples *o, sp_error *error)
{
    static const double none[BY_MULTIPLIERS] = {0};
    free(o->able);
    o->able = malloc((o->count + 1) * sizeof *o->able);
    o->able_count = 0;
    for (size_t i = 0; o->able && i < o->count; i++) {
        const sp_tuple_item *own = &o->items[i];
        assert(own->weight <= o->water && (i == 0 || own[-1].weight >= own->weight));
        if (sp_tuples_all_above(o, none, own->price, 0, o->water - own->weight)) {
            o->able[o->able_count++] = (uint32_t)i;
            o->work += own->set == NO_SET ? WORK_ROW : 0;
        }
    }
    o->over = o->work > o->work_most;
    if (!o->able)
        return sp_fail_memory(error);
    return build_sets(o, error);
}
