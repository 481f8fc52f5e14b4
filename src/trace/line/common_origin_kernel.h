/* What rays of one origin are before they are traced together: their places in the order of directions, and packets of
 * neighbours. For the kernels, which are compiled once for each set of instructions: a compiler sees vectors in the
 * loops over lanes. */
#ifndef SPRAYPLAN_TRACE_COMMON_ORIGIN_KERNEL_H
#define SPRAYPLAN_TRACE_COMMON_ORIGIN_KERNEL_H

#include "trace/line/line_packet.h"
#include "trace/bvh/wide.h"

/* No depth within the box is larger, for an origin that is near enough. */
#define LONGEST 16.0

enum { KEYS = 16 };

typedef struct {
    double velocity[3][KEYS], t_min[KEYS], bad[KEYS], z[KEYS], u[KEYS], v[KEYS];
    uint32_t key[KEYS];
} key_lanes;

static inline void see_key_lanes(key_lanes *l, double scale)
{
    for (int i = 0; i < KEYS; i++) {
        double v0 = l->velocity[0][i], v1 = l->velocity[1][i], v2 = l->velocity[2][i];
        double a0 = fabs(v0), a1 = fabs(v1), a2 = fabs(v2);
        double z = a1 > a0 ? 1 : 0, most = a1 > a0 ? a1 : a0, steep = a1 > a0 ? v1 : v0;
        double u = a1 > a0 ? v2 : v1, v = a1 > a0 ? v0 : v2;
        z = a2 > most ? 2 : z;
        steep = a2 > most ? v2 : steep;
        u = a2 > most ? v0 : u;
        v = a2 > most ? v1 : v;
        double along = fabs(steep), inverse = 1 / along, rate = along * scale;
        u *= inverse;
        v *= inverse;
        l->u[i] = u;
        l->v[i] = v;
        l->z[i] = 2 * z + (steep < 0 ? 1 : 0);
        l->bad[i] = ((rate > 1e-280) & (rate < 1e280) & (along > 1e-280) & (along < 1e280) & (l->t_min[i] >= 0) &
                     (fabs(u) + fabs(v) <= 2))
                        ? 0
                        : 1;
    }
    for (int i = 0; i < KEYS; i++)
        l->key[i] = sp_direction_key((uint32_t)(int)l->z[i], (float)l->u[i], (float)l->v[i]);
}

static bool direction_keys(const sp_bvh *bvh, const sp_ray *rays, size_t count, sp_direction_entry *order)
{
    key_lanes l;
    double bad = 0;
    for (size_t first = 0; first < count; first += KEYS) {
        for (int i = 0; i < KEYS; i++) {
            const sp_ray *ray = &rays[first + (size_t)i < count ? first + (size_t)i : count - 1];
            l.velocity[0][i] = ray->velocity.x;
            l.velocity[1][i] = ray->velocity.y;
            l.velocity[2][i] = ray->velocity.z;
            l.t_min[i] = ray->t_min;
        }
        see_key_lanes(&l, bvh->scale);
        for (size_t i = 0; i < KEYS && first + i < count; i++) {
            order[first + i] = (sp_direction_entry){l.key[i], (uint32_t)(first + i)};
            bad += l.bad[i];
        }
    }
    return bad == 0;
}

static inline float clamp_depth(double depth)
{
    return (float)sp_lesser(sp_greater(depth, 0), LONGEST);
}

/* Takes the rays of one side that come next; returns how many. Idle lanes repeat the first. */
static inline int take_rays(const sp_common_origin *c, size_t from, sp_line_packet *b, double t_min[SP_LINE_PACKET],
                            double t_max[SP_LINE_PACKET])
{
    const sp_direction_entry *order = c->order[0] + from;
    size_t left = c->count - from;
    uint32_t side = order[0].key >> 2 * SP_DIRECTION_BITS;
    int count = 0;
    b->z = (int)(side / 2);
    b->x = b->z == 2 ? 0 : b->z + 1;
    b->y = b->z == 0 ? 2 : b->z - 1;
    b->sign = side % 2 ? -1 : 1;
    while (count < SP_LINE_PACKET && (size_t)count < left && order[count].key >> 2 * SP_DIRECTION_BITS == side)
        count++;
    for (int i = 0; i < SP_LINE_PACKET; i++) {
        uint32_t number = order[i < count ? i : 0].ray;
        const sp_ray *ray = &c->rays[number];
        const double *velocity = &ray->velocity.x;
        size_t ahead = (size_t)i + SP_LINE_PACKET;
        __builtin_prefetch(&c->rays[order[ahead < left ? ahead : 0].ray].velocity);
        __builtin_prefetch(&c->rays[order[ahead < left ? ahead : 0].ray].skip);
        b->velocity[0][i] = velocity[b->x];
        b->velocity[1][i] = velocity[b->y];
        b->velocity[2][i] = velocity[b->z];
        t_min[i] = ray->t_min;
        t_max[i] = ray->t_max;
        b->skip[i] = ray->skip;
        b->ray[i] = number;
    }
    return count;
}

/* The range of slopes, its middle, and where the lines are in it. */
static inline void centre_slopes(const float slope[SP_LINE_PACKET], float off[SP_LINE_PACKET], float *centre,
                                 float *half)
{
    float least[8], most[8], low = INFINITY, high = -INFINITY;
    wide a = wide_load(slope), z = a;
    for (int i = 8; i < SP_LINE_PACKET; i += 8) {
        a = wide_lesser(a, wide_load(slope + i));
        z = wide_greater(z, wide_load(slope + i));
    }
    wide_store(least, a);
    wide_store(most, z);
    for (int i = 0; i < 8; i++) {
        low = least[i] < low ? least[i] : low;
        high = most[i] > high ? most[i] : high;
    }
    *centre = 0.5f * (low + high);
    /* Rounded up, and so that no packet is without breadth. */
    *half = 0.5f * (high - low) * 1.000001f + 0x1p-23f;
    for (int i = 0; i < SP_LINE_PACKET; i++)
        off[i] = slope[i] - *centre;
}

static size_t fill_packet(const sp_common_origin *c, size_t from, sp_line_packet *b)
{
    double t_min[SP_LINE_PACKET], t_max[SP_LINE_PACKET];
    b->count = take_rays(c, from, b, t_min, t_max);
    b->place[0] = c->place[b->x];
    b->place[1] = c->place[b->y];
    b->place[2] = c->place[b->z];
    for (int axis = 0; axis < 3; axis++)
        b->origin[axis] = (float)b->place[axis];
    for (int i = 0; i < SP_LINE_PACKET; i++) {
        double along = fabs(b->velocity[2][i]), inverse = 1 / along, rate = along * c->bvh->scale;
        b->slope_u[i] = (float)(b->velocity[0][i] * inverse);
        b->slope_v[i] = (float)(b->velocity[1][i] * inverse);
        b->first[i] = clamp_depth(t_min[i] * rate);
        b->last[i] = clamp_depth(t_max[i] * rate);
    }
    centre_slopes(b->slope_u, b->u, &b->centre[0], &b->half[0]);
    centre_slopes(b->slope_v, b->v, &b->centre[1], &b->half[1]);
    for (int i = 0; i < SP_LINE_PACKET; i++) {
        b->low[i] = INFINITY;
        b->high[i] = i < b->count ? b->last[i] + SP_BVH_PAD : -1;
        b->triangle[i] = SP_NONE;
    }
    return (size_t)b->count;
}

#endif
