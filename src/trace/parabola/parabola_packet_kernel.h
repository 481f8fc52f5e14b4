/* A packet of parabolas through the hierarchy. Included once by each file that is compiled for a set of instructions,
 * with SP_KERNEL(name) naming its functions. */
#include "trace/parabola/pending.h"
#include "trace/bvh/seen.h"
#include "trace/bvh/sheared.h"
#include "trace/parabola/parabola_packet.h"

static inline float inverse_of(float speed, float when_still)
{
    return fabsf(speed) > 0x1p-60f ? 1 / speed : when_still;
}

/* What a packet's node tests have in common. Along an axis without gravity, some parabola can be in low..high at a way
 * w if most w >= low and least w <= high: each bounds w from the one or the other side, as its speed's sign has it. */
typedef struct {
    int axis[3];                      /* steep, and the others */
    float by_low[2], by_high[2];      /* inverse speeds */
    bool low_first[2], high_first[2]; /* bounds from below */
    float sign, bend;                 /* so that bend <= 0 along sign */
    float least, most;                /* speeds along sign */
    float turn;                       /* where the fastest is highest */
} packet_slabs;

static packet_slabs slabs_of(const sp_parabola_packet *v)
{
    packet_slabs s;
    int axis = v->steep;
    s.axis[0] = axis;
    s.axis[1] = axis == 2 ? 0 : axis + 1;
    s.axis[2] = axis == 0 ? 2 : axis - 1;
    for (int i = 0; i < 2; i++) {
        float least = v->least[s.axis[1 + i]], most = v->most[s.axis[1 + i]];
        s.by_low[i] = inverse_of(most, 0x1p60f);
        s.by_high[i] = inverse_of(least, -0x1p60f);
        s.low_first[i] = s.by_low[i] > 0;
        s.high_first[i] = s.by_high[i] < 0;
    }
    s.sign = v->bend < 0 ? 1 : -1;
    s.bend = v->bend * s.sign;
    s.least = s.sign > 0 ? v->least[axis] : -v->most[axis];
    s.most = s.sign > 0 ? v->most[axis] : -v->least[axis];
    s.turn = s.bend < -0x1p-60f ? -0.5f * s.most / s.bend : s.most > 0 ? 0x1p60f : 0;
    return s;
}

/* Which children some parabola may be in, and between which ways.
 *
 * The highest that any is at a way is the parabola of the fastest, the lowest that of the slowest. Between two ways the
 * former is highest where it turns, or at the end next to that, the latter lowest at either end. Rounding as in
 * parabola_kernel.h, with S = 8: 4 e S for the polynomials and less than 8 e R otherwise, less than the boxes' pad. */
static inline uint32_t meet_children(const sp_bvh_node *node, const sp_parabola_packet *v, const packet_slabs *s,
                                     wide *first, wide *last)
{
    wide low, high, from = wide_set(0), to = wide_set(v->farthest);
    for (int i = 0; i < 2; i++) {
        int axis = s->axis[1 + i];
        see_bounds(node, axis, v->origin[axis], &low, &high);
        low = wide_multiply(low, wide_set(s->by_low[i]));
        high = wide_multiply(high, wide_set(s->by_high[i]));
        if (s->low_first[i])
            from = wide_greater(from, low);
        else
            to = wide_lesser(to, low);
        if (s->high_first[i])
            from = wide_greater(from, high);
        else
            to = wide_lesser(to, high);
    }
    see_bounds(node, s->axis[0], v->origin[s->axis[0]], &low, &high);
    if (s->sign < 0) {
        wide swap = wide_subtract(wide_set(0), low);
        low = wide_subtract(wide_set(0), high);
        high = swap;
    }
    wide bend = wide_set(s->bend), least = wide_set(s->least);
    wide top = wide_lesser(wide_greater(wide_set(s->turn), from), to);
    wide upper = wide_multiply(wide_multiply_add(bend, top, wide_set(s->most)), top);
    wide lower = wide_lesser(wide_multiply(wide_multiply_add(bend, from, least), from),
                             wide_multiply(wide_multiply_add(bend, to, least), to));
    *first = from;
    *last = to;
    return wide_at_most(from, to) & wide_at_most(low, upper) & wide_at_most(lower, high) & ((1u << node->count) - 1);
}

