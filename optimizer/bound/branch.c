#include "bound/branch.h"

#include "ranking.h"

#include "bound/branch_work.h"
#include "mesh/grow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ITERATIONS 150    /* of a solve, at most */
#define TOLERANCE 5e-4    /* at which a solve ends, as a share of the bound */
#define SOLVES_MOST 4     /* of a branch, before it parts */
#define YIELD_LEAST 2e-3  /* of the bound, by which another solve should lower it */
#define ROWS_MOST 1200    /* of the few */
#define ROWS_AT_A_TIME 96 /* that join them */
#define ROW_WORK 2000     /* a solve takes as long a row as so many candidates' pricing */
#define BLOCKS 16         /* parts of a slot that each hand out their best */
#define CHOICE_LEAST 1e-6 /* a row that the linear program takes less of than this may go */
#define JOIN_LEAST 1e-4   /* by which a row must be worth more than the best of the few */

bool sp_branching_create(const sp_cover *cover, const sp_line *line, sp_branching *b, sp_error *error)
{
    *b = (sp_branching){.cover = cover, .line = line};
    if (!sp_dual_create(cover, &b->dual, error) || !sp_highest_create(line->count, &b->price, error) ||
        !sp_highest_create(line->count, &b->least, error)) {
        sp_branching_free(b);
        return false;
    }
    b->among = calloc(line->count + 1, sizeof *b->among);
    b->alive_before = calloc(line->count + 1, sizeof *b->alive_before);
    b->run_best = calloc(line->run_count + 1, sizeof *b->run_best);
    b->rest = calloc(line->kind_count + 1, sizeof *b->rest);
    if (b->among && b->alive_before && b->run_best && b->rest)
        return true;
    sp_branching_free(b);
    return sp_fail_memory(error);
}

void sp_branching_free(sp_branching *b)
{
    for (size_t k = 0; b->rest && k <= b->line->kind_count; k++)
        sp_knapsack_free(&b->rest[k]);
    free(b->rest);
    sp_rows_free(&b->rows);
    sp_dual_free(&b->dual);
    sp_highest_free(&b->price);
    sp_highest_free(&b->least);
    free(b->among);
    free(b->slot_of);
    free(b->alive_before);
    free(b->run_best);
    *b = (sp_branching){0};
}

bool sp_branching_take(sp_branching *b, const sp_rows *rows, sp_error *error)
{
    for (size_t i = 0; i < rows->count; i++) {
        uint64_t at = rows->key[i];
        size_t first = rows->start[i];
        if (at >= b->line->count || b->among[at])
            continue;
        if (!sp_rows_add(&b->rows, at, rows->port[i], rows->tier[i], rows->texel + first, rows->share + first,
                         rows->start[i + 1] - first, error))
            return false;
        b->among[at] = 1;
    }
    return true;
}

bool sp_tree_create(const sp_branching *b, size_t water, double bound, double found, sp_tree *tree, sp_error *error)
{
    const sp_line *line = b->line;
    *tree = (sp_tree){.water = water, .found = found, .shut = -INFINITY, .rows_work = ROW_WORK * ROWS_AT_A_TIME};
    tree->alive = malloc(line->count + 1);
    if (!tree->alive || !sp_grow(&tree->open, &tree->capacity, 1, sizeof *tree->open)) {
        sp_tree_free(tree);
        return sp_fail_memory(error);
    }
    for (size_t k = 0; k < line->kind_count; k++)
        memset(tree->alive + line->kind_start[k], line->weight[k] <= water,
               line->kind_start[k + 1] - line->kind_start[k]);
    tree->open[tree->count++] = (sp_branch){.bound = bound, .nozzles = b->cover->nozzles, .water = water};
    return true;
}

void sp_tree_free(sp_tree *tree)
{
    for (size_t i = 0; i < tree->count; i++)
        free(tree->open[i].slots);
    free(tree->open);
    free(tree->alive);
    *tree = (sp_tree){0};
}

