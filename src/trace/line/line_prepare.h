/* Making lines ready for the fast walk, SP_LINES or one at a time (`lanes`, a constant wherever it is given). For the
 * kernels, which are compiled once for each set of instructions: a compiler sees vectors in the loops over lanes, and
 * plain numbers where there is one. */
#ifndef SPRAYPLAN_TRACE_LINE_PREPARE_H
#define SPRAYPLAN_TRACE_LINE_PREPARE_H

#include "trace/line/line_bvh.h"

enum { SP_LINES = 16 };

/* One line a lane. */
typedef struct {
    double origin[3][SP_LINES], velocity[3][SP_LINES], t_min[SP_LINES], t_max[SP_LINES];
    double place[3][SP_LINES], start[SP_LINES];
    double rate[SP_LINES], reach[SP_LINES], z[SP_LINES];
    double far[SP_LINES], unfit[SP_LINES]; /* 1 or 0: the origin is too far away; single precision will not do */
    float from[3][SP_LINES], direction[3][SP_LINES], inverse[3][SP_LINES], blur[SP_LINES];
    float first[SP_LINES], last[SP_LINES], surely_first[SP_LINES], surely_last[SP_LINES];
    uint32_t falls[3][SP_LINES], near[3][SP_LINES], diagonal[SP_LINES], axis[3][SP_LINES];
    uint32_t number[SP_LINES], skip[SP_LINES];
    int count;
} line_lanes;

static inline float clamp_way(double way)
{
    return (float)sp_lesser(sp_greater(way, 0), SP_BVH_LONGEST);
}

static inline void see_origins(line_lanes *l, int lanes, const sp_bvh *bvh)
{
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < lanes; i++)
            l->place[axis][i] = (l->origin[axis][i] - bvh->centre[axis]) * bvh->scale;
    for (int i = 0; i < lanes; i++) {
        l->reach[i] = sp_greater(sp_greater(fabs(l->place[0][i]), fabs(l->place[1][i])), fabs(l->place[2][i]));
        l->far[i] = ((l->t_min[i] >= 0) & (l->reach[i] <= SP_BVH_NEAR_ENOUGH)) ? 0 : 1;
        l->start[i] = 0;
    }
}

/* Without branches also where there is one lane: which axis is the longest and which way lines go is foreseen by no
 * processor. */
static inline void see_directions(line_lanes *l, int lanes, double scale)
{
    for (int i = 0; i < lanes; i++) {
        double v0 = l->velocity[0][i], v1 = l->velocity[1][i], v2 = l->velocity[2][i];
        double a0 = fabs(v0), a1 = fabs(v1), a2 = fabs(v2), most = sp_greater(a1, a0), along = sp_greater(a2, most);
        double is_y = a1 > a0 ? 1 : 0, is_z = a2 > most ? 1 : 0;
        double slowness = 1 / along, rate = along * scale, all = v0 + v1 + v2;
        l->direction[0][i] = (float)(v0 * slowness);
        l->direction[1][i] = (float)(v1 * slowness);
        l->direction[2][i] = (float)(v2 * slowness);
        l->z[i] = is_y + is_z * (2 - is_y);
        l->rate[i] = rate;
        l->unfit[i] = ((l->reach[i] <= SP_BVH_NEAR_ENOUGH) & (rate > 1e-280) & (rate < 1e280) & (along > 1e-280) &
                       (along < 1e280) & (fabs(l->start[i]) < 1e280) & (all - all == 0))
                          ? 0
                          : 1;
    }
}

static inline void see_ways(line_lanes *l, int lanes)
{
    for (int i = 0; i < lanes; i++) {
        double first = (l->t_min[i] - l->start[i]) * l->rate[i], last = (l->t_max[i] - l->start[i]) * l->rate[i];
        l->first[i] = clamp_way(first - SP_BVH_PAD);
        l->last[i] = clamp_way(last + SP_BVH_PAD);
        l->surely_first[i] = clamp_way(first + 4 * SP_BVH_PAD);
        l->surely_last[i] = clamp_way(last - 4 * SP_BVH_PAD);
        l->blur[i] = 13 * 0x1p-24f * (float)(l->reach[i] + 1);
        for (int axis = 0; axis < 3; axis++)
            l->from[axis][i] = (float)l->place[axis][i];
    }
}

