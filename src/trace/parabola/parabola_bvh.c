#include "trace/parabola/parabola_bvh.h"

enum { LEAST_TOGETHER = 4 }; /* fewer flights are prepared one by one */

/* A walk in double precision, for whatever the fast one does not take. */
typedef struct {
    uint32_t child;
    double from, to; /* s */
} pending;

static void test_block(const sp_parabola *flight, const sp_bvh *bvh, const sp_bvh_block *block, sp_search *search)
{
    for (int i = 0; i < SP_BVH_WIDTH && block->triangle[i] != SP_NONE; i++) {
        sp_corners corners;
        sp_bvh_corners(bvh, block->triangle[i], corners);
        sp_parabola_test(flight, (const double(*)[3])corners, block->triangle[i], search);
    }
}

static void walk(const sp_parabola *flight, const sp_bvh *bvh, double from, double to, sp_search *search)
{
    pending stack[SP_BVH_STACK];
    int height = 1;
    stack[0] = (pending){0, from, to};
    double margin = sp_parabola_margin(flight, sp_greater(fabs(from), fabs(to)));
    while (height > 0 && !sp_search_done(search)) {
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

static inline double course_at(const sp_bvh_course *c, double t)
{
    return c->place + t * (c->speed + 0.5 * t * c->pull);
}

/* Cuts the span to when a coordinate without gravity is within ±SP_BVH_LIMIT. */
static inline void cut_straight(const sp_bvh_course *c, double *from, double *to)
{
    double way = c->speed < 0 ? -c->place : c->place, inverse = fabs(c->inverse);
    /* Where the speed is 0 these are infinite, or no numbers, which change nothing. */
    double leave = (SP_BVH_LIMIT - way) * inverse, enter = (-SP_BVH_LIMIT - way) * inverse;
    *to = sp_lesser(leave, *to);
    *from = sp_greater(enter, *from);
}

/* When a coordinate with gravity is `way` away from its place, moving with that sign; infinite for never. */
static double time_of(const sp_bvh_course *c, double way, double sign)
{
    double square = c->speed * c->speed + 2 * c->pull * way;
    if (!(square > 0))
        return INFINITY;
    double speed = sign * sqrt(square);
    return speed * c->speed > 0 ? 2 * way / (speed + c->speed) : (speed - c->speed) / c->pull;
}

/* Likewise for a coordinate with gravity, which does not turn in the span. */
static inline bool cut_curved(const sp_bvh_course *c, double *from, double *to)
{
    /* in the middle: at its ends it may be turning */
    double middle = *to < INFINITY ? c->speed + 0.5 * c->pull * (*from + *to) : c->pull, sign = middle < 0 ? -1 : 1;
    double first = sign * course_at(c, *from);
    if (!(first <= SP_BVH_LIMIT))
        return false;
    if (first < -SP_BVH_LIMIT)
        *from = sp_greater(*from, time_of(c, -sign * SP_BVH_LIMIT - c->place, sign));
    if (!(sign * course_at(c, *to) <= SP_BVH_LIMIT))
        *to = sp_lesser(*to, time_of(c, sign * SP_BVH_LIMIT - c->place, sign));
    return *from <= *to;
}

sp_bvh_fitness sp_bvh_jet_prepare(const sp_bvh *bvh, const sp_pull *pull, sp_bvh_jet *jet, double *from, double *to)
{
    const double *centre = bvh->centre, scale = bvh->scale;
    double origin[3], velocity[3];
    sp_to_array(jet->asked->origin, origin);
    sp_to_array(jet->asked->velocity, velocity);
    jet->summed = 1;
    jet->speed = 0;
    jet->strength = pull->strength * scale;
    for (int k = 0; k < 3; k++) {
        sp_bvh_course *c = &jet->course[k];
        *c = (sp_bvh_course){(origin[k] - centre[k]) * scale, velocity[k] * scale, pull->vector[k] * scale, 0};
        jet->summed = sp_greater(jet->summed, fabs(c->place));
        jet->speed = sp_greater(jet->speed, fabs(c->speed));
        if (c->pull == 0) {
            c->inverse = 1 / c->speed;
            cut_straight(c, from, to);
        }
    }
    if (!isfinite(jet->speed + jet->strength + origin[0] + origin[1] + origin[2] + velocity[0] + velocity[1] +
                  velocity[2]))
        return SP_BVH_NOWHERE;
    if (!(jet->summed <= SP_BVH_SUMMED))
        return SP_BVH_FAR;
    return *from <= *to ? SP_BVH_READY : SP_BVH_NOWHERE;
}

/* Where in a node the bounds begin that are passed first and last. */
static inline void set_passage(sp_bvh_arc *arc, int i, bool falls)
{
    arc->near[i] = (uint32_t)(8 * arc->axis[i] + (falls ? 24 : 0));
    arc->far[i] = (uint32_t)(8 * arc->axis[i] + (falls ? 0 : 24));
}

/* Fills what of the arc is about the axis at this place in its order, `slope` being the chord's. */
static inline void set_axis(sp_bvh_arc *arc, int i, double slope, double inverse, double last)
{
    int axis = arc->axis[i];
    bool rises = slope > 0;
    double way = fabs(slope) > 0x1p-60 ? fabs(inverse) : 0x1p60; /* per unit along the axis */
    /* Halfway the flight is away from the chord by this: all on one side. */
    double off = -0.25 * arc->bend[axis] * last * last, ahead = rises ? off : -off;
    double most = sp_greater(ahead, 0), least = sp_lesser(ahead, 0);
    set_passage(arc, i, !rises);
    if (i == 0) { /* along the motion, from the origin */
        arc->sign = rises ? 1 : -1;
        arc->inverse[0] = (float)way;
        arc->sooner[0] = (float)(-most * way);
        arc->later[0] = (float)(-least * way);
    } else {
        arc->inverse[i] = (float)(rises ? way : -way);
        arc->sooner[i] = (float)(arc->origin[axis] + (rises ? most : -most));
        arc->later[i] = (float)((most - least) * way);
    }
}

/* The axes in order, gravity's largest component first. True where gravity is along that alone. */
static inline bool order_axes(const sp_pull *pull, int axis[3])
{
    int steep = fabs(pull->down[0]) > fabs(pull->down[1]) ? 0 : 1;
    steep = fabs(pull->down[2]) > fabs(pull->down[steep]) ? 2 : steep;
    axis[0] = steep;
    axis[1] = steep == 2 ? 0 : steep + 1;
    axis[2] = steep == 0 ? 2 : steep - 1;
    return pull->vector[axis[1]] == 0 && pull->vector[axis[2]] == 0;
}

static inline float way_of(const sp_bvh_arc *arc, double t, double margin)
{
    return (float)sp_lesser(sp_greater((t - arc->start) * arc->rate + margin, -64), 64);
}

/* What sp_bvh_arc.diagonal is, falls having bit k where the flight falls along axis k. */
static inline uint32_t diagonal_of(uint32_t falls)
{
    return falls & 1 ? (~falls & 6) | 1 : falls & 6;
}

sp_bvh_fitness sp_bvh_arc_prepare(const sp_pull *pull, sp_bvh_jet *jet, double from, double to)
{
    sp_bvh_arc *arc = &jet->arc;
    double t_min = from, t_max = to, fastest = 0, span;
    for (int k = 0; k < 3; k++)
        if (jet->course[k].pull != 0 && !cut_curved(&jet->course[k], &from, &to))
            return SP_BVH_NOWHERE;
    double latest = sp_greater(fabs(from), fabs(to));
    for (int k = 0; k < 3; k++) {
        const sp_bvh_course *c = &jet->course[k];
        fastest = sp_greater(fastest, sp_greater(fabs(c->speed + from * c->pull), fabs(c->speed + to * c->pull)));
    }
    if (!(2 * (jet->summed + latest * (jet->speed + 0.5 * latest * jet->strength)) <= SP_BVH_SUMMED &&
          (to - from) * fastest <= 4.2 && fastest > 1e-100 && fastest < 1e100))
        return SP_BVH_FAR;
    arc->start = from;
    arc->rate = sp_bvh_power_above(fastest, &span);
    double last = (to - from) * arc->rate;
    arc->aligned = order_axes(pull, arc->axis);
    arc->sag = 0;
    uint32_t falls = 0;
    for (int i = 0; i < 3; i++) {
        int k = arc->axis[i];
        const sp_bvh_course *c = &jet->course[k];
        arc->origin[k] = (float)course_at(c, from);
        arc->direction[k] = (float)((c->speed + from * c->pull) * span);
        arc->bend[k] = (float)(0.5 * c->pull * span * span);
        arc->sag = fabsf(arc->bend[k]) > arc->sag ? fabsf(arc->bend[k]) : arc->sag;
        double slope = (c->speed + 0.5 * c->pull * (from + to)) * span;
        set_axis(arc, i, slope, c->pull == 0 ? c->inverse * arc->rate : 1 / slope, last);
        falls |= (uint32_t) !(slope > 0) << k;
    }
    arc->diagonal = diagonal_of(falls);
    if (!arc->aligned)
        arc->sag *= 2;
    arc->last = (float)(last + 0x1p-20);
    arc->surely_first = way_of(arc, t_min, 4 * SP_BVH_PAD);
    arc->surely_last = way_of(arc, t_max, -4 * SP_BVH_PAD);
    return SP_BVH_READY;
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
    sp_search *search = &jet->search;
    if (!sp_parabola_start(p, jet->asked, jets->pull, bvh->low, bvh->high) || !sp_parabola_limit(p, search))
        return;
    double from = search->t_min, last = search->limit;
    while (from <= sp_lesser(last, search->limit) && !sp_search_done(search)) {
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
    jet->search = sp_search_start(jet->asked, !jets->hits);
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

void sp_bvh_start_take(const sp_bvh_jets *jets, int i, sp_bvh_arc *arc)
{
    const sp_bvh_starts *s = &jets->starts;
    uint32_t falls = 0;
    for (int k = 0; k < 3; k++) {
        int axis = arc->axis[k] = jets->axis[k];
        arc->origin[axis] = s->origin[k][i];
        arc->direction[axis] = s->direction[k][i];
        arc->bend[axis] = k ? 0 : s->bend[i];
        arc->inverse[k] = s->inverse[k][i];
        arc->sooner[k] = k ? s->origin[k][i] : s->sooner[i];
        arc->later[k] = k ? 0 : s->behind[i];
        set_passage(arc, k, s->falls[k][i]);
        falls |= (uint32_t)s->falls[k][i] << axis;
    }
    arc->sign = s->falls[0][i] ? -1 : 1;
    arc->aligned = true;
    arc->sag = fabsf(s->bend[i]);
    arc->last = s->last[i];
    arc->diagonal = diagonal_of(falls);
    arc->surely_first = s->surely_first[i];
    arc->surely_last = s->surely_last[i];
    arc->start = s->start[i];
    arc->rate = s->rate[i];
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
    if (is_exact(jet) && jet->later && !sp_search_done(&jet->search) && begin_piece(jets, jet, jet->to))
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

static void (*const prepares[])(const sp_bvh_jets *, sp_bvh_starts *) = {
    sp_bvh_prepare_starts_portable, sp_bvh_prepare_starts_avx2, sp_bvh_prepare_starts_avx512};
static void (*const kernels[])(sp_bvh_jets *, sp_bvh_jet *, int) = {sp_bvh_parabolas_portable, sp_bvh_parabolas_avx2,
                                                                    sp_bvh_parabolas_avx512};
static void (*const computes[])(const sp_parabola_pairs *, sp_hit *) = {sp_parabola_hits_portable,
                                                                        sp_parabola_hits_avx2, sp_parabola_hits_avx512};

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
    jets.aligned = bvh->node_count > 0 && order_axes(pull, jets.axis);
    jets.starts.count = jets.starts.next = jets.pairs.count = 0;
    sp_bvh_jet flights[SP_BVH_JETS];
    kernels[instructions](&jets, flights, SP_BVH_JETS);
    if (jets.pairs.count)
        jets.compute(&jets.pairs, hits);
}
