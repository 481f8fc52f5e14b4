/* Rotation about one axis. At any moment the jet is its own pattern, so in the mean a direction receives as much as the
 * share of its circle about the axis that lies in the pattern; and within a polar angle there leaves as much as the
 * pattern has in common with the cap of that angle. */
#include "turned.h"

#include "caps.h"

#include <assert.h>

#define STEPS_MOST 60   /* each at least halves where the angle may be */
#define PRECISION 1e-13 /* rad */

sp_spray sp_turned_jet(const sp_spray *spray)
{
    sp_spray jet = *spray;
    jet.kind = spray->jet;
    return jet;
}

static double tilt_of(const sp_spray *spray)
{
    return atan2(hypot(spray->spindle.x, spray->spindle.y), spray->spindle.z);
}

void sp_turned_settle(sp_spray *spray)
{
    spray->low = 0;
    spray->high = M_PI;
    if (spray->two_axes)
        return;
    sp_spray jet = sp_turned_jet(spray);
    spray->low = fmax(0, -sp_spray_margin(&jet, spray->spindle));
    spray->high = M_PI - fmax(0, -sp_spray_margin(&jet, sp_scale(spray->spindle, -1)));
    assert(spray->low < spray->high);
}

static double cone_density(const sp_spray *spray, double polar)
{
    double tilt = tilt_of(spray), outer = sp_cap_arc(polar, spray->outer, tilt);
    double inner = spray->inner > 0 ? sp_cap_arc(polar, spray->inner, tilt) : 0;
    return (outer - inner) / (M_PI * spray->solid_angle);
}

static double cone_within(const sp_spray *spray, double polar)
{
    double tilt = tilt_of(spray);
    return (sp_cap_overlap(spray->outer, polar, tilt) - sp_cap_overlap(spray->inner, polar, tilt)) / spray->solid_angle;
}

/* What a full cone on a hub comes to at a polar angle: its density there, or its share within. */
typedef double hub_measure(double outer, double polar);

/* A hollow cone is a full one less what it lacks. */
static double on_hub(const sp_spray *spray, hub_measure *measure, double polar)
{
    double full = measure(spray->outer, polar);
    if (!(spray->inner > 0))
        return full;
    double hollow = 2 * M_PI * sp_cap_height(0, spray->inner), all = spray->solid_angle + hollow;
    return (all * full - hollow * measure(spray->inner, polar)) / spray->solid_angle;
}

double sp_turned_density(const sp_spray *spray, double polar)
{
    if (polar < spray->low || polar > spray->high)
        return 0;
    if (spray->two_axes)
        return on_hub(spray, sp_hub_density, polar);
    if (spray->jet != SP_PATTERN_FLAT_FAN)
        return cone_density(spray, polar);
    double solid_angle, share;
    sp_turned_fan(spray, polar, &solid_angle, &share);
    return share / spray->solid_angle;
}

static double within(const sp_spray *spray, double polar)
{
    if (spray->two_axes)
        return on_hub(spray, sp_hub_within, polar);
    if (spray->jet != SP_PATTERN_FLAT_FAN)
        return cone_within(spray, polar);
    double solid_angle, share;
    sp_turned_fan(spray, polar, &solid_angle, &share);
    return solid_angle / spray->solid_angle;
}

double sp_spray_within(const sp_spray *spray, double polar)
{
    if (polar <= spray->low || polar >= spray->high)
        return polar >= spray->high;
    return fmin(1, fmax(0, within(spray, polar)));
}

/* Where a narrow cone that turns is densest: towards either side its circles' share in it falls. */
static double densest(const sp_spray *spray)
{
    return acos(fmax(-1, fmin(1, cos(tilt_of(spray)) / cos(spray->outer))));
}

void sp_turned_densities(const sp_spray *spray, double from, double to, double *least, double *most)
{
    bool narrow = spray->jet != SP_PATTERN_FLAT_FAN && !(spray->inner > 0) && spray->outer < 0.499 * M_PI;
    *least = 0;
    *most = 1 / spray->solid_angle;
    if (!narrow)
        return;
    /* on a hub a full cone is densest at the poles, and the less dense the farther from both */
    double turning = spray->two_axes ? M_PI / 2 : densest(spray);
    double ends[2] = {sp_turned_density(spray, from), sp_turned_density(spray, to)};
    double peak = from <= turning && turning <= to ? sp_turned_density(spray, turning) : ends[0];
    *least = fmin(peak, fmin(ends[0], ends[1]));
    *most = fmax(peak, fmax(ends[0], ends[1]));
}

/* Newton's method, within bounds that close in on the angle. */
double sp_turned_polar(const sp_spray *spray, double share)
{
    double low = spray->low, high = spray->high, polar = low + share * (high - low);
    assert(share >= 0 && share <= 1);
    for (int i = 0; i < STEPS_MOST && high - low > PRECISION; i++) {
        double more = sp_spray_within(spray, polar) - share;
        *(more > 0 ? &high : &low) = polar;
        double steep = 2 * M_PI * sin(polar) * sp_turned_density(spray, polar), next = polar - more / steep;
        if (fabs(next - polar) < PRECISION)
            return polar;
        polar = next > low && next < high ? next : 0.5 * (low + high);
    }
    return polar;
}

void sp_turned_ring(double polar, double breadth, double cap, double ring[2])
{
    ring[0] = polar < cap ? 0 : polar > M_PI - cap ? M_PI - cap : polar - 0.5 * breadth;
    ring[1] = polar < cap ? cap : polar > M_PI - cap ? M_PI : polar + 0.5 * breadth;
}
