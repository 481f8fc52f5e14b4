#include "front.h"

#include <stdlib.h>

bool sp_front_better(const sp_front *front, const sp_front_point *a, const sp_front_point *b)
{
    bool both = a->area >= front->target && b->area >= front->target;
    if (front->objective == SP_OBJECTIVE_MAX_COVERAGE || !both) {
        if (front->objective != SP_OBJECTIVE_MAX_COVERAGE &&
            (a->area >= front->target) != (b->area >= front->target))
            return a->area >= front->target;
        return a->area > b->area || (a->area == b->area && a->flow < b->flow);
    }
    if (front->objective == SP_OBJECTIVE_AREA_PER_WATER)
        return a->area * b->flow > b->area * a->flow;
    return a->flow < b->flow || (a->flow == b->flow && a->area > b->area);
}

static bool note(sp_front *front, const sp_front_point *point, sp_error *error)
{
    if (front->count == front->capacity) {
        size_t capacity = front->capacity ? 2 * front->capacity : 32;
        sp_front_point *points = realloc(front->points, capacity * sizeof *points);
        if (!points)
            return sp_fail_memory(error);
        front->points = points;
        front->capacity = capacity;
    }
    front->points[front->count++] = *point;
    return true;
}

bool sp_front_measure(sp_front *front, const sp_search *search, const sp_design *design, sp_front_point *point,
                      sp_error *error)
{
    sp_layout *layout = sp_design_layout(search, design, error);
    sp_coverage *coverage = layout ? sp_evaluate(front->fine, layout, error) : NULL;
    sp_front_point measured = {0};
    if (coverage)
        measured = (sp_front_point){coverage->flow, coverage->covered_area, layout->count};
    bool done = coverage != NULL;
    sp_coverage_destroy(coverage);
    sp_layout_destroy(layout);
    if (!done || !note(front, &measured, error))
        return false;
    if (point)
        *point = measured;
    if (front->found && !sp_front_better(front, &measured, &front->measured))
        return true;
    sp_design copy;
    if (!sp_design_copy(search, design, &copy, error))
        return false;
    sp_design_free(&front->best);
    front->best = copy;
    front->measured = measured;
    front->bias = measured.area - design->covered;
    front->found = true;
    return true;
}

static int compare_points(const void *a, const void *b)
{
    const sp_front_point *p = a, *q = b;
    if (p->flow != q->flow)
        return p->flow < q->flow ? -1 : 1;
    if (p->area != q->area)
        return p->area > q->area ? -1 : 1;
    return p->nozzles < q->nozzles ? -1 : p->nozzles > q->nozzles;
}

void sp_front_settle(sp_front *front)
{
    if (front->count)
        qsort(front->points, front->count, sizeof *front->points, compare_points);
    size_t kept = 0;
    for (size_t i = 0; i < front->count; i++)
        if (front->points[i].flow > 0 && front->points[i].area > (kept ? front->points[kept - 1].area : 0))
            front->points[kept++] = front->points[i];
    front->count = kept;
}

void sp_front_free(sp_front *front)
{
    sp_design_free(&front->best);
    free(front->points);
    *front = (sp_front){0};
}
