/* Flat fans: longitude atan2(x, z) and latitude asin(y), as in the 2008 study (3.1.2). */
#include "blur.h"
#include "form.h"

static void open(const sp_nozzle_type *type, double angle, sp_spray *spray)
{
    spray->half_width = fmax(0.5 * angle, 0);
    spray->half_thickness = fmax(0.5 * type->thickness, 0);
}

static double latitude_of(sp_vec3 d)
{
    return atan2(d.y, hypot(d.x, d.z));
}

/* The corners are farthest out, unless the fan reaches behind the nozzle, where its middle is. */
static double reach(const sp_spray *spray)
{
    if (spray->half_width >= 0.5 * M_PI)
        return spray->half_width;
    return acos(cos(spray->half_width) * cos(spray->half_thickness));
}

static void settle(sp_spray *spray)
{
    spray->height = sin(spray->half_thickness);
    spray->rise = cos(spray->half_thickness);
    spray->end_sine = sin(spray->half_width);
    spray->end_cosine = cos(spray->half_width);
    spray->solid_angle = 4 * spray->half_width * spray->height;
    spray->low = 0;
    spray->high = reach(spray);
}

static double intensity(const sp_spray *spray, sp_vec3 d)
{
    bool inside = fabs(atan2(d.x, d.z)) <= spray->half_width && fabs(latitude_of(d)) <= spray->half_thickness;
    return inside ? 1 / spray->solid_angle : 0;
}

static double latitude(const sp_spray *spray)
{
    return spray->half_thickness;
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

static double margin(const sp_spray *spray, sp_vec3 d)
{
    double longitude = atan2(d.x, d.z);
    double side = spray->half_thickness < 0.5 * M_PI ? spray->half_thickness - fabs(latitude_of(d)) : M_PI;
    if (spray->half_width >= M_PI)
        return side;
    double end = end_distance(spray, d, longitude);
    return fabs(longitude) <= spray->half_width ? fmin(side, end) : -end;
}

static double share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth)
{
    double share = 1, blur = SP_SPRAY_BLUR * breadth;
    if (spray->half_thickness < M_PI / 2) {
        double height = spray->height, up = sp_dot(direction, frame->y), rise = blur * spray->rise;
        share = sp_blur_step(0.5 + (height - up) / rise) + sp_blur_step(0.5 + (height + up) / rise) - 1;
    }
    if (share <= 0 || spray->half_width >= M_PI)
        return share;
    /* heights over the planes through the fan's ends */
    double along = spray->end_sine * sp_dot(direction, frame->z),
           across = spray->end_cosine * sp_dot(direction, frame->x);
    double ends = sp_blur_step(0.5 + (along - across) / blur) + sp_blur_step(0.5 + (along + across) / blur);
    return share * (spray->end_cosine >= 0 ? fmax(0, ends - 1) : fmin(1, ends));
}

static sp_vec3 direction(const sp_spray *spray, double u, double w)
{
    double longitude = (2 * u - 1) * spray->half_width;
    double y = (2 * w - 1) * sin(spray->half_thickness);
    double level = sqrt(1 - y * y);
    return sp_v(level * sin(longitude), y, level * cos(longitude));
}

/* Along one side, and back along the other. */
static sp_vec3 rim(const sp_spray *spray, int i, int count)
{
    double way = (i % (count / 2)) / (count / 2 - 1.0), side = i < count / 2 ? 1 : -1;
    double longitude = spray->half_width * (2 * way - 1) * side, latitude = spray->half_thickness * side;
    return sp_v(cos(latitude) * sin(longitude), sin(latitude), cos(latitude) * cos(longitude));
}

/* With its corners, see `reach`. */
static double angle_reaching(const sp_nozzle_type *type, double polar)
{
    if (polar >= 0.5 * M_PI)
        return 2 * polar;
    return 2 * acos(fmin(1, cos(polar) / cos(0.5 * type->thickness)));
}

/* A roll moves a direction by as much times the sine of its polar angle. On a sphere a circle of radius r about
 * latitude φ spans the longitudes ±asin(sin r / cos φ). */
static void widen(sp_spray *spray, const sp_spray *narrow, double turn, double roll, double slack)
{
    (void)narrow;
    double by = turn + slack, thickness = spray->half_thickness;
    by += roll * sin(fmin(spray->high, M_PI / 2));
    bool about_pole = by + thickness >= M_PI / 2 - slack;
    spray->half_width = about_pole ? M_PI : fmin(M_PI, spray->half_width + asin(sin(by) / cos(thickness)) + slack);
    spray->half_thickness = fmin(M_PI / 2, thickness + by);
}

static void outline(const sp_spray *spray, double slack, sp_outline *outline)
{
    outline->flat = true;
    if (spray->half_thickness < M_PI / 2)
        outline->height = (float)(sin(spray->half_thickness) + slack);
    outline->rise = (float)(1 / (SP_SPRAY_BLUR * cos(fmin(spray->half_thickness, 0.499 * M_PI))));
    outline->wide = cos(spray->half_width) < 0;
    outline->all_round = spray->half_width >= M_PI;
    outline->end_cosine = (float)cos(spray->half_width + slack);
    outline->end_sine = (float)sin(spray->half_width + slack);
}

const sp_form sp_flat_fan = {.period = M_PI,
                             .open = open,
                             .settle = settle,
                             .intensity = intensity,
                             .margin = margin,
                             .margin_slope = sp_margin_differences,
                             .latitude = latitude,
                             .share = share,
                             .direction = direction,
                             .rim = rim,
                             .outline = outline,
                             .angle_reaching = angle_reaching,
                             .widen = widen};
