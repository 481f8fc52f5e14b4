/* What one point can reach at one speed: the flights to every patch, less those that something blocks. */
#include "reach.h"

#include "ray_queue.h"
#include "free_share.h"
#include "movers.h"
#include "passing.h"
#include "team.h"

#include <stdlib.h>
#include <string.h>

/* Patches whose flights are traced together: the tracer likes many of one origin, and threads like some chunks each. */
#define CHUNKS 2 /* for every thread */
#define CHUNK_LEAST 512
#define CHUNK_MOST 4096
#define CHUNK_DRAG 256 /* with drag, where each is traced for itself */
#define WATCHED_SLOW 4 /* patches in place of SP_WATCHED, with drag and of goods that move */

static void gather(const sp_source *source, const sp_aim *aim, uint32_t patch, sp_ray_queue *queue)
{
    const sp_evaluator *evaluator = source->evaluator;
    if ((aim->known && !(aim->known[patch / 4] >> 2 * (patch % 4) & 3)) || (aim->among && !aim->among[patch]))
        return;
    sp_gathering own = {.source = *source, .aim = aim, .patch = patch, .queue = queue, .share = 1};
    sp_target target = sp_patch_target(evaluator, patch);
    if (evaluator->movers && sp_motion_of(evaluator, target.triangle) == SP_MOVING)
        sp_gather_passing(&own, &target);
    else
        sp_gather_flights(&own, &target);
}

/* A chunk's arrivals, malloc'd; NULL where there are none. */
typedef struct harvest {
    size_t count;
    sp_arrival *arrivals;
    sp_work work;
    bool failed; /* memory ran out, or it was stopped */
} harvest;

/* What is in the way of the queue's rays, of what stands. */
static void trace(const sp_source *source, sp_ray_queue *queue)
{
    const sp_evaluator *evaluator = source->evaluator;
    const sp_movers *movers = evaluator->movers;
    for (size_t i = 0; movers && i < queue->ray_count; i++) {
        uint32_t target = queue->passing[i].target;
        queue->rays[i].skip = sp_motion_of(evaluator, target) == SP_STANDING ? movers->own[target] : SP_NONE;
    }
    sp_trace_occluded_many(movers ? movers->tracer[SP_STANDING] : evaluator->tracer, queue->rays, queue->ray_count,
                           source->gravity, 1, queue->blocked);
}

/* The flights to patches first to end, as far as they may go on. */
static bool gather_all(const sp_source *source, const sp_aim *aim, uint32_t first, uint32_t end, sp_ray_queue *queue)
{
    uint32_t step = source->fronts || source->evaluator->movers ? WATCHED_SLOW : SP_WATCHED;
    for (uint32_t next = first; first < end; first = next) {
        next = end - first < step ? end : first + step;
        for (uint32_t patch = first; patch < next; patch++)
            gather(source, aim, patch, queue);
        if (aim->watch && !sp_watch_goes_on(aim->watch, next - first))
            return false;
    }
    return !queue->failed;
}

/* The arrivals at patches first to end; false where memory ran out, or it was stopped. */
static bool reap(const sp_source *source, const sp_aim *aim, uint32_t first, uint32_t end, sp_ray_queue *queue,
                 harvest *harvest)
{
    queue->count = queue->ray_count = queue->places = queue->ways = 0;
    if (!queue->shaded)
        queue->shaded = malloc(source->evaluator->positions * sizeof *queue->shaded);
    if (!queue->shaded || !sp_ray_queue_make_room(queue, 2 * (size_t)(end - first)))
        return false;
    if (!gather_all(source, aim, first, end, queue))
        return false;
    trace(source, queue);
    size_t kept = 0;
    for (size_t i = 0, ray = 0; i < queue->count; i++) {
        sp_arrival *arrival = &queue->arrivals[i];
        bool traced = !source->fronts && sp_way_is_traced(source->evaluator, aim, arrival->part);
        if (traced && source->evaluator->movers && !queue->blocked[ray])
            arrival->part *= sp_ray_free_share(source, queue, arrival->patch, ray);
        if (traced && (queue->blocked[ray++] || !(arrival->part > 0)))
            arrival->blocked = true;
        if (!arrival->blocked || aim->blocked)
            queue->arrivals[kept++] = *arrival;
    }
    *harvest = (struct harvest){.count = kept,
                                .arrivals = kept ? malloc(kept * sizeof *harvest->arrivals) : NULL,
                                .work = {queue->places, queue->ways}};
    if (harvest->arrivals)
        memcpy(harvest->arrivals, queue->arrivals, kept * sizeof *harvest->arrivals);
    return harvest->arrivals || !kept;
}

/* The patches that are asked for: how many, and into how many chunks they fall. */
typedef struct {
    size_t first, count, chunk, chunks;
} extent;

static extent extent_of(const sp_source *source, const sp_aim *aim)
{
    size_t patches = source->evaluator->patches.count, end = aim->end < patches ? aim->end : patches;
    size_t count = aim->first < end ? end - aim->first : 0;
    size_t chunks = CHUNKS * (size_t)sp_thread_count(source->evaluator->setup.run.threads), chunk = count / chunks + 1;
    if (source->fronts)
        chunk = CHUNK_DRAG;
    else if (chunk < CHUNK_LEAST)
        chunk = CHUNK_LEAST;
    else if (chunk > CHUNK_MOST)
        chunk = CHUNK_MOST;
    return (extent){aim->first, count, chunk, (count + chunk - 1) / chunk};
}

