#include "search/partial_enumeration.h"

#include "ranking/ranking.h"
#include "ranks/messages.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define FIRST_MOST 300     /* first nozzles that have their turn */
#define SECOND_MOST 48     /* second ones of each first that proved good */
#define STARTS 3           /* of each outlay, that are improved */
#define PATHS_WORK 2e9     /* terms of sums that all greedy orders may take */
#define REGROUP_WORK 1.5e9 /* the same for regrouping at one outlay */

/* A greedy order: what its first so many nozzles take and cover. */
typedef struct {
    size_t enumerated, count;
    double power;
    uint32_t row[SP_SELECTION_MOST];
    double outlay[SP_SELECTION_MOST], covered[SP_SELECTION_MOST];
} path;

/* The first nozzles of a path. */
typedef struct {
    uint32_t row[SP_SELECTION_MOST];
    size_t count;
    double outlay, covered;
} start;

typedef struct {
    const sp_coverage_matrix *matrix;
    const double *budgets;
    size_t count;
    sp_deadline *deadline;
    int threads;
    sp_selection *scratch; /* [2 x threads] */
    path *paths;
    size_t path_count;
    start *starts; /* [count x SP_SELECTION_MOST], the best of each number of nozzles, less one */
    double most;   /* of the budgets */
} enumeration;

static void enumeration_free(enumeration *e)
{
    for (int i = 0; e->scratch && i < 2 * e->threads; i++)
        sp_selection_free(&e->scratch[i]);
    free(e->scratch);
    free(e->paths);
    free(e->starts);
}

static bool enumeration_create(enumeration *e, sp_error *error)
{
    size_t paths = 2 * (FIRST_MOST + (e->count + 1) * SECOND_MOST + 1);
    e->threads = sp_threads(&e->matrix->search->options->run);
    e->scratch = calloc(2 * (size_t)e->threads, sizeof *e->scratch);
    e->paths = calloc(paths, sizeof *e->paths);
    e->starts = calloc(e->count * SP_SELECTION_MOST + 1, sizeof *e->starts);
    if (!e->scratch || !e->paths || !e->starts)
        return sp_fail_memory(error);
    for (int i = 0; i < 2 * e->threads; i++)
        if (!sp_selection_create(e->matrix, &e->scratch[i], error))
            return false;
    for (size_t i = 0; i < e->count; i++)
        e->most = fmax(e->most, e->budgets[i]);
    return true;
}

/* Puts the enumerated nozzles in and goes on greedily. */
static void follow(const enumeration *e, sp_selection *selection, path *p)
{
    sp_selection_set(selection, NULL, 0);
    for (size_t i = 0;; i++) {
        double gain = INFINITY;
        uint32_t row = i < p->enumerated
                           ? p->row[i]
                           : sp_selection_best(selection, p->power, e->matrix->search->credit, e->most, &gain);
        if (i == SP_SELECTION_MOST || gain <= 0)
            break;
        sp_selection_add(selection, row);
        p->row[i] = row;
        p->outlay[i] = selection->outlay;
        p->covered[i] = selection->covered;
        p->count = i + 1;
    }
}

/* Keeps the path's longest beginning within each outlay where no other of as many nozzles covers more. */
static void enter(enumeration *e, const path *p)
{
    for (size_t b = 0; b < e->count; b++) {
        size_t n = 0;
        while (n < p->count && p->outlay[n] <= e->budgets[b])
            n++;
        start *own = &e->starts[b * SP_SELECTION_MOST + n - (n > 0)];
        if (!n || p->covered[n - 1] <= own->covered + SP_TIE * e->matrix->search->all)
            continue;
        *own = (start){.count = n, .covered = p->covered[n - 1], .outlay = p->outlay[n - 1]};
        memcpy(own->row, p->row, n * sizeof *own->row);
    }
}

/* What a beginning promises: what it covers, and of the outlay left half as much as of what is used. */
static double promise(const enumeration *e, size_t b, size_t i)
{
    const start *s = &e->starts[b * SP_SELECTION_MOST + i];
    double used = s->outlay - e->matrix->search->kept_flow;
    return s->count ? s->covered * (1 + 0.5 * (e->budgets[b] - s->outlay) / used) : 0;
}

/* Beginning number `rank` by promise; NULL for none. */
static const start *promising(const enumeration *e, size_t b, size_t rank)
{
    for (size_t i = 0; i < SP_SELECTION_MOST; i++) {
        size_t before = 0;
        double own = promise(e, b, i);
        for (size_t k = 0; k < SP_SELECTION_MOST && own > 0; k++)
            before += promise(e, b, k) > own || (k < i && promise(e, b, k) == own);
        if (own > 0 && before == rank)
            return &e->starts[b * SP_SELECTION_MOST + i];
    }
    return NULL;
}

