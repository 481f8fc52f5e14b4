#include "trace/parabola/parabola_bvh.h"

enum { LEAST_TOGETHER = 4 }; /* fewer flights are prepared one by one */

/* A walk in double precision, for whatever the fast one does not take. */
typedef struct {
    uint32_t child;
    double from, to; /* s */
} pending;

static void test_block(const sp_parabola *flight, const sp_bvh *bvh, const sp_bvh_block *block, sp_ray_search *search)
{
    for (int i = 0; i < SP_BVH_WIDTH && block->triangle[i] != SP_NONE; i++) {
        sp_corners corners;
        sp_bvh_corners(bvh, block->triangle[i], corners);
        sp_parabola_test(flight, (const double(*)[3])corners, block->triangle[i], search);
    }
}

static void walk(const sp_parabola *flight, const sp_bvh *bvh, double from, double to, sp_ray_search *search)
{
    pending stack[SP_BVH_STACK];
    int height = 1;
    stack[0] = (pending){0, from, to};
    double margin = sp_parabola_margin(flight, sp_greater(fabs(from), fabs(to)));
    while (height > 0 && !sp_ray_search_done(search)) {
        pending at = stack[--height];
        if (at.from > search->limit)
            continue;
        if (at.child & SP_BVH_LEAF) {
            test_block(flight, bvh, &bvh->blocks[at.child - SP_BVH_LEAF], search);
            continue;
        }
        const sp_bvh_node *node = &bvh->nodes[at.child];
        for (uint32_t i = 0; i < node->count; i++) {
            double low[3], high[3];
            pending child = {node->child[i], at.from, at.to};
            bool passes = true;
            sp_bvh_child_box(bvh, node, i, low, high);
            for (int axis = 0; passes && axis < 3; axis++)
                passes = sp_parabola_cut(flight, axis, low[axis] - margin, high[axis] + margin, &child.from, &child.to);
            if (passes)
                stack[height++] = child;
        }
    }
}

/* When a coordinate next turns after `from`; `to` if none does before. */
static double next_turn(const sp_bvh_jet *jet, double from, double to)
{
    for (int k = 0; k < 3; k++) {
        const sp_bvh_course *c = &jet->course[k];
        double turn = c->pull != 0 ? -c->speed / c->pull : from;
        if (turn > from && turn < to)
            to = turn;
    }
    return to;
}

static void search_far(const sp_bvh_jets *jets, sp_bvh_jet *jet)
{
    const sp_bvh *bvh = jets->bvh;
    sp_parabola *p = &jet->parabola;
    sp_ray_search *search = &jet->search;
    if (!sp_parabola_start(p, jet->asked, jets->pull, bvh->low, bvh->high) || !sp_parabola_limit(p, search))
        return;
    double from = search->t_min, last = search->limit;
    while (from <= sp_lesser(last, search->limit) && !sp_ray_search_done(search)) {
        double to = sp_parabola_turn(p, from, last);
        walk(p, bvh, from, sp_lesser(to, search->limit), search);
        if (to == last)
            break;
        from = to;
    }
    jet->triangle = search->best.triangle;
}

static void ask(const sp_bvh_jets *jets, sp_bvh_jet *jet, uint32_t triangle)
{
    sp_corners corners;
    if (!jet->parabola_ready) /* its numbers are finite, or it would not be here */
        sp_parabola_start(&jet->parabola, jet->asked, jets->pull, jets->bvh->low, jets->bvh->high);
    jet->parabola_ready = true;
    sp_bvh_corners(jets->bvh, triangle, corners);
    sp_parabola_test(&jet->parabola, (const double(*)[3])corners, triangle, &jet->search);
}

/* Where the search's limit is along the piece. */
static inline float limit_way(const sp_bvh_jet *jet)
{
    return (float)((jet->search.limit - jet->arc.start) * jet->arc.rate);
}

void sp_bvh_jet_settle(const sp_bvh_jets *jets, sp_bvh_jet *jet, uint32_t triangle)
{
    ask(jets, jet, triangle);
    if (jet->triangle != SP_NONE)
        ask(jets, jet, jet->triangle);
    if (jet->search.best.triangle == SP_NONE)
        return;
    float way = limit_way(jet);
    jet->triangle = jet->search.best.triangle;
    jet->low = way - SP_BVH_PAD;
    jet->arc.last = way + SP_BVH_PAD < jet->arc.last ? way + SP_BVH_PAD : jet->arc.last;
}

static inline void visit_root(sp_bvh_jet *jet)
{
    jet->height = 1;
    jet->child[0] = 0;
    jet->from[0] = jet->until[0] = 0;
}

/* Makes the first piece from `from` on ready that is in the box; false where there is none before the search's limit.
 */
static bool begin_piece(const sp_bvh_jets *jets, sp_bvh_jet *jet, double from)
{
    if (!jet->course_ready) {
        double first = from, last = jet->last;
        sp_bvh_jet_prepare(jets->bvh, jets->pull, jet, &first, &last);
        jet->course_ready = true;
    }
    jet->later = true;
    while (jet->later && from <= sp_lesser(jet->last, jet->search.limit)) {
        jet->to = next_turn(jet, from, jet->last);
        jet->later = jet->to < jet->last;
        sp_bvh_fitness fitness = sp_bvh_arc_prepare(jets->pull, jet, from, sp_lesser(jet->to, jet->search.limit));
        if (fitness == SP_BVH_FAR) {
            jet->later = false;
            search_far(jets, jet);
        } else if (fitness == SP_BVH_READY) {
            visit_root(jet);
            if (jet->triangle != SP_NONE)
                jet->low = limit_way(jet) - SP_BVH_PAD;
            return true;
        }
        from = jet->to;
    }
    return false;
}

