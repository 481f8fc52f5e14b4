#include "trace/parabola_bvh.h"

/* Coordinates in the hierarchy's space up to which the fast walk goes: some more than the boxes with their padding. */
#define LIMIT (1 + 0x1p-6)
/* What positions may be summed from, in that space: 2^18 SP_PARABOLA_ROUNDING is 4 units of single precision at 1. */
#define SUMMED 0x1p18

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
    pending stack[SP_BVH_STACK] = {{0, from, to}};
    int height = 1;
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

/* False where the flight hits nothing. */
static bool make_ready(sp_bvh_jet *jet)
{
    if (!jet->ready) {
        jet->ready = true;
        if (sp_parabola_start(&jet->parabola, jet->ray, jet->pull, jet->bvh->low, jet->bvh->high))
            sp_parabola_limit(&jet->parabola, jet->search);
        else
            jet->search->limit = -INFINITY;
    }
    return jet->search->limit > -INFINITY;
}

void sp_bvh_jet_test(sp_bvh_jet *jet, uint32_t triangle)
{
    sp_corners corners;
    if (triangle == jet->search->skip || !make_ready(jet))
        return;
    sp_bvh_corners(jet->bvh, triangle, corners);
    sp_parabola_test(&jet->parabola, (const double(*)[3])corners, triangle, jet->search);
}

/* One coordinate of a flight in the hierarchy's space: place + t (speed + t pull/2). */
typedef struct {
    double place, speed, pull;
    double sign; /* of its motion in a piece */
} course;

static inline double course_at(const course *c, double t)
{
    return c->place + t * (c->speed + 0.5 * t * c->pull);
}

/* When it is `way` away from its place, moving as in the piece; never: not finite. */
static double time_of(const course *c, double way)
{
    if (c->pull == 0)
        return way / c->speed;
    double square = c->speed * c->speed + 2 * c->pull * way;
    if (!(square > 0))
        return INFINITY;
    double speed = c->sign * sqrt(square);
    return speed * c->speed > 0 ? 2 * way / (speed + c->speed) : (speed - c->speed) / c->pull;
}

/* Cuts the piece to when the coordinate is within ±LIMIT. */
static bool cut(course *c, double *from, double *to)
{
    double speed = c->speed;
    if (c->pull != 0) /* in the middle: at its ends it may be turning */
        speed = *to < INFINITY ? c->speed + 0.5 * c->pull * (*from + *to) : c->pull;
    c->sign = speed < 0 ? -1 : 1;
    double first = c->sign * course_at(c, *from);
    if (!(first <= LIMIT))
        return false;
    if (first < -LIMIT)
        *from = sp_greater(*from, c->pull == 0 && c->speed == 0 ? INFINITY : time_of(c, -c->sign * LIMIT - c->place));
    if (c->pull != 0 || c->speed != 0)
        *to = sp_lesser(*to, time_of(c, c->sign * LIMIT - c->place));
    return *from <= *to;
}

/* Fills what of the arc is about the axis at this place in its order. */
static void set_axis(sp_bvh_arc *arc, int i, double last)
{
    int axis = arc->axis[i];
    double slope = arc->direction[axis] + arc->bend[axis] * last;
    double way = fabs(slope) > 0x1p-60 ? 1 / fabs(slope) : 0x1p60; /* per unit along the axis */
    bool rises = slope > 0;
    /* Halfway the flight is away from the chord by this: all on one side. */
    double off = -0.25 * arc->bend[axis] * last * last, ahead = rises ? off : -off;
    double most = sp_greater(ahead, 0), least = sp_lesser(ahead, 0);
    arc->near[i] = (uint32_t)(8 * axis + (rises ? 0 : 24));
    arc->inverse[i] = (float)(rises ? way : -way);
    arc->sooner[i] = (float)(arc->origin[axis] + (rises ? most : -most));
    arc->later[i] = (float)((most - least) * way);
    if (i == 0) { /* along the motion, from the origin */
        arc->sign = rises ? 1 : -1;
        arc->inverse[0] = (float)way;
        arc->sooner[0] = (float)(-most * way);
        arc->later[0] = (float)(-least * way);
    }
}

static float way_of(const sp_bvh_arc *arc, double t, double margin)
{
    return (float)sp_lesser(sp_greater((t - arc->start) * arc->rate + margin, -64), 64);
}

