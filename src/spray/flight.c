/* The closed-form flights between two points. With r from start to end, b = v² + r·g and D = b² - g²r², the squared
 * flight times are T = 2(b ± √D)/g² (|r - g T/2|² = v² T); the short one is written 2r²/(b + √D), which keeps its
 * digits as g goes to 0. Flux per flux of solid angle is |n·w| / (v T √D) with w = v u + g t: the Jacobian of the map
 * from directions to points of the surface. */
#include "reserve.h"

#include <sprayplan/flight.h>

#include <assert.h>

/* What the flights between two points have in common. */
typedef struct {
    sp_vec3 r, gravity;
    double speed, g, distance;
    double b, root; /* root: √D */
} span;

/* How many flights there are. */
static int span_create(sp_vec3 from, sp_vec3 to, double speed, sp_vec3 gravity, span *s)
{
    sp_vec3 r = sp_sub(to, from);
    *s = (span){.r = r, .gravity = gravity, .speed = speed, .g = sp_length(gravity), .distance = sp_length(r)};
    if (!(s->distance > 0 && speed > 0))
        return 0;
    if (s->g == 0)
        return 1;
    s->b = speed * speed + sp_dot(r, gravity);
    /* D = b² - g²r² in factors: near the envelope, where D goes to 0, the difference of squares would lose it */
    double discriminant = sp_reserve(speed, r, gravity) * (s->b + s->g * s->distance);
    if (s->b <= 0 || discriminant <= 0)
        return 0;
    s->root = sqrt(discriminant);
    return isfinite(2 * (s->b + s->root) / (s->g * s->g)) ? 2 : 1;
}

static sp_flight line(const span *s)
{
    sp_vec3 direction = sp_scale(s->r, 1 / s->distance);
    double time = s->distance / s->speed;
    return (sp_flight){direction, sp_scale(direction, s->speed), time, s->speed * s->distance * s->distance,
                       s->speed * time};
}

static sp_flight parabola(const span *s, double squared_time)
{
    assert(squared_time > 0 && s->root > 0);
    sp_flight flight = {.time = sqrt(squared_time), .spread = s->speed * squared_time * s->root};
    flight.direction = sp_unit(sp_along(s->r, -0.5 * squared_time, s->gravity));
    flight.velocity = sp_along(sp_scale(flight.direction, s->speed), flight.time, s->gravity);
    flight.lever = s->speed * flight.time;
    return flight;
}

static sp_flight flight_of(const span *s, int arc)
{
    if (s->g == 0)
        return line(s);
    return parabola(s,
                    arc == 0 ? 2 * s->distance * s->distance / (s->b + s->root) : 2 * (s->b + s->root) / (s->g * s->g));
}

int sp_flights(sp_vec3 from, sp_vec3 to, double speed, sp_vec3 gravity, sp_flight flights[2])
{
    span s;
    int count = span_create(from, to, speed, gravity, &s);
    for (int arc = 0; arc < count; arc++)
        flights[arc] = flight_of(&s, arc);
    return count;
}

bool sp_flight_on_arc(sp_vec3 from, sp_vec3 to, double speed, sp_vec3 gravity, int arc, sp_flight *flight)
{
    span s;
    if (arc >= span_create(from, to, speed, gravity, &s))
        return false;
    *flight = flight_of(&s, arc);
    return true;
}

/* Across the plane of the flight its end moves by the lever per angle; in that plane by as much as makes the product of
 * both, the area across the flight per solid angle, spread over arriving speed. */
double sp_flight_breadth(const sp_flight *flight, double length)
{
    assert(length >= 0 && flight->lever > 0 && flight->spread > 0);
    double lever = flight->lever, across = 1 / lever;
    double along = sp_length(flight->velocity) / flight->spread * lever;
    return fmin(length * fmax(across, along), SP_BREADTH_MOST);
}
