/* Patterns: where about its axis a nozzle sprays. Regions of the unit sphere in the nozzle's frame, as in the 2008
 * study (3.1.2): polar angles about z for cones, longitude atan2(x, z) and latitude asin(y) for fans. */
#include "patternation.h"
#include "turned.h"

#include <assert.h>

#define THINNEST 1e-6 /* rad, half of a jet that turns: of thinner ones the solid angle is round-off in a cap's */

/* 1 - cos(angle) without cancellation. */
static double versine(double angle)
{
    double s = sin(0.5 * angle);
    return 2 * s * s;
}

static double polar_angle(sp_vec3 d)
{
    return atan2(hypot(d.x, d.y), d.z);
}

static double latitude(sp_vec3 d)
{
    return atan2(d.y, hypot(d.x, d.z));
}

static double squared_chord(double angle)
{
    double sine = 2 * sin(0.5 * angle);
    return angle >= M_PI ? 4 : sine * sine;
}

void sp_spray_settle(sp_spray *spray)
{
    if (spray->kind == SP_PATTERN_MEASURED) /* has no angles but its image's */
        return;
    spray->height = sin(spray->half_thickness);
    spray->rise = cos(spray->half_thickness);
    spray->end_sine = sin(spray->half_width);
    spray->end_cosine = cos(spray->half_width);
    spray->outer_chord2 = squared_chord(spray->outer);
    spray->inner_chord2 = squared_chord(spray->inner);
    spray->outer_sine = sqrt(spray->outer_chord2 * (1 - spray->outer_chord2 / 4));
    spray->inner_sine = sqrt(spray->inner_chord2 * (1 - spray->inner_chord2 / 4));
    bool turns = spray->kind == SP_PATTERN_ROTATING, fan = (turns ? spray->jet : spray->kind) == SP_PATTERN_FLAT_FAN;
    spray->solid_angle =
        fan ? 4 * spray->half_width * spray->height : 2 * M_PI * (versine(spray->outer) - versine(spray->inner));
    assert(spray->solid_angle >= 0 && spray->inner <= spray->outer); /* 0: of a cluster, whose members spray */
    if (turns)
        sp_turned_settle(spray);
}

static sp_spray measured(const sp_patternation *patternation)
{
    return (sp_spray){.kind = SP_PATTERN_MEASURED,
                      .measured = patternation,
                      .solid_angle = 1 / patternation->densest,
                      .low = patternation->low,
                      .high = patternation->high};
}

sp_spray sp_spray_create(const sp_nozzle_type *type, double angle)
{
    if (type->pattern == SP_PATTERN_MEASURED)
        return measured(type->patternation);
    sp_spray spray = {.kind = type->pattern};
    sp_pattern pattern = type->pattern;
    if (pattern == SP_PATTERN_ROTATING) {
        const sp_rotation *rotation = &type->rotation;
        double sine = sin(rotation->tilt);
        pattern = spray.jet = rotation->jet;
        spray.two_axes = rotation->jets > 0;
        spray.spindle = sp_v(-sine * cos(rotation->roll), sine * sin(rotation->roll), cos(rotation->tilt));
    }
    double thinnest = pattern == spray.kind ? 0 : THINNEST;
    if (pattern == SP_PATTERN_FLAT_FAN) {
        spray.half_width = fmax(0.5 * angle, thinnest);
        spray.half_thickness = fmax(0.5 * type->thickness, thinnest);
    } else {
        spray.outer = fmax(0.5 * angle, thinnest);
        spray.inner = pattern == SP_PATTERN_HOLLOW_CONE ? type->hollow * spray.outer : 0;
    }
    sp_spray_settle(&spray);
    return spray;
}

static bool inside(const sp_spray *spray, sp_vec3 d)
{
    if (spray->kind == SP_PATTERN_FLAT_FAN)
        return fabs(atan2(d.x, d.z)) <= spray->half_width && fabs(latitude(d)) <= spray->half_thickness;
    double polar = polar_angle(d);
    return polar >= spray->inner && polar <= spray->outer;
}

double sp_spray_intensity(const sp_spray *spray, sp_vec3 direction)
{
    if (spray->kind == SP_PATTERN_ROTATING)
        return sp_turned_density(spray, polar_angle(direction));
    if (spray->kind == SP_PATTERN_MEASURED)
        return sp_patternation_at(spray->measured, direction);
    return inside(spray, direction) ? 1 / spray->solid_angle : 0;
}

void sp_spray_densities(const sp_spray *spray, double from, double to, double *least, double *most)
{
    if (spray->kind == SP_PATTERN_MEASURED)
        sp_patternation_densities(spray->measured, from, to, least, most);
    else
        sp_turned_densities(spray, from, to, least, most);
}

/* A region without an edge keeps every direction as far inside as can be: π. */
static double cone_margin(const sp_spray *spray, sp_vec3 d)
{
    double polar = polar_angle(d);
    double outwards = spray->outer < M_PI ? spray->outer - polar : M_PI;
    double inwards = spray->inner > 0 ? polar - spray->inner : M_PI;
    return fmin(outwards, inwards);
}

/* Distance from d to the meridian that ends the fan on d's side: to the foot of the perpendicular where that lies on
 * the fan's end, and to the nearer corner elsewhere. */
static double end_distance(const sp_spray *spray, sp_vec3 d, double longitude)
{
    double width = spray->half_width, thick = spray->half_thickness;
    double along = hypot(d.x, d.z) * cos(fabs(longitude) - width);
    double foot = fmax(-thick, fmin(thick, atan2(d.y, along)));
    sp_vec3 end = sp_v(copysign(sin(width), longitude) * cos(foot), sin(foot), cos(width) * cos(foot));
    return atan2(sp_length(sp_cross(d, end)), sp_dot(d, end));
}

static double fan_margin(const sp_spray *spray, sp_vec3 d)
{
    double longitude = atan2(d.x, d.z);
    double side = spray->half_thickness < 0.5 * M_PI ? spray->half_thickness - fabs(latitude(d)) : M_PI;
    if (spray->half_width >= M_PI)
        return side;
    double end = end_distance(spray, d, longitude);
    return fabs(longitude) <= spray->half_width ? fmin(side, end) : -end;
}

static double ring_margin(const sp_spray *spray, sp_vec3 d)
{
    double polar = polar_angle(d);
    return fmin(spray->low > 0 ? polar - spray->low : M_PI, spray->high < M_PI ? spray->high - polar : M_PI);
}

double sp_spray_margin(const sp_spray *spray, sp_vec3 direction)
{
    if (!sp_spray_is_uniform(spray))
        return ring_margin(spray, direction);
    return spray->kind == SP_PATTERN_FLAT_FAN ? fan_margin(spray, direction) : cone_margin(spray, direction);
}

double sp_spray_reach(const sp_spray *spray)
{
    if (!sp_spray_is_uniform(spray))
        return spray->high;
    if (spray->kind != SP_PATTERN_FLAT_FAN)
        return spray->outer;
    /* the corners are farthest out, unless the fan reaches behind the nozzle, where its middle is */
    if (spray->half_width >= 0.5 * M_PI)
        return spray->half_width;
    return acos(cos(spray->half_width) * cos(spray->half_thickness));
}
