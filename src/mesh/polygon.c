/* A fan is right where all its triangles face the side that the polygon does: the side of Newell's normal, which is the
 * sum of the fan's areas (F. Tampieri, "Newell's Method for Computing the Plane Equation of a Polygon", Graphics Gems
 * III, 1992). Else the polygon is laid flat by leaving out the coordinate along which its normal is longest, so that no
 * coordinate is rounded. */
#include "mesh/polygon.h"

#include "mesh/ears.h"
#include "mesh/self_crossing.h"

#include <stdlib.h>

#define OVERHANG                                                                                                       \
    1e-6                /* of the polygon's area that a fan may cover outside: coordinates are written with few digits \
                         */
#define NO_AREA 1e-12   /* of the square of its extent: none */
#define CANCELLED 1e-9  /* of the fan's area: a polygon with less area lies on both sides of itself */
#define LOOKED_AT 10000 /* corners at most of what is searched for crossings: all pairs, at worst */

typedef struct {
    const sp_vec3 *vertices;
    const uint32_t *corners;
    size_t count;
    double scale; /* a power of two that leaves no coordinate above 1 */
} polygon;

static double find_scale(const sp_vec3 *vertices, const uint32_t *corners, size_t count)
{
    double largest = 0;
    int exponent;
    for (size_t i = 0; i < count; i++) {
        sp_vec3 p = vertices[corners[i]];
        largest = fmax(largest, fmax(fabs(p.x), fmax(fabs(p.y), fabs(p.z))));
    }
    frexp(largest, &exponent);
    return ldexp(1, exponent > -1000 ? -exponent : 1000);
}

static sp_vec3 point_of(const polygon *p, size_t i)
{
    return sp_scale(p->vertices[p->corners[i]], p->scale);
}

/* Twice the area of triangle i of the fan, along its normal. */
static sp_vec3 fan_area(const polygon *p, size_t i)
{
    sp_vec3 first = point_of(p, 0);
    return sp_cross(sp_sub(point_of(p, i + 1), first), sp_sub(point_of(p, i + 2), first));
}

/* Twice the polygon's area along Newell's normal; twice that of its fan's triangles. */
static sp_vec3 newell(const polygon *p, double *of_fan)
{
    sp_vec3 area = sp_v(0, 0, 0);
    *of_fan = 0;
    for (size_t i = 0; i + 2 < p->count; i++) {
        sp_vec3 own = fan_area(p, i);
        area = sp_add(area, own);
        *of_fan += sp_length(own);
    }
    return area;
}

/* Whether next to nothing of the fan faces the other side. */
static bool is_fan(const polygon *p, sp_vec3 area)
{
    sp_vec3 normal = sp_unit(area);
    double outside = 0;
    for (size_t i = 0; i + 2 < p->count; i++)
        outside -= fmin(0, sp_dot(fan_area(p, i), normal));
    return outside <= OVERHANG * sp_length(area);
}

static bool has_area(const polygon *p, double of_fan)
{
    double extent = 0;
    for (size_t i = 1; i < p->count; i++)
        extent = fmax(extent, sp_distance(point_of(p, i), point_of(p, 0)));
    return of_fan > NO_AREA * extent * extent;
}

/* Anticlockwise. */
static void lay_flat(const polygon *p, sp_vec3 area, double (*flat)[2])
{
    const double along[3] = {area.x, area.y, area.z};
    int out = fabs(along[0]) > fabs(along[1]) ? 0 : 1;
    out = fabs(along[2]) >= fabs(along[out]) ? 2 : out;
    int first = (out + 1) % 3, second = (out + 2) % 3;
    for (size_t i = 0; i < p->count; i++) {
        sp_vec3 q = point_of(p, i);
        const double at[3] = {q.x, q.y, q.z};
        flat[i][0] = at[along[out] > 0 ? first : second];
        flat[i][1] = at[along[out] > 0 ? second : first];
    }
}

static bool cut_inside(const polygon *p, sp_vec3 area, sp_facets *cut, sp_error *error)
{
    double(*flat)[2] = malloc(p->count * sizeof *flat);
    bool good = flat || sp_fail_memory(error);
    if (good)
        lay_flat(p, area, flat);
    if (good && p->count <= LOOKED_AT)
        good = sp_find_self_crossing((const double(*)[2])flat, p->count, &cut->tangled, error);
    if (good && !cut->tangled) {
        cut->triangles = malloc((p->count - 2) * sizeof *cut->triangles);
        bool done = false;
        good = cut->triangles ? sp_clip_ears((const double(*)[2])flat, (uint32_t)p->count, cut->triangles, &done, error)
                              : sp_fail_memory(error) != NULL;
        cut->tangled = !done;
    }
    free(flat);
    if (!good || cut->tangled) {
        free(cut->triangles);
        cut->triangles = NULL;
    }
    return good;
}

bool sp_polygon_cut(const sp_vec3 *vertices, const uint32_t *corners, size_t count, sp_facets *cut, sp_error *error)
{
    *cut = (sp_facets){0};
    if (count == 3)
        return true;
    polygon p = {vertices, corners, count, find_scale(vertices, corners, count)};
    double of_fan;
    sp_vec3 area = newell(&p, &of_fan);
    if (!has_area(&p, of_fan))
        return true;
    cut->tangled = sp_length(area) <= CANCELLED * of_fan;
    return cut->tangled || is_fan(&p, area) || cut_inside(&p, area, cut, error);
}

void sp_facets_free(sp_facets *cut)
{
    free(cut->triangles);
    *cut = (sp_facets){0};
}
