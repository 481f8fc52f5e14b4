#include "search/pareto.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define RATIO 1.01       /* between the ends of a range of outlays */
#define RANGES_MOST 1000 /* as many are enough where outlays lie very far apart */
#define WORK_MOST 6e9    /* terms of sums that all exploring may take, about */
#define WORK_EACH 4      /* times a matrix's entries that a layout's neighbours take: most change few patches */

#define NOTHING SIZE_MAX

/* A neighbour of a layout: without its row number `out` and with row `in`. */
typedef struct {
    double outlay, covered;
    size_t from; /* range of the layout; NOTHING: the kept nozzles alone */
    size_t out;  /* NOTHING: all stay */
    uint32_t in; /* UINT32_MAX: none comes */
} neighbour;

typedef struct {
    const sp_coverage_matrix *matrix;
    const sp_pareto *pareto;
    sp_selection selection; /* scratch */
    neighbour *best;        /* [ranges] */
} explorer;

/* The ends of ranges: the outlays, and so many between as keep ranges short; returns how many. */
static size_t set_ends(double least, double ratio, const double *outlays, size_t count, double *ends)
{
    size_t found = 0;
    double before = least;
    for (size_t i = 0; i < count; i++) {
        size_t steps = outlays[i] > before ? (size_t)ceil(log(outlays[i] / before) / log(ratio)) : 0;
        for (size_t k = 1; k <= steps; k++)
            ends[found++] = k < steps ? before * pow(ratio, (double)k) : outlays[i];
        before = fmax(before, outlays[i]);
    }
    return found;
}

bool sp_pareto_create(const sp_coverage_matrix *matrix, const double *outlays, size_t count, sp_pareto *pareto,
                      sp_error *error)
{
    double least = INFINITY, most = count ? outlays[count - 1] : 0;
    for (size_t r = 0; r < matrix->row_count; r++)
        least = fmin(least, matrix->search->kept_flow + sp_coverage_matrix_outlay(matrix, r));
    double between = most > least ? log(most / least) : 0, ratio = fmax(RATIO, exp(between / RANGES_MOST));
    *pareto = (sp_pareto){.ends = malloc(((size_t)(between / log(ratio)) + count + 2) * sizeof *pareto->ends)};
    if (pareto->ends)
        pareto->count = set_ends(least * (1 - SP_ROUNDING), ratio, outlays, count, pareto->ends);
    pareto->layouts = calloc(pareto->count + 1, sizeof *pareto->layouts);
    return (pareto->ends && pareto->layouts) || sp_fail_memory(error);
}

void sp_pareto_free(sp_pareto *pareto)
{
    free(pareto->ends);
    free(pareto->layouts);
    *pareto = (sp_pareto){0};
}