/* Where place + speed w + bend w² is 0, bend < 0: false where it is never. */
static inline bool turn_roots(float place, float speed, float bend, float roots[2])
{
    float square = speed * speed - 4 * bend * place;
    if (!(square >= 0))
        return false;
    float root = sqrtf(square), q = speed + (speed < 0 ? -root : root); /* no cancellation */
    float one = -0.5f * q / bend, two = q != 0 ? -2 * place / q : 0;
    roots[0] = one < two ? one : two;
    roots[1] = one < two ? two : one;
    return true;
}

/* Cuts from..to to ways at which some parabola may be at the height of the block's triangles; false where none is. */
static inline bool cut_to_block(const sp_bvh_block *block, const sp_parabola_packet *v, const packet_slabs *s,
                                float *from, float *to)
{
    int axis = v->steep;
    float lows[8], highs[8], low = INFINITY, high = -INFINITY, roots[2];
    wide a = wide_load(block->corner[0][axis]), b = wide_load(block->corner[1][axis]),
         c = wide_load(block->corner[2][axis]);
    wide_store(lows, wide_lesser(wide_lesser(a, b), c));
    wide_store(highs, wide_greater(wide_greater(a, b), c));
    for (int i = 0; i < 8; i++) { /* what is no number is neither */
        low = lows[i] < low ? lows[i] : low;
        high = highs[i] > high ? highs[i] : high;
    }
    low -= v->origin[axis] + 2 * SP_BVH_PAD;
    high -= v->origin[axis] - 2 * SP_BVH_PAD;
    if (s->sign < 0) {
        float swap = -low;
        low = -high;
        high = swap;
    }
    if (!turn_roots(-low, s->most, s->bend, roots))
        return false;
    *from = roots[0] > *from ? roots[0] : *from;
    *to = roots[1] < *to ? roots[1] : *to;
    if (turn_roots(-high, s->least, s->bend, roots)) { /* between them all are too high */
        if (*from > roots[0] && *from < roots[1])
            *from = roots[1];
        if (*to < roots[1] && *to > roots[0])
            *to = roots[0];
    }
    return *from <= *to;
}

/* The parabolas where they pass a block. Since way² there is 2 middle way - middle² but for at most r², r being half
 * the span, they are lines of one origin, from which they are never farther than half of bend r². */
typedef struct {
    view along;
    float u[SP_PARABOLA_PACKET], v[SP_PARABOLA_PACKET],
        inverse[SP_PARABOLA_PACKET]; /* slopes from the centre; ways per depth along z */
    float half[2];
    float from, to; /* ways between which this is so */
    float blur;     /* how far rounding may move a sheared corner */
    float sag;      /* how far the bend may move a parabola, sheared */
} packet_lines;

/* Slopes of the parabolas from their middle, where all move along l->along.z; `add` is what the bend adds to each
 * direction. */
static inline void take_slopes(const sp_parabola_packet *v, const float add[3], packet_lines *l)
{
    int z = l->along.z;
    wide low_u = wide_set(INFINITY), high_u = wide_set(-INFINITY), low_v = low_u, high_v = high_u;
    for (int i = 0; i < v->count; i += 8) {
        wide inverse =
            wide_divide(wide_set(1), wide_multiply(wide_add(wide_load(v->direction[z] + i), wide_set(add[z])),
                                                   wide_set(l->along.sign)));
        wide slope_u =
            wide_multiply(wide_add(wide_load(v->direction[l->along.x] + i), wide_set(add[l->along.x])), inverse);
        wide slope_v =
            wide_multiply(wide_add(wide_load(v->direction[l->along.y] + i), wide_set(add[l->along.y])), inverse);
        low_u = wide_lesser(low_u, slope_u);
        high_u = wide_greater(high_u, slope_u);
        low_v = wide_lesser(low_v, slope_v);
        high_v = wide_greater(high_v, slope_v);
        wide_store(l->inverse + i, inverse);
        wide_store(l->u + i, slope_u);
        wide_store(l->v + i, slope_v);
    }
    float bounds[4][8];
    wide_store(bounds[0], low_u);
    wide_store(bounds[1], high_u);
    wide_store(bounds[2], low_v);
    wide_store(bounds[3], high_v);
    for (int k = 0; k < 2; k++) {
        float low = INFINITY, high = -INFINITY;
        for (int i = 0; i < 8; i++) {
            low = bounds[2 * k][i] < low ? bounds[2 * k][i] : low;
            high = bounds[2 * k + 1][i] > high ? bounds[2 * k + 1][i] : high;
        }
        l->along.slope[k] = 0.5f * (low + high);
        l->half[k] = 0.5f * (high - low) * 1.000001f + 0x1p-22f;
    }
    for (int i = 0; i < v->count; i += 8) {
        wide_store(l->u + i, wide_subtract(wide_load(l->u + i), wide_set(l->along.slope[0])));
        wide_store(l->v + i, wide_subtract(wide_load(l->v + i), wide_set(l->along.slope[1])));
    }
}

