#include "search/front.h"

#include "mesh/grow.h"
#include "ranks/messages.h"
#include "scoring/bodies.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define FLOW_LEAST 0.01 /* share of the outlay by which points of the front differ */

/* m² by which equal coverages may differ. */
static double tie_of(const sp_front *front)
{
    return SP_TIE * sp_evaluator_patches(front->fine)->total_area;
}

sp_front sp_front_anew(sp_front *front)
{
    sp_front anew = {.fine = front->fine,
                     .draft_jets = front->draft_jets,
                     .counted = front->counted,
                     .jet_cache = front->jet_cache,
                     .deadline = front->deadline,
                     .objective = front->objective,
                     .target = front->target};
    front->counted = (sp_front_list){0};
    front->jet_cache = (sp_jet_cache){0};
    return anew;
}

static bool less_outlay(const sp_front_point *a, const sp_front_point *b)
{
    return a->outlay < b->outlay * (1 - SP_ROUNDING);
}

bool sp_front_better(const sp_front *front, const sp_front_point *a, const sp_front_point *b)
{
    double tie = tie_of(front);
    bool both = a->area >= front->target && b->area >= front->target;
    if (front->objective == SP_OBJECTIVE_MAX_COVERAGE || !both) {
        if (front->objective != SP_OBJECTIVE_MAX_COVERAGE && (a->area >= front->target) != (b->area >= front->target))
            return a->area >= front->target;
        return a->area > b->area + tie || (a->area >= b->area - tie && less_outlay(a, b));
    }
    if (front->objective == SP_OBJECTIVE_AREA_PER_WATER)
        return a->area * b->outlay > b->area * a->outlay * (1 + SP_TIE);
    return less_outlay(a, b) || (!less_outlay(b, a) && a->area > b->area + tie);
}

static double by_water(const sp_front_point *point)
{
    return point->outlay;
}

static double by_number(const sp_front_point *point)
{
    return (double)point->nozzles;
}

#ifndef NDEBUG
/* Neither more outlay (or nozzles) nor less area than the next one's. */
static bool is_rising(const sp_front_list *list, double (*key)(const sp_front_point *))
{
    for (size_t i = 1; i < list->count; i++) {
        const sp_front_point *before = &list->entries[i - 1].point, *point = &list->entries[i].point;
        if (key(before) > key(point) * (1 + SP_ROUNDING) || before->area >= point->area)
            return false;
    }
    return true;
}
#endif

/* Enters the layout at its place by `key` unless some entry of no higher key covers as much, and drops what it betters.
 * What differs by round-off is equal. */
static bool note(sp_front_list *list, double (*key)(const sp_front_point *), double tie, const sp_search *search,
                 const sp_partial *partial, const sp_front_point *point, sp_error *error)
{
    size_t at = 0;
    while (at < list->count && key(&list->entries[at].point) <= key(point) * (1 + SP_ROUNDING))
        at++;
    if (at > 0 && list->entries[at - 1].point.area >= point->area - tie)
        return true;
    sp_partial copy;
    if (!sp_grow(&list->entries, &list->capacity, list->count + 1, sizeof *list->entries))
        return sp_fail_memory(error);
    if (!sp_partial_copy(search, partial, &copy, error))
        return false;
    if (at > 0 && key(&list->entries[at - 1].point) * (1 + SP_ROUNDING) >= key(point))
        at--;
    size_t end = at;
    for (; end < list->count && list->entries[end].point.area <= point->area + tie; end++)
        sp_partial_free(&list->entries[end].partial);
    memmove(&list->entries[at + 1], &list->entries[end], (list->count - end) * sizeof *list->entries);
    list->entries[at] = (sp_front_entry){*point, copy};
    list->count += at + 1 - end;
    assert(is_rising(list, key));
    return true;
}

/* Nozzles that want a fitting made for them. */
static size_t fittings_of(const sp_search *search, const sp_partial *partial)
{
    size_t count = 0;
    for (size_t i = 0; i < partial->count; i++)
        count += search->options->mounts[partial->items[i].site.mount].kind != SP_MOUNT_PORT;
    return count;
}

static bool flies_jets(const sp_front *front)
{
    return sp_evaluator_fidelity(front->fine)->method == SP_METHOD_FORWARD;
}

/* m² that the layout covers. */
static bool evaluate(sp_front *front, const sp_search *search, const sp_layout *layout, double *area, sp_error *error)
{
    if (flies_jets(front)) {
        const sp_evaluator *evaluator = front->draft_jets ? search->coarse : front->fine;
        int reflections = sp_evaluator_fidelity(front->fine)->reflections;
        return sp_jet_cache_area(&front->jet_cache, evaluator, front->draft_jets, reflections, layout, area, error);
    }
    sp_coverage *coverage = sp_evaluate(front->fine, layout, error);
    bool done = coverage != NULL;
    *area = done ? coverage->covered_area : 0;
    sp_coverage_destroy(coverage);
    return done;
}

