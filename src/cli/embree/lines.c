/* Lines: one by one, in packets of 16, in streams. */
#include "rays.h"

#include <stdlib.h>
#include <string.h>

static bool in_packets(const bench_embree_task *task)
{
    return task->variant == BENCH_EMBREE_PACKET16 || task->variant == BENCH_EMBREE_STREAM16;
}

/* Bytes of one ray, or of one packet. */
static size_t item_size(const bench_embree_task *task)
{
    if (in_packets(task))
        return task->occluded ? sizeof(struct RTCRay16) : sizeof(struct RTCRayHit16);
    return task->occluded ? sizeof(struct RTCRay) : sizeof(struct RTCRayHit);
}

static size_t item_count(const bench_embree_task *task)
{
    return in_packets(task) ? (task->count + LANES - 1) / LANES : task->count;
}

bool lines_create(bench_embree_work *work)
{
    size_t bytes = (item_count(&work->task) + 1) * item_size(&work->task);
    work->rays = aligned_alloc(64, (bytes + 63) / 64 * 64);
    return work->rays != NULL;
}

static void *item(const bench_embree_work *work, size_t i)
{
    return (char *)work->rays + i * item_size(&work->task);
}

static void set_ray(struct RTCRay *to, const sp_ray *ray, size_t i)
{
    *to = (struct RTCRay){.org_x = (float)ray->origin.x,
                          .org_y = (float)ray->origin.y,
                          .org_z = (float)ray->origin.z,
                          .tnear = (float)ray->t_min,
                          .dir_x = (float)ray->velocity.x,
                          .dir_y = (float)ray->velocity.y,
                          .dir_z = (float)ray->velocity.z,
                          .tfar = (float)ray->t_max,
                          .mask = ~0u,
                          .id = (unsigned)i};
}

static void set_lane(struct RTCRay16 *to, int lane, const sp_ray *ray, size_t i)
{
    to->org_x[lane] = (float)ray->origin.x;
    to->org_y[lane] = (float)ray->origin.y;
    to->org_z[lane] = (float)ray->origin.z;
    to->tnear[lane] = (float)ray->t_min;
    to->dir_x[lane] = (float)ray->velocity.x;
    to->dir_y[lane] = (float)ray->velocity.y;
    to->dir_z[lane] = (float)ray->velocity.z;
    to->time[lane] = 0;
    to->tfar[lane] = (float)ray->t_max;
    to->mask[lane] = ~0u;
    to->id[lane] = (unsigned)i;
    to->flags[lane] = 0;
}

static void reset_packet(bench_embree_work *work, size_t packet)
{
    const bench_embree_task *task = &work->task;
    struct RTCRay16 *rays = item(work, packet); /* the rays stand first in RTCRayHit16, too */
    for (int lane = 0; lane < LANES; lane++) {
        size_t i = packet * LANES + (size_t)lane;
        set_lane(rays, lane, &task->rays[i < task->count ? i : task->count - 1], i);
        if (i >= task->count) { /* an empty lane, as Embree wants it */
            rays->tnear[lane] = INFINITY;
            rays->tfar[lane] = -INFINITY;
        }
    }
    if (task->occluded)
        return;
    struct RTCRayHit16 *both = item(work, packet);
    memset(both->hit.geomID, 0xFF, sizeof both->hit.geomID);
    memset(both->hit.instID, 0xFF, sizeof both->hit.instID);
}

void lines_reset(bench_embree_work *work)
{
    const bench_embree_task *task = &work->task;
    for (size_t i = 0; i < item_count(task); i++) {
        if (in_packets(task)) {
            reset_packet(work, i);
            continue;
        }
        set_ray(item(work, i), &task->rays[i], i); /* the ray stands first in RTCRayHit, too */
        if (task->occluded)
            continue;
        struct RTCRayHit *both = item(work, i);
        both->hit.geomID = RTC_INVALID_GEOMETRY_ID;
        both->hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
}

static void run_single(bench_embree_work *work, struct RTCIntersectContext *context, size_t first, size_t count)
{
    if (work->task.occluded) {
        struct RTCRay *rays = work->rays;
        for (size_t i = first; i < first + count; i++)
            rtcOccluded1(work->scene, context, &rays[i]);
    } else {
        struct RTCRayHit *rays = work->rays;
        for (size_t i = first; i < first + count; i++)
            rtcIntersect1(work->scene, context, &rays[i]);
    }
}

static void run_packets(bench_embree_work *work, struct RTCIntersectContext *context, size_t first, size_t count)
{
    _Alignas(64) int valid[LANES];
    for (size_t i = first; i < first + count; i += LANES) {
        for (int lane = 0; lane < LANES; lane++)
            valid[lane] = i + (size_t)lane < first + count ? -1 : 0;
        if (work->task.occluded)
            rtcOccluded16(valid, work->scene, context, item(work, i / LANES));
        else
            rtcIntersect16(valid, work->scene, context, item(work, i / LANES));
    }
}

/* As many rays at once as a cache of the first level holds twice; longer streams were no faster. */
enum { STREAM = 1024 };

static void run_streams(bench_embree_work *work, struct RTCIntersectContext *context, size_t first, size_t count)
{
    const bench_embree_task *task = &work->task;
    size_t size = item_size(task), end = first + count;
    for (size_t i = first; i < end; i += STREAM) {
        unsigned rays = end - i < STREAM ? (unsigned)(end - i) : STREAM;
        if (in_packets(task)) {
            void *packets = item(work, i / LANES);
            unsigned length = (rays + LANES - 1) / LANES;
            if (task->occluded)
                rtcOccludedNM(work->scene, context, packets, LANES, length, size);
            else
                rtcIntersectNM(work->scene, context, packets, LANES, length, size);
        } else if (task->occluded) {
            rtcOccluded1M(work->scene, context, item(work, i), rays, size);
        } else {
            rtcIntersect1M(work->scene, context, item(work, i), rays, size);
        }
    }
}

void lines_run(bench_embree_work *work, size_t first, size_t count)
{
    struct RTCIntersectContext context = start_context(&work->task);
    switch (work->task.variant) {
    case BENCH_EMBREE_SINGLE:
        run_single(work, &context, first, count);
        break;
    case BENCH_EMBREE_PACKET16:
        run_packets(work, &context, first, count);
        break;
    case BENCH_EMBREE_STREAM:
    case BENCH_EMBREE_STREAM16:
        run_streams(work, &context, first, count);
        break;
    }
}

uint32_t lines_triangle(const bench_embree_work *work, size_t i)
{
    const bench_embree_task *task = &work->task;
    if (in_packets(task)) {
        if (task->occluded)
            return ((const struct RTCRay16 *)work->rays)[i / LANES].tfar[i % LANES] < 0 ? 0 : SP_NONE;
        const struct RTCHit16 *hit = &((const struct RTCRayHit16 *)work->rays)[i / LANES].hit;
        return hit->geomID[i % LANES] == RTC_INVALID_GEOMETRY_ID ? SP_NONE : hit->primID[i % LANES];
    }
    if (task->occluded)
        return ((const struct RTCRay *)work->rays)[i].tfar < 0 ? 0 : SP_NONE;
    const struct RTCHit *hit = &((const struct RTCRayHit *)work->rays)[i].hit;
    return hit->geomID == RTC_INVALID_GEOMETRY_ID ? SP_NONE : hit->primID;
}
