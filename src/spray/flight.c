/* The closed-form flights between two points. With r from start to end, b = v² + r·g and D = b² - g²r², the squared
 * flight times are T = 2(b ± √D)/g² (|r - g T/2|² = v² T); the short one is written 2r²/(b + √D), which keeps its
 * digits as g goes to 0. Flux per flux of solid angle is |n·w| / (v T √D) with w = v u + g t: the Jacobian of the map
 * from directions to points of the surface. */
#include "reserve.h"

#include <sprayplan/flight.h>

static sp_flight parabola(sp_vec3 r, double speed, sp_vec3 gravity, double squared_time, double root)
{
    sp_flight flight = {.time = sqrt(squared_time), .spread = speed * squared_time * root};
    flight.direction = sp_unit(sp_along(r, -0.5 * squared_time, gravity));
    flight.velocity = sp_along(sp_scale(flight.direction, speed), flight.time, gravity);
    flight.lever = speed * flight.time;
    return flight;
}

int sp_flights(sp_vec3 from, sp_vec3 to, double speed, sp_vec3 gravity, sp_flight flights[2])
{
    sp_vec3 r = sp_sub(to, from);
    double g = sp_length(gravity), distance = sp_length(r);
    if (!(distance > 0 && speed > 0))
        return 0;
    if (g == 0) {
        sp_vec3 direction = sp_scale(r, 1 / distance);
        double time = distance / speed;
        flights[0] =
            (sp_flight){direction, sp_scale(direction, speed), time, speed * distance * distance, speed * time};
        return 1;
    }
    double b = speed * speed + sp_dot(r, gravity);
    /* D = b² - g²r² in factors: near the envelope, where D goes to 0, the difference of squares would lose it */
    double discriminant = sp_reserve(speed, r, gravity) * (b + g * distance);
    if (b <= 0 || discriminant <= 0)
        return 0;
    double root = sqrt(discriminant);
    flights[0] = parabola(r, speed, gravity, 2 * distance * distance / (b + root), root);
    double high = 2 * (b + root) / (g * g);
    if (!isfinite(high))
        return 1;
    flights[1] = parabola(r, speed, gravity, high, root);
    return 2;
}

/* Across the plane of the flight its end moves by the lever per angle; in that plane by as much as makes the product of
 * both, the area across the flight per solid angle, spread over arriving speed. */
double sp_flight_breadth(const sp_flight *flight, double length)
{
    double lever = flight->lever, across = 1 / lever;
    double along = sp_length(flight->velocity) / flight->spread * lever;
    return fmin(length * fmax(across, along), SP_BREADTH_MOST);
}