/* Jets take so long that each layout may be the last for which there is time. */
static bool has_time(const sp_front *front)
{
    if (!flies_jets(front) || sp_deadline_has_time(front->deadline, "front", 1))
        return true;
    sp_deadline_cut(front->deadline, "front");
    return false;
}

static bool measure(sp_front *front, const sp_search *search, const sp_partial *partial, sp_front_point *point,
                    sp_error *error)
{
    double area;
    sp_layout *layout = sp_partial_to_layout(search, partial, error);
    bool done = layout && evaluate(front, search, layout, &area, error);
    if (done)
        *point = (sp_front_point){.flow = sp_layout_flow(layout, &sp_evaluator_setup(front->fine)->liquid),
                                  .area = area,
                                  .nozzles = layout->count,
                                  .counted = NAN,
                                  .bound = NAN,
                                  .every_aim_bound = NAN,
                                  .fittings = fittings_of(search, partial)};
    if (done)
        point->outlay = point->flow + sp_partial_costs(search, partial);
    sp_layout_destroy(layout);
    return done;
}

/* Those that are this rank's, at once. */
static bool measure_own(sp_front *front, const sp_search *search, const sp_partial *const *partials, size_t count,
                        sp_front_point *points, sp_error *error)
{
    sp_error failure = {0};
    /* jets tell the caller how far they are, and find what was flown before, which only one thread may */
    int threads = flies_jets(front) ? 1 : sp_threads(&search->options->run);
    sp_ranks_part(search->options->run.ranks);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
    for (size_t i = 0; i < count; i++) {
        sp_error mine = {0};
        points[i] = (sp_front_point){.area = -1};
        if (partials[i] && sp_ranks_mine(search->options->run.ranks, i) && has_time(front) &&
            !measure(front, search, partials[i], &points[i], &mine)) {
#pragma omp critical(sp_front_failure)
            failure = mine;
        }
    }
    sp_ranks_rejoin(search->options->run.ranks);
    return failure.kind == SP_OK ||
           sp_fail(error, failure.kind, failure.file, failure.line, failure.column, "%s", failure.message);
}

bool sp_front_measure_ahead(sp_front *front, const sp_search *search, const sp_partial *const *partials, size_t count,
                            sp_front_point *points, sp_error *error)
{
    sp_ranks *ranks = search->options->run.ranks;
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    if (!measure_own(front, search, partials, count, points, error))
        return false;
    for (size_t i = 0; sp_ranks_count(ranks) > 1 && i < count; i++)
        if (partials[i] && sp_ranks_mine(ranks, i))
            sp_pack(&outgoing, &points[i], sizeof points[i]);
    if (!sp_ranks_gather(ranks, "points", &outgoing, &gathered, error))
        return false;
    for (size_t i = 0; i < count; i++)
        if (partials[i] && !sp_ranks_mine(ranks, i))
            sp_unpack(&gathered, sp_ranks_owner(ranks, i), &points[i], sizeof points[i]);
    sp_gathered_free(&gathered);
    return true;
}

bool sp_front_count(sp_front *front, const sp_search *search, const sp_partial *partial, const sp_front_point *point,
                    sp_error *error)
{
    sp_front_list *list = &front->counted;
    sp_partial copy;
    if (!sp_grow(&list->entries, &list->capacity, list->count + 1, sizeof *list->entries))
        return sp_fail_memory(error);
    if (!sp_partial_copy(search, partial, &copy, error))
        return false;
    list->entries[list->count++] = (sp_front_entry){*point, copy};
    return true;
}

/* A copy as the best. */
static bool keep(sp_front *front, const sp_search *search, const sp_partial *partial, const sp_front_point *point,
                 sp_error *error)
{
    sp_partial copy;
    if (!sp_partial_copy(search, partial, &copy, error))
        return false;
    sp_partial_free(&front->best);
    front->best = copy;
    front->measured = *point;
    front->bias = point->area - partial->covered;
    front->found = true;
    return true;
}

bool sp_front_settle(sp_front *front, const sp_search *search, sp_error *error)
{
    double resolution = SP_COVERAGE_TOLD * sp_evaluator_patches(front->fine)->total_area;
    if (!front->found || front->objective == SP_OBJECTIVE_MAX_COVERAGE || front->measured.area >= front->target)
        return true;
    for (size_t i = 0; i < front->by_water.count; i++) {
        const sp_front_entry *entry = &front->by_water.entries[i];
        if (entry->point.area >= front->measured.area - resolution)
            return !less_outlay(&entry->point, &front->measured) ||
                   keep(front, search, &entry->partial, &entry->point, error);
    }
    return true;
}

