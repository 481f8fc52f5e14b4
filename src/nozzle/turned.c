/* Rotation about one axis. At any moment the jet is its own pattern, so in the mean a direction receives as much as the
 * share of its circle about the axis that lies in the pattern; and within a polar angle there leaves as much as the
 * pattern has in common with the cap of that angle. */
#include "turned.h"

#include "caps.h"
#include "form.h"
#include "frame.h"
#include "ring.h"
#include "rotation.h"

#define THINNEST 2e-6 /* rad, of a jet: of thinner ones the solid angle is round-off in a cap's */

#define STEPS_MOST 60   /* each at least halves where the angle may be */
#define PRECISION 1e-13 /* rad */

static void open(const sp_nozzle_type *type, double angle, sp_spray *spray)
{
    const sp_rotation *rotation = &type->rotation;
    sp_nozzle_type jet = {.thickness = fmax(type->thickness, THINNEST), .hollow = type->hollow};
    double sine = sin(rotation->tilt);
    assert(sp_pattern_turns(rotation->jet));
    spray->jet = rotation->jet;
    spray->two_axes = rotation->jets > 0;
    spray->spindle = sp_v(-sine * cos(rotation->roll), sine * sin(rotation->roll), cos(rotation->tilt));
    sp_form_of(rotation->jet)->open(&jet, fmax(angle, THINNEST), spray);
}

static double tilt_of(const sp_spray *spray)
{
    return atan2(hypot(spray->spindle.x, spray->spindle.y), spray->spindle.z);
}

static void settle(sp_spray *spray)
{
    const sp_form *jet = sp_form_of(spray->jet);
    jet->settle(spray);
    spray->low = spray->two_axes ? 0 : fmax(0, -jet->margin(spray, spray->spindle));
    spray->high = spray->two_axes ? M_PI : M_PI - fmax(0, -jet->margin(spray, sp_scale(spray->spindle, -1)));
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

static void densities(const sp_spray *spray, double from, double to, double *least, double *most)
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

/* The polar angle within which this share of the liquid leaves, by Newton's method within bounds that close in. */
static double polar_of(const sp_spray *spray, double share)
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

static sp_vec3 direction(const sp_spray *spray, double u, double w)
{
    double polar = polar_of(spray, u), azimuth = 2 * M_PI * w;
    return sp_v(sin(polar) * cos(azimuth), sin(polar) * sin(azimuth), cos(polar));
}

static double intensity(const sp_spray *spray, sp_vec3 direction)
{
    return sp_turned_density(spray, sp_polar_angle(direction));
}

static double margin(const sp_spray *spray, sp_vec3 direction)
{
    return sp_ring_margin(spray->low, spray->high, sp_polar_angle(direction));
}

const sp_form sp_rotating = {.open = open,
                             .settle = settle,
                             .intensity = intensity,
                             .margin = margin,
                             .margin_slope = sp_margin_differences,
                             .share = sp_turned_share,
                             .density = sp_turned_mean,
                             .densities = densities,
                             .direction = direction,
                             .rim = sp_ring_rim};