static sp_ranks *ranks_of(const enumeration *e)
{
    return e->deadline->run.ranks;
}

static void pack_path(const path *p, sp_outgoing *outgoing)
{
    sp_pack(outgoing, &p->count, sizeof p->count);
    sp_pack(outgoing, p->row, p->count * sizeof *p->row);
    sp_pack(outgoing, p->outlay, p->count * sizeof *p->outlay);
    sp_pack(outgoing, p->covered, p->count * sizeof *p->covered);
}

static void unpack_path(sp_gathered *gathered, size_t rank, path *p)
{
    size_t count;
    if (sp_unpack(gathered, rank, &count, sizeof count) && count <= SP_SELECTION_MOST &&
        sp_unpack(gathered, rank, p->row, count * sizeof *p->row) &&
        sp_unpack(gathered, rank, p->outlay, count * sizeof *p->outlay) &&
        sp_unpack(gathered, rank, p->covered, count * sizeof *p->covered))
        p->count = count;
}

/* What the others' paths have become. */
static bool share_paths(enumeration *e, size_t from, sp_error *error)
{
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    for (size_t i = from; i < e->path_count; i++)
        if (sp_ranks_mine(ranks_of(e), i))
            pack_path(&e->paths[i], &outgoing);
    if (!sp_ranks_gather(ranks_of(e), "paths", &outgoing, &gathered, error))
        return false;
    for (size_t i = from; i < e->path_count; i++)
        if (!sp_ranks_mine(ranks_of(e), i))
            unpack_path(&gathered, sp_ranks_owner(ranks_of(e), i), &e->paths[i]);
    sp_gathered_free(&gathered);
    return true;
}

static bool follow_all(enumeration *e, size_t from, sp_error *error)
{
    sp_ranks_part(ranks_of(e));
#pragma omp parallel for num_threads(e->threads) schedule(dynamic, 1)
    for (size_t i = from; i < e->path_count; i++)
        if (sp_ranks_mine(ranks_of(e), i) && sp_deadline_goes_on(e->deadline, "front", 0))
            follow(e, &e->scratch[omp_get_thread_num()], &e->paths[i]);
    sp_ranks_rejoin(ranks_of(e));
    if (!share_paths(e, from, error))
        return false;
    for (size_t i = from; i < e->path_count; i++)
        enter(e, &e->paths[i]);
    return true;
}

/* Adds paths that begin with the selection's nozzles and one more, of those that gain most per root of the outlay, by
 * either weight of it. */
static bool add_paths(enumeration *e, const sp_selection *selection, size_t most, sp_error *error)
{
    size_t rows = e->matrix->row_count, found = 0;
    sp_ranked *list = malloc((rows + 1) * sizeof *list);
    if (!list)
        return sp_fail_memory(error);
    for (size_t r = 0; r < rows; r++) {
        double gain = sp_selection_gain(selection, (uint32_t)r, e->most);
        if (gain > 0)
            list[found++] = (sp_ranked){gain / sqrt(sp_coverage_matrix_outlay(e->matrix, r)), r};
    }
    sp_rank_falling_ties(list, found, SP_SCORE_TIE);
    for (size_t i = 0; i < found && i < most; i++)
        for (int way = 0; way < 2; way++) {
            path *p = &e->paths[e->path_count++];
            p->enumerated = selection->count + 1;
            p->power = way ? 0.5 : 1;
            memcpy(p->row, selection->row, selection->count * sizeof *p->row);
            p->row[selection->count] = list[i].at;
        }
    free(list);
    return true;
}

/* Terms of the sums that a row of `count` nozzles takes to be found greedily. */
static double work_of(const enumeration *e, size_t count)
{
    return (double)e->matrix->start[e->matrix->row_count] * (double)(count + 1);
}

/* The first nozzles, then second ones to those that made the best beginnings. */
static bool enumerate(enumeration *e, sp_error *error)
{
    sp_selection *selection = &e->scratch[0];
    e->paths[e->path_count++].power = 1;
    if (!follow_all(e, 0, error))
        return false;
    double work = work_of(e, e->paths[0].count), all = PATHS_WORK / work;
    size_t firsts = (size_t)fmin(FIRST_MOST, fmax(1, 0.25 * all));
    sp_selection_set(selection, NULL, 0);
    if (!add_paths(e, selection, firsts, error) || !follow_all(e, 1, error))
        return false;
    size_t second = e->path_count;
    size_t seconds = (size_t)fmin(SECOND_MOST, 0.25 * all / (double)(e->count + 1));
    for (size_t b = 0; b < e->count; b++) {
        const start *best = promising(e, b, 0);
        bool known = !best || !seconds;
        for (size_t i = second; !known && i < e->path_count; i++)
            known = e->paths[i].row[0] == best->row[0];
        if (known)
            continue;
        sp_selection_set(selection, best->row, 1);
        if (!add_paths(e, selection, seconds, error))
            return false;
    }
    return follow_all(e, second, error);
}