/* The range in which an outlay lies; the number of ranges for one above all. */
static size_t range_of(const sp_pareto *pareto, double outlay)
{
    size_t low = 0, high = pareto->count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (pareto->ends[middle] < outlay)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* More covered, or as much for less; areas that differ by round-off are equal. */
static bool betters(double tie, double covered, double outlay, const sp_pareto_layout *other)
{
    return covered > other->covered + tie ||
           (covered >= other->covered - tie && outlay < other->outlay * (1 - SP_ROUNDING));
}

static double tie_of(const sp_coverage_matrix *matrix)
{
    return SP_SCORE_TIE * matrix->search->all;
}

void sp_pareto_enter(sp_pareto *pareto, const sp_selection *selection)
{
    size_t i = range_of(pareto, selection->outlay);
    if (i == pareto->count ||
        !betters(tie_of(selection->matrix), selection->covered, selection->outlay, &pareto->layouts[i]))
        return;
    sp_pareto_layout *layout = &pareto->layouts[i];
    *layout = (sp_pareto_layout){.count = selection->count, .outlay = selection->outlay, .covered = selection->covered};
    memcpy(layout->row, selection->row, selection->count * sizeof *layout->row);
}

bool sp_pareto_counts(const sp_pareto *pareto, size_t i)
{
    bool most = pareto->layouts[i].covered > 0;
    for (size_t k = 0; k < i && most; k++)
        most = pareto->layouts[k].covered < pareto->layouts[i].covered;
    return most;
}

/* Keeps the better of two in an order of all neighbours, so that it makes no difference who finds which first. */
static bool goes_before(const neighbour *a, const neighbour *b)
{
    if (a->covered < b->covered || a->covered > b->covered)
        return a->covered > b->covered;
    if (a->outlay < b->outlay || a->outlay > b->outlay)
        return a->outlay < b->outlay;
    if (a->from != b->from)
        return a->from < b->from;
    return a->out != b->out ? a->out < b->out : a->in < b->in;
}

static void offer(const explorer *e, neighbour found)
{
    size_t i = range_of(e->pareto, found.outlay);
    if (i < e->pareto->count && betters(tie_of(e->matrix), found.covered, found.outlay, &e->pareto->layouts[i]) &&
        goes_before(&found, &e->best[i]))
        e->best[i] = found;
}

/* What is selected, and that with each row besides. */
static void offer_with_each(explorer *e, size_t from, size_t out)
{
    const sp_selection *selection = &e->selection;
    double covered = selection->covered, all = e->matrix->search->all;
    offer(e, (neighbour){selection->outlay, covered, from, out, UINT32_MAX});
    const double *gains = sp_selection_gains(&e->selection, 0, e->pareto->ends[e->pareto->count - 1]);
    for (size_t r = 0; r < e->matrix->row_count; r++)
        if (gains[r] > 0)
            offer(e, (neighbour){selection->outlay + sp_coverage_matrix_outlay(e->matrix, r), covered + gains[r] * all,
                                 from, out, (uint32_t)r});
}

static void explore(explorer *e, size_t from)
{
    static const sp_pareto_layout nothing = {0};
    const sp_pareto_layout *layout = from == NOTHING ? &nothing : &e->pareto->layouts[from];
    sp_selection_set(&e->selection, layout->row, layout->count);
    offer_with_each(e, from, NOTHING);
    /* the first goes out and comes back last, so that gains are kept up and not found anew */
    for (size_t out = 0; out < layout->count; out++) {
        sp_selection_remove(&e->selection, 0);
        offer_with_each(e, from, out);
        sp_selection_add(&e->selection, layout->row[out]);
    }
}

static void free_explorers(explorer *explorers, int count)
{
    for (int i = 0; explorers && i < count; i++) {
        sp_selection_free(&explorers[i].selection);
        free(explorers[i].best);
    }
    free(explorers);
}

static explorer *create_explorers(const sp_coverage_matrix *matrix, const sp_pareto *pareto, int count, sp_error *error)
{
    explorer *explorers = calloc((size_t)count, sizeof *explorers);
    bool done = explorers || sp_fail_memory(error);
    for (int i = 0; done && i < count; i++) {
        explorers[i].matrix = matrix;
        explorers[i].pareto = pareto;
        explorers[i].best = malloc((pareto->count + 1) * sizeof *explorers[i].best);
        done =
            (explorers[i].best || sp_fail_memory(error)) && sp_selection_create(matrix, &explorers[i].selection, error);
    }
    if (done)
        return explorers;
    free_explorers(explorers, count);
    return NULL;
}

/* The layout itself, counted anew. */
static void enter(sp_pareto *pareto, const neighbour *found, const sp_pareto_layout *before, sp_selection *selection)
{
    sp_selection_set(selection, before ? before->row : NULL, before ? before->count : 0);
    if (found->out != NOTHING)
        sp_selection_remove(selection, found->out);
    if (found->in != UINT32_MAX)
        sp_selection_add(selection, found->in);
    sp_pareto_enter(pareto, selection);
}

/* What the explorers have found of each range; false where memory ran out. */
static bool enter_all(sp_pareto *pareto, explorer *explorers, int threads)
{
    sp_pareto_layout *before = malloc((pareto->count + 1) * sizeof *before);
    if (!before)
        return false;
    memcpy(before, pareto->layouts, pareto->count * sizeof *before);
    for (size_t i = 0; i < pareto->count; i++) {
        const neighbour *best = &explorers[0].best[i];
        for (int k = 1; k < threads; k++)
            if (goes_before(&explorers[k].best[i], best))
                best = &explorers[k].best[i];
        if (best->covered > 0)
            enter(pareto, best, best->from == NOTHING ? NULL : &before[best->from], &explorers[0].selection);
    }
    free(before);
    return true;
}

/* Ranges whose layouts are still to be explored, evenly chosen where they are more than `most`; returns how many. */
static size_t list_unexplored(const sp_pareto *pareto, size_t most, size_t *list)
{
    size_t count = 0, taken = 0;
    for (size_t i = 0; i < pareto->count; i++)
        if (!pareto->layouts[i].explored && sp_pareto_counts(pareto, i))
            list[count++] = i;
    for (; taken < count && taken < most; taken++)
        list[taken] = list[count <= most ? taken : taken * count / most];
    return taken;
}

/* The neighbours of every layout of the list, which are entered then. */
static bool explore_all(sp_pareto *pareto, explorer *explorers, int threads, const size_t *list, size_t count)
{
    for (int k = 0; k < threads; k++)
        for (size_t i = 0; i < pareto->count; i++)
            explorers[k].best[i] = (neighbour){.covered = 0, .outlay = INFINITY};
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
    for (size_t i = 0; i < count; i++)
        explore(&explorers[omp_get_thread_num()], list[i]);
    for (size_t i = 0; i < count && list[i] != NOTHING; i++)
        pareto->layouts[list[i]].explored = true;
    return enter_all(pareto, explorers, threads);
}

bool sp_pareto_search(const sp_coverage_matrix *matrix, sp_deadline *deadline, const char *stage, sp_pareto *pareto,
                      sp_error *error)
{
    if (!pareto->count) /* no row is as light as what may be spent */
        return true;
    int threads = sp_threads(&matrix->search->options->run);
    double each = WORK_EACH * (double)matrix->start[matrix->row_count] + 1;
    size_t left = (size_t)(WORK_MOST / each), count = 1;
    size_t *list = malloc((pareto->count + 1) * sizeof *list);
    explorer *explorers = list ? create_explorers(matrix, pareto, threads, error) : sp_fail_memory(error);
    bool done = explorers != NULL;
    if (done)
        list[0] = NOTHING;
    while (done && count && sp_deadline_goes_on(deadline, stage, 1)) {
        done = explore_all(pareto, explorers, threads, list, count) || sp_fail_memory(error);
        left -= count < left ? count : left;
        count = list_unexplored(pareto, left, list);
    }
    free_explorers(explorers, threads);
    free(list);
    return done;
}
