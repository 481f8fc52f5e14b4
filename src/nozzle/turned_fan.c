/* A fan is a rectangle in longitude λ and height y = sin(latitude), which keep areas (Archimedes). A cap whose axis has
 * longitude λ0 and height a holds of the parallel at y what is within β(y) of λ0,
 *   cos β = (cos ϑ - a y) / (√(1 - a²) √(1 - y²)).
 * Of that a length L(β) lies within the fan's ends; L is linear in β, by a slope of 0, 1 or 2, but where the cap's rim
 * crosses an end. So between two crossings the solid angle is ∫ L dy = ∫ (L0 + slope β) dy, and ∫ β dy is half of what
 * the cap has in common with the cap about the fan's y axis above the one height, less that above the other. */
#include "caps.h"
#include "turned.h"

#define ON_AXIS 1e-9 /* rad off the fan's own y axis: there the cap's rim is a parallel, and crosses nothing */

typedef struct {
    double polar, cosine; /* of the cap's rim */
    double longitude;     /* of its axis, 0 to π: fans are alike on either side */
    double height, level; /* sine and cosine of its axis' latitude */
    double apart;         /* rad, from the fan's y axis */
    double half_width;
} cap;

/* β */
static double half_chord(const cap *own, double y)
{
    double across = own->cosine - own->height * y, along = own->level * sqrt(fmax(0, 1 - y * y));
    return across >= along ? 0 : across <= -along ? M_PI : acos(across / along);
}

/* What L has, and its slope, of what lies within `beta` of a longitude. */
static double arc_within(double longitude, double beta, double half_width, double *slope)
{
    double right = fmin(longitude + beta, half_width), left = fmax(longitude - beta, -half_width);
    if (right < left)
        return 0;
    *slope += (longitude + beta < half_width) + (longitude - beta > -half_width);
    return right - left;
}

static double length_within(const cap *own, double beta, double *slope)
{
    *slope = own->half_width < M_PI ? 0 : 2;
    if (own->half_width >= M_PI)
        return 2 * beta;
    return arc_within(own->longitude, beta, own->half_width, slope) +
           arc_within(2 * M_PI - own->longitude, beta, own->half_width, slope);
}

/* Adds the heights at which the cap's rim crosses a meridian `turn` from its axis. */
static int add_crossings(const cap *own, double turn, double limit, double *heights, int count)
{
    double along = own->level * cos(turn), all = hypot(along, own->height);
    if (!(fabs(own->cosine) <= all))
        return count;
    double middle = atan2(own->height, along), beside = acos(own->cosine / all);
    for (int side = -1; side <= 1; side += 2) {
        double latitude = remainder(middle + side * beside, 2 * M_PI), y = sin(latitude);
        int at = count;
        if (fabs(latitude) > M_PI / 2 || fabs(y) >= limit)
            continue;
        for (; at > 0 && heights[at - 1] > y; at--)
            heights[at] = heights[at - 1];
        heights[at] = y;
        count++;
    }
    return count;
}

/* What of the fan lies between two heights with no crossing between them. */
static void add_band(const cap *own, double low, double high, double *solid_angle, double *arc)
{
    double slope, beta = half_chord(own, 0.5 * (low + high)), length = length_within(own, beta, &slope);
    *solid_angle += (length - slope * beta) * (high - low);
    if (slope == 0)
        return;
    double above[2] = {acos(low), acos(high)};
    *solid_angle +=
        0.5 * slope *
        (sp_cap_overlap(above[0], own->polar, own->apart) - sp_cap_overlap(above[1], own->polar, own->apart));
    *arc += slope * (sp_cap_arc(own->polar, above[0], own->apart) - sp_cap_arc(own->polar, above[1], own->apart));
}

/* Both where the cap is about the fan's y axis, either way. */
static void turn_on_axis(const sp_spray *spray, double polar, double *solid_angle, double *share)
{
    double height = cos(polar), below = fmax(-spray->height, fmin(spray->height, height));
    *solid_angle = 2 * spray->half_width * (spray->height - below);
    *share = fabs(height) <= spray->height ? spray->half_width / M_PI : 0;
}

void sp_turned_fan(const sp_spray *spray, double polar, double *solid_angle, double *share)
{
    sp_vec3 a = spray->spindle;
    cap own = {.polar = polar,
               .cosine = cos(polar),
               .longitude = fabs(atan2(a.x, a.z)),
               .height = a.y,
               .level = hypot(a.x, a.z),
               .half_width = spray->half_width};
    if (own.level < ON_AXIS) {
        turn_on_axis(spray, polar, solid_angle, share);
        return;
    }
    own.apart = atan2(own.level, own.height);
    double heights[6] = {-spray->height}, arc = 0;
    int count = 1;
    count = add_crossings(&own, spray->half_width - own.longitude, spray->height, heights, count);
    count = add_crossings(&own, spray->half_width + own.longitude, spray->height, heights, count);
    heights[count++] = spray->height;
    *solid_angle = 0;
    for (int i = 0; i + 1 < count; i++)
        add_band(&own, heights[i], heights[i + 1], solid_angle, &arc);
    *share = fmin(1, fmax(0, arc / (2 * M_PI)));
}
