/* Flights near one that is known: by how much it changes as its end moves, and the one to a place near by. The front
 * that it arrives on tells by how much its elevation and its time change, and what lies a little before and behind it
 * on the same way how all else does with these. */
#include "wavefronts.h"

#define STEP 1e-4  /* rad, and share of the time, that is looked before and behind */
#define ROUNDS 8   /* of Newton's method */
#define FAR 0.1    /* rad, and share of the time, that is not near */
#define DONE 1e-12 /* of the way, that an end may be missed by */
#define STEEP                                                                                                          \
    0.05 /* of the lengths of both directions that an end moves in, that their area is at least: else the              \
          * flight is so close to the limit of reach that its neighbour may be on the other arc */

/* The upright plane of a flight. */
typedef struct {
    sp_vec3 ahead, up, aside; /* orthonormal */
    double elevation;         /* rad */
} plane;

static plane plane_of(const sp_wavefronts *fronts, sp_vec3 level, double sine)
{
    sp_vec3 up = fronts->up, other = fabs(up.x) < 0.6 ? sp_v(1, 0, 0) : sp_v(0, 1, 0);
    double cosine = sp_length(level);
    sp_vec3 ahead = cosine > 0 ? sp_scale(level, 1 / cosine) : sp_unit(sp_cross(up, other));
    return (plane){ahead, up, sp_cross(up, ahead), atan2(sine, cosine)};
}

/* What arrives at a time of what left at an elevation, in its upright plane. */
typedef struct {
    double q, q_time;
    double place[2];    /* m, ahead and up */
    double velocity[2]; /* m/s */
    double along[2];    /* by how much the end moves with the elevation, m */
    double area;        /* m²/s, of both, signed */
} arrival;

static arrival arrival_at(const sp_wavefronts *fronts, double elevation, double time)
{
    sp_drop_wavefront front = sp_wavefront_between(fronts, sp_wavefront_moment_before(fronts, time), time, elevation);
    double sine = sin(elevation), cosine = cos(elevation);
    arrival own = {
        .q = front.q,
        .q_time = front.q_time,
        .place = {front.q * cosine, front.q * sine + front.d},
        .velocity = {front.q_time * cosine, front.q_time * sine + front.d_time},
        .along = {front.q_turn * cosine - front.q * sine, front.q_turn * sine + front.q * cosine + front.d_turn}};
    own.area = own.along[0] * own.velocity[1] - own.along[1] * own.velocity[0];
    return own;
}

/* By how much elevation and time change where the end moves ahead and up. */
typedef struct {
    double rise, later; /* rad, s */
} turn;

static turn turn_by(const arrival *at, double ahead, double up)
{
    return (turn){(ahead * at->velocity[1] - up * at->velocity[0]) / at->area,
                  (at->along[0] * up - at->along[1] * ahead) / at->area};
}

sp_flight_change sp_wavefronts_change(const sp_wavefronts *fronts, const sp_flight *flight, sp_vec3 move)
{
    double sine = sp_dot(flight->direction, fronts->up), cosine;
    plane plane = plane_of(fronts, sp_along(flight->direction, -sine, fronts->up), sine);
    arrival at = arrival_at(fronts, plane.elevation, flight->time);
    turn turn = turn_by(&at, sp_dot(move, plane.ahead), sp_dot(move, plane.up));
    double sideways = sp_dot(move, plane.aside) / at.q;
    double step = STEP / fmax(fabs(turn.rise), fmax(fabs(turn.later) / flight->time, 1e-300)), by = 0.5 / step;
    arrival front = arrival_at(fronts, plane.elevation + step * turn.rise, flight->time + step * turn.later);
    arrival back = arrival_at(fronts, plane.elevation - step * turn.rise, flight->time - step * turn.later);
    sp_vec3 velocity = sp_along(sp_scale(plane.ahead, by * (front.velocity[0] - back.velocity[0])),
                                by * (front.velocity[1] - back.velocity[1]), plane.up);
    cosine = cos(plane.elevation);
    return (sp_flight_change){
        .direction = sp_along(sp_along(sp_scale(plane.ahead, -turn.rise * sine), turn.rise * cosine, plane.up),
                              sideways, plane.aside),
        .velocity = sp_along(velocity, at.q_time * sideways, plane.aside),
        .spread = by * ((front.q - back.q) / at.q + (front.area - back.area) / at.area)};
}

/* Whether an arrival is so far from the limit of reach that both arcs are told apart. */
static bool is_clear(const arrival *at)
{
    return fabs(at->area) > STEEP * hypot(at->along[0], at->along[1]) * hypot(at->velocity[0], at->velocity[1]);
}

bool sp_wavefronts_flight_near(const sp_wavefronts *fronts, sp_vec3 from, sp_vec3 to, const sp_flight *near,
                               sp_flight *flight)
{
    sp_vec3 way = sp_sub(to, from);
    double up = sp_dot(way, fronts->up), distance = sp_length(way);
    sp_vec3 level = sp_along(way, -up, fronts->up);
    plane plane = plane_of(fronts, level, up);
    double ahead = sp_length(level), sine = sp_dot(near->direction, fronts->up), end = fronts->time[fronts->count - 1];
    double elevation = asin(fmin(1, fmax(-1, sine))), time = near->time;
    arrival at = arrival_at(fronts, elevation, time);
    bool clear = is_clear(&at), positive = at.area > 0;
    for (int round = 0; clear && round < ROUNDS; round++) {
        double off[2] = {ahead - at.place[0], up - at.place[1]};
        if (hypot(off[0], off[1]) <= DONE * distance)
            break;
        turn turn = turn_by(&at, off[0], off[1]);
        elevation += turn.rise;
        time += turn.later;
        clear = fabs(turn.rise) < FAR && fabs(turn.later) < FAR * time && fabs(elevation) <= 0.5 * M_PI && time > 0 &&
                time <= end;
        if (clear)
            at = arrival_at(fronts, elevation, time);
        clear = clear && is_clear(&at) && (at.area > 0) == positive;
    }
    if (!clear || !(hypot(ahead - at.place[0], up - at.place[1]) <= DONE * distance))
        return false;
    *flight = (sp_flight){.direction = sp_along(sp_scale(plane.ahead, cos(elevation)), sin(elevation), plane.up),
                          .velocity = sp_along(sp_scale(plane.ahead, at.velocity[0]), at.velocity[1], plane.up),
                          .time = time,
                          .spread = at.q * fabs(at.area),
                          .lever = at.q};
    return true;
}