double sp_tree_bound(const sp_tree *tree)
{
    double most = tree->shut;
    for (size_t i = 0; i < tree->count; i++)
        most = fmax(most, tree->open[i].bound);
    return most;
}

bool sp_tree_closed(const sp_tree *tree)
{
    return !tree->count;
}

/* Lets go of rows that the linear program has no use for, the oldest first. */
static bool thin_out(sp_branching *b, sp_error *error)
{
    sp_rows *rows = &b->rows;
    size_t count = rows->count, excess = count > ROWS_MOST ? count - ROWS_MOST : 0;
    bool *marked = malloc((count + 1) * sizeof *marked);
    if (!marked)
        return sp_fail_memory(error);
    for (size_t c = 0; c < count; c++) {
        marked[c] = !excess || sp_dual_choice(&b->dual, c) >= CHOICE_LEAST;
        excess -= !marked[c];
        b->among[rows->key[c]] = marked[c];
    }
    sp_rows_keep(rows, marked);
    sp_dual_keep(&b->dual, count, marked);
    free(marked);
    return true;
}

/* Which slot of the branch each of the few belongs to. */
static bool set_slots(sp_branching *b, const sp_tree *tree, const sp_branch *branch, sp_error *error)
{
    if (!sp_grow(&b->slot_of, &b->slot_room, b->rows.count + 1, sizeof *b->slot_of))
        return sp_fail_memory(error);
    for (size_t c = 0; c < b->rows.count; c++) {
        size_t at = b->rows.key[c];
        b->slot_of[c] = SP_SHUT_OUT;
        if (!tree->alive[at])
            continue;
        if (branch->rest < b->line->kind_count && at >= b->line->kind_start[branch->rest])
            b->slot_of[c] = SP_NO_SLOT;
        for (size_t i = 0; i < branch->slot_count; i++)
            if (at >= branch->slots[i].first && at < branch->slots[i].end)
                b->slot_of[c] = (uint32_t)i;
        b->solved += b->slot_of[c] != SP_SHUT_OUT;
    }
    return true;
}

/* One nozzle: all that counts is whether it alone brings all. */
static void price_alone(sp_branching *b)
{
    sp_prices *u = &b->dual.price;
    u->lifts = b->cover->whole ? NULL : &b->lifts;
    for (size_t t = 0; t < b->cover->texel_count; t++) {
        u->plain[t] = b->cover->whole ? b->cover->area[t] : 0;
        u->lifted[t] = b->cover->whole ? 0 : b->cover->area[t];
        u->kind[t] = SP_LIFT_ALL_OR_NOTHING;
    }
    b->dual.bound = 0;
}

/* Seeks prices that make the branch's bound low, on the few. */
static bool seek_prices(sp_branching *b, const sp_tree *tree, const sp_branch *branch, sp_error *error)
{
    size_t nozzles = sp_branch_nozzles(b, branch);
    size_t rest = sp_rest_fits(b, branch->rest, branch->nozzles, branch->water);
    sp_lifts_create(nozzles ? nozzles : 1, &b->lifts);
    b->solved = 0;
    if (nozzles <= 1) {
        price_alone(b);
        return true;
    }
    uint32_t *room = malloc((branch->slot_count + 1) * sizeof *room);
    if (!room)
        return sp_fail_memory(error);
    for (size_t i = 0; i < branch->slot_count; i++)
        room[i] = branch->slots[i].count;
    const sp_lifts *lifts = b->cover->whole ? NULL : &b->lifts;
    bool done = thin_out(b, error) && set_slots(b, tree, branch, error);
    sp_dual_task task = {.nozzles = rest,
                         .water = rest ? branch->water : 0,
                         .slot_count = branch->slot_count,
                         .slot_room = room,
                         .slot_of = b->slot_of,
                         .iterations = ITERATIONS,
                         .tolerance = TOLERANCE,
                         .lifts = lifts};
    done = done && (!lifts || sp_dual_lift(&b->dual, &b->rows, lifts, error)) &&
           sp_dual_solve(&b->dual, &b->rows, &task, error);
    free(room);
    return done;
}

