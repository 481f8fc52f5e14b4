/* All that leaves a point at one speed at once lies on a front, which spreads and sinks.
 *
 * In the upright plane of a direction of elevation θ it has come to q (cos θ, sin θ) + d (0, 1): without drag q = v t
 * and d = -g t²/2, whatever the direction. With drag both depend on θ, little and smoothly, so that few polynomials in
 * θ tell them, and polynomials in time between moments: nothing is singular straight up or down. */
#ifndef SPRAY_DRAG_WAVEFRONTS_H
#define SPRAY_DRAG_WAVEFRONTS_H

#include "integrate.h"

#define SP_FRONT_ORDER 32 /* polynomials in θ at most */
#define SP_FRONT_DATA 6   /* q, its first and second derivative by time, and the same of d */

struct sp_wavefronts {
    sp_drag drag;
    double speed; /* m/s */
    sp_vec3 gravity, up;
    double far;    /* m */
    unsigned most; /* polynomials in θ there is room for */
    size_t count, capacity;
    double *time;                     /* [count], s, ascending from 0 */
    unsigned *terms;                  /* [count], polynomials in θ at that moment */
    unsigned *rough;                  /* [count], of these, as many as tell about what it is */
    double (*sum)[SP_FRONT_DATA];     /* [count x most], Chebyshev's in 2 θ/π, by moment */
    struct sp_wavefront_bound *bound; /* [count], by moment */
    double *joints;                   /* [joint_count], s, from 0: in between ways are parabolas, but for little */
    size_t joint_count;
};

/* Over all elevations, by moment: no more than the least q, and no less than the most that has sunk, in m. Both grow
 * with time: what has left goes on, and what lies below the way it left on is pulled farther below, by d'' = -g - k d',
 * k ≥ 0 being the drag over the speed. */
typedef struct sp_wavefront_bound {
    double out, sunk;
} sp_wavefront_bound;

/* Of the front at a time. */
typedef struct {
    double q, q_time, q_turn; /* m, and by time and elevation */
    double d, d_time, d_turn;
} sp_drop_wavefront;

/* At moment i, by so many polynomials. */
sp_drop_wavefront sp_wavefront_at_moment(const sp_wavefronts *fronts, size_t i, unsigned terms, double elevation);
/* At a time between moments i and i + 1. */
sp_drop_wavefront sp_wavefront_between(const sp_wavefronts *fronts, size_t i, double time, double elevation);
/* Where a flight of one elevation is: q and d, m. */
typedef struct {
    double q, d;
} sp_wavefront_place;
/* Fills Chebyshev's polynomials [fronts->most] at an elevation, for what follows. */
void sp_wavefront_polynomials(const sp_wavefronts *fronts, double elevation, double *polynomials);
sp_wavefront_place sp_wavefront_place_between(const sp_wavefronts *fronts, double time, const double *polynomials);
/* The last moment before a time, or the first. */
size_t sp_wavefront_moment_before(const sp_wavefronts *fronts, double time);

/* How far an end is within what is reached: m from the last front that does not, negative beyond. */
typedef struct {
    double margin;   /* m */
    sp_vec3 slope;   /* of it, by the end's place */
    double lever;    /* m, as a flight's, of the flight there */
    double arriving; /* m/s, its speed */
    /* m²/s/√m: flights that end there sweep turn √margin, in m²/s, of their plane per rad of elevation, so that what
     * arrives grows as 1/√margin towards the limit. */
    double turn;
} sp_wavefront_limit;
/* As sp_wavefronts_flights. *margin is no more than that margin; it is not to be trusted where there are no flights. */
int sp_wavefronts_reach(const sp_wavefronts *fronts, sp_vec3 from, sp_vec3 to, sp_flight flights[2], double *margin);
/* Of all flights to ends that lie no farther than `far` (m): how far their ends have sunk below where they would be
 * along the direction in which they left, at most by low arcs and at least by high ones (INFINITY: there are none), in
 * m. False where that is not known. */
bool sp_wavefronts_sinking(const sp_wavefronts *fronts, double far, double *low, double *high);
/* False without gravity, where what comes to rest is the limit and nothing goes wrong near it. */
bool sp_wavefronts_limit(const sp_wavefronts *fronts, sp_vec3 from, sp_vec3 to, sp_wavefront_limit *limit);

#endif
