/* What one point can reach at one speed: the flights to every patch, less those that something blocks. */
#include "reach.h"

#include "aside.h"
#include "movers.h"
#include "near.h"
#include "spray/drag/fronts.h"

#include <stdlib.h>
#include <string.h>

#define CHUNK 4096 /* patches whose flights are traced together: the tracer likes many of one origin */
#define WIDEST 3.0 /* of a patch's length, from its point: it lies within */

sp_aim sp_aim_at(sp_vec3 axis, double half_angle)
{
    return (sp_aim){.axis = axis,
                    .half_angle = half_angle,
                    .cosine = half_angle < M_PI ? cos(half_angle) - 1e-12 : -2,
                    .end = SIZE_MAX};
}

/* What else is to be known of a ray where goods move. */
typedef struct {
    size_t position; /* theirs */
    uint32_t target; /* triangle, of the setup's mesh */
} passing_ray;

/* Flights that pass all questions but whether their way is free. */
typedef struct flock {
    size_t count, capacity;
    sp_arrival *arrivals; /* [capacity], as what follows */
    size_t ray_count;
    sp_ray *rays; /* of those whose way is not known yet */
    bool *blocked;
    passing_ray *passing;
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
    passing_ray *passing = realloc(flock->passing, capacity * sizeof *passing);
    flock->passing = passing ? passing : flock->passing;
    flock->failed = flock->failed || !arrivals || !rays || !blocked || !passing;
    flock->capacity = flock->failed ? flock->capacity : capacity;
    return !flock->failed;
}

static void flock_free(flock *flock)
{
    free(flock->arrivals);
    free(flock->rays);
    free(flock->blocked);
    free(flock->passing);
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
    sp_source source; /* as the patch sees it from where the mesh has it */
    const sp_aim *aim;
    uint32_t patch;
    flock *flock;
    double share;    /* of the pass, that the goods' position stands for */
    double step;     /* m, that the goods move from one position to the next; 0: the patch does not */
    size_t position; /* theirs */
    sp_vec3 offset;  /* m, theirs */
} gathering;

/* What is known of a patch is not known of its cells, nor of where goods were then. */
static bool is_traced(const sp_evaluator *evaluator, const sp_aim *aim, double part)
{
    return !aim->known || part < 1 || evaluator->movers;
}

/* The ray of a flight whose way is to be looked along, which is not known yet. */
static void look_along(const gathering *own, const sp_target *target, const sp_flight *way)
{
    flock *flock = own->flock;
    flock->passing[flock->ray_count] = (passing_ray){own->position, target->triangle};
    flock->rays[flock->ray_count] = sp_flight_ray(&own->source, target, way);
    flock->rays[flock->ray_count].origin = sp_add(own->source.position, own->offset);
    flock->ray_count++;
}

/* These flights to a patch, or to a cell that is `part` of it. */
static void take(const gathering *own, const sp_target *target, const sp_flight *flights, int count, double part)
{
    const sp_source *source = &own->source;
    const sp_aim *aim = own->aim;
    flock *flock = own->flock;
    part *= own->share;
    if (!make_room(flock, 2))
        return;
    flock->places++;
    for (int k = 0; k < count; k++) {
        sp_arrival *arrival = &flock->arrivals[flock->count];
        size_t bit = 2 * (size_t)own->patch + (size_t)k;
        bool traced = is_traced(source->evaluator, aim, part);
        if (aim->known && !(aim->known[bit / 8] >> bit % 8 & 1))
            continue;
        if (!sp_arrive(source, target, &flights[k], arrival) || (aim->passing && !arrival->passes))
            continue;
        /* what a spray's edge is blurred over is no less than a step, so that no thin spray falls between two */
        arrival->breadth = sp_flight_breadth(&flights[k], fmax(target->length, own->step));
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
        arrival->point = sp_add(arrival->point, own->offset);
        flock->count++;
        flock->ways += traced;
        if (traced && !source->fronts)
            look_along(own, target, &way);
    }
}

/* All flights there. */
static void gather_at(void *user, const sp_target *target, double part)
{
    const gathering *own = user;
    sp_flight flights[2];
    take(own, target, flights, sp_source_flights(&own->source, target->point, flights), part);
}

static void cut(gathering *own)
{
    const sp_aim *aim = own->aim;
    if (!sp_patch_cut(&own->source, own->patch, aim->axis, aim->half_angle + sp_spray_fringe(SP_BREADTH_MOST),
                      gather_at, own))
        own->flock->failed = true;
}

/* With drag finding the flights is what takes long. */
static void gather_with_drag(gathering *own, const sp_target *target)
{
    const sp_source *source = &own->source;
    sp_flight flights[2];
    double margin;
    int count = sp_fronts_reach(source->fronts, source->position, target->point, flights, &margin);
    if (sp_target_is_near_by(source, target, flights, count, margin))
        cut(own);
    else
        take(own, target, flights, count, 1);
}

/* The patch, whole or in cells. */
static void gather_patch(gathering *own, const sp_target *target)
{
    if (own->source.fronts)
        gather_with_drag(own, target);
    else if (!sp_target_is_near(&own->source, target))
        gather_at(own, target, 1);
    else
        cut(own);
}