/* What the beginnings for one outlay become. */
static void improve(const enumeration *e, size_t b, sp_selection *own, sp_selection *scratch, sp_selection *best)
{
    sp_selection_memo memo = {0};
    own->memo = scratch->memo = &memo;
    for (size_t k = 0; k < STARTS && sp_deadline_goes_on(e->deadline, "front", 0); k++) {
        const start *from = promising(e, b, k);
        if (!from)
            break;
        sp_selection_set(own, from->row, from->count);
        sp_selection_improve(own, e->budgets[b]);
        if (own->covered > best->covered + SP_TIE * e->matrix->search->all)
            sp_selection_set(best, own->row, own->count);
    }
    if (6 * (double)best->count * work_of(e, best->count) <= REGROUP_WORK)
        sp_selection_regroup(best, e->budgets[b], scratch);
    own->memo = scratch->memo = NULL;
    sp_selection_memo_free(&memo);
}

/* The best beginnings improved, dealt out by outlay. */
static bool improve_all(const enumeration *e, sp_selection *selections, sp_error *error)
{
    sp_ranks *ranks = ranks_of(e);
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    sp_ranks_part(ranks);
#pragma omp parallel for num_threads(e->threads) schedule(dynamic, 1)
    for (size_t b = 0; b < e->count; b++) {
        sp_selection *scratch = &e->scratch[2 * omp_get_thread_num()];
        if (sp_ranks_mine(ranks, b))
            improve(e, b, &scratch[0], &scratch[1], &selections[b]);
    }
    sp_ranks_rejoin(ranks);
    for (size_t b = 0; b < e->count; b++)
        if (sp_ranks_mine(ranks, b)) {
            sp_pack(&outgoing, &selections[b].count, sizeof selections[b].count);
            sp_pack(&outgoing, selections[b].row, selections[b].count * sizeof *selections[b].row);
        }
    if (!sp_ranks_gather(ranks, "enumeration", &outgoing, &gathered, error))
        return false;
    for (size_t b = 0; b < e->count; b++) {
        uint32_t row[SP_SELECTION_MOST];
        size_t count, rank = sp_ranks_owner(ranks, b);
        if (!sp_ranks_mine(ranks, b) && sp_unpack(&gathered, rank, &count, sizeof count) &&
            count <= SP_SELECTION_MOST && sp_unpack(&gathered, rank, row, count * sizeof *row))
            sp_selection_set(&selections[b], row, count);
    }
    sp_gathered_free(&gathered);
    return true;
}

bool sp_enumerate_partially(const sp_coverage_matrix *matrix, const double *budgets, size_t count,
                            sp_deadline *deadline, sp_selection *selections, sp_error *error)
{
    enumeration e = {.matrix = matrix, .budgets = budgets, .count = count, .deadline = deadline};
    size_t created = 0;
    bool done = enumeration_create(&e, error);
    while (done && created < count) {
        done = sp_selection_create(matrix, &selections[created], error);
        created += done;
    }
    done = done && enumerate(&e, error) && improve_all(&e, selections, error);
    enumeration_free(&e);
    for (size_t i = 0; !done && i < created; i++)
        sp_selection_free(&selections[i]);
    return done;
}

bool sp_rows_partial(const sp_coverage_matrix *matrix, const uint32_t *rows, size_t count, const sp_search *search,
                     const sp_placed *const *others, sp_partial *partial, sp_error *error)
{
    const sp_pool *pool = matrix->pool;
    if (!sp_partial_create(search, partial, error))
        return false;
    bool done = true;
    for (size_t i = 0; done && i < count; i++) {
        size_t row = rows[i];
        done = row < pool->count ? sp_partial_add_pose(search, partial, pool->items[row], error)
                                 : sp_partial_add_copy(search, partial, others[row - pool->count], error);
    }
    if (!done)
        sp_partial_free(partial);
    return done;
}

bool sp_selection_partial(const sp_selection *selection, const sp_search *search, const sp_placed *const *others,
                          sp_partial *partial, sp_error *error)
{
    return sp_rows_partial(selection->matrix, selection->row, selection->count, search, others, partial, error);
}
