/* Low flights leave within asin g d / (v √2b) of the way, as g²T is 2d²g²/b at most, and high ones within asin g d / b
 * of the vertical, as it is 2b at least. */
#include "aside.h"

#define ROUND_OFF 1e-12 /* rad */

/* Directions of all flights to a ball: those of low ones and of high ones, each within a cone. */
typedef struct {
    sp_vec3 low, high;            /* unit */
    double low_angle, high_angle; /* rad; high_angle < 0: there are none */
} leaving;

/* False where nothing is known, as with drag. */
static bool leaving_for(const sp_source *source, sp_vec3 point, double radius, leaving *leaving)
{
    sp_vec3 gravity = source->evaluator->gravity, r = sp_sub(point, source->position);
    double distance = sp_length(r), g = sp_length(gravity), speed = source->speed, far = distance + radius;
    double b = speed * speed + sp_dot(r, gravity) - g * radius;
    if (source->fronts || distance <= radius || b <= 0 || g * far >= b || g * far >= speed * sqrt(2 * b))
        return false;
    leaving->low = sp_scale(r, 1 / distance);
    leaving->low_angle = asin(radius / distance) + asin(g * far / (speed * sqrt(2 * b)));
    leaving->high = g > 0 ? sp_scale(gravity, -1 / g) : leaving->low;
    leaving->high_angle = g > 0 ? asin(g * far / b) : -1;
    return true;
}

static double angle_between(sp_vec3 a, sp_vec3 b)
{
    return acos(fmin(1, fmax(-1, sp_dot(a, b))));
}

bool sp_cone_is_aside(const sp_source *source, sp_vec3 axis, double half_angle, sp_vec3 point, double radius)
{
    leaving leaving;
    double most = half_angle + ROUND_OFF;
    if (most >= M_PI || !leaving_for(source, point, radius, &leaving))
        return false;
    if (angle_between(leaving.low, axis) <= most + leaving.low_angle)
        return false;
    return leaving.high_angle < 0 || angle_between(leaving.high, axis) > most + leaving.high_angle;
}

static double latitude(sp_vec3 direction, const sp_frame *frame)
{
    return fabs(asin(fmin(1, fmax(-1, sp_dot(direction, frame->y)))));
}

bool sp_fan_is_aside(const sp_emitter *emitter, sp_vec3 position, double beyond, sp_vec3 point, double radius)
{
    leaving leaving;
    sp_source source = emitter->source;
    double most = emitter->spray.half_thickness + beyond + ROUND_OFF;
    source.position = position;
    if (emitter->spray.kind != SP_PATTERN_FLAT_FAN || !leaving_for(&source, point, radius, &leaving))
        return false;
    if (latitude(leaving.low, &emitter->frame) <= most + leaving.low_angle)
        return false;
    return leaving.high_angle < 0 || latitude(leaving.high, &emitter->frame) > most + leaving.high_angle;
}

/* With ε = g d/v², what is arrived at at w: v t is d/√(1 + ε) at least, as T is d²/b, D is v⁴ (1 - 2ε) at least and w²
 * no more than v² (1 + 2ε) (see flight.c). */
double sp_breadth_most(const sp_source *source, sp_vec3 point, double radius, double length)
{
    double distance = sp_distance(point, source->position), near = distance - radius;
    double slow = sp_length(source->evaluator->gravity) * (distance + radius) / (source->speed * source->speed);
    if (!(near > 0) || !(slow < 0.5))
        return SP_BREADTH_MOST;
    return fmin(SP_BREADTH_MOST, length / near * sqrt((1 + 2 * slow) * (1 + slow) / (1 - 2 * slow)));
}