/* Whether the spray surely misses a patch at all positions from one to another. */
static bool passes_aside(const gathering *own, const sp_source *source, const sp_target *target, size_t first,
                         size_t end)
{
    const sp_evaluator *evaluator = source->evaluator;
    sp_vec3 from = sp_pass_offset(evaluator, sp_pass_share(evaluator, own->patch, first)),
            to = sp_pass_offset(evaluator, sp_pass_share(evaluator, own->patch, end - 1));
    sp_vec3 middle = sp_along(target->point, 0.5, sp_add(from, to));
    double radius = 0.5 * sp_distance(from, to) + WIDEST * target->length;
    double fringe = sp_spray_fringe(sp_breadth_most(source, middle, radius, fmax(target->length, own->step)));
    return sp_cone_is_aside(source, own->aim->axis, own->aim->half_angle + fringe, middle, radius) ||
           (own->aim->emitter && sp_fan_is_aside(own->aim->emitter, source->position, fringe, middle, radius));
}

/* A patch that moves, at the positions first to end: halves of the way that the spray misses are not looked at. */
static void gather_moving(gathering *own, const sp_source *source, const sp_target *target, size_t first, size_t end)
{
    const sp_evaluator *evaluator = source->evaluator;
    if (passes_aside(own, source, target, first, end))
        return;
    if (end - first > 1) {
        gather_moving(own, source, target, first, first + (end - first) / 2);
        gather_moving(own, source, target, first + (end - first) / 2, end);
        return;
    }
    own->position = first;
    own->share = 1 / (double)evaluator->positions;
    own->offset = sp_pass_offset(evaluator, sp_pass_share(evaluator, own->patch, first));
    own->source.position = sp_sub(source->position, own->offset);
    gather_patch(own, target);
}

static void gather(const sp_source *source, const sp_aim *aim, uint32_t patch, flock *flock)
{
    const sp_evaluator *evaluator = source->evaluator;
    if ((aim->known && !(aim->known[patch / 4] >> 2 * (patch % 4) & 3)) || (aim->among && !aim->among[patch]))
        return;
    gathering own = {.source = *source, .aim = aim, .patch = patch, .flock = flock, .share = 1};
    sp_target target = sp_patch_target(evaluator, patch);
    if (!evaluator->movers || sp_motion_of(evaluator, target.triangle) == SP_STANDING) {
        gather_patch(&own, &target);
        return;
    }
    own.step = sp_pass_step(evaluator);
    gather_moving(&own, source, &target, 0, evaluator->positions);
}

/* A chunk's arrivals, malloc'd; NULL where there are none, or where memory ran out. */
typedef struct harvest {
    size_t count;
    sp_arrival *arrivals;
    sp_work work;
} harvest;

/* What is in the way of the flock's rays, of what stands. */
static void trace(const sp_evaluator *evaluator, flock *flock)
{
    const sp_movers *movers = evaluator->movers;
    for (size_t i = 0; movers && i < flock->ray_count; i++) {
        uint32_t target = flock->passing[i].target;
        flock->rays[i].skip = sp_motion_of(evaluator, target) == SP_STANDING ? movers->own[target] : SP_NONE;
    }
    sp_trace_occluded_many(movers ? movers->tracer[SP_STANDING] : evaluator->tracer, flock->rays, flock->ray_count,
                           evaluator->gravity, 1, flock->blocked);
}

/* The share of an arrival's time in which no goods are in its way: all or none where they are looked at in one
 * position, and of what stands the mean over the pass. */
static double free_share(const sp_evaluator *evaluator, const flock *flock, uint32_t patch, size_t i)
{
    const passing_ray *passing = &flock->passing[i];
    sp_ray ray = flock->rays[i];
    ray.skip = passing->target;
    bool moves = sp_motion_of(evaluator, passing->target) == SP_MOVING;
    size_t first = moves ? passing->position : 0, end = moves ? first + 1 : evaluator->positions, free = 0;
    for (size_t k = first; k < end; k++) {
        sp_vec3 offset = sp_pass_offset(evaluator, sp_pass_share(evaluator, patch, k));
        free += !sp_movers_occlude(evaluator, SP_MOVING, &ray, offset);
    }
    return (double)free / (double)(end - first);
}

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
    trace(source->evaluator, flock);
    size_t kept = 0;
    for (size_t i = 0, ray = 0; i < flock->count; i++) {
        sp_arrival *arrival = &flock->arrivals[i];
        bool traced = !source->fronts && is_traced(source->evaluator, aim, arrival->part);
        if (traced && source->evaluator->movers && !flock->blocked[ray])
            arrival->part *= free_share(source->evaluator, flock, arrival->patch, ray);
        if (traced && (flock->blocked[ray++] || !(arrival->part > 0)))
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

/* Where it is known how what leaves flies; else false, with an error. */
static bool source_of(const sp_evaluator *evaluator, sp_vec3 position, sp_launch launch, sp_source *source,
                      sp_error *error)
{
    if (!evaluator)
        return false;
    bool drag = evaluator->fidelity.trajectory == SP_TRAJECTORY_DRAG;
    *source = (sp_source){evaluator, position, launch.speed, launch.fronts};
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
