/* Rays of one origin: put in the order of their directions, then traced in bundles of neighbours. */
#include "trace/bundle.h"
#include "trace/direction_order.h"
#include "trace/line.h"
#include "trace/line_bvh.h"

#include <stdlib.h>
#include <string.h>

/* Origins farther away are left to single lines, which begin near the mesh. */
#define NEAR_ENOUGH 7.0
#define LONGEST 16.0

typedef struct {
    const sp_bvh *bvh;
    const sp_ray *rays;
    size_t count;
    sp_fan_line *lines;           /* [count], as the rays */
    sp_direction_entry *order[2]; /* [count] */
    sp_hit *hits;                 /* [count], or NULL */
    float origin[3];              /* in the hierarchy's space */
    float blur;
} fan;

static inline float clamp_depth(double depth)
{
    return (float)sp_lesser(sp_greater(depth, 0), LONGEST);
}

/* False where the ray is none that a fan takes. */
static inline bool see_line(const fan *f, const sp_ray *ray, sp_fan_line *line, uint32_t *key)
{
    double *velocity = line->velocity;
    sp_to_array(ray->velocity, velocity);
    int z = 0;
    for (int axis = 1; axis < 3; axis++)
        if (fabs(velocity[axis]) > fabs(velocity[z]))
            z = axis;
    double along = fabs(velocity[z]), inverse = 1 / along, rate = along * f->bvh->scale;
    if (!(rate > 1e-280 && rate < 1e280 && along > 1e-280 && along < 1e280 && ray->t_min >= 0))
        return false;
    line->u = (float)(velocity[(z + 1) % 3] * inverse);
    line->v = (float)(velocity[(z + 2) % 3] * inverse);
    if (!isfinite(line->u + line->v))
        return false;
    line->first = clamp_depth(ray->t_min * rate);
    line->last = clamp_depth(ray->t_max * rate);
    line->skip = ray->skip;
    line->side = (uint32_t)(2 * z + (velocity[z] < 0));
    *key = sp_direction_key(line->side, line->u, line->v);
    return true;
}

/* A place in the order of directions, whatever the ray. */
static inline uint32_t key_of(const sp_ray *ray)
{
    double velocity[3];
    sp_to_array(ray->velocity, velocity);
    int z = 0;
    for (int axis = 1; axis < 3; axis++)
        if (fabs(velocity[axis]) > fabs(velocity[z]))
            z = axis;
    double inverse = 1 / fabs(velocity[z]);
    float u = (float)(velocity[(z + 1) % 3] * inverse), v = (float)(velocity[(z + 2) % 3] * inverse);
    return u >= -1 && v >= -1 ? sp_direction_key((uint32_t)(2 * z) + (velocity[z] < 0), u, v) : 0;
}

/* Reads the rays, and sorts them. */
static bool read_rays(fan *f)
{
    for (size_t i = 0; i < f->count; i++) {
        uint32_t key;
        if (!see_line(f, &f->rays[i], &f->lines[i], &key))
            return false;
        f->order[0][i] = (sp_direction_entry){key, (uint32_t)i};
    }
    sp_direction_sort(f->order, f->count);
    return true;
}

/* Has what the bundle after the next one needs brought near. */
static inline void fetch(const fan *f, size_t from)
{
    size_t end = f->count - from < SP_BUNDLE ? f->count : from + SP_BUNDLE;
    for (size_t i = from; from < f->count && i < end; i++) {
        uint32_t number = f->order[0][i].ray;
        __builtin_prefetch(&f->lines[number]);
        if (f->hits)
            __builtin_prefetch(&f->hits[number], 1);
    }
}

/* Puts the next lines of one side into a bundle; returns how many. */
static size_t fill_bundle(const fan *f, size_t from, sp_bundle *b)
{
    float low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    uint32_t side = f->lines[f->order[0][from].ray].side;
    int count = 0;
    fetch(f, from + SP_BUNDLE);
    for (; count < SP_BUNDLE && from + (size_t)count < f->count; count++) {
        uint32_t number = f->order[0][from + (size_t)count].ray;
        const sp_fan_line *line = &f->lines[number];
        if (line->side != side)
            break;
        b->u[count] = line->u;
        b->v[count] = line->v;
        b->first[count] = line->first;
        b->last[count] = line->last;
        b->low[count] = INFINITY;
        b->high[count] = line->last + SP_BVH_PAD;
        b->triangle[count] = SP_NONE;
        b->skip[count] = line->skip;
        b->ray[count] = number;
        low[0] = line->u < low[0] ? line->u : low[0];
        low[1] = line->v < low[1] ? line->v : low[1];
        high[0] = line->u > high[0] ? line->u : high[0];
        high[1] = line->v > high[1] ? line->v : high[1];
    }
    b->count = count;
    b->z = (int)(side / 2);
    b->x = (b->z + 1) % 3;
    b->y = (b->z + 2) % 3;
    b->sign = side % 2 ? -1 : 1;
    b->origin[0] = f->origin[b->x];
    b->origin[1] = f->origin[b->y];
    b->origin[2] = f->origin[b->z];
    for (int k = 0; k < 2; k++) {
        b->centre[k] = 0.5f * (low[k] + high[k]);
        /* Rounded up, and so that no bundle is without breadth. */
        b->half[k] = 0.5f * (high[k] - low[k]) * 1.000001f + 0x1p-23f;
    }
    for (int i = 0; i < (count + 7) / 8 * 8; i++) {
        b->u[i] = i < count ? b->u[i] - b->centre[0] : 0;
        b->v[i] = i < count ? b->v[i] - b->centre[1] : 0;
        if (i >= count)
            b->high[i] = -1;
    }
    return (size_t)count;
}

