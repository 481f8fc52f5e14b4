/* A packet of lines through the hierarchy. Included once by each file that is compiled for a set of instructions, with
 * SP_KERNEL(name) naming its functions. */
#include "trace/line/answer.h"
#include "trace/line/line_packet.h"
#include "trace/line/common_origin_kernel.h"
#include "trace/bvh/seen.h"
#include "trace/bvh/sheared.h"

typedef struct {
    uint32_t child;
    float depth;
    uint32_t node, slot; /* whose child it is, for its box */
} packet_pending;

/* Boxes whose span low..high has something in common with the packet's, whose slopes are centre ± half. */
static inline uint32_t meet_slopes(wide low, wide high, wide near, wide far, float centre, float half)
{
    wide least = wide_set(centre - half), most = wide_set(centre + half);
    wide left = wide_lesser(wide_multiply(least, near), wide_multiply(least, far));
    wide right = wide_greater(wide_multiply(most, near), wide_multiply(most, far));
    return wide_at_most(low, right) & wide_at_most(left, high);
}

/* Which children some line of the packet may pass: boxes against the pyramid that holds all of them. Rounding is less
 * than the boxes' pad, as in line_kernel.h: of the corner and origin 2 e R, of the bounds e R, of the slopes e R, and
 * of their products e R. */
static inline uint32_t meet_children(const sp_bvh_node *node, const sp_line_packet *b, wide *depth)
{
    wide low, high, near, far, zero = wide_set(0);
    see_bounds(node, b->z, b->origin[2], &near, &far);
    if (b->sign < 0) {
        wide swap = wide_subtract(zero, near);
        near = wide_subtract(zero, far);
        far = swap;
    }
    uint32_t mask = wide_at_most(zero, far) & wide_at_most(near, wide_set(b->farthest));
    near = wide_greater(near, zero);
    see_bounds(node, b->x, b->origin[0], &low, &high);
    mask &= meet_slopes(low, high, near, far, b->centre[0], b->half[0]);
    see_bounds(node, b->y, b->origin[1], &low, &high);
    mask &= meet_slopes(low, high, near, far, b->centre[1], b->half[1]);
    *depth = near;
    return mask & ((1u << node->count) - 1);
}

/* Which lines may pass a node's child, each by itself, and not beyond what it wants. Rounding is as above. */
static inline uint32_t meet_lines(const sp_bvh_node *node, uint32_t slot, const sp_line_packet *b)
{
    float low[3], high[3];
    const int axes[3] = {b->x, b->y, b->z};
    for (int k = 0; k < 3; k++) {
        float corner = node->origin[axes[k]] - b->origin[k], step = node->step[axes[k]];
        low[k] = corner + step * (float)node->low[axes[k]][slot];
        high[k] = corner + step * (float)node->high[axes[k]][slot];
    }
    float near = b->sign < 0 ? -high[2] : low[2], far = b->sign < 0 ? -low[2] : high[2];
    near = near > 0 ? near : 0;
    wide first = wide_set(near), last = wide_set(far);
    uint32_t mask = 0;
    for (int group = 0; group < b->count; group += 8) {
        wide u = wide_load(b->slope_u + group), v = wide_load(b->slope_v + group);
        wide u0 = wide_multiply(u, first), u1 = wide_multiply(u, last);
        wide v0 = wide_multiply(v, first), v1 = wide_multiply(v, last);
        uint32_t meets = wide_at_most(wide_lesser(u0, u1), wide_set(high[0])) &
                         wide_at_most(wide_set(low[0]), wide_greater(u0, u1)) &
                         wide_at_most(wide_lesser(v0, v1), wide_set(high[1])) &
                         wide_at_most(wide_set(low[1]), wide_greater(v0, v1)) &
                         wide_at_most(first, wide_load(b->high + group));
        mask |= meets << group;
    }
    return mask;
}

/* What the lines need to know of a block. A line's depth in the triangle's plane is volume over the sum of the weights.
 */
typedef struct {
    weights weights;
    float volume[8], error[8], nearest[8], depth_error[8];
} packet_block;