static void set_out(const sp_bvh_jets *jets, uint32_t number, sp_bvh_jet *jet)
{
    jet->asked = &jets->rays[number];
    jet->number = number;
    jet->search = sp_ray_search_start(jet->asked, !jets->hits);
    jet->parabola_ready = jet->course_ready = jet->ending = false;
    jet->triangle = SP_NONE;
    jet->low = INFINITY;
}

/* False where there is nothing to visit. */
static bool begin(const sp_bvh_jets *jets, uint32_t number, sp_bvh_jet *jet)
{
    set_out(jets, number, jet);
    if (jets->bvh->node_count == 0)
        return false;
    double from = jet->search.t_min;
    jet->last = jet->search.limit;
    jet->course_ready = true;
    sp_bvh_fitness fitness = sp_bvh_jet_prepare(jets->bvh, jets->pull, jet, &from, &jet->last);
    if (fitness == SP_BVH_FAR)
        search_far(jets, jet);
    return fitness == SP_BVH_READY && begin_piece(jets, jet, from);
}

/* Likewise, for the next of those that are prepared. */
static bool begin_prepared(sp_bvh_jets *jets, sp_bvh_jet *jet)
{
    sp_bvh_starts *s = &jets->starts;
    int i = s->next++;
    if (s->fits[i] == SP_BVH_FAR)
        return begin(jets, s->ray[i], jet);
    set_out(jets, s->ray[i], jet);
    if (s->fits[i] == SP_BVH_NOWHERE)
        return false;
    sp_bvh_start_take(jets, i, &jet->arc);
    jet->later = s->later[i];
    jet->to = s->to[i];
    jet->last = s->end[i];
    visit_root(jet);
    return true;
}

static void prepare_starts(sp_bvh_jets *jets)
{
    sp_bvh_starts *s = &jets->starts;
    for (s->count = 0; s->count < SP_BVH_STARTS && jets->next < jets->count; s->count++)
        s->ray[s->count] = jets->order[jets->next++];
    s->next = 0;
    jets->prepare(jets, s);
}

/* Whether double precision has decided about the best. */
static inline bool is_exact(const sp_bvh_jet *jet)
{
    return jet->triangle == jet->search.best.triangle;
}

bool sp_bvh_jet_go_on(const sp_bvh_jets *jets, sp_bvh_jet *jet)
{
    /* What was surely hit was so within the last piece. */
    if (is_exact(jet) && jet->later && !sp_ray_search_done(&jet->search) && begin_piece(jets, jet, jet->to))
        return true;
    if (is_exact(jet) || jet->ending || jet->search.any)
        return false;
    jet->ending = true;
    jet->height = 0;
    sp_bvh_fetch_corners(jets->bvh, jet->triangle);
    return true;
}

void sp_bvh_jets_end(sp_bvh_jets *jets, sp_bvh_jet *jet)
{
    sp_parabola_pairs *pairs = &jets->pairs;
    if (!jets->hits) {
        jets->occluded[jet->number] = jet->triangle != SP_NONE;
    } else if (is_exact(jet)) {
        jets->hits[jet->number] = jet->search.best;
    } else {
        pairs->ray[pairs->count] = jet->number;
        pairs->triangle[pairs->count++] = jet->triangle;
        if (pairs->count < SP_PARABOLA_HITS)
            return;
        jets->compute(pairs, jets->hits);
        pairs->count = 0;
    }
}

bool sp_bvh_jets_begin(sp_bvh_jets *jets, sp_bvh_jet *jet)
{
    const sp_bvh_starts *s = &jets->starts;
    for (;;) {
        if (s->next == s->count && jets->aligned && jets->count - jets->next >= LEAST_TOGETHER)
            prepare_starts(jets);
        if (s->next < s->count) {
            if (begin_prepared(jets, jet))
                return true;
        } else if (jets->next == jets->count) {
            return false;
        } else if (begin(jets, jets->order[jets->next++], jet)) {
            return true;
        }
        sp_bvh_jets_end(jets, jet);
    }
}

static void (*const prepares[])(const sp_bvh_jets *, sp_bvh_starts *) = SP_KERNELS(sp_bvh_prepare_starts);
static void (*const kernels[])(sp_bvh_jets *, sp_bvh_jet *, int) = SP_KERNELS(sp_bvh_parabolas);
static void (*const computes[])(const sp_parabola_pairs *, sp_hit *) = SP_KERNELS(sp_parabola_hits);

void sp_bvh_trace_parabolas(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, const uint32_t *order,
                            size_t count, const sp_pull *pull, sp_hit *hits, bool *occluded)
{
    sp_bvh_jets jets;
    jets.bvh = jets.pairs.bvh = bvh;
    jets.pull = jets.pairs.pull = pull;
    jets.rays = jets.pairs.rays = rays;
    jets.order = order;
    jets.count = count;
    jets.next = 0;
    jets.hits = hits;
    jets.occluded = occluded;
    jets.prepare = prepares[instructions];
    jets.compute = computes[instructions];
    jets.aligned = bvh->node_count > 0 && sp_bvh_order_axes(pull, jets.axis);
    jets.starts.count = jets.starts.next = jets.pairs.count = 0;
    sp_bvh_jet flights[SP_BVH_JETS];
    kernels[instructions](&jets, flights, SP_BVH_JETS);
    if (jets.pairs.count)
        jets.compute(&jets.pairs, hits);
}
