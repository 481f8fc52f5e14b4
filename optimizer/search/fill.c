#include "search/fill.h"

#include "search/pareto.h"
#include "search/partial_enumeration.h"

#include <stdlib.h>

#define GAIN_LEAST 0.003 /* of what is covered, that a layout must add on the search's patches to be measured */

typedef struct {
    const sp_search *search;
    const sp_pool *pool;
    sp_deadline *deadline;
    sp_front *front;
    sp_coverage_matrix matrix; /* the pool's rows, then those of the front's layouts, one's after the other's */
    sp_pareto pareto;
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

/* The front's layouts, from which the search begins. */
static bool enter_front(filling *f)
{
    const sp_front_list *list = &f->front->by_water;
    sp_selection selection;
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
    }
    sp_selection_free(&selection);
    return true;
}

/* The most that the front's layouts of no more outlay cover of the search's patches. */
static double known_to_cover(const sp_front *front, double outlay)
{
    double covered = 0;
    const sp_front_list *list = &front->by_water;
    for (size_t i = 0; i < list->count && list->entries[i].point.outlay <= outlay * (1 + SP_ROUNDING); i++)
        covered = fmax(covered, list->entries[i].partial.covered);
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
        done = sp_selection_partial(&selection, partial, f->error);
        if (done && partial->covered > known_to_cover(f->front, partial->outlay) * (1 + GAIN_LEAST))
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

bool sp_fill_front(const sp_search *search, const sp_pool *pool, sp_deadline *deadline, sp_front *front,
                   sp_error *error)
{
    filling f = {.search = search, .pool = pool, .deadline = deadline, .front = front, .error = error};
    size_t count;
    if (!front->by_water.count || !sp_deadline_goes_on(deadline, "fill", 0))
        return true;
    const sp_placed **nozzles = sp_front_nozzles(front, &count);
    bool done = (nozzles || sp_fail_memory(error)) &&
                sp_coverage_matrix_create(search, pool, nozzles, count, &f.matrix, error) && create_ranges(&f) &&
                enter_front(&f) && sp_pareto_search(&f.matrix, deadline, "fill", &f.pareto, error) &&
                (!sp_deadline_goes_on(deadline, "fill", 0.5) || measure_all(&f));
    sp_pareto_free(&f.pareto);
    sp_coverage_matrix_free(&f.matrix);
    free(nozzles);
    return done;
}
