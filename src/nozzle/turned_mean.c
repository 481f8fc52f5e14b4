/* How much of a patch lies inside what rotates, and what it receives in the mean. */
#include "caps.h"
#include "frame.h"
#include "turned.h"

#define FINEST 1e-6 /* rad, of a breadth: the liquid of a thinner ring is round-off, and its middle tells as much */

/* Of what rotates a patch is a ring about the axis, blurred: three rings of different breadth, the broader the more, as
 * steps of a slope that falls off evenly on either side; by one alone a thin jet's patches would come to 1 % more or
 * less than it, by chance. */
static const double ring_breadths[3] = {1.0 / 3, 1, 5.0 / 3}; /* of a patch's */
static const double ring_weights[3] = {1.0 / 9, 3.0 / 9, 5.0 / 9};
static const double cap_radii[3] = {1.0, 1.4, 1.8}; /* of the same, about the axis: the middles of several patches */

/* The polar angles, low and high, of what is `breadth` broad about a direction at a polar angle: a ring or, less than
 * `cap` from either pole, the cap of that radius about it, which is no less than half the breadth. */
static void ring_at(double polar, double breadth, double cap, double ring[2])
{
    ring[0] = polar < cap ? 0 : polar > M_PI - cap ? M_PI - cap : polar - 0.5 * breadth;
    ring[1] = polar < cap ? cap : polar > M_PI - cap ? M_PI : polar + 0.5 * breadth;
}

/* By how much the rings lie in the region, as solid angle. */
double sp_turned_share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    double polar = sp_polar_angle(sp_frame_local(frame, direction)), share = 0;
    if (breadth < FINEST)
        return polar >= spray->low && polar <= spray->high;
    for (int i = 0; i < 3; i++) {
        double ring[2];
        ring_at(polar, ring_breadths[i] * breadth, cap_radii[i] * breadth, ring);
        double low = fmax(ring[0], spray->low), high = fmin(ring[1], spray->high);
        share += high > low ? ring_weights[i] * sp_cap_height(low, high) / sp_cap_height(ring[0], ring[1]) : 0;
    }
    return share;
}

double sp_turned_mean(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    double polar = sp_polar_angle(sp_frame_local(frame, direction)), density = 0;
    if (breadth < FINEST)
        return sp_turned_density(spray, polar);
    for (int i = 0; i < 3; i++) {
        double ring[2];
        ring_at(polar, ring_breadths[i] * breadth, cap_radii[i] * breadth, ring);
        double liquid = sp_spray_within(spray, ring[1]) - sp_spray_within(spray, ring[0]);
        density += ring_weights[i] * fmax(0, liquid) / (2 * M_PI * sp_cap_height(ring[0], ring[1]));
    }
    return density;
}
