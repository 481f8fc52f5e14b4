/* Rays in Embree's own layouts. */
#ifndef CLI_EMBREE_RAYS_H
#define CLI_EMBREE_RAYS_H

#include "module.h"

#include <embree3/rtcore.h>

enum { LANES = 16 };

struct bench_embree_scene {
    RTCDevice device;
    RTCScene scene;
    ssize_t bytes;
};

struct bench_embree_work {
    RTCScene scene;
    bench_embree_task task;
    void *rays;          /* RTCRayHit, RTCRay, RTCRayHit16 or RTCRay16; none for chords */
    uint32_t *triangles; /* [count], the answers of chords */
};

static inline struct RTCIntersectContext start_context(const bench_embree_task *task)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = task->coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

/* lines.c */
bool lines_create(bench_embree_work *work);
void lines_reset(bench_embree_work *work);
void lines_run(bench_embree_work *work, size_t first, size_t count);
uint32_t lines_triangle(const bench_embree_work *work, size_t i);

/* chords.c */
void chords_run(bench_embree_work *work, size_t first, size_t count);

#endif
