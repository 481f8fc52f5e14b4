/* How liquid that leaves one point at one speed arrives at a point of the surface. */
#ifndef SPRAY_ARRIVAL_H
#define SPRAY_ARRIVAL_H

#include "spray/state/state.h"

#include <sprayplan/flight.h>

typedef struct {
    const sp_evaluator *evaluator;
    sp_vec3 position;            /* m */
    double speed;                /* m/s */
    const sp_wavefronts *fronts; /* that leave there, with drag; NULL: lines or parabolas */
    sp_vec3 gravity;             /* m/s²; zero for lines */
} sp_source;

typedef struct {
    sp_vec3 point;     /* m */
    sp_vec3 normal;    /* unit, towards the wet side */
    sp_side side;      /* SP_SIDE_BOTH takes liquid from either side */
    uint32_t triangle; /* that holds the point */
    double length;     /* m, of the texel's edges on the surface */
    double moved;      /* m, from a point of the surface, in the triangle's plane */
} sp_target;

/* The flights from the source to a point, low arc first: 0, 1 or 2. */
int sp_source_flights(const sp_source *source, sp_vec3 to, sp_flight flights[2]);
sp_target sp_patch_target(const sp_evaluator *evaluator, uint32_t patch);
/* Fills everything but `patch`, `arc`, `part`, `breadth` and `blocked`; false where the flight comes to the dry side.
 */
bool sp_arrive(const sp_source *source, const sp_target *target, const sp_flight *flight, sp_arrival *arrival);
/* The flight, without drag, as a ray that ends at the target and skips the target's own triangle. */
sp_ray sp_flight_ray(const sp_source *source, const sp_target *target, const sp_flight *flight);
/* True where the flight, without drag, comes through the target's own triangle before it arrives there, which a
 * parabola may. */
bool sp_flight_pierces(const sp_source *source, const sp_target *target, const sp_flight *flight);
/* A piece of a flight's way, by its own clock, and what pulls at it (m/s²): true where that is enough. */
typedef bool sp_way_visitor(void *user, const sp_ray *piece, sp_vec3 acceleration);
/* Visits the way of a flight with or without drag, piece by piece, until that is enough: true then, and where the
 * flight comes through the target's own triangle before. */
bool sp_flight_visit(const sp_source *source, const sp_target *target, const sp_flight *flight, sp_way_visitor *visit,
                     void *user);
/* True where anything lies in the way of a flight with or without drag, nothing of which moves. */
bool sp_flight_is_blocked(const sp_source *source, const sp_target *target, const sp_flight *flight);

#endif
