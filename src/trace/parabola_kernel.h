/* One piece of a parabola through the hierarchy. Included once by each file that is compiled for a set of instructions,
 * with SP_KERNEL(name) naming its functions. */
#include "trace/parabola_bvh.h"
#include "trace/pending.h"

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
static inline uint32_t enter_children(const sp_bvh_node *node, const sp_bvh_arc *arc, bool aligned, wide *first,
                                      wide *last)
{
    const uint8_t *bytes = (const uint8_t *)node->low;
    wide from = wide_set(0), to = wide_set(arc->last);
    for (int i = 1; i < 3; i++) {
        int axis = arc->axis[i];
        wide inverse = wide_set(arc->inverse[i]), step = wide_multiply(wide_set(node->step[axis]), inverse);
        wide corner = wide_multiply(wide_subtract(wide_set(node->origin[axis]), wide_set(arc->sooner[i])), inverse);
        wide beyond = aligned ? corner : wide_add(corner, wide_set(arc->later[i]));
        from = wide_greater(from, wide_multiply_add(wide_bytes(bytes + arc->near[i]), step, corner));
        to = wide_lesser(to, wide_multiply_add(wide_bytes(bytes + arc->far[i]), step, beyond));
    }
    int steep = arc->axis[0];
    wide sign = wide_set(arc->sign), inverse = wide_set(arc->inverse[0]);
    wide corner = wide_multiply(wide_subtract(wide_set(node->origin[steep]), wide_set(arc->origin[steep])), sign);
    wide step = wide_multiply(wide_set(node->step[steep]), sign);
    wide enter = wide_multiply_add(wide_bytes(bytes + arc->near[0]), step, corner);
    wide leave = wide_multiply_add(wide_bytes(bytes + arc->far[0]), step, corner);
    from = wide_greater(from, wide_multiply_add(enter, inverse, wide_set(arc->sooner[0])));
    to = wide_lesser(to, wide_multiply_add(leave, inverse, wide_set(arc->later[0])));
    wide bend = wide_set(arc->bend[steep] * arc->sign), direction = wide_set(arc->direction[steep] * arc->sign);
    wide before = wide_multiply(wide_multiply_add(bend, from, direction), from);
    wide after = wide_multiply(wide_multiply_add(bend, to, direction), to);
    *first = from;
    *last = to;
    /* What is not in use is inside out, which the room between the lines may turn back. */
    return wide_at_most(from, to) & wide_at_most(before, leave) & wide_at_most(enter, after) &
           ((1u << node->count) - 1);
}

/* The flight where it passes a block: a line parallel to it in the middle of the span, from which it is never farther
 * than `blur`, rounding included. */
typedef struct {
    int x, y, z; /* axes, z the one of the largest component of direction */
    float origin[3], shear_x, shear_y, sign;
    float blur;
    float first, last, surely_first, surely_last; /* along z, from the origin */
} chord;

/* With r half the span, the flight is away from its tangent in the middle by bend (way - middle)², so that halfway to
 * the farthest it is off by at most bend r²/2 either way along each axis; when sheared, by no more if gravity is along
 * one axis, else by twice that: sag knows. The rounding of the line's origin is that of the polynomial above and
 * another 3 e; that of its direction, e each for direction and bend, 2 e for its sum and as much for the shear, makes
 * 12 e over the box; and of a sheared corner, as for lines, 13 e times 1.04 + the box: 28 + 3 + 12 + 27 = 70. */
static inline chord chord_of(const sp_bvh_arc *arc, float from, float to)
{
    chord c;
    float spare = 0x1p-4f * (to - from) + 16 * SP_BVH_PAD, r = 0.5f * (to - from) + spare, middle = 0.5f * (from + to);
    float direction[3], half = 0.5f * r * r;
    for (int k = 0; k < 3; k++) {
        direction[k] = arc->direction[k] + 2 * middle * arc->bend[k];
        c.origin[k] = arc->origin[k] + (arc->direction[k] + arc->bend[k] * middle) * middle + arc->bend[k] * half;
    }
    c.z = fabsf(direction[0]) > fabsf(direction[1]) ? 0 : 1;
    c.z = fabsf(direction[2]) > fabsf(direction[c.z]) ? 2 : c.z;
    c.x = c.z == 2 ? 0 : c.z + 1;
    c.y = c.z == 0 ? 2 : c.z - 1;
    float inverse = 1 / direction[c.z], speed = fabsf(direction[c.z]);
    c.shear_x = direction[c.x] * inverse;
    c.shear_y = direction[c.y] * inverse;
    c.sign = direction[c.z] > 0 ? 1 : -1;
    c.blur = 70 * 0x1p-24f + 1.001f * half * arc->sag;
    float slack = c.blur + 4 * SP_BVH_PAD;
    c.first = -r * speed - slack;
    c.last = (arc->last - middle) * speed + slack;
    float soonest = from - spare > arc->surely_first ? from - spare : arc->surely_first;
    float latest = to + spare < arc->surely_last ? to + spare : arc->surely_last;
    c.surely_first = (soonest - middle) * speed + slack;
    c.surely_last = (latest - middle) * speed - slack;
    return c;
}

/* What is to be known of a block's triangles: those that may be hit, and those that surely are. */
typedef struct {
    uint32_t maybe, surely;
} verdict;

