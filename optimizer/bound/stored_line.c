#include "bound/line.h"

#include "ranking.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const sp_stored_line *stored;
    float *shares; /* [texels] of a pivot, times area */
    sp_ranked *entries;
} ordering;

/* m² that a row and the pivot have in common, as a share of the row's own. */
static double in_common(const ordering *o, size_t row)
{
    const sp_rows *rows = o->stored->rows;
    double both = 0, own = 0;
    for (size_t i = rows->start[row]; i < rows->start[row + 1]; i++) {
        both += (double)(sp_share_of(rows->share[i]) * o->shares[rows->texel[i]]);
        own += (double)(sp_share_of(rows->share[i]) * o->stored->cover->area[rows->texel[i]]);
    }
    return own > 0 ? both / own : 0;
}

static void set_pivot(ordering *o, size_t row, bool on)
{
    const sp_rows *rows = o->stored->rows;
    for (size_t i = rows->start[row]; i < rows->start[row + 1]; i++)
        o->shares[rows->texel[i]] = on ? sp_share_of(rows->share[i]) * o->stored->cover->area[rows->texel[i]] : 0;
}

/* The row of the range with least in common with the pivot. */
static size_t far_from(ordering *o, size_t pivot, size_t first, size_t end)
{
    size_t found = first;
    double least = INFINITY;
    set_pivot(o, pivot, true);
    for (size_t i = first; i < end; i++) {
        double common = in_common(o, o->stored->order[i]);
        if (common < least) {
            least = common;
            found = i;
        }
    }
    set_pivot(o, pivot, false);
    return o->stored->order[found];
}

/* Halves the range between two rows far from each other, and so on; rows of equal ports stay together. */
static void halve(ordering *o, size_t first, size_t end)
{
    size_t *order = o->stored->order;
    if (end - first < 3)
        return;
    size_t left = far_from(o, order[first], first, end), right = far_from(o, left, first, end);
    set_pivot(o, right, true);
    for (size_t i = first; i < end; i++)
        o->entries[i] = (sp_ranked){in_common(o, order[i]), order[i]};
    set_pivot(o, right, false);
    set_pivot(o, left, true);
    for (size_t i = first; i < end; i++)
        o->entries[i].merit -= in_common(o, order[i]);
    set_pivot(o, left, false);
    sp_rank_rising(o->entries + first, end - first);
    for (size_t i = first; i < end; i++)
        order[i] = o->entries[i].at;
    halve(o, first, first + (end - first) / 2);
    halve(o, first + (end - first) / 2, end);
}

static size_t cut(void *user, size_t first, size_t end)
{
    const sp_stored_line *stored = user;
    size_t run = sp_line_run(&stored->line, first), last = sp_line_run(&stored->line, end - 1);
    return run < last ? stored->line.run_start[run + (last - run + 1) / 2] : first + (end - first) / 2;
}

static bool price(void *user, const sp_prices *u, const uint8_t *alive, float *prices, sp_error *error)
{
    (void)error;
    const sp_stored_line *stored = user;
#pragma omp parallel for num_threads(stored->cover->threads) schedule(dynamic, 16)
    for (size_t i = 0; i < stored->line.count; i++)
        prices[i] = alive[i] ? nextafterf((float)sp_rows_price(stored->rows, stored->order[i], u), INFINITY) : 0;
    return true;
}

static bool row(void *user, size_t position, sp_rows *rows, sp_error *error)
{
    const sp_stored_line *stored = user;
    const sp_rows *all = stored->rows;
    size_t from = stored->order[position], first = all->start[from], count = all->start[from + 1] - first;
    return sp_rows_add(rows, position, all->port[from], all->tier[from], all->texel + first, all->share + first, count,
                       error);
}

/* The heavier, then by port, then by number. */
static bool comes_first(const sp_stored_line *stored, size_t a, size_t b)
{
    const sp_rows *rows = stored->rows;
    uint32_t p = stored->cover->weight[rows->tier[a]], q = stored->cover->weight[rows->tier[b]];
    return p != q ? p > q : rows->port[a] != rows->port[b] ? rows->port[a] < rows->port[b] : a < b;
}

/* Kinds and runs of rows that are sorted by them. */
static void mark(sp_stored_line *stored)
{
    const sp_rows *rows = stored->rows;
    sp_line *line = &stored->line;
    for (size_t i = 0; i < rows->count; i++) {
        uint32_t weight = stored->cover->weight[rows->tier[stored->order[i]]];
        size_t port = rows->port[stored->order[i]];
        bool other = !i || weight != line->weight[line->kind_count - 1];
        if (other) {
            line->kind_start[line->kind_count] = i;
            line->weight[line->kind_count++] = weight;
        }
        if (other || port != line->run_port[line->run_count - 1]) {
            line->run_start[line->run_count] = i;
            line->run_port[line->run_count++] = port;
        }
    }
    line->kind_start[line->kind_count] = line->run_start[line->run_count] = rows->count;
}

static bool fill(sp_stored_line *stored, ordering *o)
{
    size_t count = stored->rows->count;
    sp_line *line = &stored->line;
    if (!stored->order || !line->kind_start || !line->weight || !line->run_start || !line->run_port || !o->shares ||
        !o->entries)
        return false;
    for (size_t i = 0; i < count; i++) {
        size_t at = i;
        for (; at > 0 && comes_first(stored, i, stored->order[at - 1]); at--)
            stored->order[at] = stored->order[at - 1];
        stored->order[at] = i;
    }
    mark(stored);
    for (size_t i = 0; i < line->run_count; i++)
        halve(o, line->run_start[i], line->run_start[i + 1]);
    return true;
}

bool sp_stored_line_create(const sp_cover *cover, const sp_rows *rows, sp_stored_line *stored, sp_error *error)
{
    size_t room = rows->count + 1;
    *stored = (sp_stored_line){.cover = cover, .rows = rows, .order = malloc(room * sizeof *stored->order)};
    stored->line = (sp_line){.user = stored,
                             .count = rows->count,
                             .kind_start = malloc(room * sizeof(size_t)),
                             .weight = malloc(room * sizeof(uint32_t)),
                             .run_start = malloc(room * sizeof(size_t)),
                             .run_port = malloc(room * sizeof(size_t)),
                             .cut = cut,
                             .price = price,
                             .row = row};
    ordering o = {stored, calloc(cover->texel_count + 1, sizeof(float)), malloc(room * sizeof(sp_ranked))};
    bool done = fill(stored, &o);
    free(o.shares);
    free(o.entries);
    if (done)
        return true;
    sp_stored_line_free(stored);
    return sp_fail_memory(error);
}

void sp_stored_line_free(sp_stored_line *stored)
{
    free(stored->order);
    sp_line_free(&stored->line);
    stored->order = NULL;
}
