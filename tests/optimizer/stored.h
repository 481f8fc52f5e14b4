/* Candidates that all lie in memory, as the bounds want them: priced all at once, and in a list. */
#ifndef STORED_H
#define STORED_H

#include "instance.h"

#include "bound/bound.h"
#include "bound/candidate_list.h"
#include "ranking/ranking.h"

typedef struct {
    const sp_cover *cover;
    const sp_rows *rows;
    size_t most; /* rows to hand out at a time */
} stored;

static inline bool stored_price(void *user, const sp_pricing_task *task, sp_offers *offers, sp_rows *rows,
                                sp_error *error)
{
    const stored *s = user;
    const sp_rows *from = s->rows;
    sp_ranked *entries = malloc((from->count + 1) * sizeof *entries);
    uint64_t *keys = sp_rows_keys(rows);
    assert_true(entries && keys);
    size_t count = 0, had = rows->count;
    for (size_t c = 0; c < from->count; c++) {
        double need = task->needed[from->tier[c]], price = sp_rows_price(from, c, task->u);
        if (sp_keys_hold(keys, had, from->key[c]))
            continue;
        if (price > fmin(need, task->idle[from->tier[c]]))
            sp_offers_add(offers, from->port[c], from->tier[c], price);
        if (price > need)
            entries[count++] = (sp_ranked){need > 0 ? price / need : price * 1e30, c};
    }
    sp_rank_falling(entries, count);
    for (size_t i = 0; task->extend && i < count && i < s->most; i++) {
        size_t row = entries[i].at, first = from->start[row];
        assert_true(sp_rows_add(rows, from->key[row], from->port[row], from->tier[row], from->texel + first,
                                from->share + first, from->start[row + 1] - first, error));
    }
    free(entries);
    free(keys);
    return true;
}

static inline sp_pricer stored_pricer(stored *s)
{
    return (sp_pricer){s, .leaves_idle = true, .price = stored_price};
}

typedef struct {
    const sp_cover *cover;
    const sp_rows *rows;
    size_t *order; /* [rows], row at each position */
    sp_candidate_list list;
} stored_line;

static inline bool stored_line_price(void *user, const sp_multipliers *u, const uint8_t *alive, float *price,
                                     sp_error *error)
{
    (void)error;
    const stored_line *s = user;
    for (size_t i = 0; i < s->list.count; i++)
        price[i] = alive[i] ? nextafterf((float)sp_rows_price(s->rows, s->order[i], u), INFINITY) : 0;
    return true;
}

static inline bool stored_line_row(void *user, size_t position, sp_rows *rows, sp_error *error)
{
    const stored_line *s = user;
    size_t row = s->order[position], first = s->rows->start[row];
    return sp_rows_add(rows, position, s->rows->port[row], s->rows->tier[row], s->rows->texel + first,
                       s->rows->share + first, s->rows->start[row + 1] - first, error);
}

/* By falling weight, then by port. */
static inline void stored_line_create(const sp_cover *cover, const sp_rows *rows, stored_line *s)
{
    size_t count = rows->count;
    *s = (stored_line){.cover = cover, .rows = rows, .order = malloc((count + 1) * sizeof *s->order)};
    sp_candidate_list *list = &s->list;
    *list = (sp_candidate_list){.user = s,
                                .kind_start = calloc(count + 1, sizeof(size_t)),
                                .weight = malloc((count + 1) * sizeof(uint32_t)),
                                .run_start = calloc(count + 1, sizeof(size_t)),
                                .run_port = malloc((count + 1) * sizeof(size_t)),
                                .price = stored_line_price,
                                .row = stored_line_row,
                                .threads = cover->threads};
    assert_true(s->order && list->kind_start && list->weight && list->run_start && list->run_port);
    sp_ranked *by_port = malloc((count + 1) * sizeof *by_port), *by_weight = malloc((count + 1) * sizeof *by_weight);
    assert_true(by_port && by_weight);
    for (size_t i = 0; i < count; i++)
        by_port[i] = (sp_ranked){-(double)rows->port[i], i};
    sp_rank_rising(by_port, count);
    for (size_t i = 0; i < count; i++)
        by_weight[i] = (sp_ranked){(double)cover->weight[rows->tier[by_port[i].at]], i};
    sp_rank_falling(by_weight, count);
    for (size_t i = 0; i < count; i++) {
        size_t row = s->order[i] = by_port[by_weight[i].at].at;
        uint32_t weight = cover->weight[rows->tier[row]];
        bool other = !i || list->weight[list->kind_count - 1] != weight;
        if (other) {
            list->kind_start[list->kind_count] = i;
            list->weight[list->kind_count++] = weight;
        }
        if (other || list->run_port[list->run_count - 1] != rows->port[row]) {
            list->run_start[list->run_count] = i;
            list->run_port[list->run_count++] = rows->port[row];
        }
    }
    list->count = list->kind_start[list->kind_count] = list->run_start[list->run_count] = count;
    free(by_port);
    free(by_weight);
}

static inline void stored_line_free(stored_line *s)
{
    sp_candidate_list_free(&s->list);
    free(s->order);
}

#endif
