#include "bound/branch_work.h"

#include <math.h>
#include <stdlib.h>

#define UPWARDS (1 + 1e-11)

size_t sp_rest_fits(const sp_branching *b, size_t kind, size_t nozzles, size_t water)
{
    const sp_line *line = b->line;
    if (kind >= line->kind_count)
        return 0;
    size_t fit = water / line->weight[line->kind_count - 1];
    return fit < nozzles ? fit : nozzles;
}

size_t sp_branch_nozzles(const sp_branching *b, const sp_branch *branch)
{
    size_t count = sp_rest_fits(b, branch->rest, branch->nozzles, branch->water);
    for (size_t i = 0; i < branch->slot_count; i++)
        count += branch->slots[i].count;
    return count;
}

static void forget_tables(sp_branching *b)
{
    for (size_t k = 0; k <= b->line->kind_count; k++)
        sp_knapsack_free(&b->rest[k]);
}

/* After the candidates' prices at u are set. */
static void settle(sp_branching *b, const sp_prices *u)
{
    const sp_line *line = b->line;
    sp_highest_build(&b->price);
    for (size_t r = 0; r < line->run_count; r++)
        b->run_best[r] = (double)sp_highest_of(&b->price, line->run_start[r], line->run_start[r + 1]);
    forget_tables(b);
    b->rest_area = b->cover->base + sp_cover_rest(b->cover, u);
    b->valid = u->lifts ? u->lifts->nozzles : SIZE_MAX;
}

bool sp_branching_price(sp_branching *b, const sp_tree *tree, const sp_prices *u, sp_error *error)
{
    const sp_line *line = b->line;
    if (!line->price(line->user, u, tree->alive, b->price.top + b->price.count, error))
        return false;
    settle(b, u);
    return true;
}

bool sp_tree_hear(sp_branching *b, sp_tree *tree, const sp_prices *u, const float *price, sp_error *error)
{
    float *own = b->price.top + b->price.count;
    size_t most = 0;
    for (size_t i = 0; i < tree->count; i++)
        most = sp_branch_nozzles(b, &tree->open[i]) > most ? sp_branch_nozzles(b, &tree->open[i]) : most;
    if (!tree->count || (u->lifts && most > u->lifts->nozzles))
        return true;
    for (size_t i = 0; i < b->line->count; i++)
        own[i] = tree->alive[i] ? price[i] : 0;
    settle(b, u);
    return sp_tree_lower(b, tree, error);
}

/* The knapsack of nozzles of this kind and lighter. A candidate may be in it more than once. */
static bool fill_rest(const sp_branching *b, size_t kind, sp_knapsack *knapsack, sp_error *error)
{
    const sp_line *line = b->line;
    const sp_cover *cover = b->cover;
    sp_offers offers;
    if (!sp_offers_create(line->kind_count - kind, line->weight + kind, cover->port_count, cover->nozzles, true,
                          &offers, error))
        return false;
    for (size_t r = sp_line_run(line, line->kind_start[kind]); r < line->run_count; r++)
        if (b->run_best[r] > 0)
            sp_offers_add(&offers, line->run_port[r], sp_line_kind(line, line->run_start[r]) - kind, b->run_best[r]);
    bool done = sp_knapsack_create(cover->nozzles, cover->water, knapsack, error);
    if (done)
        sp_knapsack_fill(knapsack, &offers, cover->water);
    sp_offers_free(&offers);
    return done;
}

/* What the nozzles in no slot can be worth; `nozzles` of them in so much water. */
static bool rest_value(sp_branching *b, size_t kind, size_t nozzles, size_t water, double *value, sp_error *error)
{
    *value = 0;
    if (!sp_rest_fits(b, kind, nozzles, water))
        return true;
    if (!b->rest[kind].value && !fill_rest(b, kind, &b->rest[kind], error))
        return false;
    *value = sp_knapsack_value(&b->rest[kind], nozzles, water);
    return true;
}

bool sp_branch_value(sp_branching *b, const sp_branch *branch, double *value, sp_error *error)
{
    *value = INFINITY;
    if (sp_branch_nozzles(b, branch) > b->valid)
        return true;
    if (!rest_value(b, branch->rest, branch->nozzles, branch->water, value, error))
        return false;
    *value += b->rest_area;
    for (size_t i = 0; i < branch->slot_count; i++) {
        const sp_slot *slot = &branch->slots[i];
        *value += slot->count * (double)sp_highest_of(&b->price, slot->first, slot->end);
    }
    *value *= UPWARDS;
    return true;
}

/* What a candidate must be worth for the branch to hold better than what was found: `value` is the branch's. */
static bool note_least(sp_branching *b, const sp_tree *tree, const sp_branch *branch, double value, sp_error *error)
{
    const sp_line *line = b->line;
    double room = tree->found - value, rest, without;
    for (size_t i = 0; i < branch->slot_count; i++) {
        const sp_slot *slot = &branch->slots[i];
        double best = (double)sp_highest_of(&b->price, slot->first, slot->end);
        sp_lowest_lower(&b->least, slot->first, slot->end, (float)(best + room));
    }
    if (!sp_rest_fits(b, branch->rest, branch->nozzles, branch->water))
        return true;
    if (!rest_value(b, branch->rest, branch->nozzles, branch->water, &rest, error))
        return false;
    for (size_t k = branch->rest; k < line->kind_count; k++) {
        if (line->weight[k] > branch->water)
            continue;
        if (!rest_value(b, branch->rest, branch->nozzles - 1, branch->water - line->weight[k], &without, error))
            return false;
        sp_lowest_lower(&b->least, line->kind_start[k], line->kind_start[k + 1], (float)(rest - without + room));
    }
    return true;
}

void sp_branching_count_alive(sp_branching *b, const sp_tree *tree)
{
    b->alive_before[0] = 0;
    for (size_t i = 0; i < b->line->count; i++)
        b->alive_before[i + 1] = b->alive_before[i] + tree->alive[i];
}

static void shut_out(sp_branching *b, sp_tree *tree)
{
    const float *price = b->price.top + b->price.count, *least = b->least.top + b->least.count;
    sp_lowest_spread(&b->least);
    for (size_t i = 0; i < b->line->count; i++)
        /* by more than single precision can mistake */
        if (tree->alive[i] && (double)price[i] < (double)least[i] - 1e-6 * fabs((double)least[i])) {
            tree->alive[i] = 0;
            tree->shut = fmax(tree->shut, tree->found);
        }
    sp_branching_count_alive(b, tree);
}

bool sp_tree_lower(sp_branching *b, sp_tree *tree, sp_error *error)
{
    sp_lowest_clear(&b->least);
    for (size_t i = 0; i < tree->count;) {
        sp_branch *branch = &tree->open[i];
        double value;
        if (!sp_branch_value(b, branch, &value, error))
            return false;
        branch->bound = fmin(branch->bound, value);
        if (branch->bound <= tree->found) {
            sp_branch closed = sp_tree_take(tree, i);
            tree->shut = fmax(tree->shut, closed.bound);
            free(closed.slots);
            continue;
        }
        if (!note_least(b, tree, branch, value, error))
            return false;
        i++;
    }
    shut_out(b, tree);
    tree->next_work = tree->rows_work + (double)b->alive_before[b->line->count];
    return true;
}
