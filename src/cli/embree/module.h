/* What the bench command asks of Embree. The module that answers is built where Embree 3 is found, opened at run time
 * from the folder of the program, and is no part of what is installed: the product neither needs nor links Embree. */
#ifndef CLI_EMBREE_MODULE_H
#define CLI_EMBREE_MODULE_H

#include <sprayplan/trace.h>

typedef struct bench_embree_scene bench_embree_scene;
typedef struct bench_embree_work bench_embree_work;

typedef enum {
    BENCH_EMBREE_SINGLE,   /* rtcIntersect1, rtcOccluded1 */
    BENCH_EMBREE_PACKET16, /* rtcIntersect16, rtcOccluded16 */
    BENCH_EMBREE_STREAM,   /* rtcIntersect1M, rtcOccluded1M */
    BENCH_EMBREE_STREAM16, /* rtcIntersectNM, rtcOccludedNM with packets of 16 */
} bench_embree_variant;

/* Rays are borrowed and must outlive the work made of them. */
typedef struct {
    bench_embree_variant variant; /* single or packet16 for chords */
    bool occluded;                /* any hit, not the nearest */
    bool coherent;                /* what Embree is told of the rays */
    const sp_ray *rays;           /* [count] */
    size_t count;
    int chords;              /* 0: the rays are lines */
    sp_vec3 gravity;         /* of the parabolas that are cut into chords, m/s² */
    const double (*span)[2]; /* [count], s: from when to when each parabola is followed; chords only */
} bench_embree_task;

typedef struct {
    const char *version;
    /* Builds at Embree's default quality and says how long that took, s, without starting the device and its threads;
     * `vertices` [3 vertex_count + 1] and `triangles` are borrowed. NULL where it fails. */
    bench_embree_scene *(*scene_create)(const float *vertices, size_t vertex_count, const uint32_t (*triangles)[3],
                                        size_t triangle_count, bool robust, int threads, double *seconds);
    void (*scene_destroy)(bench_embree_scene *scene);
    /* Bytes held besides the mesh, as Embree's memory monitor counts them. */
    size_t (*scene_bytes)(const bench_embree_scene *scene);
    /* Rays as Embree wants them, in memory of their own; NULL where there is none. */
    bench_embree_work *(*work_create)(const bench_embree_scene *scene, const bench_embree_task *task);
    void (*work_destroy)(bench_embree_work *work);
    /* Forgets all answers; to be called before each run. */
    void (*work_reset)(bench_embree_work *work);
    /* Traces rays [first, first + count), first a multiple of 16; ranges that do not touch may run in parallel. */
    void (*work_run)(bench_embree_work *work, size_t first, size_t count);
    /* What ray i has hit, SP_NONE for nothing; for `occluded` any other number. */
    uint32_t (*work_triangle)(const bench_embree_work *work, size_t i);
} bench_embree;

/* The one function of the module, named "bench_embree_open". */
typedef const bench_embree *bench_embree_open_function(void);

#endif
