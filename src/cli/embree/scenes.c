/* Scenes, and the module's one door. */
#include "rays.h"

#include "../../clock.h"

#include <pmmintrin.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xmmintrin.h>

static bool count_bytes(void *user, ssize_t bytes, bool after)
{
    (void)after;
    bench_embree_scene *scene = user;
    __atomic_fetch_add(&scene->bytes, bytes, __ATOMIC_RELAXED);
    return true;
}

static void scene_destroy(bench_embree_scene *scene)
{
    if (!scene)
        return;
    rtcReleaseScene(scene->scene);
    if (scene->device) {
        rtcSetDeviceMemoryMonitorFunction(scene->device, NULL, NULL);
        rtcReleaseDevice(scene->device);
    }
    free(scene);
}

static void commit(bench_embree_scene *built, const float *vertices, size_t vertex_count,
                   const uint32_t (*triangles)[3], size_t triangle_count, bool robust)
{
    RTCGeometry geometry = rtcNewGeometry(built->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, 0, 3 * sizeof(float),
                               vertex_count);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles, 0, sizeof *triangles,
                               triangle_count);
    rtcCommitGeometry(geometry);
    built->scene = rtcNewScene(built->device);
    if (robust)
        rtcSetSceneFlags(built->scene, RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(built->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(built->scene);
}

static bench_embree_scene *scene_create(const float *vertices, size_t vertex_count, const uint32_t (*triangles)[3],
                                        size_t triangle_count, bool robust, int threads, double *seconds)
{
    char settings[64];
    snprintf(settings, sizeof settings, "threads=%d,user_threads=0", threads);
    bench_embree_scene *built = calloc(1, sizeof *built);
    if (!built)
        return NULL;
    built->device = rtcNewDevice(settings);
    if (built->device) {
        rtcSetDeviceMemoryMonitorFunction(built->device, count_bytes, built);
        double start = sp_now();
        commit(built, vertices, vertex_count, triangles, triangle_count, robust);
        *seconds = sp_now() - start;
    }
    if (built->device && rtcGetDeviceError(built->device) == RTC_ERROR_NONE)
        return built;
    scene_destroy(built);
    return NULL;
}

static size_t scene_bytes(const bench_embree_scene *scene)
{
    return (size_t)scene->bytes;
}

static void work_destroy(bench_embree_work *work)
{
    if (!work)
        return;
    free(work->rays);
    free(work->triangles);
    free(work);
}

static bench_embree_work *work_create(const bench_embree_scene *scene, const bench_embree_task *task)
{
    bench_embree_work *work = calloc(1, sizeof *work);
    if (!work)
        return NULL;
    work->scene = scene->scene;
    work->task = *task;
    bool made;
    if (task->chords)
        made = (work->triangles = malloc((task->count + 1) * sizeof *work->triangles)) != NULL;
    else
        made = lines_create(work);
    if (made)
        return work;
    work_destroy(work);
    return NULL;
}

static void work_reset(bench_embree_work *work)
{
    if (work->task.chords)
        memset(work->triangles, 0xFF, work->task.count * sizeof *work->triangles);
    else
        lines_reset(work);
}

/* Embree's manual asks for denormals to be flushed; the caller's own arithmetic keeps them. */
static void work_run(bench_embree_work *work, size_t first, size_t count)
{
    unsigned before = _mm_getcsr();
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    if (work->task.chords)
        chords_run(work, first, count);
    else
        lines_run(work, first, count);
    _mm_setcsr(before);
}

static uint32_t work_triangle(const bench_embree_work *work, size_t i)
{
    return work->task.chords ? work->triangles[i] : lines_triangle(work, i);
}

__attribute__((visibility("default"))) const bench_embree *bench_embree_open(void);

const bench_embree *bench_embree_open(void)
{
    static const bench_embree embree = {
        .version = RTC_VERSION_STRING,
        .scene_create = scene_create,
        .scene_destroy = scene_destroy,
        .scene_bytes = scene_bytes,
        .work_create = work_create,
        .work_destroy = work_destroy,
        .work_reset = work_reset,
        .work_run = work_run,
        .work_triangle = work_triangle,
    };
    return &embree;
}
