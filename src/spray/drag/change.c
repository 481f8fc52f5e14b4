/* How a flight changes as its end moves: the front that it arrives on tells by how much its elevation and its time do,
 * and what lies a little before and behind it on the same way how all else changes with these. */
#include "fronts.h"

#define STEP 1e-4 /* rad, and share of the time, that is looked before and behind */

/* What arrives at a time of what left at an elevation, in its upright plane. */
typedef struct {
    double q, q_time;
    double forward, up; /* velocity, m/s */
    double along[2];    /* by how much the end moves with the elevation, m: forward, up */
    double area;        /* m²/s, of both, signed */
} arrival;

static arrival arrival_at(const sp_fronts *fronts, double elevation, double time)
{
    sp_front front = sp_front_between(fronts, sp_front_moment_before(fronts, time), time, elevation);
    double sine = sin(elevation), cosine = cos(elevation);
    arrival own = {.q = front.q,
                   .q_time = front.q_time,
                   .forward = front.q_time * cosine,
                   .up = front.q_time * sine + front.d_time,
                   .along = {front.q_turn * cosine - front.q * sine,
                             front.q_turn * sine + front.q * cosine + front.d_turn}};
    own.area = own.along[0] * own.up - own.along[1] * own.forward;
    return own;
}

sp_flight_change sp_fronts_change(const sp_fronts *fronts, const sp_flight *flight, sp_vec3 move)
{
    sp_vec3 up = fronts->up, other = fabs(up.x) < 0.6 ? sp_v(1, 0, 0) : sp_v(0, 1, 0);
    double sine = sp_dot(flight->direction, up);
    sp_vec3 level = sp_along(flight->direction, -sine, up);
    double cosine = sp_length(level), elevation = atan2(sine, cosine);
    sp_vec3 ahead = cosine > 0 ? sp_scale(level, 1 / cosine) : sp_unit(sp_cross(up, other)),
            aside = sp_cross(up, ahead);
    arrival at = arrival_at(fronts, elevation, flight->time);
    double forwards = sp_dot(move, ahead), upwards = sp_dot(move, up), sideways = sp_dot(move, aside) / at.q;
    double rise = (forwards * at.up - upwards * at.forward) / at.area;
    double later = (at.along[0] * upwards - at.along[1] * forwards) / at.area;
    double step = STEP / fmax(fabs(rise), fmax(fabs(later) / flight->time, 1e-300)), by = 0.5 / step;
    arrival front = arrival_at(fronts, elevation + step * rise, flight->time + step * later);
    arrival back = arrival_at(fronts, elevation - step * rise, flight->time - step * later);
    sp_vec3 velocity = sp_along(sp_scale(ahead, by * (front.forward - back.forward)), by * (front.up - back.up), up);
    return (sp_flight_change){
        .direction = sp_along(sp_along(sp_scale(ahead, -rise * sine), rise * cosine, up), sideways, aside),
        .velocity = sp_along(velocity, at.q_time * sideways, aside),
        .spread = by * ((front.q - back.q) / at.q + (front.area - back.area) / at.area)};
}
