/* Cones, full and hollow, and streams, which are narrow ones: polar angles about z, as in the 2008 study (3.1.2). */
#include "blur.h"
#include "form.h"
#include "frame.h"
#include "ring.h"

#define ON_AXIS 1e-9 /* sine of the polar angle below which it has no slope */

/* 1 - cos(angle) without cancellation. */
static double versine(double angle)
{
    double s = sin(0.5 * angle);
    return 2 * s * s;
}

static double squared_chord(double angle)
{
    double sine = 2 * sin(0.5 * angle);
    return angle >= M_PI ? 4 : sine * sine;
}

static void open_full(const sp_nozzle_type *type, double angle, sp_spray *spray)
{
    (void)type;
    spray->outer = fmax(0.5 * angle, 0);
}

static void open_hollow(const sp_nozzle_type *type, double angle, sp_spray *spray)
{
    spray->outer = fmax(0.5 * angle, 0);
    spray->inner = type->hollow * spray->outer;
}

static void settle(sp_spray *spray)
{
    spray->outer_chord2 = squared_chord(spray->outer);
    spray->inner_chord2 = squared_chord(spray->inner);
    spray->outer_sine = sqrt(spray->outer_chord2 * (1 - spray->outer_chord2 / 4));
    spray->inner_sine = sqrt(spray->inner_chord2 * (1 - spray->inner_chord2 / 4));
    spray->solid_angle = 2 * M_PI * (versine(spray->outer) - versine(spray->inner));
    spray->low = spray->inner;
    spray->high = spray->outer;
}

static double intensity(const sp_spray *spray, sp_vec3 direction)
{
    double polar = sp_polar_angle(direction);
    return polar >= spray->inner && polar <= spray->outer ? 1 / spray->solid_angle : 0;
}

static double margin(const sp_spray *spray, sp_vec3 direction)
{
    return sp_ring_margin(spray->inner, spray->outer, sp_polar_angle(direction));
}

/* The polar angle's gradient on the sphere is -1/sin along z. */
static double margin_slope(const sp_spray *spray, sp_vec3 d, sp_vec3 *gradient)
{
    double sine = sqrt(d.x * d.x + d.y * d.y), polar = atan2(sine, d.z);
    double outwards = spray->outer < M_PI ? spray->outer - polar : M_PI;
    double inwards = spray->inner > 0 ? polar - spray->inner : M_PI;
    bool out = outwards < inwards;
    if (gradient)
        *gradient = sp_v(0, 0, sine < ON_AXIS || (out ? outwards : inwards) >= M_PI ? 0 : (out ? 1 : -1) / sine);
    return out ? outwards : inwards;
}

/* A disc smaller than the blur is spread over it. Chords squared. */
static double spot_share(double edge2, double chord2, double blur2)
{
    return edge2 / blur2 * sp_blur_step(1 - chord2 / (2 * blur2));
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
    return apart >= 0.5 * across ? 1 : apart <= -0.5 * across ? 0 : sp_blur_step(0.5 + apart / across);
}

static double share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    sp_vec3 to_axis = sp_sub(frame->z, direction);
    double chord2 = sp_dot(to_axis, to_axis),
           outer = disc_share(spray->outer_chord2, spray->outer_sine, chord2, breadth);
    return spray->inner > 0 ? outer - disc_share(spray->inner_chord2, spray->inner_sine, chord2, breadth) : outer;
}

/* h = 1 - cos(polar angle), so that narrow streams keep their digits. */
static sp_vec3 direction(const sp_spray *spray, double u, double w)
{
    double a = sin(0.5 * spray->inner), b = sin(0.5 * spray->outer);
    double h = 2 * (a * a + u * (b * b - a * a));
    double level = sqrt(h * (2 - h)), azimuth = 2 * M_PI * w;
    return sp_v(level * cos(azimuth), level * sin(azimuth), 1 - h);
}

static double angle_reaching(const sp_nozzle_type *type, double polar)
{
    (void)type;
    return 2 * polar;
}

static void widen(sp_spray *spray, const sp_spray *narrow, double turn, double roll, double slack)
{
    (void)roll;
    spray->outer = fmin(M_PI, spray->outer + (turn + slack));
    spray->inner = fmax(0, narrow->inner - (turn + slack));
}

static void outline(const sp_spray *spray, double slack, sp_outline *outline)
{
    outline->outer = sp_rim_at(spray->outer, slack);
    if (spray->inner > 0)
        outline->inner = sp_rim_at(spray->inner, -slack);
}

#define CONE                                                                                                           \
    .settle = settle, .intensity = intensity, .margin = margin, .margin_slope = margin_slope, .share = share,          \
    .direction = direction, .rim = sp_ring_rim, .angle_reaching = angle_reaching, .widen = widen

const sp_form sp_full_cone = {.outline = outline, .open = open_full, CONE};
const sp_form sp_hollow_cone = {.outline = outline, .open = open_hollow, CONE};
const sp_form sp_solid_stream = {.outline = outline, .stream = true, .open = open_full, CONE};
/* Of a cluster, whose members spray, nothing but what holds them. */
const sp_form sp_cluster_body = {.period = 2 * M_PI, .open = open_full, CONE};