/* As for lines, against the chord: a triangle that the flight meets is within `blur` of the chord where that passes, so
 * that a weight below -error means that it passes beside. What lies inside by more is surely crossed, if that is at a
 * way between one at which the flight is still before the triangle and one at which it is beyond: the chord meets the
 * triangle at the corners' mean by weight, and within `blur` of it the triangle is nearer or farther by no more than 3
 * errors' share of its extent. */
static inline verdict test_block(const sp_bvh_block *block, const chord *c, bool any)
{
    wide x[3], y[3], z[3], sign = wide_set(c->sign);
    for (int i = 0; i < 3; i++) {
        wide away = wide_subtract(wide_load(block->corner[i][c->z]), wide_set(c->origin[c->z]));
        x[i] = wide_subtract(wide_load(block->corner[i][c->x]), wide_set(c->origin[c->x]));
        y[i] = wide_subtract(wide_load(block->corner[i][c->y]), wide_set(c->origin[c->y]));
        x[i] = wide_subtract_product(x[i], wide_set(c->shear_x), away);
        y[i] = wide_subtract_product(y[i], wide_set(c->shear_y), away);
        z[i] = wide_multiply(away, sign);
    }
    wide u = wide_subtract_product(wide_multiply(x[2], y[1]), y[2], x[1]);
    wide v = wide_subtract_product(wide_multiply(x[0], y[2]), y[0], x[2]);
    wide w = wide_subtract_product(wide_multiply(x[1], y[0]), y[1], x[0]);
    wide most =
        wide_greater_amount(wide_greater_amount(wide_greater_amount(x[0], y[0]), wide_greater_amount(x[1], y[1])),
                            wide_greater_amount(x[2], y[2]));
    wide error = wide_multiply_add(most, wide_multiply_add(most, wide_set(5 * 0x1p-24f), wide_set(4 * c->blur)),
                                   wide_set(2 * c->blur * c->blur + 0x1p-120f));
    wide least = wide_lesser(wide_lesser(u, v), w), largest = wide_greater(wide_greater(u, v), w);
    wide minus = wide_subtract(wide_set(0), error);
    uint32_t inside = wide_at_most(minus, least) | wide_at_most(largest, error);
    if (!inside)
        return (verdict){0, 0};
    wide nearest = wide_lesser(wide_lesser(z[0], z[1]), z[2]), farthest = wide_greater(wide_greater(z[0], z[1]), z[2]);
    uint32_t maybe = inside & wide_at_most(nearest, wide_set(c->last)) & wide_at_most(wide_set(c->first), farthest);
    uint32_t surely = maybe & (wide_at_most(error, least) | wide_at_most(largest, minus));
    if (any && surely) {
        wide sum = wide_add(wide_add(u, v), w);
        wide met = wide_multiply_add(u, z[0], wide_multiply_add(v, z[1], wide_multiply(w, z[2])));
        wide unsure = wide_multiply(wide_set(4), wide_multiply(error, wide_subtract(farthest, nearest)));
        wide square = wide_multiply(sum, sum), place = wide_multiply(met, sum);
        unsure = wide_multiply(unsure, wide_absolute(sum));
        surely &= wide_at_most(wide_multiply_add(square, wide_set(c->surely_first), unsure), place) &
                  wide_at_most(wide_add(place, unsure), wide_multiply(square, wide_set(c->surely_last)));
    }
    return (verdict){maybe, surely};
}

/* Puts what a block decides into the search; true where the search is over. */
static bool search_block(sp_bvh_jet *jet, const sp_bvh_block *block, float from, float to)
{
    sp_search *search = jet->search;
    chord c = chord_of(&jet->arc, from, to);
    verdict found = test_block(block, &c, search->any);
    for (uint32_t rest = search->any ? found.surely : 0; rest; rest &= rest - 1) {
        uint32_t triangle = block->triangle[__builtin_ctz(rest)];
        if (triangle != search->skip) {
            search->best.triangle = triangle;
            return true;
        }
    }
    for (uint32_t rest = found.maybe; rest; rest &= rest - 1)
        sp_bvh_jet_test(jet, block->triangle[__builtin_ctz(rest)]);
    if (found.maybe)
        sp_bvh_arc_shorten(&jet->arc, search->limit);
    return sp_search_done(search);
}

static inline void walk(sp_bvh_jet *jet, bool aligned)
{
    const sp_bvh *bvh = jet->bvh;
    const sp_bvh_arc *arc = &jet->arc;
    pending stack[SP_BVH_STACK];
    int height = 1;
    stack[0] = (pending){0, 0, 0};
    while (height > 0) {
        pending at = stack[--height];
        if (at.from > arc->last)
            continue;
        if (at.child & SP_BVH_LEAF) {
            if (search_block(jet, &bvh->blocks[at.child - SP_BVH_LEAF], at.from, at.to))
                return;
            continue;
        }
        const sp_bvh_node *node = &bvh->nodes[at.child];
        wide from, to;
        uint32_t mask = enter_children(node, arc, aligned, &from, &to);
        height += push_children(node, mask, from, to, stack + height);
    }
}

void SP_KERNEL(sp_bvh_parabola)(sp_bvh_jet *jet)
{
    if (jet->arc.aligned)
        walk(jet, true);
    else
        walk(jet, false);
}