sp_hit sp_bundle_ask(const sp_bundle *b, int lane, uint32_t triangle, uint32_t other)
{
    const sp_ray *ray = &b->rays[b->ray[lane]];
    sp_search search = sp_search_start(ray, false);
    sp_line line;
    uint32_t candidates[2] = {triangle, other};
    bool good = sp_line_start(&line, ray);
    for (int i = 0; good && i < 2 && candidates[i] != SP_NONE; i++) {
        sp_corners corners;
        sp_bvh_corners(b->bvh, candidates[i], corners);
        sp_line_test(&line, (const double(*)[3])corners, candidates[i], &search);
    }
    return search.best;
}

void sp_bundle_settle(sp_bundle *b, int lane, uint32_t triangle)
{
    sp_hit hit = sp_bundle_ask(b, lane, triangle, b->triangle[lane]);
    if (hit.triangle == SP_NONE)
        return;
    float depth = (float)(hit.t * fabs(b->lines[b->ray[lane]].velocity[b->z]) * b->bvh->scale);
    b->triangle[lane] = hit.triangle;
    b->low[lane] = depth - SP_BVH_PAD;
    b->high[lane] = b->any ? -1 : depth + SP_BVH_PAD;
}

/* Where the origin is in the hierarchy's space; false where that is too far away. */
static bool place_origin(fan *f)
{
    double origin[3], reach = 0;
    sp_to_array(f->rays[0].origin, origin);
    for (int axis = 0; axis < 3; axis++) {
        double place = (origin[axis] - f->bvh->centre[axis]) * f->bvh->scale;
        f->origin[axis] = (float)place;
        reach = sp_greater(reach, fabs(place) + 1);
        if (!(fabs(place) <= NEAR_ENOUGH))
            return false;
    }
    f->blur = 13 * 0x1p-24f * (float)reach;
    return true;
}

void sp_fan_room_clear(sp_fan_room *room)
{
    free(room->lines);
    free(room->order);
    *room = (sp_fan_room){0};
}

static bool make_room(sp_fan_room *room, size_t count)
{
    if (count <= room->count)
        return true;
    sp_fan_room_clear(room);
    if (count > SIZE_MAX / (2 * sizeof(sp_fan_line)))
        return false;
    room->lines = aligned_alloc(alignof(sp_fan_line), count * sizeof *room->lines);
    room->order = malloc(2 * count * sizeof(sp_direction_entry));
    if (!room->lines || !room->order)
        return false;
    room->count = count;
    return true;
}

bool sp_fan_trace(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count, sp_fan_room *room,
                  sp_hit *hits, bool *occluded)
{
    static void (*const searches[])(sp_bundle *) = {sp_bundle_search_portable, sp_bundle_search_avx2,
                                                    sp_bundle_search_avx512};
    static void (*const answers[])(const sp_bundle *, sp_hit *) = {sp_bundle_answer_portable, sp_bundle_answer_avx2,
                                                                   sp_bundle_answer_avx512};
    fan f = {.bvh = bvh, .rays = rays, .count = count, .hits = hits};
    if (bvh->node_count == 0 || count == 0 || !place_origin(&f))
        return false;
    if (!make_room(room, count))
        return false;
    f.lines = room->lines;
    f.order[0] = room->order;
    f.order[1] = f.order[0] + count;
    if (!read_rays(&f))
        return false;
    sp_bundle bundle = {.bvh = bvh, .rays = rays, .lines = f.lines, .blur = f.blur, .any = !hits};
    for (size_t i = 0; i < count;) {
        i += fill_bundle(&f, i, &bundle);
        searches[instructions](&bundle);
        if (hits)
            answers[instructions](&bundle, hits);
        for (int k = 0; !hits && k < bundle.count; k++)
            occluded[bundle.ray[k]] = bundle.triangle[k] != SP_NONE;
    }
    return true;
}

bool sp_fan_stream(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count, sp_fan_room *room,
                   sp_hit *hits, bool *occluded)
{
    if (!make_room(room, count))
        return false;
    sp_direction_entry *order[2] = {room->order, (sp_direction_entry *)room->order + count};
    for (size_t i = 0; i < count; i++)
        order[0][i] = (sp_direction_entry){key_of(&rays[i]), (uint32_t)i};
    sp_direction_sort(order, count);
    sp_bvh_trace_lines(bvh, instructions, rays, order[0], count, hits, occluded);
    return true;
}
