/* One piece of a parabola through the hierarchy. Included once by each file that is compiled for a set of instructions,
 * with SP_KERNEL(name) naming its functions. */
#include "trace/parabola/parabola_bvh.h"
#include "trace/bvh/sheared.h"

/* The places of children in a node. */
static const float places[8] = {0, 1, 2, 3, 4, 5, 6, 7};

/* Which children the flight passes, and the ways between which it may be in each.
 *
 * Along each axis two parallel lines, the chord and the tangent, tell when it passes a plane at the soonest and at the
 * latest; without gravity along the axis they are one. Between these ways the steep coordinate goes one way, so that
 * what it is at either end, two products each, tells whether it can be in the box: no square root, and as sharp as if
 * it were solved for, because the two other axes have cut the span to the box.
 *
 * Nothing that a hit is in is left out. Let e = 2^-24. The origin is at most 1.02 and the box at most 1 away from 0, so
 * that planes are at most R = 2.03 away from the origin; let S = 4.2 be the most that speed times way is, and ways be
 * at most 2 S. Rounding moves, for the ways: sooner by e R; node's corner - sooner by e R; the slope's inverse, rounded
 * once, and the direction are a turn of 2 e, that is 2 e R of the plane; the corner's product and the step's by e R
 * each; the sum by e R (without fma another e R): 8 e R < 17 e. And for the steep coordinate: direction and bend by e S
 * each, the inner sum of the polynomial by e S, without fma another e S, the outer product by e R; origin and node's
 * corner - origin by e R each, the plane's product and sum by 2 e R: 4 e S + 5 e R < 28 e. The last way is lengthened
 * by 16 e, over which the chord is off by no more. The double precision test's notion of where the flight is differs by
 * less than 8 e: sp_bvh_arc_prepare sees to that. All together are less than 64 e = SP_BVH_PAD, by which the boxes are
 * wider than what they hold, so that the flight is in them from before the hit until after it. An inverse that is cut
 * to 2^60 turns the chord by 2^-60. */
static inline void enter_children(const sp_bvh_node *node, const sp_bvh_arc *arc, bool aligned, wide *first, wide *last)
{
    const uint8_t *bytes = (const uint8_t *)node->low;
    wide from = wide_set(0), to = wide_set(arc->last), nowhere = wide_set(INFINITY);
    for (int i = 1; i < 3; i++) {
        int axis = arc->axis[i];
        float slow = (node->origin[axis] - arc->sooner[i]) * arc->inverse[i];
        wide step = wide_set(node->step[axis] * arc->inverse[i]), corner = wide_set(slow);
        wide beyond = aligned ? corner : wide_set(slow + arc->later[i]);
        from = wide_greater(from, wide_multiply_add(wide_bytes(bytes + arc->near[i]), step, corner));
        to = wide_lesser(to, wide_multiply_add(wide_bytes(bytes + arc->far[i]), step, beyond));
    }
    int steep = arc->axis[0];
    wide inverse = wide_set(arc->inverse[0]), step = wide_set(node->step[steep] * arc->sign);
    wide corner = wide_set((node->origin[steep] - arc->origin[steep]) * arc->sign);
    wide enter = wide_multiply_add(wide_bytes(bytes + arc->near[0]), step, corner);
    wide leave = wide_multiply_add(wide_bytes(bytes + arc->far[0]), step, corner);
    from = wide_greater(from, wide_multiply_add(enter, inverse, wide_set(arc->sooner[0])));
    to = wide_lesser(to, wide_multiply_add(leave, inverse, wide_set(arc->later[0])));
    wide bend = wide_set(arc->bend[steep] * arc->sign), direction = wide_set(arc->direction[steep] * arc->sign);
    wide before = wide_multiply(wide_multiply_add(bend, from, direction), from);
    wide after = wide_multiply(wide_multiply_add(bend, to, direction), to);
    from = wide_where_at_most(before, leave, from, nowhere);
    from = wide_where_at_most(enter, after, from, nowhere);
    /* What is not in use is inside out, which the room between the lines may turn back. */
    if (!aligned)
        from = wide_where_at_most(wide_load(places), wide_set((float)node->count - 1), from, nowhere);
    *first = from;
    *last = to;
}

/* The flight where it passes a block: a line parallel to it in the middle of the span, from which it is never farther
 * than `blur`, rounding included. */
