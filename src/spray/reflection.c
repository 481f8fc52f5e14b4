#include "reflection.h"

/* Of the geometry's farthest coordinate. What comes no higher over a wall stays there: what hops ever lower, or is
 * caught in an edge, would go on for ever and get nowhere. */
#define LOWEST_HOP 0x1p-30

sp_landing sp_landing_of(const sp_ray *ray, const sp_hit *hit, sp_vec3 acceleration)
{
    return (sp_landing){.hit = *hit,
                        .piece = {.ray = *ray, .acceleration = acceleration, .last = true},
                        .velocity = sp_ray_velocity(ray, acceleration, hit->t),
                        .time = hit->t};
}

/* What flies on starts a little before the wall, on the way that has been free so far: the impact itself may be rounded
 * to beyond the wall. `across`: the speed at which the flight arrives, across the wall. */
static sp_vec3 before_the_wall(const sp_evaluator *evaluator, const sp_landing *landing, double across)
{
    double back = sp_stand_off(evaluator) / fabs(across);
    const sp_ray *ray = &landing->piece.ray;
    return sp_ray_point(ray, landing->piece.acceleration, fmax(ray->t_min, landing->hit.t - back));
}

/* How high over the wall a flight of duration t comes (m) that meets it at the speed `across` it. */
static double height_over(sp_vec3 gravity, sp_vec3 normal, double t, double across)
{
    double acceleration = sp_dot(gravity, normal) * copysign(1, across), speed = fabs(across);
    return speed < acceleration * t ? 0.5 * speed * speed / acceleration : (speed - 0.5 * acceleration * t) * t;
}

bool sp_bounce(const sp_evaluator *evaluator, const sp_landing *landing, sp_vec3 acceleration, sp_ray *ray,
               double *flow)
{
    const sp_mesh *mesh = evaluator->setup.mesh;
    uint32_t triangle = landing->hit.triangle;
    const sp_surface *surface = &evaluator->setup.surfaces[mesh->part[triangle]];
    sp_vec3 normal = sp_triangle_normal(mesh, triangle);
    double across = sp_dot(landing->velocity, normal);
    double height = height_over(acceleration, normal, landing->time, across);
    ray->origin = before_the_wall(evaluator, landing, across);
    ray->velocity = sp_along(landing->velocity, -(1 + surface->restitution) * across, normal);
    ray->t_min = 0;
    *flow *= surface->rebound;
    return surface->restitution > 0 && *flow > 0 && sp_length(ray->velocity) > 0 &&
           height >= LOWEST_HOP * evaluator->farthest;
}
