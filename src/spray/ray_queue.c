#include "ray_queue.h"

#include "free_share.h"
#include "near_patches.h"
#include "spray/drag/wavefronts.h"

#include <assert.h>
#include <stdlib.h>

bool sp_ray_queue_make_room(sp_ray_queue *queue, size_t more)
{
    if (queue->count + more <= queue->capacity)
        return true;
    size_t capacity = queue->count + more > 2 * queue->capacity ? queue->count + more : 2 * queue->capacity;
    sp_arrival *arrivals = realloc(queue->arrivals, capacity * sizeof *arrivals);
    queue->arrivals = arrivals ? arrivals : queue->arrivals;
    sp_ray *rays = realloc(queue->rays, capacity * sizeof *rays);
    queue->rays = rays ? rays : queue->rays;
    bool *blocked = realloc(queue->blocked, capacity * sizeof *blocked);
    queue->blocked = blocked ? blocked : queue->blocked;
    sp_passing_ray *passing = realloc(queue->passing, capacity * sizeof *passing);
    queue->passing = passing ? passing : queue->passing;
    queue->failed = queue->failed || !arrivals || !rays || !blocked || !passing;
    queue->capacity = queue->failed ? queue->capacity : capacity;
    return !queue->failed;
}

void sp_ray_queue_free(sp_ray_queue *queue)
{
    free(queue->arrivals);
    free(queue->rays);
    free(queue->blocked);
    free(queue->passing);
    free(queue->shaded);
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

/* What is known of a patch is not known of its cells, nor of where goods were then. */
bool sp_way_is_traced(const sp_evaluator *evaluator, const sp_aim *aim, double part)
{
    return !aim->known || part < 1 || evaluator->movers;
}

/* The ray of a flight whose way is to be looked along, which is not known yet. */
static void look_along(const sp_gathering *own, const sp_target *target, const sp_flight *way)
{
    sp_ray_queue *queue = own->queue;
    assert(queue->ray_count < queue->count && queue->count <= queue->capacity);
    queue->passing[queue->ray_count] = (sp_passing_ray){own->position, target->triangle};
    queue->rays[queue->ray_count] = sp_flight_ray(&own->source, target, way);
    queue->rays[queue->ray_count].origin = sp_add(own->source.position, own->offset);
    queue->ray_count++;
}

/* The share of its time in which nothing is in a flight's way, as far as that is not asked of many at once later. */
static double free_share(const sp_gathering *own, const sp_target *target, const sp_flight *way)
{
    const sp_source *source = &own->source;
    if (source->fronts && source->evaluator->movers)
        return sp_pass_free_share(own, target, way);
    return source->fronts ? !sp_flight_is_blocked(source, target, way) : !sp_flight_pierces(source, target, way);
}

/* These flights to a patch, or to a cell that is `part` of it. */
static void take(const sp_gathering *own, const sp_target *target, const sp_flight *flights, int count, double part)
{
    const sp_source *source = &own->source;
    const sp_aim *aim = own->aim;
    sp_ray_queue *queue = own->queue;
    part *= own->share;
    if (!sp_ray_queue_make_room(queue, 2))
        return;
    queue->places++;
    assert(count <= 2 && part >= 0 && part <= 1 + 1e-9);
    for (int k = 0; k < count; k++) {
        sp_arrival *arrival = &queue->arrivals[queue->count];
        size_t bit = 2 * (size_t)own->patch + (size_t)k;
        bool traced = sp_way_is_traced(source->evaluator, aim, part);
        if ((aim->known && !(aim->known[bit / 8] >> bit % 8 & 1)) ||
            sp_dot(flights[k].direction, aim->axis) < aim->outside)
            continue;
        if (!sp_arrive(source, target, &flights[k], arrival) || (aim->passing && !arrival->passes))
            continue;
        /* what a spray's edge is blurred over is no less than a step, so that no thin spray falls between two */
        arrival->breadth = sp_flight_breadth(&flights[k], fmax(target->length, own->step));
        sp_flight way = aim->beside ? flight_beside(flights[k], aim->beside) : flights[k];
        if (!sp_aim_takes(aim, arrival))
            continue;
        double clear = traced ? free_share(own, target, &way) : 1;
        arrival->blocked = !(clear > 0);
        if (arrival->blocked && !aim->blocked)
            continue;
        assert(clear <= 1 && arrival->breadth > 0);
        arrival->patch = own->patch;
        arrival->arc = (uint8_t)k;
        arrival->part = arrival->blocked ? part : part * clear;
        arrival->point = sp_add(arrival->point, own->offset);
        queue->count++;
        queue->ways += traced;
        if (traced && !source->fronts)
            look_along(own, target, &way);
    }
}

/* All flights there. */
static void gather_at(void *user, const sp_target *target, double part)
{
    const sp_gathering *own = user;
    sp_flight flights[2];
    take(own, target, flights, sp_source_flights(&own->source, target->point, flights), part);
}

static void cut(sp_gathering *own)
{
    const sp_aim *aim = own->aim;
    if (!sp_patch_cut(&own->source, own->patch, aim->axis, aim->half_angle + sp_spray_fringe(SP_BREADTH_MOST),
                      gather_at, own))
        own->queue->failed = true;
}

/* With drag finding the flights is what takes long. */
static void gather_with_drag(sp_gathering *own, const sp_target *target)
{
    const sp_source *source = &own->source;
    sp_flight flights[2];
    double margin;
    int count = sp_wavefronts_reach(source->fronts, source->position, target->point, flights, &margin);
    if (sp_target_is_near_by(source, target, flights, count, margin))
        cut(own);
    else
        take(own, target, flights, count, 1);
}

/* The patch, whole or in cells. */
void sp_gather_flights(sp_gathering *own, const sp_target *target)
{
    if (own->source.fronts)
        gather_with_drag(own, target);
    else if (!sp_target_is_near(&own->source, target))
        gather_at(own, target, 1);
    else
        cut(own);
}
