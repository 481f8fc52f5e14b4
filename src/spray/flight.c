/* The closed-form flights between two points. With r from start to end, b = v² + r·g and D = b² - g²r², the squared
 * flight times are T = 2(b ± √D)/g² (|r - g T/2|² = v² T); the short one is written 2r²/(b + √D), which keeps its
 * digits as g goes to 0. Flux per flux of solid angle is |n·w| / (v T √D) with w = v u + g t: the Jacobian of the map
 * from directions to points of the surface. */
#include <sprayplan/evaluator.h>

static sp_flight parabola(sp_vec3 r, double speed, sp_vec3 gravity, double squared_time, double root)
{
    sp_flight flight = {.time = sqrt(squared_time), .spread = speed * squared_time * root};
    flight.direction = sp_unit(sp_along(r, -0.5 * squared_time, gravity));
    flight.velocity = sp_along(sp_scale(flight.direction, speed), flight.time, gravity);
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
        flights[0] = (sp_flight){direction, sp_scale(direction, speed), distance / speed, speed * distance * distance};
        return 1;
    }
    double b = speed * speed + sp_dot(r, gravity);
    /* D = b² - g²r² in factors: near the envelope, where D goes to 0, the difference of squares would lose it */
    double discriminant = (b - g * distance) * (b + g * distance);
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

#define MOST_SQUARE 0.25 /* rad² */

/* A flight whose direction changes by u' and that is later by t' ends v t u' + w t' further on, w being the velocity
 * there, so that a step s on the surface needs u' = (s - w (u·s)/(u·w)) / (v t). Steps of all directions of the surface
 * make an ellipse of u', whose axes are those of the 2 x 2 matrix of what a step brings about across u. */
sp_breadth sp_flight_breadth(const sp_flight *flight, double speed, sp_vec3 normal, double length)
{
    sp_vec3 u = flight->direction, w = flight->velocity, across[2];
    across[0] = sp_unit(sp_cross(u, fabs(u.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0)));
    across[1] = sp_cross(u, across[0]);
    double along = sp_dot(u, w), scale = length / (speed * flight->time);
    along = copysign(fmax(fabs(along), 1e-9 * speed), along);
    double back[2], face[2], nu = sp_dot(normal, u);
    for (int i = 0; i < 2; i++) {
        back[i] = -sp_dot(w, across[i]) / along;
        face[i] = sp_dot(normal, across[i]) + back[i] * nu;
    }
    /* products of the steps across[i] + back[i] u, without what they have along the normal */
    double square = scale * scale, xx = square * (1 + back[0] * back[0] - face[0] * face[0]),
           yy = square * (1 + back[1] * back[1] - face[1] * face[1]),
           xy = square * (back[0] * back[1] - face[0] * face[1]);
    double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy), apart = sqrt(half * half + xy * xy);
    double major = fmin(mean + apart, MOST_SQUARE), minor = fmin(fmax(mean - apart, 0), MOST_SQUARE);
    /* the minor axis is a quarter turn from half the angle whose cosine is half / apart */
    double twice = apart > 0 ? half / apart : 1, cosine = sqrt(fmax(0, 0.5 * (1 + twice))),
           sine = copysign(sqrt(fmax(0, 0.5 * (1 - twice))), xy);
    sp_vec3 narrow = sp_along(sp_scale(across[0], -sine), cosine, across[1]);
    return (sp_breadth){major, sp_scale(narrow, sqrt(major - minor))};
}
