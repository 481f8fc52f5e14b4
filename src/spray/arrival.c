/* How liquid arrives: from which side, how fast, how steeply, how densely, and whether the way is free. */
#include "arrival.h"

#include "criterion.h"
#include "spray/drag/chain.h"

/* Share of a flight's time at either end in which nothing blocks it: the surface that it leaves or meets lies there,
 * and which of two triangles at an edge that is belongs to round-off. */
static const double ends = 1e-7;

int sp_source_flights(const sp_source *source, sp_vec3 to, sp_flight flights[2])
{
    return source->fronts ? sp_wavefronts_flights(source->fronts, source->position, to, flights)
                          : sp_flights(source->position, to, source->speed, source->gravity, flights);
}

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
    arrival->time = flight->time;
    arrival->point = target->point;
    arrival->normal = target->normal;
    arrival->transfer = against / flight->spread;
    arrival->speed = sp_length(flight->velocity);
    arrival->towards = against;
    arrival->along = sp_speed_along(flight->velocity, target->normal);
    arrival->passes = sp_is_fast_enough(criterion, arrival->speed) && sp_arrives_steeply(criterion, arrival);
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

/* Of the two times at which a parabola that takes `time` meets the plane of the triangle one is its arrival, so that
 * the other follows from their sum without round-off. */
static bool pierces(const sp_evaluator *evaluator, const sp_target *target, const sp_ray *ray, sp_vec3 acceleration,
                    double time)
{
    double fall = sp_dot(acceleration, target->normal);
    double t = -2 * sp_dot(ray->velocity, target->normal) / fall - time;
    if (fall == 0 || !(t > ends * time && t < (1 - ends) * time))
        return false;
    double u, v;
    return sp_triangle_weights(evaluator->setup.mesh, target->triangle, sp_ray_point(ray, acceleration, t), &u, &v);
}

bool sp_flight_pierces(const sp_source *source, const sp_target *target, const sp_flight *flight)
{
    sp_ray ray = {.origin = source->position, .velocity = sp_scale(flight->direction, source->speed)};
    return pierces(source->evaluator, target, &ray, source->gravity, flight->time);
}

/* Nothing blocks the first and last of it, as of parabolas, and the last piece ends on the target's own triangle, which
 * the others may meet. */
static bool visit_chain(const sp_source *source, const sp_target *target, const sp_flight *flight,
                        sp_way_visitor *visit, void *user)
{
    double end = flight->time - fmax(ends * flight->time, target->moved / sp_length(flight->velocity));
    sp_chain chain = sp_chain_of(source->fronts, source->position, flight);
    sp_arc_piece piece;
    while (sp_chain_next(&chain, &piece)) {
        sp_ray *ray = &piece.ray;
        double time = flight->time - piece.start;
        ray->t_min = fmax(0, ends * flight->time - piece.start);
        ray->t_max = fmin(ray->t_max, end - piece.start);
        if (piece.last) {
            ray->skip = target->triangle;
            if (pierces(source->evaluator, target, ray, piece.acceleration, time))
                return true;
        }
        if (ray->t_max > ray->t_min && visit(user, ray, piece.acceleration))
            return true;
    }
    return false;
}

bool sp_flight_visit(const sp_source *source, const sp_target *target, const sp_flight *flight, sp_way_visitor *visit,
                     void *user)
{
    if (source->fronts)
        return visit_chain(source, target, flight, visit, user);
    sp_ray ray = sp_flight_ray(source, target, flight);
    return sp_flight_pierces(source, target, flight) || visit(user, &ray, source->gravity);
}

static bool meets(void *user, const sp_ray *piece, sp_vec3 acceleration)
{
    const sp_tracer *tracer = user;
    return sp_trace_occluded(tracer, piece, acceleration);
}

bool sp_flight_is_blocked(const sp_source *source, const sp_target *target, const sp_flight *flight)
{
    return sp_flight_visit(source, target, flight, meets, source->evaluator->tracer);
}

bool sp_evaluator_flight_free(const sp_evaluator *evaluator, sp_vec3 position, sp_launch launch,
                              const sp_flight *flight, uint32_t patch)
{
    sp_source source = {evaluator, position, launch.speed, launch.fronts, sp_evaluator_gravity(evaluator, &launch)};
    sp_target target = sp_patch_target(evaluator, patch);
    return !sp_flight_is_blocked(&source, &target, flight);
}
