#include "search/front_gaps.h"

#include "search/jet_fields.h"
#include "search/pareto.h"
#include "search/partial_enumeration.h"

#include <stdlib.h>

#define POSES_FEW 250    /* of the pool, that jets are flown from all */
#define GAIN_LEAST 0.003 /* of what is covered, that a layout must add on the search's patches to be measured */

typedef struct {
    const sp_search *search;
    const sp_pool *pool;
    const sp_placed **nozzles; /* of the front's layouts, one's after the other's, and what else there is */
    sp_deadline *deadline;
    sp_front *front;
    bool by_jets;              /* the matrix tells what jets find, which the nozzles' own fields do not */
    sp_coverage_matrix matrix; /* the pool's rows, then the nozzles' */
    sp_pareto pareto;
    double *known; /* [front->by_water.count], m² that each of its layouts covers, as `covers` tells */
    sp_error *error;
} filling;

/* Up to what may be spent, with an end at what each layout of the front takes. */
static bool create_ranges(filling *f)
{
    const sp_front_list *list = &f->front->by_water;
    double *outlays = malloc((list->count + 1) * sizeof *outlays);
    size_t count = 0;
    if (!outlays)
        return sp_fail_memory(f->error);
    for (size_t i = 0; i < list->count; i++)
        outlays[count++] = list->entries[i].point.outlay * (1 + SP_ROUNDING);
    if (isfinite(f->search->outlay_most))
        outlays[count++] = f->search->outlay_most * (1 + SP_ROUNDING);
    bool done = sp_pareto_create(&f->matrix, outlays, count, &f->pareto, f->error);
    free(outlays);
    return done;
}

/* m² of the search's patches; of the matrix's sample, where only that tells what jets find. */
static double covers(const filling *f, const sp_selection *selection, const sp_partial *partial)
{
    return f->by_jets ? selection->covered : partial->covered;
}

/* The front's layouts, from which the search begins. */
static bool enter_front(filling *f)
{
    const sp_front_list *list = &f->front->by_water;
    sp_selection selection;
    f->known = malloc((list->count + 1) * sizeof *f->known);
    if (!f->known)
        return sp_fail_memory(f->error);
    if (!sp_selection_create(&f->matrix, &selection, f->error))
        return false;
    uint32_t row = (uint32_t)f->pool->count;
    for (size_t i = 0; i < list->count; i++) {
        size_t count = list->entries[i].partial.count;
        sp_selection_set(&selection, NULL, 0);
        for (size_t n = 0; n < count; n++, row++)
            if (count <= SP_SELECTION_MOST)
                sp_selection_add(&selection, row);
        sp_pareto_enter(&f->pareto, &selection);
        f->known[i] = covers(f, &selection, &list->entries[i].partial);
    }
    sp_selection_free(&selection);
    return true;
}

/* The most that the front's layouts of no more outlay cover. */
static double known_to_cover(const filling *f, double outlay)
{
    double covered = 0;
    const sp_front_list *list = &f->front->by_water;
    for (size_t i = 0; i < list->count && list->entries[i].point.outlay <= outlay * (1 + SP_ROUNDING); i++)
        covered = fmax(covered, f->known[i]);
    return covered;
}

/* Layouts of the search as partial ones, where they cover clearly more than the front does for as much. All of them
 * before any is noted: the front may then drop layouts whose nozzles they hold. */
static bool build_all(const filling *f, sp_partial *partials, size_t *count)
{
    sp_selection selection;
    if (!sp_selection_create(&f->matrix, &selection, f->error))
        return false;
    bool done = true;
    for (size_t i = 0; done && i < f->pareto.count; i++) {
        sp_partial *partial = &partials[*count];
        if (!sp_pareto_counts(&f->pareto, i))
            continue;
        sp_selection_set(&selection, f->pareto.layouts[i].row, f->pareto.layouts[i].count);
        done = sp_selection_partial(&selection, f->search, f->nozzles, partial, f->error);
        if (done && covers(f, &selection, partial) > known_to_cover(f, partial->outlay) * (1 + GAIN_LEAST))
            (*count)++;
        else if (done)
            sp_partial_free(partial);
    }
    sp_selection_free(&selection);
    return done;
}

