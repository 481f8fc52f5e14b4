/* One line through the hierarchy. Included once by each file that is compiled for a set of instructions, with
 * SP_KERNEL(name) naming its functions. */
#include "trace/line_bvh.h"
#include "trace/wide.h"

typedef struct {
    uint32_t child;
    float way; /* where the line enters its box */
} pending;

/* Which children the line passes, and where it enters each.
 *
 * Nothing that a hit is in is left out. Say the origin is at most 7 and the box at most 1 away from 0 along every axis,
 * so that planes are at most R = 8 away from the origin. Let e = 2^-24. Rounding moves: the origin by e 7; origin -
 * node's corner by e R; the inverse, its own rounding and that of the direction, by a change of direction of 2 e, that
 * is 2 e R of the plane; the corner's product by e R; the step's by e R (without fma another e R); the sum by e R. Then
 * the double precision test's notion of where the line is differs by up to 2^-40 of at most 2^16, another e. All are
 * less than 64 e = SP_BVH_PAD = 2^-18, by which the boxes are wider than what they hold, along every axis, so that a
 * line that hits a triangle enters its boxes before the hit and leaves them after it. An inverse that is cut to 2^60
 * turns the line by 2^-60. Bounds are finite, so that no infinity or NaN arises. */
static inline uint32_t enter_children(const sp_bvh_node *node, const sp_bvh_line *ray, wide *way)
{
    const uint8_t *bytes = (const uint8_t *)node->low;
    wide from = wide_set(ray->first), to = wide_set(ray->last);
    for (int axis = 0; axis < 3; axis++) {
        wide corner = wide_set((node->origin[axis] - ray->origin[axis]) * ray->inverse[axis]);
        wide step = wide_set(node->step[axis] * ray->inverse[axis]);
        uint32_t near = ray->near[axis], far = near < 24 ? near + 24 : near - 24;
        from = wide_greater(from, wide_multiply_add(wide_bytes(bytes + near), step, corner));
        to = wide_lesser(to, wide_multiply_add(wide_bytes(bytes + far), step, corner));
    }
    *way = from;
    return wide_at_most(from, to);
}

/* What is to be known of a block's triangles: those that may be hit, and those that surely are. */
typedef struct {
    uint32_t maybe, surely;
} verdict;

/* The watertight test of line.c in single precision, with a bound on what that may change.
 *
 * R and e as above, here R = 1 + the origin's largest coordinate. A corner's difference from the origin is off by e for
 * the corner, e R for the origin and e R for the difference; times the shear (at most 1, itself off by e), subtracted
 * and rounded: |x - x'| <= e (3 R + 3 R + R + R + 2 R) = 10 e R, and blur is 13 e R. A weight x2 y1 - y2 x1 of numbers
 * of at most M then is off by 4 M blur + 2 blur^2, and by rounding of its own 4 e M^2. The weights in double precision,
 * scaled alike, are off by far less, which the difference between 10 and 13 covers: a weight that is below -error here
 * is below zero there. The way to a hit lies between those to the nearest and farthest corner. */
