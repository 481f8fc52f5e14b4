/* What a line makes of a node and of a block. For the kernels, which are compiled once for each set of instructions. */
#ifndef SPRAYPLAN_TRACE_LINE_STEP_H
#define SPRAYPLAN_TRACE_LINE_STEP_H

#include "trace/line/line_bvh.h"
#include "trace/bvh/sheared.h"

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
static inline void enter_children(const sp_bvh_node *node, const sp_bvh_line *ray, wide *enters, wide *leaves)
{
    const uint8_t *bytes = (const uint8_t *)node->low;
    wide from = wide_set(ray->first), to = wide_set(ray->last);
    for (int axis = 0; axis < 3; axis++) {
        wide corner = wide_set((node->origin[axis] - ray->origin[axis]) * ray->inverse[axis]);
        wide step = wide_set(node->step[axis] * ray->inverse[axis]);
        uint32_t near = ray->near[axis], far = (uint32_t)(24 + 16 * axis) - near;
        from = wide_greater(from, wide_multiply_add(wide_bytes(bytes + near), step, corner));
        to = wide_lesser(to, wide_multiply_add(wide_bytes(bytes + far), step, corner));
    }
    *enters = from;
    *leaves = to;
}

/* The node's children from far to near, a byte each. */
static inline uint64_t children_order(const sp_bvh_node *node, const sp_bvh_line *ray)
{
    uint64_t order = wide_order(node->order[ray->diagonal >> 1]), back = __builtin_bswap64(order);
    return ray->diagonal & 1 ? back : order;
}

/* The watertight test of line.c in single precision, with a bound on what that may change.
 *
 * R and e as above, here R = 1 + the origin's largest coordinate. A corner's difference from the origin is off by e for
 * the corner, e R for the origin and e R for the difference; times the shear (at most 1, itself off by e), subtracted
 * and rounded: |x - x'| <= e (3 R + 3 R + R + R + 2 R) = 10 e R, and blur is 13 e R. A weight x2 y1 - y2 x1 of numbers
 * of at most M then is off by 4 M blur + 2 blur^2, and by rounding of its own 4 e M^2. The weights in double precision,
 * scaled alike, are off by far less, which the difference between 10 and 13 covers: a weight that is below -error here
 * is below zero there. The way to a hit lies between those to the nearest and farthest corner. */
static inline void test_block(const sp_bvh_block *block, const sp_bvh_line *ray, sp_bvh_verdict *found)
{
    int x = (int)ray->x, y = (int)ray->y, z = (int)ray->z;
    const float *origin = ray->origin, *direction = ray->direction;
    sheared seen =
        shear_block(block, (view){x, y, z, {origin[x], origin[y], origin[z]}, {direction[x], direction[y]}, ray->sign});
    barycentric w = barycentric_sheared(&seen, ray->blur);
    found->maybe = found->surely = 0;
    if (!w.inside)
        return;
    wide nearest = least_of(seen.z), farthest = largest_of(seen.z), pad = wide_set(SP_BVH_PAD);
    found->maybe = w.inside & wide_at_most(nearest, wide_add(wide_set(ray->last), pad)) &
                   wide_at_most(wide_subtract(wide_set(ray->first), pad), farthest);
    if (!found->maybe)
        return;
    wide way, inverse;
    found->surely = found->maybe & meet_sheared(&seen, &w, &way, &inverse);
    wide spread = wide_multiply(wide_multiply(w.error, wide_set(16)), wide_greater_amount(nearest, farthest));
    spread = wide_multiply_add(spread, wide_absolute(inverse), wide_set(ray->blur));
    wide_store(found->low, wide_subtract(way, spread));
    wide_store(found->high, wide_add(way, spread));
}

/* Takes a hit that is sure in single precision, or asks double precision. */
static inline void take(const sp_line_queue *queue, sp_line_flight *flight, uint32_t triangle, bool sure, float low,
                        float high)
{
    sp_bvh_line *ray = &flight->ray;
    bool any = !queue->hits;
    if (triangle == ray->skip || (sure && (low > ray->last || high < ray->first)))
        return;
    if (!sure || low < ray->surely_first || high > ray->surely_last || (high >= flight->low && !any)) {
        sp_line_flight_settle(queue, flight, triangle);
    } else {
        flight->triangle = triangle;
        flight->low = low;
        ray->last = high;
        __builtin_prefetch(&queue->bvh->mesh->triangles[triangle]);
    }
}

/* Takes what the block that the flight visits has found. */
static inline void take_found(const sp_line_queue *queue, sp_line_flight *flight, const sp_bvh_block *block)
{
    const sp_bvh_verdict *found = &flight->found;
    for (uint32_t rest = found->maybe; rest; rest &= rest - 1) {
        int i = __builtin_ctz(rest);
        take(queue, flight, block->triangle[i], found->surely >> i & 1, found->low[i], found->high[i]);
    }
}

#endif
