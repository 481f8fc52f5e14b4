#include "search/front.h"

#include "grow.h"

#include <stdlib.h>
#include <string.h>

#define FLOW_LEAST 0.01 /* share of the water by which points of the front differ */

bool sp_front_better(const sp_front *front, const sp_front_point *a, const sp_front_point *b)
{
    bool both = a->area >= front->target && b->area >= front->target;
    if (front->objective == SP_OBJECTIVE_MAX_COVERAGE || !both) {
        if (front->objective != SP_OBJECTIVE_MAX_COVERAGE && (a->area >= front->target) != (b->area >= front->target))
            return a->area >= front->target;
        return a->area > b->area || (a->area == b->area && a->flow < b->flow);
    }
    if (front->objective == SP_OBJECTIVE_AREA_PER_WATER)
        return a->area * b->flow > b->area * a->flow;
    return a->flow < b->flow || (a->flow == b->flow && a->area > b->area);
}

/* Enters the draft at its place unless some entry covers as much with no more water, and drops what it betters. */
static bool note(sp_front *front, const sp_search *search, const sp_draft *draft, const sp_front_point *point,
                 sp_error *error)
{
    size_t at = 0;
    while (at < front->count && front->entries[at].point.flow <= point->flow)
        at++;
    if (at > 0 && front->entries[at - 1].point.area >= point->area)
        return true;
    sp_draft copy;
    if (!sp_grow(&front->entries, &front->capacity, front->count + 1, sizeof *front->entries))
        return sp_fail_memory(error);
    if (!sp_draft_copy(search, draft, &copy, error))
        return false;
    if (at > 0 && front->entries[at - 1].point.flow == point->flow)
        at--;
    size_t end = at;
    for (; end < front->count && front->entries[end].point.area <= point->area; end++)
        sp_draft_free(&front->entries[end].draft);
    memmove(&front->entries[at + 1], &front->entries[end], (front->count - end) * sizeof *front->entries);
    front->entries[at] = (sp_front_entry){*point, copy};
    front->count += at + 1 - end;
    return true;
}

bool sp_front_measure(sp_front *front, const sp_search *search, const sp_draft *draft, sp_front_point *point,
                      sp_error *error)
{
    sp_layout *layout = sp_draft_layout(search, draft, error);
    sp_coverage *coverage = layout ? sp_evaluate(front->fine, layout, error) : NULL;
    sp_front_point measured = {0};
    if (coverage)
        measured = (sp_front_point){coverage->flow, coverage->covered_area, layout->count, NAN, NAN, NAN};
    bool done = coverage != NULL;
    sp_coverage_destroy(coverage);
    sp_layout_destroy(layout);
    if (!done || !note(front, search, draft, &measured, error))
        return false;
    if (point)
        *point = measured;
    if (front->found && !sp_front_better(front, &measured, &front->measured))
        return true;
    sp_draft copy;
    if (!sp_draft_copy(search, draft, &copy, error))
        return false;
    sp_draft_free(&front->best);
    front->best = copy;
    front->measured = measured;
    front->bias = measured.area - draft->covered;
    front->found = true;
    return true;
}

bool sp_front_counts(const sp_front *front, size_t i)
{
    return i + 1 == front->count || front->entries[i + 1].point.flow > front->entries[i].point.flow * (1 + FLOW_LEAST);
}

sp_front_point *sp_front_points(const sp_front *front, size_t *count, sp_error *error)
{
    sp_front_point *points = malloc((front->count ? front->count : 1) * sizeof *points);
    if (!points)
        return sp_fail_memory(error);
    *count = 0;
    for (size_t i = 0; i < front->count; i++)
        if (front->entries[i].point.flow > 0 && front->entries[i].point.area > 0 && sp_front_counts(front, i))
            points[(*count)++] = front->entries[i].point;
    return points;
}

void sp_front_free(sp_front *front)
{
    for (size_t i = 0; i < front->count; i++)
        sp_draft_free(&front->entries[i].draft);
    sp_draft_free(&front->best);
    free(front->entries);
    *front = (sp_front){0};
}
