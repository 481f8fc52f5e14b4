#include "search/runners_up.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define SINGLES 4 /* runners-up of one nozzle; of more there is one without each of them */
/* Of what the best covers, that one may cover less; a single nozzle is refined in no time, and may come from farther
 * behind. */
#define LAG 0.03
#define LAG_OF_ONE 0.06

/* A thread's. */
typedef struct {
    sp_selection selection;
    bool *barred; /* [row_count] */
    sp_deadline *deadline;
} scratch;

/* What refinement leaves of a row's nozzle, and the mounting point that it is moved from. */
typedef struct {
    const sp_nozzle_type *type;
    double pressure; /* Pa */
    sp_vec3 place;
} kind;

static kind kind_of(const sp_coverage_matrix *matrix, size_t row)
{
    size_t poses = matrix->pool->count;
    if (row >= poses) {
        const sp_placed *placed = matrix->others[row - poses];
        return (kind){placed->nozzle.type, placed->nozzle.pressure, placed->origin.position};
    }
    sp_pose pose = matrix->pool->items[row];
    const sp_variant *variant = &matrix->search->candidates->variants[pose.variant];
    return (kind){variant->type, variant->pressure, matrix->search->sites->items[pose.site].position};
}

/* Bars the row, and all that refinement may turn it into without moving it. */
static void bar(const sp_coverage_matrix *matrix, uint32_t row, bool *barred)
{
    kind own = kind_of(matrix, row);
    for (size_t r = 0; r < matrix->row_count; r++) {
        kind other = kind_of(matrix, r);
        barred[r] |=
            other.type == own.type && other.pressure == own.pressure && sp_distance(other.place, own.place) == 0;
    }
}

static bool has(const uint32_t *rows, size_t count, uint32_t row)
{
    bool found = false;
    for (size_t i = 0; i < count && !found; i++)
        found = rows[i] == row;
    return found;
}

static bool is_known(const sp_runner_up *found, size_t count, const sp_selection *selection)
{
    bool known = false;
    for (size_t k = 0; k < count && !known; k++) {
        known = found[k].count == selection->count;
        for (size_t i = 0; i < selection->count && known; i++)
            known = has(found[k].row, found[k].count, selection->row[i]);
    }
    return known;
}

static bool is_close(const sp_selection *best, const sp_selection *selection)
{
    double lag = selection->count == 1 ? LAG_OF_ONE : LAG;
    return selection->count && selection->count <= SP_FEW && selection->covered >= best->covered * (1 - lag);
}

/* Adds it to the `count` found, if it is new; how many there are then. */
static size_t note(const sp_selection *selection, sp_runner_up *found, size_t count)
{
    if (count == SP_RUNNERS_UP || is_known(found, count, selection))
        return count;
    memcpy(found[count].row, selection->row, selection->count * sizeof *selection->row);
    found[count].count = selection->count;
    return count + 1;
}

/* Adds to the `count` found the runners-up without nozzle i of the best, `most` of them; how many there are then. */
static size_t find_without(const sp_selection *best, size_t i, double budget, size_t most, scratch *own,
                           sp_runner_up *found, size_t count)
{
    const sp_coverage_matrix *matrix = best->matrix;
    sp_selection *selection = &own->selection;
    memset(own->barred, 0, matrix->row_count * sizeof *own->barred);
    bar(matrix, best->row[i], own->barred);
    for (size_t k = 0; k < most && sp_deadline_goes_on(own->deadline, "refine", 0); k++) {
        sp_selection_set(selection, best->row, best->count);
        sp_selection_remove(selection, i);
        sp_selection_improve(selection, budget);
        if (!is_close(best, selection))
            break;
        count = note(selection, found, count);
        for (size_t n = 0; n < selection->count; n++)
            if (!has(best->row, best->count, selection->row[n]))
                bar(matrix, selection->row[n], own->barred);
    }
    return count;
}

/* Single nozzles that cover nearly as much as the best; how many. By gain per outlay they stand back behind several. */
static size_t find_singles(const sp_selection *best, double budget, scratch *own, sp_runner_up *found)
{
    size_t count = 0;
    sp_selection *selection = &own->selection;
    memset(own->barred, 0, best->matrix->row_count * sizeof *own->barred);
    for (size_t k = 0; k < SINGLES; k++) {
        double gain;
        sp_selection_set(selection, NULL, 0);
        uint32_t row = sp_selection_best(selection, 0, 0, budget, &gain);
        if (!(gain > 0))
            break;
        sp_selection_add(selection, row);
        if (!is_close(best, selection))
            break;
        count = note(selection, found, count);
        bar(best->matrix, row, own->barred);
    }
    return count;
}

static void find(const sp_selection *best, double budget, scratch *own, sp_runner_up *found)
{
    size_t number = best->count, count = number > 1 ? find_singles(best, budget, own, found) : 0;
    for (size_t i = 0; number <= SP_FEW && i < number; i++)
        count = find_without(best, i, budget, number == 1 ? SINGLES : 1, own, found, count);
}

static bool scratch_create(const sp_coverage_matrix *matrix, int threads, sp_deadline *deadline, scratch **all,
                           sp_error *error)
{
    *all = calloc((size_t)threads, sizeof **all);
    if (!*all)
        return sp_fail_memory(error);
    for (int i = 0; i < threads; i++) {
        scratch *own = &(*all)[i];
        own->barred = malloc((matrix->row_count + 1) * sizeof *own->barred);
        if (!own->barred)
            return sp_fail_memory(error);
        if (!sp_selection_create(matrix, &own->selection, error))
            return false;
        own->selection.barred = own->barred;
        own->deadline = deadline;
    }
    return true;
}

static void scratch_free(scratch *all, int threads)
{
    for (int i = 0; all && i < threads; i++) {
        sp_selection_free(&all[i].selection);
        free(all[i].barred);
    }
    free(all);
}

bool sp_find_runners_up(const sp_selection *best, const double *budgets, size_t count, sp_deadline *deadline,
                        sp_runner_up *found, sp_error *error)
{
    memset(found, 0, count * SP_RUNNERS_UP * sizeof *found);
    /* every rank looks for all of them, and what the clock says is agreed on here */
    if (!count || !sp_deadline_goes_on(deadline, "refine", 0))
        return true;
    const sp_coverage_matrix *matrix = best->matrix;
    int threads = sp_threads(&matrix->search->options->run);
    scratch *all;
    bool done = scratch_create(matrix, threads, deadline, &all, error);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
    for (size_t b = 0; b < count; b++)
        if (done)
            find(&best[b], budgets[b], &all[omp_get_thread_num()], &found[b * SP_RUNNERS_UP]);
    scratch_free(all, threads);
    return done;
}

bool sp_find_singles(const sp_coverage_matrix *matrix, double most, sp_deadline *deadline, sp_runner_up *found,
                     sp_error *error)
{
    scratch *own;
    sp_selection best;
    memset(found, 0, SP_RUNNERS_UP * sizeof *found);
    bool created = sp_selection_create(matrix, &best, error);
    bool done = scratch_create(matrix, 1, deadline, &own, error) && created;
    double gain = 0;
    uint32_t row = done ? sp_selection_best(&best, 0, 0, most, &gain) : 0;
    if (gain > 0) {
        sp_selection_add(&best, row);
        find_singles(&best, most, own, found);
    }
    scratch_free(own, 1);
    if (created)
        sp_selection_free(&best);
    return done;
}
