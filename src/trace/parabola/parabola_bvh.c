#include "trace/parabola/parabola_bvh.h"

#include <assert.h>

enum { LEAST_TOGETHER = 4 }; /* fewer flights are prepared one by one */

/* A walk in double precision, for whatever the fast one does not take. */
typedef struct {
    uint32_t child;
    double from, to; /* s */
} pending;

static void test_block(const sp_parabola *parabola, const sp_bvh *bvh, const sp_bvh_block *block, sp_ray_search *search)
{
    for (int i = 0; i < SP_BVH_WIDTH && block->triangle[i] != SP_NONE; i++) {
        sp_corners corners;
        sp_bvh_corners(bvh, block->triangle[i], corners);
        sp_parabola_test(parabola, (const double(*)[3])corners, block->triangle[i], search);
    }
}

static void walk(const sp_parabola *parabola, const sp_bvh *bvh, double from, double to, sp_ray_search *search)
{
    pending stack[SP_BVH_STACK];
    int height = 1;
    stack[0] = (pending){0, from, to};
    double margin = sp_parabola_margin(parabola, sp_greater(fabs(from), fabs(to)));
    while (height > 0 && !sp_ray_search_done(search)) {
        pending at = stack[--height];
        if (at.from > search->limit)
            continue;
        if (at.child & SP_BVH_LEAF) {
            test_block(parabola, bvh, &bvh->blocks[at.child - SP_BVH_LEAF], search);
            continue;
        }
        const sp_bvh_node *node = &bvh->nodes[at.child];
        for (uint32_t i = 0; i < node->count; i++) {
            double low[3], high[3];
            pending child = {node->child[i], at.from, at.to};
            bool passes = true;
            sp_bvh_child_box(bvh, node, i, low, high);
            for (int axis = 0; passes && axis < 3; axis++)
                passes =
                    sp_parabola_cut(parabola, axis, low[axis] - margin, high[axis] + margin, &child.from, &child.to);
            if (passes)
                stack[height++] = child;
        }
    }
}

/* When a coordinate next turns after `from`; `to` if none does before. */
static double next_turn(const sp_parabola_flight *flight, double from, double to)
{
    for (int k = 0; k < 3; k++) {
        const sp_bvh_course *c = &flight->course[k];
        double turn = c->acceleration != 0 ? -c->speed / c->acceleration : from;
        if (turn > from && turn < to)
            to = turn;
    }
    return to;
}

static void search_far(const sp_parabola_queue *queue, sp_parabola_flight *flight)
{
    const sp_bvh *bvh = queue->bvh;
    sp_parabola *p = &flight->parabola;
    sp_ray_search *search = &flight->search;
    if (!sp_parabola_start(p, flight->asked, queue->acceleration, bvh->low, bvh->high) || !sp_parabola_limit(p, search))
        return;
    double from = search->t_min, last = search->limit;
    while (from <= sp_lesser(last, search->limit) && !sp_ray_search_done(search)) {
        double to = sp_parabola_turn(p, from, last);
        walk(p, bvh, from, sp_lesser(to, search->limit), search);
        if (to == last)
            break;
        from = to;
    }
    flight->triangle = search->best.triangle;
}

static void ask(const sp_parabola_queue *queue, sp_parabola_flight *flight, uint32_t triangle)
{
    sp_corners corners;
    if (!flight->parabola_ready) /* its numbers are finite, or it would not be here */
        sp_parabola_start(&flight->parabola, flight->asked, queue->acceleration, queue->bvh->low, queue->bvh->high);
    flight->parabola_ready = true;
    sp_bvh_corners(queue->bvh, triangle, corners);
    sp_parabola_test(&flight->parabola, (const double(*)[3])corners, triangle, &flight->search);
}

/* Where the search's limit is along the piece. */
static inline float limit_way(const sp_parabola_flight *flight)
{
    return (float)((flight->search.limit - flight->arc.start) * flight->arc.rate);
}

void sp_parabola_flight_settle(const sp_parabola_queue *queue, sp_parabola_flight *flight, uint32_t triangle)
{
    ask(queue, flight, triangle);
    if (flight->triangle != SP_NONE)
        ask(queue, flight, flight->triangle);
    if (flight->search.best.triangle == SP_NONE)
        return;
    float way = limit_way(flight);
    flight->triangle = flight->search.best.triangle;
    flight->low = way - SP_BVH_PAD;
    flight->arc.last = way + SP_BVH_PAD < flight->arc.last ? way + SP_BVH_PAD : flight->arc.last;
}

static inline void visit_root(sp_parabola_flight *flight)
{
    flight->height = 1;
    flight->child[0] = 0;
    flight->from[0] = flight->until[0] = 0;
}

/* Makes the first piece from `from` on ready that is in the box; false where there is none before the search's limit.
 */
static bool begin_piece(const sp_parabola_queue *queue, sp_parabola_flight *flight, double from)
{
    if (!flight->course_ready) {
        double first = from, last = flight->last;
        sp_parabola_flight_prepare(queue->bvh, queue->acceleration, flight, &first, &last);
        flight->course_ready = true;
    }
    flight->later = true;
    while (flight->later && from <= sp_lesser(flight->last, flight->search.limit)) {
        flight->to = next_turn(flight, from, flight->last);
        flight->later = flight->to < flight->last;
        sp_bvh_fitness fitness =
            sp_bvh_arc_prepare(queue->acceleration, flight, from, sp_lesser(flight->to, flight->search.limit));
        if (fitness == SP_BVH_FAR) {
            flight->later = false;
            search_far(queue, flight);
        } else if (fitness == SP_BVH_READY) {
            visit_root(flight);
            if (flight->triangle != SP_NONE)
                flight->low = limit_way(flight) - SP_BVH_PAD;
            return true;
        }
        from = flight->to;
    }
    return false;
}

