/* The rim of an opening: around a line that leaves by it, from where it starts, directions are tried until something is
 * in the way. */
#include "spray/wet/opening_rim.h"

#define STEPS 16    /* of leaning over, to 45 degrees */
#define HALVES 10   /* of a step */
#define ASLANT 0.25 /* least cosine between a line and the normal of the rim that it shows */

/* Whether a line leaves the liquid; else where it ends in *t. */
static bool leaves(const sp_flood *flood, const bool *liquid, const sp_ray *line, double *t)
{
    sp_hit hit = sp_trace_nearest(flood->tracer, line, sp_v(0, 0, 0));
    uint32_t met = sp_flood_met(flood, line, &hit);
    *t = hit.t;
    return met == SP_SKY || (met < flood->sides && !liquid[met]);
}

/* Leans a line over, step by step so as not to miss what parts this opening from the next, until something is in the
 * way. *rim is where that stands; false where nothing is within 45 degrees. */
static bool lean(const sp_flood *flood, const bool *liquid, sp_ray line, sp_vec3 aside, sp_vec3 *rim)
{
    sp_vec3 straight = line.velocity;
    double t, low = 0, high;
    for (int step = 1;; step++) {
        high = (double)step / STEPS;
        line.velocity = sp_along(straight, high, aside);
        if (!leaves(flood, liquid, &line, &t))
            break;
        if (step == STEPS)
            return false;
        low = high;
    }
    *rim = sp_ray_point(&line, sp_v(0, 0, 0), t);
    for (int half = 0; half < HALVES; half++) {
        double middle = 0.5 * (low + high);
        line.velocity = sp_along(straight, middle, aside);
        if (leaves(flood, liquid, &line, &t)) {
            low = middle;
        } else {
            high = middle;
            *rim = sp_ray_point(&line, sp_v(0, 0, 0), t);
        }
    }
    return true;
}

sp_opening_rim sp_opening_rim_find(const sp_flood *flood, const bool *liquid, sp_ray line)
{
    sp_vec3 normal = line.velocity, x = sp_unit(sp_cross(fabs(normal.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0), normal));
    sp_vec3 y = sp_cross(normal, x);
    sp_opening_rim found = {.count = 0};
    for (int i = 0; i < SP_RIM_POINTS; i++) {
        double turn = 2 * M_PI * i / SP_RIM_POINTS;
        found.there[i] = lean(flood, liquid, line, sp_along(sp_scale(x, cos(turn)), sin(turn), y), &found.point[i]);
        found.count += found.there[i];
    }
    return found;
}

/* Newell's method. */
sp_vec3 sp_rim_normal(const sp_vec3 *rim, int count)
{
    sp_vec3 twice = sp_v(0, 0, 0);
    for (int i = 0; i < count; i++)
        twice = sp_add(twice, sp_cross(sp_sub(rim[i], rim[0]), sp_sub(rim[(i + 1) % count], rim[0])));
    return twice;
}

/* Whether all of a rim is there, within `off` (m) of one plane that faces a direction. What stands before an opening is
 * no rim of it. */
bool sp_opening_rim_is_flat(const sp_opening_rim *rim, double off, sp_vec3 direction)
{
    sp_vec3 twice = sp_rim_normal(rim->point, SP_RIM_POINTS), first = rim->point[0];
    double least = INFINITY, most = -INFINITY;
    for (int i = 0; i < SP_RIM_POINTS; i++) {
        double height = sp_dot(twice, sp_sub(rim->point[i], first));
        least = fmin(least, height);
        most = fmax(most, height);
    }
    return rim->count == SP_RIM_POINTS && most - least <= off * sp_length(twice) &&
           fabs(sp_dot(twice, direction)) >= ASLANT * sp_length(twice);
}

/* From the triangles about its first point. */
sp_vec3 sp_rim_middle(const sp_vec3 *rim, int count)
{
    sp_vec3 twice = sp_rim_normal(rim, count), moment = sp_v(0, 0, 0);
    for (int i = 1; i + 1 < count; i++) {
        sp_vec3 a = sp_sub(rim[i], rim[0]), b = sp_sub(rim[i + 1], rim[0]);
        moment = sp_along(moment, sp_dot(sp_cross(a, b), twice) / (3 * sp_dot(twice, twice)), sp_add(a, b));
    }
    return sp_add(rim[0], moment);
}

double sp_rim_width(const sp_vec3 *rim, int count, sp_vec3 normal)
{
    double narrowest = INFINITY;
    for (int i = 0; i < count; i++) {
        sp_vec3 across = sp_cross(normal, sp_sub(rim[(i + 1) % count], rim[i]));
        if (!(sp_length(across) > 0))
            continue;
        across = sp_unit(across);
        double least = INFINITY, most = -INFINITY;
        for (int j = 0; j < count; j++) {
            least = fmin(least, sp_dot(across, rim[j]));
            most = fmax(most, sp_dot(across, rim[j]));
        }
        narrowest = fmin(narrowest, most - least);
    }
    return narrowest;
}
