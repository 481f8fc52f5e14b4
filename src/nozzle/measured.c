/* Patterns by an image of liquid per solid angle. */
#include "form.h"
#include "frame.h"
#include "patternation.h"
#include "ring.h"

static void open(const sp_nozzle_type *type, double angle, sp_spray *spray)
{
    (void)angle; /* its image's */
    spray->measured = type->patternation;
}

static void settle(sp_spray *spray)
{
    spray->solid_angle = 1 / spray->measured->densest;
    spray->low = spray->measured->low;
    spray->high = spray->measured->high;
}

static double intensity(const sp_spray *spray, sp_vec3 direction)
{
    return sp_patternation_at(spray->measured, direction);
}

static double margin(const sp_spray *spray, sp_vec3 direction)
{
    return sp_ring_margin(spray->low, spray->high, sp_polar_angle(direction));
}

static double share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    return sp_patternation_mean(spray->measured, sp_frame_local(frame, direction), breadth).wet;
}

static double density(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    return sp_patternation_mean(spray->measured, sp_frame_local(frame, direction), breadth).liquid;
}

static void densities(const sp_spray *spray, double from, double to, double *least, double *most)
{
    sp_patternation_densities(spray->measured, from, to, least, most);
}

static sp_vec3 direction(const sp_spray *spray, double u, double w)
{
    return sp_patternation_direction(spray->measured, u, w);
}

const sp_form sp_measured = {.gaps = true,
                             .image = true,
                             .period = 2 * M_PI,
                             .open = open,
                             .settle = settle,
                             .intensity = intensity,
                             .margin = margin,
                             .margin_slope = sp_margin_differences,
                             .share = share,
                             .density = density,
                             .densities = densities,
                             .direction = direction,
                             .rim = sp_ring_rim};
