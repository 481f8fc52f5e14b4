/* How much of a patch lies inside a spray. A patch is small against the way to it, and looks at most as broad from the
 * nozzle as its breadth says; the spray's edge is blurred by as much. The blur is odd about the edge in a coordinate in
 * which solid angle is even (the squared chord to a cone's axis; the height over a fan's middle, Archimedes), so that
 * over patches side by side the shares come to the region's own solid angle, however thin it is; a plain test of the
 * points would let it fall between them. */
#include "caps.h"
#include "patternation.h"
#include "turned.h"

#include <assert.h>

#define FINEST 1e-6    /* rad, of a breadth: the liquid of a thinner ring is round-off, and its middle tells as much */
#define ROUND_OFF 1e-6 /* share that all lacks */
/* 0 to 1, with two even derivatives at either end (Perlin, Improving noise, 2002): what is left of a lattice's own
 * wavelengths after it is under 1 %. */
static double smooth_step(double t)
{
    t = fmin(1, fmax(0, t));
    return t * t * t * (10 + t * (6 * t - 15));
}

/* A disc smaller than the blur is spread over it. Chords squared. */
static double spot_share(double edge2, double chord2, double blur2)
{
    return edge2 / blur2 * smooth_step(1 - chord2 / (2 * blur2));
}

/* The share within the polar angle of this sine whose chord's square is edge2 (4: all directions). */
static double disc_share(double edge2, double sine, double chord2, double breadth)
{
    double blur = SP_SPRAY_BLUR * breadth, blur2 = blur * blur;
    if (edge2 <= 0 || edge2 >= 4)
        return edge2 > 0;
    if (edge2 < fmin(blur2, 2))
        return spot_share(edge2, chord2, blur2);
    if (4 - edge2 < blur2)
        return 1 - spot_share(4 - edge2, 4 - chord2, blur2);
    /* a step across the edge changes the squared chord by twice the edge's sine */
    double apart = edge2 - chord2, across = 2 * blur * sine;
    return apart >= 0.5 * across ? 1 : apart <= -0.5 * across ? 0 : smooth_step(0.5 + apart / across);
}

static double cone_share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    sp_vec3 to_axis = sp_sub(frame->z, direction);
    double chord2 = sp_dot(to_axis, to_axis),
           outer = disc_share(spray->outer_chord2, spray->outer_sine, chord2, breadth);
    return spray->inner > 0 ? outer - disc_share(spray->inner_chord2, spray->inner_sine, chord2, breadth) : outer;
}

static double fan_share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    double share = 1, blur = SP_SPRAY_BLUR * breadth;
    if (spray->half_thickness < M_PI / 2) {
        double height = spray->height, up = sp_dot(direction, frame->y), rise = blur * spray->rise;
        share = smooth_step(0.5 + (height - up) / rise) + smooth_step(0.5 + (height + up) / rise) - 1;
    }
    if (share <= 0 || spray->half_width >= M_PI)
        return share;
    /* heights over the planes through the fan's ends */
    double along = spray->end_sine * sp_dot(direction, frame->z),
           across = spray->end_cosine * sp_dot(direction, frame->x);
    double ends = smooth_step(0.5 + (along - across) / blur) + smooth_step(0.5 + (along + across) / blur);
    return share * (spray->end_cosine >= 0 ? fmax(0, ends - 1) : fmin(1, ends));
}

static double polar_angle(const sp_frame *frame, sp_vec3 direction)
{
    return atan2(hypot(sp_dot(direction, frame->x), sp_dot(direction, frame->y)), sp_dot(direction, frame->z));
}

/* Of what rotates a patch is a ring about the axis, blurred: three rings of different breadth, the broader the more, as
 * steps of a slope that falls off evenly on either side; by one alone a thin jet's patches would come to 1 % more or
 * less than it, by chance. */
static const double ring_breadths[3] = {1.0 / 3, 1, 5.0 / 3}; /* of a patch's */
static const double ring_weights[3] = {1.0 / 9, 3.0 / 9, 5.0 / 9};
static const double cap_radii[3] = {1.0, 1.4, 1.8}; /* of the same, about the axis: the middles of several patches */

/* By how much the rings lie in the region, as solid angle. */
static double ring_share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    double polar = polar_angle(frame, direction), share = 0;
    if (breadth < FINEST)
        return polar >= spray->low && polar <= spray->high;
    for (int i = 0; i < 3; i++) {
        double ring[2];
        sp_turned_ring(polar, ring_breadths[i] * breadth, cap_radii[i] * breadth, ring);
        double low = fmax(ring[0], spray->low), high = fmin(ring[1], spray->high);
        share += high > low ? ring_weights[i] * sp_cap_height(low, high) / sp_cap_height(ring[0], ring[1]) : 0;
    }
    return share;
}

static sp_held mean_of(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    sp_vec3 own = sp_v(sp_dot(direction, frame->x), sp_dot(direction, frame->y), sp_dot(direction, frame->z));
    return sp_patternation_mean(spray->measured, own, breadth);
}

double sp_spray_density(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    if (spray->kind == SP_PATTERN_MEASURED)
        return mean_of(spray, frame, direction, breadth).liquid;
    if (spray->kind != SP_PATTERN_ROTATING)
        return sp_spray_share(spray, frame, direction, breadth) / spray->solid_angle;
    double polar = polar_angle(frame, direction), density = 0;
    if (breadth < FINEST)
        return sp_turned_density(spray, polar);
    for (int i = 0; i < 3; i++) {
        double ring[2];
        sp_turned_ring(polar, ring_breadths[i] * breadth, cap_radii[i] * breadth, ring);
        double liquid = sp_spray_within(spray, ring[1]) - sp_spray_within(spray, ring[0]);
        density += ring_weights[i] * fmax(0, liquid) / (2 * M_PI * sp_cap_height(ring[0], ring[1]));
    }
    return density;
}

double sp_spray_share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    assert(breadth >= 0 && fabs(sp_dot(direction, direction) - 1) < 1e-6);
    double share = spray->kind == SP_PATTERN_ROTATING   ? ring_share(spray, frame, direction, breadth)
                   : spray->kind == SP_PATTERN_MEASURED ? mean_of(spray, frame, direction, breadth).wet
                   : spray->kind == SP_PATTERN_FLAT_FAN ? fan_share(spray, frame, direction, breadth)
                                                        : cone_share(spray, frame, direction, breadth);
    return share > 1 - ROUND_OFF ? 1 : fmax(0, share);
}

double sp_spray_fringe(double breadth)
{
    return sqrt(2) * SP_SPRAY_BLUR * breadth;
}
