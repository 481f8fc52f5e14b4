/* Crossings of the tracks with one circle about the body's axis. Azimuths are in turns: from one turn of the hub to the
 * next they advance by q/p, p/q being the gear ratio in lowest terms, so that a whole mesh's are p evenly spread ones
 * for each jet and sign, whatever the order in which they are drawn. */
#include <sprayplan/tracks.h>

#include <assert.h>

static unsigned common_divisor(unsigned a, unsigned b)
{
    while (b) {
        unsigned rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

unsigned sp_track_turns(const sp_rotation *rotation)
{
    assert(rotation->gears[0] > 0 && rotation->gears[1] > 0);
    return rotation->gears[1] / common_divisor(rotation->gears[0], rotation->gears[1]);
}

/* How far (turns) from an azimuth the nearest crossing of one jet and sign is, whose first is `start` turns after the
 * hub's own zero. */
static double nearest_crossing(const sp_rotation *rotation, unsigned turns, double start, double azimuth)
{
    unsigned whole = sp_track_turns(rotation);
    double hub = (double)rotation->gears[0] * whole / rotation->gears[1], ratio = hub / whole, nearest = 1;
    if (turns == 0 || turns >= whole)
        return fabs(remainder(azimuth - start / ratio, 1 / hub));
    for (double m = ceil(-start); m + start <= ratio * turns; m++) {
        double apart = azimuth - (start + m) / ratio;
        nearest = fmin(nearest, fabs(apart - rint(apart)));
    }
    return nearest;
}

double sp_track_angle(const sp_rotation *rotation, unsigned turns, sp_vec3 direction)
{
    double sine = hypot(direction.x, direction.y), polar = atan2(sine, direction.z) / (2 * M_PI), nearest = 1;
    double azimuth = atan2(direction.y, direction.x) / (2 * M_PI);
    double ratio = (double)rotation->gears[0] / rotation->gears[1];
    for (unsigned j = 0; j < rotation->jets; j++) {
        double behind = (double)j / rotation->jets;
        nearest = fmin(nearest, nearest_crossing(rotation, turns, polar - behind, azimuth));
        nearest = fmin(nearest, nearest_crossing(rotation, turns, -polar - behind, azimuth - 0.5));
    }
    return 2 * M_PI * nearest * sine * ratio / hypot(ratio, sine);
}