/* Lists the best of each of so many parts of a range that are worth more than all of the few there. */
static void list_better(const sp_branching *b, size_t first, size_t end, size_t parts, sp_ranked *entries,
                        size_t *count)
{
    const float *price = b->price.top + b->price.count;
    float needed = 0;
    for (size_t c = 0; c < b->rows.count; c++)
        if (b->rows.key[c] >= first && b->rows.key[c] < end)
            needed = fmaxf(needed, price[b->rows.key[c]]);
    for (size_t k = 0; k < parts; k++) {
        size_t from = first + (end - first) * k / parts, to = first + (end - first) * (k + 1) / parts;
        if (from == to)
            continue;
        size_t at = sp_highest_at(&b->price, from, to);
        if (price[at] > needed * (1 + JOIN_LEAST) && !b->among[at])
            entries[(*count)++] = (sp_ranked){needed > 0 ? (double)(price[at] / needed) : 1e30 * (double)price[at], at};
    }
}

/* What is worth more than the few of its slot joins them. */
static bool join(sp_branching *b, const sp_branch *branch, size_t *joined, sp_error *error)
{
    const sp_line *line = b->line;
    sp_ranked *entries = malloc((branch->slot_count * BLOCKS + 2 * line->run_count + 1) * sizeof *entries);
    if (!entries)
        return sp_fail_memory(error);
    size_t count = 0;
    for (size_t i = 0; i < branch->slot_count; i++)
        list_better(b, branch->slots[i].first, branch->slots[i].end, BLOCKS, entries, &count);
    if (sp_rest_fits(b, branch->rest, branch->nozzles, branch->water))
        for (size_t r = sp_line_run(line, line->kind_start[branch->rest]); r < line->run_count; r++)
            list_better(b, line->run_start[r], line->run_start[r + 1], 2, entries, &count);
    sp_rank_falling(entries, count);
    bool done = true;
    *joined = 0;
    for (size_t i = 0; done && i < count && i < ROWS_AT_A_TIME; i++) {
        if (b->among[entries[i].at])
            continue;
        done = line->row(line->user, entries[i].at, &b->rows, error);
        b->among[entries[i].at] = 1;
        ++*joined;
    }
    free(entries);
    return done;
}

static size_t highest_branch(const sp_tree *tree)
{
    size_t best = 0;
    for (size_t i = 1; i < tree->count; i++)
        if (tree->open[i].bound > tree->open[best].bound)
            best = i;
    return best;
}

bool sp_tree_step(sp_branching *b, sp_tree *tree, sp_error *error)
{
    if (!tree->count)
        return true;
    size_t i = highest_branch(tree), joined = 0;
    sp_branch *branch = &tree->open[i];
    double before = branch->bound;
    size_t solves = ++branch->solves;
    tree->steps++;
    sp_branching_count_alive(b, tree);
    if (!seek_prices(b, tree, branch, error))
        return false;
    if (!sp_cover_goes_on(b->cover))
        return true;
    if (!sp_branching_price(b, tree, &b->dual.price, error))
        return false;
    if (!sp_cover_goes_on(b->cover))
        return true;
    if (!join(b, branch, &joined, error))
        return false;
    tree->rows_work = ROW_WORK * (double)b->solved;
    tree->work += tree->rows_work + (double)b->alive_before[b->line->count];
    double reach = fmax(tree->found, b->dual.bound);
    /* the branch may move, or go, when the others are lowered */
    branch->solves = SIZE_MAX;
    if (!sp_tree_lower(b, tree, error))
        return false;
    for (i = 0; i < tree->count && tree->open[i].solves != SIZE_MAX; i++)
        ;
    if (i == tree->count)
        return true;
    branch = &tree->open[i];
    branch->solves = solves;
    bool more = joined && solves < SOLVES_MOST && branch->bound > reach * (1 + YIELD_LEAST) &&
                (solves == 1 || branch->bound < before * (1 - YIELD_LEAST));
    return more || sp_tree_part(b, tree, i, error);
}