static inline void see_slopes(line_lanes *l, int lanes)
{
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < lanes; i++) {
            float d = l->direction[axis][i], inverse = 1 / d;
            uint32_t bits;
            memcpy(&bits, &d, sizeof bits);
            l->inverse[axis][i] = fabsf(d) > 0x1p-60f ? inverse : copysignf(0x1p60f, d);
            l->falls[axis][i] = bits >> 31;
            l->near[axis][i] = (uint32_t)(8 * axis) + 24 * (bits >> 31);
        }
    for (int i = 0; i < lanes; i++) {
        uint32_t falls = l->falls[0][i], others = 2 * l->falls[1][i] + 4 * l->falls[2][i];
        uint32_t z = (uint32_t)(int)l->z[i];
        l->diagonal[i] = (others ^ (6 * falls)) | falls;
        l->axis[0][i] = z == 2 ? 0 : z + 1;
        l->axis[1][i] = z == 0 ? 2 : z - 1;
        l->axis[2][i] = z;
    }
}

static inline void put_line(const line_lanes *l, int i, sp_bvh_line *line)
{
    for (int axis = 0; axis < 3; axis++) {
        line->origin[axis] = l->from[axis][i];
        line->inverse[axis] = l->inverse[axis][i];
        line->near[axis] = l->near[axis][i];
        line->direction[axis] = l->direction[axis][i];
    }
    line->diagonal = l->diagonal[i];
    line->x = l->axis[0][i];
    line->y = l->axis[1][i];
    line->z = l->axis[2][i];
    line->sign = copysignf(1, l->direction[l->axis[2][i]][i]);
    line->blur = l->blur[i];
    line->first = l->first[i];
    line->last = l->last[i];
    line->surely_first = l->surely_first[i];
    line->surely_last = l->surely_last[i];
    line->start = l->start[i];
    line->rate = l->rate[i];
    line->number = l->number[i];
    line->skip = l->skip[i];
}

static inline void answer_line(const sp_line_queue *queue, size_t ray, sp_hit hit)
{
    if (queue->hits)
        queue->hits[ray] = hit;
    else
        queue->occluded[ray] = hit.triangle != SP_NONE;
}

/* Takes the queue's next rays; idle lanes repeat the last. */
static inline void take_rays(sp_line_queue *queue, line_lanes *l, int lanes)
{
    size_t left = queue->count - queue->next;
    l->count = left < (size_t)lanes ? (int)left : lanes;
    for (int i = 0; i < lanes; i++) {
        size_t at = queue->next + (size_t)(i < l->count ? i : l->count - 1), number = at;
        if (queue->order) {
            number = queue->order[at].ray;
            size_t ahead = at + (size_t)lanes;
            __builtin_prefetch(&queue->rays[queue->order[ahead < queue->count ? ahead : at].ray]);
        }
        const sp_ray *ray = &queue->rays[number];
        l->origin[0][i] = ray->origin.x;
        l->origin[1][i] = ray->origin.y;
        l->origin[2][i] = ray->origin.z;
        l->velocity[0][i] = ray->velocity.x;
        l->velocity[1][i] = ray->velocity.y;
        l->velocity[2][i] = ray->velocity.z;
        l->t_min[i] = ray->t_min;
        l->t_max[i] = ray->t_max;
        l->number[i] = (uint32_t)number;
        l->skip[i] = ray->skip;
    }
    queue->next += (size_t)l->count;
}

/* Lets a line from afar begin where it comes near the box; false where it never does. */
static inline bool come_near(const sp_line_queue *queue, line_lanes *l, int i)
{
    double place[3];
    if (!sp_bvh_line_begin(queue->bvh, &queue->rays[l->number[i]], place, &l->start[i]))
        return false;
    l->reach[i] = 0;
    for (int axis = 0; axis < 3; axis++) {
        l->place[axis][i] = place[axis];
        l->reach[i] = sp_greater(l->reach[i], fabs(place[axis]));
    }
    return true;
}

/* Makes the queue's next lines ready, `lanes` at a time; those for which single precision will not do get their
 * answers. Returns how many are ready. */
static inline __attribute__((always_inline)) int make_ready(sp_line_queue *queue, int lanes, sp_bvh_line *ready)
{
    line_lanes l;
    uint32_t beside = 0;
    int count = 0;
    take_rays(queue, &l, lanes);
    see_origins(&l, lanes, queue->bvh);
    for (int i = 0; i < l.count; i++)
        if (l.far[i] != 0)
            beside |= (uint32_t)!come_near(queue, &l, i) << i;
    see_directions(&l, lanes, queue->bvh->scale);
    see_ways(&l, lanes);
    see_slopes(&l, lanes);
    for (int i = 0; i < l.count; i++) {
        const sp_ray *ray = &queue->rays[l.number[i]];
        if (beside >> i & 1)
            answer_line(queue, l.number[i], (sp_hit){INFINITY, 0, 0, SP_NONE});
        else if (l.unfit[i] != 0)
            answer_line(queue, l.number[i], sp_bvh_line_walk(queue->bvh, ray, !queue->hits));
        else
            put_line(&l, i, &ready[count++]);
    }
    return count;
}

#endif