static inline verdict test_block(const sp_bvh_block *block, const sp_bvh_line *ray)
{
    wide x[3], y[3], z[3], sign = wide_set(ray->sign);
    for (int i = 0; i < 3; i++) {
        wide away = wide_subtract(wide_load(block->corner[i][ray->z]), wide_set(ray->origin[ray->z]));
        x[i] = wide_subtract(wide_load(block->corner[i][ray->x]), wide_set(ray->origin[ray->x]));
        y[i] = wide_subtract(wide_load(block->corner[i][ray->y]), wide_set(ray->origin[ray->y]));
        x[i] = wide_subtract_product(x[i], wide_set(ray->shear_x), away);
        y[i] = wide_subtract_product(y[i], wide_set(ray->shear_y), away);
        z[i] = wide_multiply(away, sign);
    }
    wide u = wide_subtract_product(wide_multiply(x[2], y[1]), y[2], x[1]);
    wide v = wide_subtract_product(wide_multiply(x[0], y[2]), y[0], x[2]);
    wide w = wide_subtract_product(wide_multiply(x[1], y[0]), y[1], x[0]);
    wide most =
        wide_greater_amount(wide_greater_amount(wide_greater_amount(x[0], y[0]), wide_greater_amount(x[1], y[1])),
                            wide_greater_amount(x[2], y[2]));
    float blur = ray->blur;
    wide error = wide_multiply_add(most, wide_multiply_add(most, wide_set(5 * 0x1p-24f), wide_set(4 * blur)),
                                   wide_set(2 * blur * blur + 0x1p-120f));
    wide least = wide_lesser(wide_lesser(u, v), w), largest = wide_greater(wide_greater(u, v), w);
    wide minus = wide_subtract(wide_set(0), error);
    uint32_t inside = wide_at_most(minus, least) | wide_at_most(largest, error);
    if (!inside)
        return (verdict){0, 0};
    wide nearest = wide_lesser(wide_lesser(z[0], z[1]), z[2]), farthest = wide_greater(wide_greater(z[0], z[1]), z[2]);
    wide pad = wide_set(SP_BVH_PAD);
    uint32_t maybe = inside & wide_at_most(nearest, wide_add(wide_set(ray->last), pad)) &
                     wide_at_most(wide_subtract(wide_set(ray->first), pad), farthest);
    uint32_t surely = maybe & (wide_at_most(error, least) | wide_at_most(largest, minus)) &
                      wide_at_most(wide_set(ray->surely_first), nearest) &
                      wide_at_most(farthest, wide_set(ray->surely_last));
    return (verdict){maybe, surely};
}

/* Puts what a block decides into the search; true where the search is over. */
static bool search_block(sp_bvh_flight *flight, const sp_bvh_block *block)
{
    sp_search *search = flight->search;
    verdict found = test_block(block, &flight->ray);
    for (uint32_t rest = search->any ? found.surely : 0; rest; rest &= rest - 1) {
        uint32_t triangle = block->triangle[__builtin_ctz(rest)];
        if (triangle != search->skip) {
            search->best.triangle = triangle;
            return true;
        }
    }
    for (uint32_t rest = found.maybe; rest; rest &= rest - 1) {
        uint32_t triangle = block->triangle[__builtin_ctz(rest)];
        sp_corners corners;
        sp_bvh_corners(flight->bvh, triangle, corners);
        sp_line_test(flight->line, (const double(*)[3])corners, triangle, search);
    }
    if (found.maybe)
        sp_bvh_line_shorten(&flight->ray, search->limit);
    return sp_search_done(search);
}

/* Puts the children onto the stack, the nearest on top. */
static inline int push_children(const sp_bvh_node *node, uint32_t mask, const float ways[8], pending *stack)
{
    int count = 0;
    for (; mask; mask &= mask - 1) {
        int i = __builtin_ctz(mask), place = count++;
        pending item = {node->child[i], ways[i]};
        for (; place > 0 && stack[place - 1].way < item.way; place--)
            stack[place] = stack[place - 1];
        stack[place] = item;
    }
    return count;
}

void SP_KERNEL(sp_bvh_line)(sp_bvh_flight *flight)
{
    const sp_bvh *bvh = flight->bvh;
    sp_bvh_line *ray = &flight->ray;
    pending stack[SP_BVH_STACK];
    int height = 1;
    stack[0] = (pending){0, 0};
    while (height > 0) {
        pending at = stack[--height];
        if (at.way > ray->last)
            continue;
        if (at.child & SP_BVH_LEAF) {
            if (search_block(flight, &bvh->blocks[at.child - SP_BVH_LEAF]))
                return;
            continue;
        }
        const sp_bvh_node *node = &bvh->nodes[at.child];
        float ways[8];
        wide way;
        uint32_t mask = enter_children(node, ray, &way);
        wide_store(ways, way);
        height += push_children(node, mask, ways, stack + height);
    }
}