/* How far rounding may move a sheared corner, as the parabolas see it. With e = 2^-24 and R = 1.02 + reach, the most
 * that a corner is away from the lines' origin along an axis: a corner is off by e for itself and e R for its
 * difference from the origin, along x and, times the slope, along z; shearing adds e R for the product, times the
 * slope, and e R times 1 + slope for the sum: less than e R (3 + 4 slope). A slope is off by 3 of its e, for the
 * inverse, the product and what the centre takes, over R. The origin O is off by e reach, what the bend adds to it,
 * bend (r²/2 - middle²), by 5 e of at most 1.5 bend way², their sum by e reach; directions by e for themselves, 2 e for
 * 2 bend middle and e for the sum, over way: e (2 reach + 2 speed way + 14 bend way²) along an axis, times 1 + slope
 * when sheared. What double precision is off its flight is less than e. */
static inline float blur_of(float reach, float slope, float straight, float bent)
{
    float lines = 2 * reach + 2 * straight + 14 * bent;
    return 1.1f * 0x1p-24f * ((1.02f + reach) * (3 + 7 * slope) + (1 + slope) * lines + 2);
}

/* False where they differ too much to be taken together. */
static inline bool lines_of(const sp_parabola_packet *v, float from, float to, packet_lines *l)
{
    float spare = 0x1p-4f * (to - from) + 16 * SP_BVH_PAD, r = 0.5f * (to - from) + spare, middle = 0.5f * (from + to);
    float add[3] = {0, 0, 0}, origin[3], fastest[3], reach = 0;
    add[v->steep] = 2 * v->bend * middle;
    for (int k = 0; k < 3; k++) {
        origin[k] = v->origin[k];
        if (k == v->steep)
            origin[k] += v->bend * (0.5f * r * r - middle * middle);
        float far = fabsf(origin[k]) > fabsf(v->origin[k]) ? fabsf(origin[k]) : fabsf(v->origin[k]);
        reach = far > reach ? far : reach;
        fastest[k] = 0.5f * (v->least[k] + v->most[k]) + add[k];
    }
    int z = fabsf(fastest[0]) > fabsf(fastest[1]) ? 0 : 1;
    z = fabsf(fastest[2]) > fabsf(fastest[z]) ? 2 : z;
    l->along.z = z;
    l->along.x = z == 2 ? 0 : z + 1;
    l->along.y = z == 0 ? 2 : z - 1;
    l->along.sign = fastest[z] > 0 ? 1 : -1;
    float half = 0.5f * (v->most[z] - v->least[z]);
    if (!(half < 0.4f * fabsf(fastest[z])))
        return false;
    l->along.origin[0] = origin[l->along.x];
    l->along.origin[1] = origin[l->along.y];
    l->along.origin[2] = origin[z];
    l->from = from - spare;
    l->to = to + spare;
    take_slopes(v, add, l);
    float slope = 1, speed = 0;
    for (int k = 0; k < 2; k++)
        slope = fabsf(l->along.slope[k]) + l->half[k] > slope ? fabsf(l->along.slope[k]) + l->half[k] : slope;
    for (int k = 0; k < 3; k++) {
        float most = fabsf(v->least[k]) > fabsf(v->most[k]) ? fabsf(v->least[k]) : fabsf(v->most[k]);
        speed = most > speed ? most : speed;
    }
    l->blur = blur_of(reach, slope, speed * l->to, fabsf(v->bend) * l->to * l->to);
    l->sag = 0.5001f * fabsf(v->bend) * r * r * slope;
    return true;
}