/* What all threads that trace share. */
typedef struct {
    const sp_source *source;
    const sp_aim *aim;
    extent extent;
    sp_ray_queue *queues; /* by thread */
    harvest *harvests;    /* by chunk */
} reaping;

static void reap_chunk(void *user, size_t chunk)
{
    const reaping *own = user;
    const extent *extent = &own->extent;
    size_t first = chunk * extent->chunk, end = first + extent->chunk;
    end = end < extent->count ? end : extent->count;
    own->harvests[chunk].failed =
        !reap(own->source, own->aim, (uint32_t)(extent->first + first), (uint32_t)(extent->first + end),
              &own->queues[omp_get_thread_num()], &own->harvests[chunk]);
}

static bool reap_all(const sp_source *source, const sp_aim *aim, extent extent, harvest *harvests)
{
    int threads = sp_thread_count(source->evaluator->setup.run.threads), size = sp_team_size(extent.chunks, threads);
    reaping reaping = {source, aim, extent, calloc((size_t)size, sizeof *reaping.queues), harvests};
    if (!reaping.queues)
        return false;
    sp_team_do(extent.chunks, threads, reap_chunk, &reaping);
    for (int i = 0; i < size; i++)
        sp_ray_queue_free(&reaping.queues[i]);
    free(reaping.queues);
    bool done = true;
    for (size_t i = 0; i < extent.chunks; i++)
        done = done && !harvests[i].failed;
    return done;
}

sp_reach *sp_reach_create(const sp_source *source, const sp_aim *aim, sp_error *error)
{
    extent extent = extent_of(source, aim);
    harvest *harvests = calloc(extent.chunks + 1, sizeof *harvests);
    sp_reach *reach = calloc(1, sizeof *reach);
    bool done = harvests && reach && reap_all(source, aim, extent, harvests);
    for (size_t i = 0; done && i < extent.chunks; i++) {
        reach->count += harvests[i].count;
        reach->work.places += harvests[i].work.places;
        reach->work.rays += harvests[i].work.rays;
    }
    if (done)
        reach->arrivals = malloc((reach->count ? reach->count : 1) * sizeof *reach->arrivals);
    done = done && reach->arrivals;
    for (size_t i = 0, at = 0; harvests && i < extent.chunks; i++) {
        if (done && harvests[i].count)
            memcpy(&reach->arrivals[at], harvests[i].arrivals, harvests[i].count * sizeof *reach->arrivals);
        at += harvests[i].count;
        free(harvests[i].arrivals);
    }
    free(harvests);
    if (done)
        return reach;
    sp_reach_destroy(reach);
    return sp_watch_fail(aim->watch, error);
}

/* Where it is known how what leaves flies; else false, with an error. */
static bool source_of(const sp_evaluator *evaluator, sp_vec3 position, sp_launch launch, sp_source *source,
                      sp_error *error)
{
    if (!evaluator)
        return false;
    bool drag = sp_trajectory_of(evaluator, launch.trajectory) == SP_TRAJECTORY_DRAG;
    *source = (sp_source){evaluator, position, launch.speed, launch.fronts, sp_evaluator_gravity(evaluator, &launch)};
    return drag == (launch.fronts != NULL) || !(launch.speed > 0) ||
           sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "trajectory: %s drag found, and a launch %s",
                   drag ? "with" : "without", drag ? "without fronts" : "with fronts");
}

sp_reach *sp_evaluator_reach(const sp_evaluator *evaluator, sp_vec3 position, sp_launch launch, sp_vec3 axis,
                             double half_angle, sp_error *error)
{
    sp_source source;
    sp_aim aim = sp_aim_at(axis, half_angle);
    return source_of(evaluator, position, launch, &source, error) ? sp_reach_create(&source, &aim, error) : NULL;
}

sp_reach *sp_evaluator_reach_passing(const sp_evaluator *evaluator, sp_vec3 position, sp_launch launch, sp_vec3 axis,
                                     double half_angle, const bool *among, sp_error *error)
{
    sp_source source;
    sp_aim aim = sp_aim_at(axis, half_angle);
    aim.passing = true;
    aim.among = among;
    return source_of(evaluator, position, launch, &source, error) ? sp_reach_create(&source, &aim, error) : NULL;
}

sp_reach *sp_evaluator_reach_part(const sp_evaluator *evaluator, sp_vec3 position, sp_launch launch, sp_vec3 axis,
                                  double half_angle, size_t first, size_t end, const uint8_t *known, sp_error *error)
{
    sp_source source;
    sp_aim aim = sp_aim_at(axis, half_angle);
    aim.passing = evaluator && !evaluator->everything;
    aim.first = first;
    aim.end = end;
    aim.known = known;
    return source_of(evaluator, position, launch, &source, error) ? sp_reach_create(&source, &aim, error) : NULL;
}

void sp_reach_destroy(sp_reach *reach)
{
    if (!reach)
        return;
    free(reach->arrivals);
    free(reach);
}
