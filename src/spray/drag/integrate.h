/* Flights with drag, step by step. */
#ifndef SPRAY_DRAG_INTEGRATE_H
#define SPRAY_DRAG_INTEGRATE_H

#include <sprayplan/flight.h>
#include <sprayplan/trace.h>

typedef struct {
    sp_vec3 point;        /* m */
    sp_vec3 velocity;     /* m/s */
    sp_vec3 acceleration; /* m/s² */
} sp_drag_state;

/* A drop at a place, with the acceleration that follows from its velocity. */
sp_drag_state sp_drag_state_of(const sp_drag *drag, sp_vec3 point, sp_vec3 velocity, sp_vec3 gravity);
/* Where it is after `step` seconds, by one step of Dormand and Prince's pair of orders 5 and 4. Returns its error in
 * speed, or that of its way over its time, by the pair's difference, in m/s; INFINITY for a step too long for numbers.
 */
double sp_drag_step(const sp_drag *drag, const sp_drag_state *from, sp_vec3 gravity, double step, sp_drag_state *to);
/* By what a step of this error is to be multiplied for the next to have the `tolerance`. */
double sp_drag_stride(double error, double tolerance);
/* Whether nothing changes any more: it falls at its terminal speed or, without gravity, is slower than `tolerance`
 * times the `speed` it had. */
bool sp_drag_is_settled(const sp_drag_state *moment, sp_vec3 gravity, double speed, double tolerance);

/* What lies between two moments: the polynomial of order 5 that has both their places, velocities and accelerations. */
typedef struct {
    sp_drag_state from, to;
    double time; /* s, from one to the other; INFINITY: it goes on at the first's velocity */
} sp_leg;

/* Acceleration left out. */
sp_drag_state sp_leg_at(const sp_leg *leg, double t);

/* A flight from start to end: one leg after the other. */
typedef struct {
    const sp_drag *drag;
    sp_vec3 gravity;
    double speed; /* m/s, at the start */
    sp_drag_state now;
    double flown; /* s */
    double step;  /* s, to be tried next */
} sp_march;

sp_march sp_march_from(const sp_drag *drag, sp_vec3 gravity, sp_vec3 point, sp_vec3 velocity);
/* The next leg, with a relative error of its end of no more than `tolerance`. The last has no end. */
sp_leg sp_march_on(sp_march *march, double tolerance);

/* The parabola through three places, at the start, the middle and the end of `time` seconds, as a ray without its ends,
 * and its acceleration (m/s²). */
sp_ray sp_parabola_through(const sp_vec3 place[3], double time, sp_vec3 *acceleration);
/* How far a way is from the parabola through its start, middle and end, at a quarter of its time, in m. */
double sp_parabola_misses(const sp_vec3 place[3], sp_vec3 quarter);

#endif