typedef struct {
    view along; /* z is the axis of the largest component of direction */
    float blur;
    float first, last;               /* along z, from the origin: between these it may be hit */
    float middle, per_depth;         /* way = middle + depth along z per_depth */
    float surely_first, surely_last; /* ways between which the flight is no farther from the chord */
} chord;

/* What rounding may move a sheared corner by, as the flight sees it. With e = 2^-24 and R = 1.02 + reach, the most that
 * a corner is away from the chord's origin along an axis: a corner is off by e for itself and e R for its difference
 * from the origin, and so it is along z; the shear, at most 1, by 3 e; the sheared corner's product and sum by e R and
 * 2 e R: less than 10 e R. The chord's origin is off by e reach for the flight's, by 3 e of way and 6 e of sag way² for
 * what is added to it, and e reach for the sum; its direction by e for the flight's, 2 e for 2 bend middle and e for
 * the sum, over way: e (2 reach + 5 way + 14 sag way²) along an axis, as no speed is more than 1, and twice that when
 * sheared. What double precision is off its flight is less than 8 e. */
static inline float rounding_of(const sp_bvh_arc *arc, float reach, float way)
{
    float line = 2 * reach + 5 * way + 14 * arc->sag * way * way;
    return 1.1f * 0x1p-24f * (10 * (1.02f + reach) + 2 * line + 8);
}

/* With r half the span, the flight is away from its tangent in the middle by bend (way - middle)², so that halfway to
 * the farthest it is off by at most bend r²/2 either way along each axis; when sheared, by no more if gravity is along
 * one axis, else by twice that: sag knows. */
static inline chord chord_of(const sp_bvh_arc *arc, float from, float to)
{
    chord c;
    float spare = 0x1p-4f * (to - from) + 16 * SP_BVH_PAD, r = 0.5f * (to - from) + spare, middle = 0.5f * (from + to);
    float origin[3], direction[3], half = 0.5f * r * r, reach = 0;
    for (int k = 0; k < 3; k++) {
        direction[k] = arc->direction[k] + 2 * middle * arc->bend[k];
        origin[k] = arc->origin[k] + (arc->direction[k] + arc->bend[k] * middle) * middle + arc->bend[k] * half;
        reach = fabsf(origin[k]) > reach ? fabsf(origin[k]) : reach;
        reach = fabsf(arc->origin[k]) > reach ? fabsf(arc->origin[k]) : reach;
    }
    int z = fabsf(direction[0]) > fabsf(direction[1]) ? 0 : 1;
    z = fabsf(direction[2]) > fabsf(direction[z]) ? 2 : z;
    int x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
    float speed = fabsf(direction[z]), inverse = 1 / speed;
    if (!(speed > 0x1p-40f)) /* as it turns, upright: it is hardly anywhere else */
        inverse = 0;
    c.along = (view){x, y, z, {origin[x], origin[y], origin[z]}, {direction[x] * inverse, direction[y] * inverse}, 0};
    c.along.sign = direction[z] > 0 ? 1 : -1;
    c.blur = rounding_of(arc, reach, to + spare) + 1.001f * half * arc->sag;
    float slack = c.blur + 4 * SP_BVH_PAD;
    c.first = -r * speed - slack;
    c.last = (arc->last - middle) * speed + slack;
    c.middle = middle;
    c.per_depth = inverse;
    c.surely_first = speed > 0x1p-40f ? from - spare : INFINITY;
    c.surely_last = to + spare;
    return c;
}

/* What is to be known of a block's triangles: those that may be hit, and those that surely are. */
typedef struct {
    uint32_t maybe, surely;
    float low[8], high[8]; /* of those surely hit: ways */
} verdict;

/* As for lines, against the chord: a triangle that the flight meets is within `blur` of the chord where that passes, so
 * that a weight below -error means that it passes beside. What lies inside by more is surely crossed, if that is at a
 * way between one at which the flight is still before the triangle and one at which it is beyond: the chord meets the
 * triangle at the corners' mean by weight, and within `blur` of it the triangle is nearer or farther by no more than 3
 * errors' share of its extent. */