/* What the parabolas need to know of a block. One that sees a corner at most m away sees all of them at most m + across
 * away; a weight then is off by error + 4 (m + across) blur. */
typedef struct {
    weights weights;
    float depth[3][8], x[8], y[8]; /* x, y: of the first corner */
    float error[8], across[8], range[8], nearest[8];
} packet_block;

/* As prepare_block in line_packet_kernel.h, where the error of rounding is derived: 16 e M² + 4 m blur + 2 blur², M
 * being the most that any parabola sees of the corners, m what the one does that the weight is of. The bend moves all
 * three corners alike, by sag at most, and a weight by no more than that times what the triangle measures across the
 * parabolas. Where a weight is off by `error`, the mean of the corners' depths by weight is off by at most 4 errors'
 * share of their difference. */
static inline uint32_t prepare_packet_block(const sp_bvh_block *block, const packet_lines *l, packet_block *p)
{
    sheared seen = shear_block(block, l->along);
    wide half_u = wide_set(l->half[0]), half_v = wide_set(l->half[1]);
    uint32_t meets = meet_breadth(&seen, half_u, half_v, l->blur + l->sag);
    if (!meets)
        return 0;
    wide nearest = least_of(seen.z), farthest = largest_of(seen.z), range = wide_subtract(farthest, nearest);
    wide size = wide_multiply_add(wide_set(l->half[0] > l->half[1] ? l->half[0] : l->half[1]),
                                  wide_greater_amount(nearest, farthest), breadth_of(&seen));
    wide error = wide_multiply_add(wide_multiply(size, size), wide_set(16 * 0x1p-24f),
                                   wide_set(2 * l->blur * l->blur + 0x1p-120f));
    wide across = wide_multiply(wide_add(half_u, half_v), range);
    across = wide_add(across, wide_subtract(largest_of(seen.x), least_of(seen.x)));
    across = wide_add(across, wide_subtract(largest_of(seen.y), least_of(seen.y)));
    error = wide_multiply_add(across, wide_set(1.0001f * l->sag), error);
    wide least, largest;
    form_weights(&seen, half_u, half_v, &p->weights, &least, &largest);
    for (int i = 0; i < 3; i++)
        wide_store(p->depth[i], seen.z[i]);
    wide_store(p->x, seen.x[0]);
    wide_store(p->y, seen.y[0]);
    wide_store(p->error, error);
    wide_store(p->across, across);
    wide_store(p->range, range);
    wide_store(p->nearest, wide_subtract(nearest, wide_set(l->blur + l->sag)));
    error = wide_multiply_add(size, wide_set(4 * l->blur), error);
    return meets & (wide_at_most(wide_subtract(wide_set(0), error), least) | wide_at_most(largest, error));
}

/* Takes the way of a sure hit, or asks double precision where that is not sure enough. */
static inline void take(sp_parabola_packet *v, const packet_lines *l, int lane, uint32_t triangle, bool sure, float low,
                        float high)
{
    const float pad = 4 * SP_BVH_PAD;
    if (triangle == v->skip[lane] || v->high[lane] < 0)
        return;
    if (sure && (low > v->high[lane] || low > l->to || high < l->from || high < v->first[lane] - pad))
        return;
    if (!sure || low < v->first[lane] + pad || high > v->last[lane] - pad || low < l->from || high > l->to) {
        sp_parabola_packet_settle(v, lane, triangle);
    } else if (v->any) {
        v->triangle[lane] = triangle;
        v->high[lane] = -1;
    } else if (high < v->low[lane]) {
        v->triangle[lane] = triangle;
        v->low[lane] = low;
        v->high[lane] = high;
    } else {
        sp_parabola_packet_settle(v, lane, triangle);
    }
}

