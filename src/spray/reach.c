/* What one point can reach at one speed: the flights to every patch, less those that something blocks. */
#include "reach.h"

#include "near.h"
#include "spray/drag/fronts.h"

#include <stdlib.h>
#include <string.h>

#define CHUNK 4096 /* patches whose flights are traced together: the tracer likes many of one origin */

sp_aim sp_aim_at(sp_vec3 axis, double half_angle)
{
    return (sp_aim){.axis = axis,
                    .half_angle = half_angle,
                    .cosine = half_angle < M_PI ? cos(half_angle) - 1e-12 : -2,
                    .end = SIZE_MAX};
}

/* Flights that pass all questions but whether their way is free. */
typedef struct flock {
    size_t count, capacity;
    sp_arrival *arrivals; /* [capacity], as what follows */
    size_t ray_count;
    sp_ray *rays; /* of those whose way is not known yet */
    bool *blocked;
    size_t places; /* that flights were solved for */
    size_t ways;   /* that were looked along, with drag one by one */
    bool failed;   /* for want of memory */
} flock;

static bool make_room(flock *flock, size_t more)
{
    if (flock->count + more <= flock->capacity)
        return true;
    size_t capacity = flock->count + more > 2 * flock->capacity ? flock->count + more : 2 * flock->capacity;
    sp_arrival *arrivals = realloc(flock->arrivals, capacity * sizeof *arrivals);
    flock->arrivals = arrivals ? arrivals : flock->arrivals;
    sp_ray *rays = realloc(flock->rays, capacity * sizeof *rays);
    flock->rays = rays ? rays : flock->rays;
    bool *blocked = realloc(flock->blocked, capacity * sizeof *blocked);
    flock->blocked = blocked ? blocked : flock->blocked;
    flock->failed = flock->failed || !arrivals || !rays || !blocked;
    flock->capacity = flock->failed ? flock->capacity : capacity;
    return !flock->failed;
}

static void flock_free(flock *flock)
{
    free(flock->arrivals);
    free(flock->rays);
    free(flock->blocked);
}

/* Within the cone, a hair wider than asked, so that round-off never takes a jet of the edge away; or not farther
 * beyond than a patch's share may lie. */
static bool aimed(const sp_aim *aim, const sp_arrival *arrival)
{
    double along = sp_dot(arrival->direction, aim->axis);
    if (along < aim->cosine) {
        double most = aim->half_angle + sp_spray_fringe(arrival->breadth);
        if (most < M_PI && along < cos(most))
            return false;
    }
    return !aim->emitter || sp_emitter_share(aim->emitter, arrival) > 0 ||
           sp_emitter_holds(aim->emitter, arrival->direction);
}

/* The flight as it leaves on one of four sides of itself. */
static sp_flight flight_beside(sp_flight flight, unsigned side)
{
    sp_vec3 own = flight.direction, other = fabs(own.x) < 0.6 ? sp_v(1, 0, 0) : sp_v(0, 1, 0);
    sp_vec3 across = sp_unit(sp_cross(own, other));
    if (side > 2)
        across = sp_cross(own, across);
    flight.direction = sp_unit(sp_along(own, side % 2 ? SP_BESIDE : -SP_BESIDE, across));
    return flight;
}

/* One patch while its flights are gathered. */
typedef struct {
    const sp_source *source;
    const sp_aim *aim;
    uint32_t patch;
    flock *flock;
} gathering;

/* These flights to a patch, or to a cell that is `part` of it. */
static void take(const gathering *own, const sp_target *target, const sp_flight *flights, int count, double part)
{
    const sp_source *source = own->source;
    const sp_aim *aim = own->aim;
    flock *flock = own->flock;
    if (!make_room(flock, 2))
        return;
    flock->places++;
    for (int k = 0; k < count; k++) {
        sp_arrival *arrival = &flock->arrivals[flock->count];
        size_t bit = 2 * (size_t)own->patch + (size_t)k;
        bool traced = !aim->known || part < 1;
        if (aim->known && !(aim->known[bit / 8] >> bit % 8 & 1))
            continue;
        if (!sp_arrive(source, target, &flights[k], arrival) || (aim->passing && !arrival->passes))
            continue;
        arrival->breadth = sp_flight_breadth(&flights[k], target->length);
        sp_flight way = aim->beside ? flight_beside(flights[k], aim->beside) : flights[k];
        if (!aimed(aim, arrival))
            continue;
        arrival->blocked = traced && (source->fronts ? sp_flight_is_blocked(source, target, &way)
                                                     : sp_flight_pierces(source, target, &way));
        if (arrival->blocked && !aim->blocked)
            continue;
        arrival->patch = own->patch;
        arrival->arc = (uint8_t)k;
        arrival->part = part;
        flock->count++;
        flock->ways += traced;
        if (traced && !source->fronts)
            flock->rays[flock->ray_count++] = sp_flight_ray(source, target, &way);
    }
}

/* All flights there. */
static void gather_at(void *user, const sp_target *target, double part)
{
    const gathering *own = user;
    sp_flight flights[2];
    take(own, target, flights, sp_source_flights(own->source, target->point, flights), part);
}

static void cut(gathering *own)
{
    const sp_aim *aim = own->aim;
    if (!sp_patch_cut(own->source, own->patch, aim->axis, aim->half_angle + sp_spray_fringe(SP_BREADTH_MOST), gather_at,
                      own))
        own->flock->failed = true;
}

/* With drag finding the flights is what takes long. */
static void gather_with_drag(gathering *own, const sp_target *target)
{
    const sp_source *source = own->source;
    sp_flight flights[2];
    double margin;
    int count = sp_fronts_reach(source->fronts, source->position, target->point, flights, &margin);
    if (sp_target_is_near_by(source, target, flights, count, margin))
        cut(own);
    else
        take(own, target, flights, count, 1);
}