int sp_bvh_arc_prepare(sp_bvh_arc *arc, const sp_bvh *bvh, const sp_ray *ray, const sp_pull *pull, double from,
                       double to)
{
    course c[3];
    double origin[3], velocity[3], farthest = 1, speed = 0, rate = 0, strength = pull->strength * bvh->scale;
    double t_min = from, t_max = to;
    sp_to_array(ray->origin, origin);
    sp_to_array(ray->velocity, velocity);
    for (int k = 0; k < 3; k++) {
        c[k] = (course){(origin[k] - bvh->centre[k]) * bvh->scale, velocity[k] * bvh->scale,
                        pull->vector[k] * bvh->scale, 0};
        farthest = sp_greater(farthest, fabs(c[k].place));
        speed = sp_greater(speed, fabs(c[k].speed));
    }
    if (!(farthest <= SUMMED))
        return -1;
    for (int k = 0; k < 3; k++)
        if (!cut(&c[k], &from, &to))
            return isnan(from + to) ? -1 : 0;
    double latest = sp_greater(fabs(from), fabs(to));
    if (!(2 * (farthest + latest * (speed + 0.5 * latest * strength)) <= SUMMED))
        return -1;
    for (int k = 0; k < 3; k++)
        rate = sp_greater(rate, sp_greater(fabs(c[k].speed + from * c[k].pull), fabs(c[k].speed + to * c[k].pull)));
    double span = 1 / rate, last = (to - from) * rate;
    if (!(rate > 1e-100 && rate < 1e100 && last <= 4.5))
        return -1;
    arc->start = from;
    arc->rate = rate;
    arc->axis[0] = fabs(c[0].pull) > fabs(c[1].pull) ? 0 : 1;
    arc->axis[0] = fabs(c[2].pull) > fabs(c[arc->axis[0]].pull) ? 2 : arc->axis[0];
    arc->axis[1] = (arc->axis[0] + 1) % 3;
    arc->axis[2] = (arc->axis[0] + 2) % 3;
    for (int k = 0; k < 3; k++) {
        arc->origin[k] = (float)course_at(&c[k], from);
        arc->direction[k] = (float)((c[k].speed + from * c[k].pull) * span);
        arc->bend[k] = (float)(0.5 * c[k].pull * span * span);
    }
    for (int i = 0; i < 3; i++)
        set_axis(arc, i, last);
    arc->last = (float)(last + 0x1p-21);
    arc->surely_first = way_of(arc, t_min, 4 * SP_BVH_PAD);
    arc->surely_last = way_of(arc, t_max, -4 * SP_BVH_PAD);
    return 1;
}

/* When a coordinate next turns after `from`; `to` if none does before. */
static double next_turn(const sp_ray *ray, const sp_pull *pull, double from, double to)
{
    double velocity[3];
    sp_to_array(ray->velocity, velocity);
    for (int k = 0; k < 3; k++) {
        double turn = pull->vector[k] != 0 ? -velocity[k] / pull->vector[k] : from;
        if (turn > from && turn < to)
            to = turn;
    }
    return to;
}

static void search_piece(sp_bvh_jet *jet, double from, double to, sp_instructions instructions)
{
    static void (*const kernels[])(sp_bvh_jet *) = {sp_bvh_parabola_portable, sp_bvh_parabola_avx2,
                                                    sp_bvh_parabola_avx512};
    int prepared = sp_bvh_arc_prepare(&jet->arc, jet->bvh, jet->ray, jet->pull, from, to);
    if (prepared > 0)
        kernels[instructions](jet);
    else if (prepared < 0 && make_ready(jet))
        walk(&jet->parabola, jet->bvh, sp_greater(from, jet->parabola.first), sp_lesser(to, jet->parabola.last),
             jet->search);
}

void sp_parabola_search_bvh(const sp_bvh *bvh, const sp_ray *ray, const sp_pull *pull, sp_instructions instructions,
                            sp_search *search)
{
    sp_bvh_jet jet;
    if (bvh->node_count == 0)
        return;
    jet.bvh = bvh;
    jet.ray = ray;
    jet.pull = pull;
    jet.search = search;
    jet.ready = false;
    double from = ray->t_min, last = search->limit;
    while (from <= sp_lesser(last, search->limit) && !sp_search_done(search)) {
        double to = next_turn(ray, pull, from, last);
        search_piece(&jet, from, sp_lesser(to, search->limit), instructions);
        if (!(to > from && to < last))
            return;
        from = to;
    }
}