static inline void test_block(const sp_bvh_block *block, const chord *c, verdict *found)
{
    sheared seen = shear_block(block, c->along);
    barycentric w = barycentric_sheared(&seen, c->blur);
    found->maybe = found->surely = 0;
    if (!w.inside)
        return;
    wide nearest = least_of(seen.z), farthest = largest_of(seen.z);
    found->maybe = w.inside & wide_at_most(nearest, wide_set(c->last)) & wide_at_most(wide_set(c->first), farthest);
    if (!found->maybe)
        return;
    wide met, inverse;
    uint32_t surely = meet_sheared(&seen, &w, &met, &inverse);
    wide unsure = wide_multiply(wide_set(4), wide_multiply(w.error, wide_subtract(farthest, nearest)));
    unsure = wide_multiply_add(unsure, wide_absolute(inverse), wide_set(c->blur + 2 * SP_BVH_PAD));
    wide per_depth = wide_set(c->per_depth), middle = wide_set(c->middle);
    wide low = wide_multiply_add(wide_subtract(met, unsure), per_depth, middle);
    wide high = wide_multiply_add(wide_add(met, unsure), per_depth, middle);
    found->surely = found->maybe & surely & wide_at_most(wide_set(c->surely_first), low) &
                    wide_at_most(high, wide_set(c->surely_last));
    wide_store(found->low, low);
    wide_store(found->high, high);
}

/* Takes a hit that is sure in single precision, or asks double precision. True where the search is over. */
static inline bool take(const sp_parabola_queue *queue, sp_parabola_flight *flight, uint32_t triangle, bool sure,
                        float low, float high)
{
    sp_bvh_arc *arc = &flight->arc;
    if (triangle == flight->search.skip || (sure && low > arc->last))
        return false;
    if (!sure || low < arc->surely_first || high > arc->surely_last || (high >= flight->low && !flight->search.any)) {
        sp_parabola_flight_settle(queue, flight, triangle);
    } else {
        flight->triangle = triangle;
        flight->low = low;
        arc->last = high;
        __builtin_prefetch(&queue->bvh->mesh->triangles[triangle]);
    }
    return flight->search.any && flight->triangle != SP_NONE;
}

/* True where the search is over. */
static inline bool search_block(const sp_parabola_queue *queue, sp_parabola_flight *flight, const sp_bvh_block *block,
                                float from, float until)
{
    chord c = chord_of(&flight->arc, from, until);
    verdict found;
    test_block(block, &c, &found);
    for (uint32_t rest = found.maybe; rest; rest &= rest - 1) {
        int i = __builtin_ctz(rest);
        if (take(queue, flight, block->triangle[i], found.surely >> i & 1, found.low[i], found.high[i]))
            return true;
    }
    return false;
}

/* Visits what is on top of the stack; false where the flight is at its end. */
static inline bool step(const sp_parabola_queue *queue, sp_parabola_flight *flight)
{
    const sp_bvh *bvh = queue->bvh;
    const sp_bvh_arc *arc = &flight->arc;
    int height = flight->height;
    float last = arc->last;
    do
        if (--height < 0)
            return sp_parabola_flight_go_on(queue, flight);
    while (flight->from[height] > last);
    uint32_t child = flight->child[height];
    if (child & SP_BVH_LEAF) {
        if (search_block(queue, flight, &bvh->blocks[child - SP_BVH_LEAF], flight->from[height], flight->until[height]))
            return false;
    } else {
        const sp_bvh_node *node = &bvh->nodes[child];
        wide from, until;
        if (arc->aligned)
            enter_children(node, arc, true, &from, &until);
        else
            enter_children(node, arc, false, &from, &until);
        uint64_t order = wide_order(node->order[arc->diagonal >> 1]);
        if (arc->diagonal & 1)
            order = __builtin_bswap64(order);
        height += wide_pack_spans(node->child, from, until, order, flight->child + height, flight->from + height,
                                  flight->until + height);
    }
    flight->height = height;
    if (height > 0)
        sp_bvh_prefetch(bvh, flight->child[height - 1]);
    return true;
}

void SP_KERNEL(sp_bvh_parabolas)(sp_parabola_queue *queue, sp_parabola_flight *flights, int most)
{
    sp_parabola_flight *active[SP_PARABOLA_FLIGHTS];
    int count = 0;
    while (count < most && sp_parabola_queue_begin(queue, &flights[count])) {
        active[count] = &flights[count];
        count++;
    }
    while (count > 0) {
        for (int i = 0; i < count; i++) {
            if (step(queue, active[i]))
                continue;
            sp_parabola_queue_end(queue, active[i]);
            if (!sp_parabola_queue_begin(queue, active[i]))
                active[i--] = active[--count];
        }
    }
}