static void gather(const sp_source *source, const sp_aim *aim, uint32_t patch, flock *flock)
{
    if ((aim->known && !(aim->known[patch / 4] >> 2 * (patch % 4) & 3)) || (aim->among && !aim->among[patch]))
        return;
    gathering own = {source, aim, patch, flock};
    sp_target target = sp_patch_target(source->evaluator, patch);
    if (source->fronts)
        gather_with_drag(&own, &target);
    else if (!sp_target_is_near(source, &target))
        gather_at(&own, &target, 1);
    else
        cut(&own);
}

/* A chunk's arrivals, malloc'd; NULL where there are none, or where memory ran out. */
typedef struct harvest {
    size_t count;
    sp_arrival *arrivals;
    sp_work work;
} harvest;

/* The arrivals at patches first to end; false where memory ran out. */
static bool reap(const sp_source *source, const sp_aim *aim, uint32_t first, uint32_t end, flock *flock,
                 harvest *harvest)
{
    flock->count = flock->ray_count = flock->places = flock->ways = 0;
    if (!make_room(flock, 2 * (size_t)(end - first)))
        return false;
    for (uint32_t patch = first; patch < end; patch++)
        gather(source, aim, patch, flock);
    if (flock->failed)
        return false;
    sp_trace_occluded_many(source->evaluator->tracer, flock->rays, flock->ray_count, source->evaluator->gravity, 1,
                           flock->blocked);
    size_t kept = 0;
    for (size_t i = 0, ray = 0; i < flock->count; i++) {
        sp_arrival *arrival = &flock->arrivals[i];
        bool traced = !source->fronts && (!aim->known || arrival->part < 1);
        if (traced && flock->blocked[ray++])
            arrival->blocked = true;
        if (!arrival->blocked || aim->blocked)
            flock->arrivals[kept++] = *arrival;
    }
    *harvest =
        (struct harvest){kept, kept ? malloc(kept * sizeof *harvest->arrivals) : NULL, {flock->places, flock->ways}};
    if (harvest->arrivals)
        memcpy(harvest->arrivals, flock->arrivals, kept * sizeof *harvest->arrivals);
    return harvest->arrivals || !kept;
}

/* The patches that are asked for: how many, and into how many chunks they fall. */
typedef struct {
    size_t first, count, chunks;
} extent;

static extent extent_of(const sp_source *source, const sp_aim *aim)
{
    size_t patches = source->evaluator->patches.count, end = aim->end < patches ? aim->end : patches;
    size_t count = aim->first < end ? end - aim->first : 0;
    return (extent){aim->first, count, (count + CHUNK - 1) / CHUNK};
}

static bool reap_all(const sp_source *source, const sp_aim *aim, extent extent, harvest *harvests)
{
    int threads = omp_in_parallel() ? 1 : sp_thread_count(source->evaluator->setup.run.threads);
    if ((size_t)threads > extent.chunks)
        threads = extent.chunks ? (int)extent.chunks : 1;
    flock *flocks = calloc((size_t)threads, sizeof *flocks);
    bool done = flocks != NULL;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) reduction(&& : done)
    for (size_t i = 0; i < extent.chunks; i++) {
        size_t first = i * CHUNK, end = first + CHUNK < extent.count ? first + CHUNK : extent.count;
        done = done && reap(source, aim, (uint32_t)(extent.first + first), (uint32_t)(extent.first + end),
                            &flocks[omp_get_thread_num()], &harvests[i]);
    }
    for (int i = 0; flocks && i < threads; i++)
        flock_free(&flocks[i]);
    free(flocks);
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
    return sp_fail_memory(error);
}

/* False, with an error: here nothing says what drops they are. */
static bool flies_free(const sp_evaluator *evaluator, sp_error *error)
{
    return evaluator && (evaluator->fidelity.trajectory != SP_TRAJECTORY_DRAG ||
                         sp_fail(error, SP_ERROR_UNSUPPORTED, NULL, 0, 0,
                                 "trajectory: drag found, of which reach knows nothing yet"));
}

sp_reach *sp_evaluator_reach(const sp_evaluator *evaluator, sp_vec3 position, double speed, sp_vec3 axis,
                             double half_angle, sp_error *error)
{
    sp_source source = {evaluator, position, speed, NULL};
    sp_aim aim = sp_aim_at(axis, half_angle);
    return flies_free(evaluator, error) ? sp_reach_create(&source, &aim, error) : NULL;
}

sp_reach *sp_evaluator_reach_passing(const sp_evaluator *evaluator, sp_vec3 position, double speed, sp_vec3 axis,
                                     double half_angle, const bool *among, sp_error *error)
{
    sp_source source = {evaluator, position, speed, NULL};
    sp_aim aim = sp_aim_at(axis, half_angle);
    aim.passing = true;
    aim.among = among;
    return flies_free(evaluator, error) ? sp_reach_create(&source, &aim, error) : NULL;
}

sp_reach *sp_evaluator_reach_part(const sp_evaluator *evaluator, sp_vec3 position, double speed, sp_vec3 axis,
                                  double half_angle, size_t first, size_t end, const uint8_t *known, sp_error *error)
{
    sp_source source = {evaluator, position, speed, NULL};
    sp_aim aim = sp_aim_at(axis, half_angle);
    aim.passing = evaluator && !evaluator->everything;
    aim.first = first;
    aim.end = end;
    aim.known = known;
    return flies_free(evaluator, error) ? sp_reach_create(&source, &aim, error) : NULL;
}

void sp_reach_destroy(sp_reach *reach)
{
    if (!reach)
        return;
    free(reach->arrivals);
    free(reach);
}
