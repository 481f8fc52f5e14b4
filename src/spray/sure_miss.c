/* Low flights leave within asin g d / (v √2b) of the way, as g²T is 2d²g²/b at most, and high ones within asin g d / b
 * of the vertical, as it is 2b at least. */
#include "sure_miss.h"

#include "nozzle/pattern.h"
#include "spray/drag/wavefronts.h"

#define ROUND_OFF 1e-12 /* rad */

/* Directions of all flights to a ball: those of low ones and of high ones, each within a cone. */
typedef struct {
    sp_vec3 low, high;            /* unit */
    double low_angle, high_angle; /* rad; high_angle < 0: there are none */
} leaving;

/* With drag ends lie at the way on which they left and as far below as they have sunk: low ones little, high ones far.
 * False where nothing is known. */
static bool leaving_with_drag(const sp_source *source, sp_vec3 r, double radius, leaving *leaving)
{
    double distance = sp_length(r), near = distance - radius, far = distance + radius, low, high;
    if (!(near > 0) || !sp_wavefronts_sinking(source->fronts, far, &low, &high) || low >= near || far >= high)
        return false;
    leaving->low = sp_scale(r, 1 / distance);
    leaving->low_angle = asin(radius / distance) + asin(low / near);
    leaving->high = source->fronts->up;
    leaving->high_angle = isinf(high) ? -1 : asin(far / high);
    return true;
}

/* False where nothing is known. */
static bool leaving_for(const sp_source *source, sp_vec3 point, double radius, leaving *leaving)
{
    sp_vec3 gravity = source->gravity, r = sp_sub(point, source->position);
    if (source->fronts)
        return leaving_with_drag(source, r, radius, leaving);
    double distance = sp_length(r), g = sp_length(gravity), speed = source->speed, far = distance + radius;
    double b = speed * speed + sp_dot(r, gravity) - g * radius;
    if (distance <= radius || b <= 0 || g * far >= b || g * far >= speed * sqrt(2 * b))
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

static double latitude(sp_vec3 direction, const sp_frame *frame)
{
    return fabs(asin(fmin(1, fmax(-1, sp_dot(direction, frame->y)))));
}

/* Whether all directions within `angle` of one lie outside of a cone or, of an emitter that is flat, beside it. */
static bool is_outside(sp_vec3 direction, double angle, sp_vec3 axis, double half_angle, const sp_emitter *flat,
                       double beyond)
{
    double most = angle + beyond + ROUND_OFF;
    return angle_between(direction, axis) > half_angle + most ||
           (flat && latitude(direction, &flat->frame) > sp_spray_latitude(&flat->spray) + most);
}

bool sp_spray_surely_misses(const sp_source *source, sp_vec3 axis, double half_angle, const sp_emitter *emitter,
                            double beyond, sp_vec3 point, double radius)
{
    leaving leaving;
    const sp_emitter *flat = emitter && sp_spray_latitude(&emitter->spray) < M_PI / 2 ? emitter : NULL;
    if ((!flat && half_angle + beyond >= M_PI) || !leaving_for(source, point, radius, &leaving))
        return false;
    return is_outside(leaving.low, leaving.low_angle, axis, half_angle, flat, beyond) &&
           (leaving.high_angle < 0 || is_outside(leaving.high, leaving.high_angle, axis, half_angle, flat, beyond));
}

/* With ε = g d/v², what is arrived at at w: v t is d/√(1 + ε) at least, as T is d²/b, D is v⁴ (1 - 2ε) at least and w²
 * no more than v² (1 + 2ε) (see flight.c). */
double sp_breadth_most(const sp_source *source, sp_vec3 point, double radius, double length)
{
    double distance = sp_distance(point, source->position), near = distance - radius;
    double slow = sp_length(source->gravity) * (distance + radius) / (source->speed * source->speed);
    if (!(near > 0) || !(slow < 0.5) || source->fronts)
        return SP_BREADTH_MOST;
    return fmin(SP_BREADTH_MOST, length / near * sqrt((1 + 2 * slow) * (1 + slow) / (1 - 2 * slow)));
}
