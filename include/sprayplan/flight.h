/* How liquid flies from one point to another: along parabolas in closed form, or as drops that the air holds back. */
#ifndef SPRAYPLAN_FLIGHT_H
#define SPRAYPLAN_FLIGHT_H

#include <sprayplan/export.h>
#include <sprayplan/nozzle.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    sp_vec3 direction; /* unit, at the start */
    sp_vec3 velocity;  /* on arrival, m/s */
    double time;       /* s */
    double spread; /* m³/s: transfer (1/m²) = |n · velocity| / spread; v r² for a line, v T √D for a parabola */
    double lever;  /* m: by how much the end moves across the plane of the flight, per rad; v T without drag */
} sp_flight;

/* The closed-form flights from `from` to `to` at `speed` under `gravity`, without drag, low arc first. Returns 0, 1 or
 * 2. A line (gravity zero) has one. */
SP_API int sp_flights(sp_vec3 from, sp_vec3 to, double speed, sp_vec3 gravity, sp_flight flights[2]);
/* One of these, `arc` 0 the low one or the line, 1 the high one; false where there is none. */
SP_API bool sp_flight_on_arc(sp_vec3 from, sp_vec3 to, double speed, sp_vec3 gravity, int arc, sp_flight *flight);
/* How broad a square of this edge length (m) about the flight's end looks from where it starts, at most, however it is
 * turned: by how much the flight's direction has to change for its end to move so far. Never more than SP_BREADTH_MOST
 * (rad): a patch that looks broader is cut into cells that do not, and the spray's edge is blurred over them by as
 * much, so that their shares still come to the region's solid angle. */
#define SP_BREADTH_MOST 0.2
SP_API double sp_flight_breadth(const sp_flight *flight, double length);

/* How air holds single drops back: dv/dt = g - (3 rho_a Cd / 4 rho D) |v| v with Haider and Levenspiel's drag
 * coefficient of a sphere, Cd = 24/Re (1 + 0.1806 Re^0.6459) + 0.4251/(1 + 6880.95/Re) (Powder Technology 58, 1989).
 * Where Re goes to 0 that is Stokes' drag, -18 mu_a v / (rho D²), which knows no density of air. */
typedef struct {
    double stokes;   /* 1/s: 18 mu_a / (rho D²); 0, with `form`: no drag */
    double form;     /* 1/m: 0.4251 · 3 rho_a / (4 rho D) */
    double reynolds; /* s/m: rho_a D / mu_a, Re per speed */
    double delay;    /* s, in which nothing is held back: what leaves is a stream still */
} sp_drag;

/* Of what leaves as drops of a diameter (m). No air (density 0), no drag. */
SP_API sp_drag sp_drag_of_drops(double diameter, const sp_fluid *liquid, const sp_fluid *air);
/* Of what leaves a nozzle of one pattern at its speed and flow: drops of its type's diameter, of solid streams only
 * once they have broken up. That is 5 We^0.378 of their diameters away, in the time that it takes at the exit speed; We
 * is the liquid's, rho v² d / sigma, and the diameter d that of a round stream of this flow and speed. With two axes
 * the jets share the flow. */
SP_API sp_drag sp_drag_of(const sp_nozzle *nozzle, const sp_fluid *liquid, const sp_fluid *air);
/* m/s², of a drop at a velocity through air at rest. */
SP_API sp_vec3 sp_drag_acceleration(const sp_drag *drag, sp_vec3 velocity, sp_vec3 gravity);

/* All that leaves a point at one speed at once, whatever its direction, moment by moment: the table that flights with
 * drag are found in, accurate to about 1e-9 of their length. Constant once it is made. */
typedef struct sp_wavefronts sp_wavefronts;
/* `far`: m, no flight is asked for to an end farther off than this. NULL on error. */
SP_API sp_wavefronts *sp_wavefronts_create(const sp_drag *drag, double speed, sp_vec3 gravity, double far,
                                           sp_error *error);
/* Accepts NULL. */
SP_API void sp_wavefronts_destroy(sp_wavefronts *fronts);
/* As sp_flights, with drag. */
SP_API int sp_wavefronts_flights(const sp_wavefronts *fronts, sp_vec3 from, sp_vec3 to, sp_flight flights[2]);

/* The flight on the same arc as one near by, of which direction and time are asked; false where it is not found so. */
SP_API bool sp_wavefronts_flight_near(const sp_wavefronts *fronts, sp_vec3 from, sp_vec3 to, const sp_flight *near,
                                      sp_flight *flight);

/* How a flight with drag changes as its end moves from where it is: derivatives by the share of the move. */
typedef struct {
    sp_vec3 direction; /* per unit */
    sp_vec3 velocity;  /* on arrival, m/s */
    double spread;     /* of its logarithm */
} sp_flight_change;
/* `flight` is one that sp_wavefronts_flights has found; `move` in m. Nothing is finite at the limit of reach. */
SP_API sp_flight_change sp_wavefronts_change(const sp_wavefronts *fronts, const sp_flight *flight, sp_vec3 move);

/* How liquid leaves a nozzle of one pattern, wherever that is and however it is turned. */
typedef struct {
    double speed;                /* m/s */
    const sp_wavefronts *fronts; /* borrowed, of what leaves so; NULL: it flies without drag */
    sp_trajectory trajectory;    /* its type's own; auto: the evaluator's */
} sp_launch;

/* The flights of what leaves so, low arc first: 0, 1 or 2; `gravity` for those without drag. */
SP_API int sp_launch_flights(const sp_launch *launch, sp_vec3 from, sp_vec3 to, sp_vec3 gravity, sp_flight flights[2]);
/* The same of one arc alone, 0 or 1, where a flight on it to or from a place near by, of which direction and time are
 * asked, is known: with drag that is quicker. False where there is none. */
SP_API bool sp_launch_flight_near(const sp_launch *launch, sp_vec3 from, sp_vec3 to, sp_vec3 gravity, int arc,
                                  const sp_flight *near, sp_flight *flight);

#ifdef __cplusplus
}
#endif
#endif