bool sp_front_aim(sp_front *front, const sp_search *search, double target, sp_error *error)
{
    bool done = true;
    front->target = target;
    for (size_t i = 0; done && i < front->by_water.count; i++) {
        const sp_front_entry *entry = &front->by_water.entries[i];
        if (sp_front_better(front, &entry->point, &front->measured))
            done = keep(front, search, &entry->partial, &entry->point, error);
    }
    return done;
}

/* A layout that has been measured, into the fronts, if its bodies allow that it be built. */
static bool enter(sp_front *front, const sp_search *search, const sp_partial *partial, const sp_front_point *point,
                  sp_error *error)
{
    if (!sp_partial_clear(search, partial))
        return true;
    if (!note(&front->by_water, by_water, tie_of(front), search, partial, point, error) ||
        !note(&front->by_number, by_number, tie_of(front), search, partial, point, error))
        return false;
    return (front->found && !sp_front_better(front, point, &front->measured)) ||
           keep(front, search, partial, point, error);
}

bool sp_front_measure(sp_front *front, const sp_search *search, const sp_partial *partial, sp_front_point *point,
                      sp_error *error)
{
    sp_front_point own;
    if (!measure(front, search, partial, &own, error) || !enter(front, search, partial, &own, error))
        return false;
    if (point)
        *point = own;
    return true;
}

bool sp_front_note(sp_front *front, const sp_search *search, const sp_partial *partial, sp_front_point *point,
                   sp_error *error)
{
    if (point->area < 0)
        return !has_time(front) || sp_front_measure(front, search, partial, point, error);
    return enter(front, search, partial, point, error);
}

bool sp_front_measure_all(sp_front *front, const sp_search *search, const sp_partial *partials, size_t count,
                          sp_error *error)
{
    const sp_partial **each = calloc(count + 1, sizeof *each);
    sp_front_point *points = malloc((count + 1) * sizeof *points);
    bool done = (each && points) || sp_fail_memory(error);
    for (size_t i = 0; done && i < count; i++)
        each[i] = &partials[i];
    done = done && sp_front_measure_ahead(front, search, each, count, points, error);
    for (size_t i = 0; done && i < count; i++)
        done = sp_front_note(front, search, &partials[i], &points[i], error);
    free(each);
    free(points);
    return done;
}

const sp_placed **sp_front_nozzles(const sp_front *front, size_t *count)
{
    size_t total = 0;
    for (size_t i = 0; i < front->by_water.count; i++)
        total += front->by_water.entries[i].partial.count;
    const sp_placed **nozzles = malloc((total + 1) * sizeof *nozzles);
    *count = 0;
    for (size_t i = 0; nozzles && i < front->by_water.count; i++)
        for (size_t n = 0; n < front->by_water.entries[i].partial.count; n++)
            nozzles[(*count)++] = &front->by_water.entries[i].partial.items[n];
    return nozzles;
}

bool sp_front_counts(const sp_front *front, size_t i)
{
    const sp_front_entry *entries = front->by_water.entries;
    size_t next = front->by_water.count - 1;
    assert(i < front->by_water.count);
    for (size_t k = next; k > i; k--)
        if (entries[next].point.outlay > entries[k - 1].point.outlay * (1 + FLOW_LEAST))
            next = k - 1;
    return next == i;
}

static sp_front_point *points_of(const sp_front *front, const sp_front_list *list, size_t *count, sp_error *error)
{
    sp_front_point *points = malloc((list->count ? list->count : 1) * sizeof *points);
    if (!points)
        return sp_fail_memory(error);
    *count = 0;
    for (size_t i = 0; i < list->count; i++)
        if (list->entries[i].point.flow > 0 && list->entries[i].point.area > 0 &&
            (list == &front->by_number || sp_front_counts(front, i)))
            points[(*count)++] = list->entries[i].point;
    return points;
}

sp_front_point *sp_front_by_water(const sp_front *front, size_t *count, sp_error *error)
{
    return points_of(front, &front->by_water, count, error);
}

sp_front_point *sp_front_by_number(const sp_front *front, size_t *count, sp_error *error)
{
    return points_of(front, &front->by_number, count, error);
}

static void list_free(sp_front_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        sp_partial_free(&list->entries[i].partial);
    free(list->entries);
}

void sp_front_free(sp_front *front)
{
    list_free(&front->by_water);
    list_free(&front->by_number);
    list_free(&front->counted);
    sp_partial_free(&front->best);
    sp_jet_cache_free(&front->jet_cache);
    *front = (sp_front){0};
}