static bool measure_all(const filling *f)
{
    size_t count = 0;
    sp_partial *partials = calloc(f->pareto.count + 1, sizeof *partials);
    bool done = (partials || sp_fail_memory(f->error)) && build_all(f, partials, &count) &&
                sp_front_measure_all(f->front, f->search, partials, count, f->error);
    for (size_t i = 0; i < count; i++)
        sp_partial_free(&partials[i]);
    free(partials);
    return done;
}

/* With the matrix of `search`, whose pool and nozzles [count] are the filling's, or the same as jets find them. */
static bool fill(filling *f, const sp_search *search, const sp_placed *const *nozzles, size_t count)
{
    bool done = sp_coverage_matrix_create(search, f->pool, nozzles, count, &f->matrix, f->error) && create_ranges(f) &&
                enter_front(f) && sp_pareto_search(&f->matrix, f->deadline, "fill", &f->pareto, f->error) &&
                (!sp_deadline_goes_on(f->deadline, "fill", 0.5) || measure_all(f));
    sp_pareto_free(&f->pareto);
    sp_coverage_matrix_free(&f->matrix);
    free(f->known);
    return done;
}

bool sp_fill_front(const sp_search *search, const sp_pool *pool, sp_deadline *deadline, sp_front *front,
                   sp_error *error)
{
    filling f = {.search = search, .pool = pool, .deadline = deadline, .front = front, .error = error};
    size_t count;
    if (!front->by_water.count || !sp_deadline_goes_on(deadline, "fill", 0))
        return true;
    f.nozzles = sp_front_nozzles(front, &count);
    bool done = (f.nozzles || sp_fail_memory(error)) && fill(&f, search, f.nozzles, count);
    free(f.nozzles);
    return done;
}

/* Of the front's layouts, and behind them those of `few`. */
static const sp_placed **list_nozzles(const sp_front *front, const sp_partial *few, size_t *count)
{
    size_t own;
    const sp_placed **nozzles = sp_front_nozzles(front, &own);
    const sp_placed **all = nozzles ? realloc(nozzles, (own + few->count + 1) * sizeof *all) : NULL;
    *count = own + few->count;
    for (size_t i = 0; all && i < few->count; i++)
        all[own + i] = &few->items[i];
    if (!all)
        free(nozzles);
    return all;
}

/* The pool's poses, where they are few. */
static bool place_few(const sp_search *search, const sp_pool *pool, sp_partial *few, sp_error *error)
{
    bool done = sp_partial_create(search, few, error);
    for (size_t i = 0; done && pool->count <= POSES_FEW && i < pool->count; i++)
        done = sp_partial_add_pose(search, few, pool->items[i], error);
    return done;
}

bool sp_fill_front_by_jets(const sp_search *search, const sp_pool *pool, sp_deadline *deadline, sp_front *front,
                           sp_error *error)
{
    const sp_pool none = {0};
    filling f = {
        .search = search, .pool = &none, .deadline = deadline, .front = front, .by_jets = true, .error = error};
    sp_jet_fields fields = {0};
    sp_partial few = {0};
    size_t count;
    bool moves = sp_evaluator_setup(front->fine)->sweep.speed > 0;
    if (moves || !sp_evaluator_counts_thrown_back(front->fine) || !sp_deadline_goes_on(deadline, "fill", 0.5))
        return true;
    bool done = place_few(search, pool, &few, error) &&
                ((f.nozzles = list_nozzles(front, &few, &count)) || sp_fail_memory(error)) &&
                sp_jet_fields_create(search, front->fine, f.nozzles, count, deadline, &fields, error) &&
                (!fields.count || fill(&f, &fields.search, fields.flown, count));
    sp_jet_fields_free(&fields);
    sp_partial_free(&few);
    free(f.nozzles);
    return done;
}
