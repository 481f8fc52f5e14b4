/* How liquid arrives: from which side, how fast, how steeply, how densely, and whether the way is free. */
#include "arrival.h"

/* Share of a flight's time at either end in which nothing blocks it: the surface that it leaves or meets lies there,
 * and which of two triangles at an edge that is belongs to round-off. */
static const double ends = 1e-7;

sp_target sp_patch_target(const sp_evaluator *evaluator, uint32_t patch)
{
    const sp_patches *patches = &evaluator->patches;
    return (sp_target){patches->point[patch],    patches->normal[patch], patches->side[patch],
                       patches->triangle[patch], patches->length[patch], 0};
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
    arrival->point = target->point;
    arrival->normal = target->normal;
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
                    .t_max =
                        fmin((1 - ends) * flight->time, flight->time - target->moved / sp_length(flight->velocity)),
                    .skip = target->triangle};
}

/* Of the two times at which a parabola meets the plane of the triangle one is its arrival, so that the other follows
 * from their sum without round-off. */
bool sp_flight_pierces(const sp_source *source, const sp_target *target, const sp_flight *flight)
{
    const sp_evaluator *evaluator = source->evaluator;
    sp_vec3 velocity = sp_scale(flight->direction, source->speed);
    double fall = sp_dot(evaluator->gravity, target->normal);
    double t = -2 * sp_dot(velocity, target->normal) / fall - flight->time;
    if (fall == 0 || !(t > ends * flight->time && t < (1 - ends) * flight->time))
        return false;
    sp_ray ray = {.origin = source->position, .velocity = velocity};
    double u, v;
    return sp_triangle_weights(evaluator->setup.mesh, target->triangle, sp_ray_point(&ray, evaluator->gravity, t), &u,
                               &v);
}

bool sp_evaluator_flight_free(const sp_evaluator *evaluator, sp_vec3 position, double speed, const sp_flight *flight,
                              uint32_t patch)
{
    sp_source source = {evaluator, position, speed};
    sp_target target = sp_patch_target(evaluator, patch);
    sp_ray ray = sp_flight_ray(&source, &target, flight);
    return !sp_flight_pierces(&source, &target, flight) &&
           !sp_trace_occluded(evaluator->tracer, &ray, evaluator->gravity);
}