/* Prepares a block, and returns which of its triangles some line may hit.
 *
 * As in line_kernel.h, e = 2^-24 and R bounds what is seen from the origin. A corner sheared along the packet's centre,
 * x = a - c z, is off by at most 10 e R; a line's own x - u z by e R more: blur is 13 e R. Let M bound what a line of
 * the packet sees of the corners' x and y, |x| + half z. The weight x2 y1 - y2 x1 with x - u z for x and y - v z for y
 * is (x2 y1 - y2 x1) + u (y2 z1 - z2 y1) + v (z2 x1 - x2 z1), the products of u v cancel. Corners' errors move it by at
 * most 4 M blur + 2 blur^2; each of its terms is at most 2 M^2 and rounded at most twice before they are added: 16 e
 * M^2. That is `error`. The sum of the weights then is off by 4 errors, the volume by 4 errors times Z, the largest
 * |z|; where the sum is more than 8 errors, the depth is off by at most 16 errors Z over the sum, and by blur. */
static inline uint32_t prepare_block(const sp_bvh_block *block, const sp_line_packet *b, packet_block *p)
{
    const float *origin = b->origin;
    sheared seen = shear_block(
        block, (view){b->x, b->y, b->z, {origin[0], origin[1], origin[2]}, {b->centre[0], b->centre[1]}, b->sign});
    wide half_u = wide_set(b->half[0]), half_v = wide_set(b->half[1]), blur = wide_set(b->blur);
    wide nearest = least_of(seen.z), farthest = largest_of(seen.z);
    uint32_t meets =
        wide_at_most(wide_set(-b->blur), farthest) & wide_at_most(nearest, wide_set(b->farthest + b->blur));
    meets &= meet_breadth(&seen, half_u, half_v, b->blur);
    if (!meets)
        return 0;

    wide depth = wide_greater_amount(nearest, farthest);
    wide size =
        wide_multiply_add(wide_set(b->half[0] > b->half[1] ? b->half[0] : b->half[1]), depth, breadth_of(&seen));
    wide error = wide_multiply_add(size, wide_multiply_add(size, wide_set(16 * 0x1p-24f), wide_set(4 * b->blur)),
                                   wide_set(2 * b->blur * b->blur + 0x1p-120f));
    wide least, largest, volume = wide_set(0);
    form_weights(&seen, half_u, half_v, &p->weights, &least, &largest);
    for (int i = 0; i < 3; i++)
        volume = wide_multiply_add(wide_load(p->weights.constant[i]), seen.z[i], volume);
    /* Some weight above 0 for all lines, and some below: none of them hits. */
    meets &= wide_at_most(wide_subtract(wide_set(0), error), least) | wide_at_most(largest, error);
    wide_store(p->volume, volume);
    wide_store(p->error, error);
    wide_store(p->nearest, wide_subtract(nearest, blur));
    wide_store(p->depth_error, wide_multiply(wide_multiply(error, wide_set(16)), depth));
    return meets;
}

/* Takes the time of a sure hit, or asks double precision where that is not sure enough. */
static inline void take(sp_line_packet *b, int lane, uint32_t triangle, bool sure, float low, float high)
{
    if (low > b->high[lane] || triangle == b->skip[lane])
        return;
    if (!sure || low < b->first[lane] + 4 * SP_BVH_PAD || high > b->last[lane] - 4 * SP_BVH_PAD) {
        if (!sure || !(high < b->first[lane] - 4 * SP_BVH_PAD))
            sp_line_packet_settle(b, lane, triangle);
    } else if (b->any) {
        b->triangle[lane] = triangle;
        b->high[lane] = -1;
    } else if (high < b->low[lane]) {
        __builtin_prefetch(&b->bvh->mesh->triangles[triangle]);
        b->triangle[lane] = triangle;
        b->low[lane] = low;
        b->high[lane] = high;
    } else {
        sp_line_packet_settle(b, lane, triangle);
    }
}

/* For what the packet's view of a block leaves in doubt: the line's own, in double precision, of the corners as the
 * block has them. Between which depths it hits; low above high where it surely does not; false where that, too, is in
 * doubt.
 *
 * A corner is off by e along each axis, sheared by 2 e; all else is rounded to 2^-52. As above, weights then are off by
 * 8 M e + 8 e^2, where M itself is off by 2 e, and the depth by 16 of these times Z over the sum, and by 2 e. */
