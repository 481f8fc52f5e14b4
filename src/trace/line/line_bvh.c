#include "trace/line/line_bvh.h"

#include <assert.h>

/* For origins farther away, in the hierarchy's space, single precision will not do even where the line comes near. */
#define FAR 0x1p15

enum { FEW = 4 }; /* fewer lines are faster one after another */

/* A walk in double precision, for whatever the fast one does not take. */
typedef struct {
    uint32_t node;
    double from; /* s */
} pending;

/* When the line enters the box widened by `margin`, no sooner than `from`; false where it does not before `to`. */
static bool enter(const sp_line *line, const double low[3], const double high[3], double margin, double *from,
                  double to)
{
    for (int axis = 0; axis < 3; axis++) {
        double speed = line->velocity[axis], a = low[axis] - margin - line->origin[axis],
               b = high[axis] + margin - line->origin[axis];
        if (speed == 0 && (a > 0 || b < 0))
            return false;
        if (speed != 0) {
            *from = sp_greater(*from, (speed > 0 ? a : b) / speed);
            to = sp_lesser(to, (speed > 0 ? b : a) / speed);
        }
    }
    return *from <= to;
}

static void test_block(const sp_bvh *bvh, const sp_line *line, const sp_bvh_block *block, sp_ray_search *search)
{
    for (int i = 0; i < SP_BVH_WIDTH && block->triangle[i] != SP_NONE; i++) {
        sp_corners corners;
        sp_bvh_corners(bvh, block->triangle[i], corners);
        sp_line_test(line, (const double(*)[3])corners, block->triangle[i], search);
    }
}

sp_hit sp_bvh_line_walk(const sp_bvh *bvh, const sp_ray *ray, bool any)
{
    sp_ray_search search = sp_ray_search_start(ray, any);
    sp_line line;
    pending stack[SP_BVH_STACK];
    int height = 1;
    double farthest = 0;
    if (!sp_line_start(&line, ray))
        return search.best;
    stack[0] = (pending){0, search.t_min};
    for (int axis = 0; axis < 3; axis++)
        farthest = sp_greater(
            farthest, sp_greater(fabs(bvh->low[axis] - line.origin[axis]), fabs(bvh->high[axis] - line.origin[axis])));
    while (height > 0 && !sp_ray_search_done(&search)) {
        pending at = stack[--height];
        if (at.from > search.limit)
            continue;
        if (at.node & SP_BVH_LEAF) {
            test_block(bvh, &line, &bvh->blocks[at.node - SP_BVH_LEAF], &search);
            continue;
        }
        const sp_bvh_node *node = &bvh->nodes[at.node];
        for (uint32_t i = 0; i < node->count; i++) {
            double low[3], high[3], from = at.from;
            sp_bvh_child_box(bvh, node, i, low, high);
            if (enter(&line, low, high, SP_LINE_MARGIN * farthest, &from, search.limit))
                stack[height++] = (pending){node->child[i], from};
        }
    }
    return search.best;
}

bool sp_bvh_line_begin(const sp_bvh *bvh, const sp_ray *ray, double place[3], double *start)
{
    sp_line line;
    double farthest = 0;
    *start = ray->t_min;
    if (!sp_line_start(&line, ray))
        return false;
    for (int axis = 0; axis < 3; axis++)
        farthest = sp_greater(farthest, fabs(line.origin[axis] - bvh->centre[axis]) * bvh->scale);
    if (!enter(&line, bvh->low, bvh->high, 0x1p-6 / bvh->scale + SP_LINE_MARGIN * farthest / bvh->scale, start,
               ray->t_max))
        return false;
    for (int axis = 0; axis < 3; axis++)
        place[axis] = farthest <= FAR
                          ? (line.origin[axis] - bvh->centre[axis] + *start * line.velocity[axis]) * bvh->scale
                          : INFINITY;
    return true;
}

static void ask(const sp_bvh *bvh, sp_line_flight *flight, uint32_t triangle)
{
    sp_corners corners;
    sp_bvh_corners(bvh, triangle, corners);
    sp_line_test(&flight->line, (const double(*)[3])corners, triangle, &flight->search);
}

void sp_line_flight_settle(const sp_line_queue *queue, sp_line_flight *flight, uint32_t triangle)
{
    const sp_ray *ray = &queue->rays[flight->ray.number];
    const sp_ray_search *search = &flight->search;
    if (!flight->in_doubt) {
        sp_line_start(&flight->line, ray);
        flight->search = sp_ray_search_start(ray, !queue->hits);
    }
    flight->in_doubt = true;
    ask(queue->bvh, flight, triangle);
    if (flight->triangle != SP_NONE)
        ask(queue->bvh, flight, flight->triangle);
    if (search->best.triangle == SP_NONE)
        return;
    float way = (float)((search->limit - flight->ray.start) * flight->ray.rate);
    flight->triangle = search->best.triangle;
    flight->low = way - SP_BVH_PAD;
    flight->ray.last = sp_lesser(flight->ray.last, way + SP_BVH_PAD);
}

sp_hit sp_bvh_line_ask(const sp_bvh *bvh, const sp_ray *ray, uint32_t triangle)
{
    sp_ray_search search = sp_ray_search_start(ray, false);
    sp_line line;
    sp_corners corners;
    if (sp_line_start(&line, ray)) {
        sp_bvh_corners(bvh, triangle, corners);
        sp_line_test(&line, (const double(*)[3])corners, triangle, &search);
    }
    return search.best;
}

void sp_bvh_trace_lines(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays,
                        const sp_direction_entry *order, size_t count, sp_hit *hits, bool *occluded)
{
    static void (*const together[])(sp_line_queue *) = SP_KERNELS(sp_bvh_lines);
    static void (*const single[])(sp_line_queue *) = SP_KERNELS(sp_bvh_lines_single);
    assert(hits || occluded || count == 0);
    sp_line_queue queue = {
        .bvh = bvh, .rays = rays, .order = order, .count = count, .hits = hits, .occluded = occluded};
    for (size_t i = 0; bvh->node_count == 0 && i < count; i++) {
        if (hits)
            hits[i] = (sp_hit){INFINITY, 0, 0, SP_NONE};
        else
            occluded[i] = false;
    }
    if (bvh->node_count > 0)
        (count < FEW ? single : together)[instructions](&queue);
}