/* Tests the parabolas against triangle i of the block; returns whether anything came of it. */
static inline bool test_triangle(sp_parabola_packet *v, const packet_lines *l, const packet_block *p, int i,
                                 uint32_t triangle)
{
    bool taken = false;
    for (int group = 0; group < v->count; group += 8) {
        wide u = wide_load(l->u + group), w = wide_load(l->v + group), per_depth = wide_load(l->inverse + group),
             weight[3];
        wide away = wide_greater_amount(wide_subtract_product(wide_set(p->x[i]), u, wide_set(p->depth[0][i])),
                                        wide_subtract_product(wide_set(p->y[i]), w, wide_set(p->depth[0][i])));
        wide error = wide_multiply_add(wide_add(away, wide_set(p->across[i])), wide_set(4 * l->blur),
                                       wide_set(p->error[i])),
             minus = wide_subtract(wide_set(0), error);
        barycentric_of_ways(&p->weights, i, u, w, weight);
        wide least = least_of(weight), largest = largest_of(weight);
        uint32_t maybe = (wide_at_most(minus, least) | wide_at_most(largest, error)) &
                         wide_at_most(wide_multiply(wide_set(p->nearest[i]), per_depth), wide_load(v->high + group));
        if (!maybe)
            continue;
        wide sum = wide_add(wide_add(weight[0], weight[1]), weight[2]), inverse = wide_divide(wide_set(1), sum);
        wide depth = wide_multiply(weight[0], wide_set(p->depth[0][i]));
        depth = wide_multiply_add(weight[1], wide_set(p->depth[1][i]), depth);
        depth = wide_multiply(wide_multiply_add(weight[2], wide_set(p->depth[2][i]), depth), inverse);
        wide unsure = wide_multiply(wide_multiply(error, wide_set(4)), wide_set(p->range[i]));
        wide blur = wide_multiply_add(wide_absolute(inverse), unsure, wide_set(2 * l->blur + l->sag));
        uint32_t sure = (wide_at_most(error, least) | wide_at_most(largest, minus)) &
                        wide_at_most(wide_multiply(error, wide_set(8)), wide_absolute(sum));
        float low[8], high[8];
        wide_store(low, wide_multiply(wide_subtract(depth, blur), per_depth));
        wide_store(high, wide_multiply(wide_add(depth, blur), per_depth));
        for (; maybe; maybe &= maybe - 1) {
            int lane = __builtin_ctz(maybe);
            if (group + lane < v->count)
                take(v, l, group + lane, triangle, sure >> lane & 1, low[lane], high[lane]);
        }
        taken = true;
    }
    return taken;
}

static void find_farthest(sp_parabola_packet *v)
{
    float farthest = -1;
    for (int i = 0; i < v->count; i++)
        farthest = v->high[i] > farthest ? v->high[i] : farthest;
    v->farthest = farthest;
}

static void search_packet_block(sp_parabola_packet *v, const packet_slabs *s, const sp_bvh_block *block, float from,
                                float to)
{
    packet_lines l;
    packet_block p;
    bool taken = false;
    to = to < v->farthest ? to : v->farthest;
    if (!cut_to_block(block, v, s, &from, &to))
        return;
    if (lines_of(v, from, to, &l)) {
        for (uint32_t rest = prepare_packet_block(block, &l, &p); rest; rest &= rest - 1) {
            int i = __builtin_ctz(rest);
            v->met++;
            taken |= test_triangle(v, &l, &p, i, block->triangle[i]);
        }
    } else {
        for (int i = 0; i < SP_BVH_WIDTH && block->triangle[i] != SP_NONE; i++)
            for (int lane = 0; lane < v->count; lane++)
                if (v->high[lane] >= 0 && block->triangle[i] != v->skip[lane])
                    sp_parabola_packet_settle(v, lane, block->triangle[i]);
        taken = true;
    }
    if (taken)
        find_farthest(v);
}

void SP_KERNEL(sp_parabola_packet_search)(sp_parabola_packet *v)
{
    packet_slabs slabs = slabs_of(v);
    pending stack[SP_BVH_STACK];
    int height = 1;
    find_farthest(v);
    stack[0] = (pending){0, 0, v->farthest};
    while (height > 0) {
        pending at = stack[--height];
        if (at.from > v->farthest)
            continue;
        if (at.child & SP_BVH_LEAF) {
            search_packet_block(v, &slabs, &v->bvh->blocks[at.child - SP_BVH_LEAF], at.from, at.to);
            continue;
        }
        const sp_bvh_node *node = &v->bvh->nodes[at.child];
        wide from, to;
        uint32_t mask = meet_children(node, v, &slabs, &from, &to);
        height += push_children(node, mask, from, to, stack + height);
    }
}