static inline bool look_closer(const sp_line_packet *b, int lane, const sp_bvh_block *block, int i, float *low,
                               float *high)
{
    const double e = 0x1p-24;
    double x[3], y[3], z[3], inverse = 1 / fabs(b->velocity[2][lane]), most = 0, deepest = 0;
    double u = b->velocity[0][lane] * inverse, v = b->velocity[1][lane] * inverse;
    for (int k = 0; k < 3; k++) {
        z[k] = (block->corner[k][b->z][i] - b->place[2]) * b->sign;
        x[k] = block->corner[k][b->x][i] - b->place[0] - u * z[k];
        y[k] = block->corner[k][b->y][i] - b->place[1] - v * z[k];
        most = sp_greater(most, sp_greater(fabs(x[k]), fabs(y[k])));
        deepest = sp_greater(deepest, fabs(z[k]));
    }
    double w0 = x[2] * y[1] - y[2] * x[1], w1 = x[0] * y[2] - y[0] * x[2], w2 = x[1] * y[0] - y[1] * x[0];
    double error = 9 * e * most + 32 * e * e, sum = w0 + w1 + w2;
    double least = sp_lesser(sp_lesser(w0, w1), w2), largest = sp_greater(sp_greater(w0, w1), w2);
    if (least < -error && largest > error) {
        *low = 1;
        *high = 0;
        return true;
    }
    double depth = (w0 * z[0] + w1 * z[1] + w2 * z[2]) / sum, off = 16 * error * deepest / fabs(sum) + 4 * e;
    *low = (float)(depth - off - 16 * e);
    *high = (float)(depth + off + 16 * e);
    return (least > error || largest < -error) && fabs(sum) > 8 * error;
}

/* Takes what the packet's view found, or looks closer. */
static inline void take_found(sp_line_packet *b, int lane, const sp_bvh_block *block, int i, bool sure, float nearest,
                              float low, float high)
{
    if (!sure) {
        sure = look_closer(b, lane, block, i, &low, &high);
        if (sure && low > high)
            return;
    }
    take(b, lane, block->triangle[i], sure, sure ? low : nearest, high);
}

/* Where lines meet triangles, one of either at a time: weights and how far they may be off. */
typedef struct {
    wide least, largest, sum;
    uint32_t maybe;
} meeting;

static inline meeting meet(wide weight[3], wide error, wide nearest, wide farthest)
{
    meeting m;
    wide minus = wide_subtract(wide_set(0), error);
    m.least = least_of(weight);
    m.largest = largest_of(weight);
    m.maybe = (wide_at_most(minus, m.least) | wide_at_most(m.largest, error)) & wide_at_most(nearest, farthest);
    m.sum = wide_add(wide_add(weight[0], weight[1]), weight[2]);
    return m;
}

/* Which of these are sure, and between which depths. */
static inline uint32_t decide(const meeting *m, wide error, wide volume, wide depth_error, float blur, float low[8],
                              float high[8])
{
    wide inverse = wide_divide(wide_set(1), m->sum), depth = wide_multiply(volume, inverse);
    wide off = wide_multiply_add(wide_absolute(inverse), depth_error, wide_set(blur));
    wide_store(low, wide_subtract(depth, off));
    wide_store(high, wide_add(depth, off));
    return (wide_at_most(error, m->least) | wide_at_most(m->largest, wide_subtract(wide_set(0), error))) &
           wide_at_most(wide_multiply(wide_set(8), error), wide_absolute(m->sum));
}

/* Tests those of the packet's lines against triangle i of the block; returns whether anything came of it. */
static inline bool test_triangle(sp_line_packet *b, const packet_block *p, uint32_t lines, int i,
                                 const sp_bvh_block *block)
{
    wide error = wide_set(p->error[i]);
    bool taken = false;
    for (int group = 0; group < b->count; group += 8) {
        if (!(lines >> group & 255))
            continue;
        wide u = wide_load(b->u + group), v = wide_load(b->v + group), weight[3];
        barycentric_of_ways(&p->weights, i, u, v, weight);
        meeting m = meet(weight, error, wide_set(p->nearest[i]), wide_load(b->high + group));
        if (!m.maybe)
            continue;
        float low[8], high[8];
        uint32_t sure = decide(&m, error, wide_set(p->volume[i]), wide_set(p->depth_error[i]), b->blur, low, high);
        for (uint32_t rest = m.maybe; rest; rest &= rest - 1) {
            int lane = __builtin_ctz(rest);
            take_found(b, group + lane, block, i, sure >> lane & 1, p->nearest[i], low[lane], high[lane]);
        }
        taken = true;
    }
    return taken;
}

