/* How liquid arrives: from which side, how fast, how steeply, how densely, and whether the way is free. */
#include "arrival.h"

/* Share of a flight's time at either end in which nothing blocks it: the surface that it leaves or meets lies there,
 * and which of two triangles at an edge that is belongs to round-off. */
static const double ends = 1e-7;

sp_target sp_patch_target(const sp_patches *patches, uint32_t patch)
{
    return (sp_target){patches->point[patch], patches->normal[patch], patches->side[patch], patches->triangle[patch]};
}

bool sp_arrive(const sp_source *source, const sp_target *target, const sp_flight *flight, sp_arrival *arrival)
{
    double against = -sp_dot(flight->velocity, target->normal);
    if (target->side == SP_SIDE_BOTH)
        against = fabs(against);
    if (!(against > 0))
        return false;
    const sp_criterion *criterion = &source->evaluator->setup.criterion;
    arrival->direction = flight->direction;
    arrival->transfer = against / flight->spread;
    arrival->speed = sp_length(flight->velocity);
    arrival->incidence = atan2(sp_length(sp_cross(flight->velocity, target->normal)), against);
    arrival->passes = arrival->speed >= criterion->impact_speed && arrival->incidence <= criterion->incidence;
    return true;
}

sp_ray sp_flight_ray(const sp_source *source, const sp_target *target, const sp_flight *flight)
{
    return (sp_ray){.origin = source->position,
                    .velocity = sp_scale(flight->direction, source->speed),
                    .t_min = ends * flight->time,
                    .t_max = (1 - ends) * flight->time,
                    .skip = target->triangle};
}

bool sp_flight_blocked(const sp_source *source, const sp_target *target, const sp_flight *flight)
{
    sp_ray ray = sp_flight_ray(source, target, flight);
    return sp_trace_occluded(source->evaluator->tracer, &ray, source->evaluator->gravity);
}
