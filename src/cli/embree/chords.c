/* Parabolas as a user of Embree must trace them: cut into chords of equal time, followed until one hits. */
#include "rays.h"

/* Where parabola i is after `step` of its chords. */
static sp_vec3 joint(const bench_embree_task *task, size_t i, int step)
{
    const double *span = task->span[i];
    double share = (double)step / task->chords;
    return sp_ray_point(&task->rays[i], task->gravity, span[0] + share * (span[1] - span[0]));
}

static bool has_chords(const bench_embree_task *task, size_t i)
{
    return task->span[i][0] < task->span[i][1];
}

static struct RTCRay chord(sp_vec3 from, sp_vec3 to)
{
    /* Joints are rounded before they are subtracted, so that each chord ends where the next begins. */
    float x = (float)from.x, y = (float)from.y, z = (float)from.z;
    return (struct RTCRay){.org_x = x,
                           .org_y = y,
                           .org_z = z,
                           .dir_x = (float)to.x - x,
                           .dir_y = (float)to.y - y,
                           .dir_z = (float)to.z - z,
                           .tfar = 1,
                           .mask = ~0u};
}

static uint32_t follow(const bench_embree_work *work, struct RTCIntersectContext *context, size_t i)
{
    const bench_embree_task *task = &work->task;
    if (!has_chords(task, i))
        return SP_NONE;
    sp_vec3 from = joint(task, i, 0);
    for (int step = 1; step <= task->chords; step++) {
        sp_vec3 to = joint(task, i, step);
        struct RTCRayHit both = {.ray = chord(from, to), .hit.geomID = RTC_INVALID_GEOMETRY_ID};
        both.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        from = to;
        if (task->occluded) {
            rtcOccluded1(work->scene, context, &both.ray);
            if (both.ray.tfar < 0)
                return 0;
        } else {
            rtcIntersect1(work->scene, context, &both);
            if (both.hit.geomID != RTC_INVALID_GEOMETRY_ID)
                return both.hit.primID;
        }
    }
    return SP_NONE;
}

static void set_lane(struct RTCRay16 *rays, int lane, const struct RTCRay *ray)
{
    rays->org_x[lane] = ray->org_x;
    rays->org_y[lane] = ray->org_y;
    rays->org_z[lane] = ray->org_z;
    rays->tnear[lane] = 0;
    rays->dir_x[lane] = ray->dir_x;
    rays->dir_y[lane] = ray->dir_y;
    rays->dir_z[lane] = ray->dir_z;
    rays->time[lane] = 0;
    rays->tfar[lane] = 1;
    rays->mask[lane] = ~0u;
    rays->id[lane] = (unsigned)lane;
    rays->flags[lane] = 0;
}

/* One step of those of 16 parabolas that have not hit yet; true while there are any. */
static bool step_packet(bench_embree_work *work, struct RTCIntersectContext *context, size_t first, int step,
                        sp_vec3 from[LANES], int valid[LANES])
{
    const bench_embree_task *task = &work->task;
    struct RTCRayHit16 both;
    bool going = false;
    for (int lane = 0; lane < LANES; lane++) {
        size_t i = first + (size_t)lane;
        both.hit.geomID[lane] = both.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        sp_vec3 to = valid[lane] ? joint(task, i, step) : sp_v(1, 0, 0);
        struct RTCRay ray = chord(from[lane], to);
        set_lane(&both.ray, lane, &ray);
        from[lane] = to;
    }
    if (task->occluded)
        rtcOccluded16(valid, work->scene, context, &both.ray);
    else
        rtcIntersect16(valid, work->scene, context, &both);
    for (int lane = 0; lane < LANES; lane++) {
        bool hit = task->occluded ? both.ray.tfar[lane] < 0 : both.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
        if (valid[lane] && hit) {
            work->triangles[first + (size_t)lane] = task->occluded ? 0 : both.hit.primID[lane];
            valid[lane] = 0;
        }
        going |= valid[lane] != 0;
    }
    return going;
}

static void follow_packet(bench_embree_work *work, struct RTCIntersectContext *context, size_t first, size_t count)
{
    _Alignas(64) int valid[LANES];
    sp_vec3 from[LANES];
    for (int lane = 0; lane < LANES; lane++) {
        valid[lane] = (size_t)lane < count && has_chords(&work->task, first + (size_t)lane) ? -1 : 0;
        from[lane] = valid[lane] ? joint(&work->task, first + (size_t)lane, 0) : sp_v(0, 0, 0);
    }
    for (int step = 1; step <= work->task.chords; step++)
        if (!step_packet(work, context, first, step, from, valid))
            return;
}

void chords_run(bench_embree_work *work, size_t first, size_t count)
{
    struct RTCIntersectContext context = start_context(&work->task);
    if (work->task.variant == BENCH_EMBREE_SINGLE)
        for (size_t i = first; i < first + count; i++)
            work->triangles[i] = follow(work, &context, i);
    else
        for (size_t i = first; i < first + count; i += LANES)
            follow_packet(work, &context, i, first + count - i < LANES ? first + count - i : LANES);
}