/* Tests one line against those triangles of the block; likewise. */
static inline bool test_line(sp_line_packet *b, const packet_block *p, uint32_t triangles, int lane,
                             const sp_bvh_block *block)
{
    wide u = wide_set(b->u[lane]), v = wide_set(b->v[lane]), error = wide_load(p->error), weight[3];
    for (int k = 0; k < 3; k++)
        weight[k] =
            wide_multiply_add(u, wide_load(p->weights.by_u[k]),
                              wide_multiply_add(v, wide_load(p->weights.by_v[k]), wide_load(p->weights.constant[k])));
    meeting m = meet(weight, error, wide_load(p->nearest), wide_set(b->high[lane]));
    m.maybe &= triangles;
    if (!m.maybe)
        return false;
    float low[8], high[8];
    uint32_t sure = decide(&m, error, wide_load(p->volume), wide_load(p->depth_error), b->blur, low, high);
    for (uint32_t rest = m.maybe; rest; rest &= rest - 1) {
        int i = __builtin_ctz(rest);
        take_found(b, lane, block, i, sure >> i & 1, p->nearest[i], low[i], high[i]);
    }
    return true;
}

static inline void find_farthest(sp_line_packet *b)
{
    float lane[8], farthest = -1;
    wide most = wide_load(b->high);
    for (int group = 8; group < b->count; group += 8)
        most = wide_greater(most, wide_load(b->high + group));
    wide_store(lane, most);
    for (int i = 0; i < 8; i++)
        farthest = lane[i] > farthest ? lane[i] : farthest;
    b->farthest = farthest;
}

/* Lines by triangles, or triangles by lines, whichever is less. */
static inline void search_packet_block(sp_line_packet *b, const sp_bvh_block *block, uint32_t lines)
{
    packet_block p;
    bool taken = false;
    uint32_t triangles = prepare_block(block, b, &p);
    if (!triangles)
        return;
    if (__builtin_popcount(lines) <= (b->count + 7) / 8 * __builtin_popcount(triangles)) {
        for (uint32_t rest = lines; rest; rest &= rest - 1)
            taken |= test_line(b, &p, triangles, __builtin_ctz(rest), block);
    } else {
        for (uint32_t rest = triangles; rest; rest &= rest - 1) {
            int i = __builtin_ctz(rest);
            taken |= test_triangle(b, &p, lines, i, block);
        }
    }
    if (taken)
        find_farthest(b);
}

static inline int push_met(const sp_bvh *bvh, uint32_t parent, uint32_t mask, const float depths[8],
                           packet_pending *stack)
{
    const sp_bvh_node *node = &bvh->nodes[parent];
    int count = 0;
    for (; mask; mask &= mask - 1) {
        int i = __builtin_ctz(mask), place = count++;
        packet_pending item = {node->child[i], depths[i], parent, (uint32_t)i};
        sp_bvh_prefetch(bvh, item.child);
        for (; place > 0 && stack[place - 1].depth < item.depth; place--)
            stack[place] = stack[place - 1];
        stack[place] = item;
    }
    return count;
}

static void search(sp_line_packet *b)
{
    const sp_bvh *bvh = b->bvh;
    packet_pending stack[SP_BVH_STACK];
    int height = 1;
    stack[0] = (packet_pending){0, 0, 0, 0};
    find_farthest(b);
    while (height > 0) {
        packet_pending at = stack[--height];
        if (at.depth > b->farthest)
            continue;
        if (at.child & SP_BVH_LEAF) {
            uint32_t lines = meet_lines(&bvh->nodes[at.node], at.slot, b);
            if (lines)
                search_packet_block(b, &bvh->blocks[at.child - SP_BVH_LEAF], lines);
            continue;
        }
        const sp_bvh_node *node = &bvh->nodes[at.child];
        float depths[8];
        wide depth;
        uint32_t mask = meet_children(node, b, &depth);
        wide_store(depths, depth);
        height += push_met(bvh, at.child, mask, depths, stack + height);
    }
}

static void answer(const sp_line_packet *b, sp_hit *hits)
{
    answers a;
    answer_lanes l;
    double place[3];
    if (b->count == 0)
        return;
    start_answers(&a, b->bvh, b->rays, hits);
    sp_to_array(b->rays[b->ray[0]].origin, place);
    for (int i = 0; i < b->count; i++) {
        if (b->triangle[i] == SP_NONE) {
            hits[b->ray[i]] = (sp_hit){INFINITY, 0, 0, SP_NONE};
            continue;
        }
        l.origin[0][a.count] = place[b->x];
        l.origin[1][a.count] = place[b->y];
        l.origin[2][a.count] = place[b->z];
        for (int k = 0; k < 3; k++)
            l.velocity[k][a.count] = b->velocity[k][i];
        note_answer(&a, b->ray[i], b->triangle[i], (uint32_t)b->z);
    }
    if (a.count > 0)
        finish_answers(&a, &l);
}

const sp_line_packet_kernel SP_KERNEL(sp_line_packet) = {direction_keys, fill_packet, search, answer};