static void set_out(const sp_parabola_queue *queue, uint32_t number, sp_parabola_flight *flight)
{
    flight->asked = &queue->rays[number];
    flight->number = number;
    flight->search = sp_ray_search_start(flight->asked, !queue->hits);
    flight->parabola_ready = flight->course_ready = flight->ending = false;
    flight->triangle = SP_NONE;
    flight->low = INFINITY;
}

/* False where there is nothing to visit. */
static bool begin(const sp_parabola_queue *queue, uint32_t number, sp_parabola_flight *flight)
{
    set_out(queue, number, flight);
    if (queue->bvh->node_count == 0)
        return false;
    double from = flight->search.t_min;
    flight->last = flight->search.limit;
    flight->course_ready = true;
    sp_bvh_fitness fitness = sp_parabola_flight_prepare(queue->bvh, queue->acceleration, flight, &from, &flight->last);
    if (fitness == SP_BVH_FAR)
        search_far(queue, flight);
    return fitness == SP_BVH_READY && begin_piece(queue, flight, from);
}

/* Likewise, for the next of those that are prepared. */
static bool begin_prepared(sp_parabola_queue *queue, sp_parabola_flight *flight)
{
    sp_bvh_starts *s = &queue->starts;
    int i = s->next++;
    if (s->fits[i] == SP_BVH_FAR)
        return begin(queue, s->ray[i], flight);
    set_out(queue, s->ray[i], flight);
    if (s->fits[i] == SP_BVH_NOWHERE)
        return false;
    sp_bvh_start_take(queue, i, &flight->arc);
    flight->later = s->later[i];
    flight->to = s->to[i];
    flight->last = s->end[i];
    visit_root(flight);
    return true;
}

static void prepare_starts(sp_parabola_queue *queue)
{
    sp_bvh_starts *s = &queue->starts;
    for (s->count = 0; s->count < SP_BVH_STARTS && queue->next < queue->count; s->count++)
        s->ray[s->count] = queue->order[queue->next++];
    s->next = 0;
    queue->prepare(queue, s);
}

/* Whether double precision has decided about the best. */
static inline bool is_exact(const sp_parabola_flight *flight)
{
    return flight->triangle == flight->search.best.triangle;
}

bool sp_parabola_flight_go_on(const sp_parabola_queue *queue, sp_parabola_flight *flight)
{
    /* What was surely hit was so within the last piece. */
    if (is_exact(flight) && flight->later && !sp_ray_search_done(&flight->search) &&
        begin_piece(queue, flight, flight->to))
        return true;
    if (is_exact(flight) || flight->ending || flight->search.any)
        return false;
    flight->ending = true;
    flight->height = 0;
    sp_bvh_prefetch_corners(queue->bvh, flight->triangle);
    return true;
}

void sp_parabola_queue_end(sp_parabola_queue *queue, sp_parabola_flight *flight)
{
    sp_parabola_pairs *pairs = &queue->pairs;
    if (!queue->hits) {
        queue->occluded[flight->number] = flight->triangle != SP_NONE;
    } else if (is_exact(flight)) {
        queue->hits[flight->number] = flight->search.best;
    } else {
        pairs->ray[pairs->count] = flight->number;
        pairs->triangle[pairs->count++] = flight->triangle;
        if (pairs->count < SP_PARABOLA_HITS)
            return;
        queue->compute(pairs, queue->hits);
        pairs->count = 0;
    }
}

bool sp_parabola_queue_begin(sp_parabola_queue *queue, sp_parabola_flight *flight)
{
    const sp_bvh_starts *s = &queue->starts;
    for (;;) {
        if (s->next == s->count && queue->aligned && queue->count - queue->next >= LEAST_TOGETHER)
            prepare_starts(queue);
        if (s->next < s->count) {
            if (begin_prepared(queue, flight))
                return true;
        } else if (queue->next == queue->count) {
            return false;
        } else if (begin(queue, queue->order[queue->next++], flight)) {
            return true;
        }
        sp_parabola_queue_end(queue, flight);
    }
}

static void (*const prepares[])(const sp_parabola_queue *, sp_bvh_starts *) = SP_KERNELS(sp_bvh_prepare_starts);
static void (*const kernels[])(sp_parabola_queue *, sp_parabola_flight *, int) = SP_KERNELS(sp_bvh_parabolas);
static void (*const computes[])(const sp_parabola_pairs *, sp_hit *) = SP_KERNELS(sp_parabola_hits);

void sp_bvh_trace_parabolas(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, const uint32_t *order,
                            size_t count, const sp_acceleration *acceleration, sp_hit *hits, bool *occluded)
{
    sp_parabola_queue queue;
    assert(acceleration->strength != 0 && (hits || occluded || count == 0));
    queue.bvh = queue.pairs.bvh = bvh;
    queue.acceleration = queue.pairs.acceleration = acceleration;
    queue.rays = queue.pairs.rays = rays;
    queue.order = order;
    queue.count = count;
    queue.next = 0;
    queue.hits = hits;
    queue.occluded = occluded;
    queue.prepare = prepares[instructions];
    queue.compute = computes[instructions];
    queue.aligned = bvh->node_count > 0 && sp_bvh_order_axes(acceleration, queue.axis);
    queue.starts.count = queue.starts.next = queue.pairs.count = 0;
    sp_parabola_flight flights[SP_PARABOLA_FLIGHTS];
    kernels[instructions](&queue, flights, SP_PARABOLA_FLIGHTS);
    if (queue.pairs.count)
        queue.compute(&queue.pairs, hits);
}
