#include "trace/distance.h"

#include "mesh/distance.h"
#include "trace/ray/visit.h"

#define EXACTLY (1 - 1e-9) /* a point placed exactly at the clearance must not fail by round-off */
#define ROUNDED (1 + 1e-9) /* boxes as near as the nearest so far are looked into, however their distance is rounded   \
                            */

/* Squared, from a point to a box. */
static double distance2_to(sp_vec3 point, const double low[3], const double high[3])
{
    const double p[3] = {point.x, point.y, point.z};
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double out = p[k] < low[k] ? low[k] - p[k] : p[k] > high[k] ? p[k] - high[k] : 0;
        sum += out * out;
    }
    return sum;
}

static double distance2_of(const sp_mesh *mesh, uint32_t triangle, sp_vec3 point)
{
    sp_vec3 away = sp_sub(sp_triangle_nearest(mesh, triangle, point), point);
    return sp_dot(away, away);
}

/* The nearest triangle so far. */
typedef struct {
    double distance2;
    uint32_t triangle;
} nearest;

typedef struct {
    const sp_mesh *mesh;
    sp_vec3 point;
    uint32_t part;
    nearest *found;
} nearest_search;

static bool box_may_have_nearer(const void *region, const double low[3], const double high[3])
{
    const nearest_search *search = region;
    return distance2_to(search->point, low, high) <= search->found->distance2 * ROUNDED;
}

static bool take_nearer(const void *region, uint32_t triangle)
{
    const nearest_search *search = region;
    nearest *found = search->found;
    if ((search->part != SP_NONE && search->mesh->part[triangle] != search->part) ||
        !sp_triangle_may_be_within(search->mesh, triangle, search->point, found->distance2 * ROUNDED))
        return true;
    double distance2 = distance2_of(search->mesh, triangle, search->point);
    if (distance2 < found->distance2 || (distance2 <= found->distance2 && triangle < found->triangle))
        *found = (nearest){distance2, triangle};
    return true;
}

uint32_t sp_tracer_nearest_triangle(const sp_tracer *tracer, uint32_t part, sp_vec3 point)
{
    nearest found = {INFINITY, SP_NONE};
    const nearest_search search = {sp_tracer_mesh(tracer), point, part, &found};
    sp_tracer_visit(tracer, box_may_have_nearer, take_nearer, &search);
    return found.triangle;
}

/* A ball, or what a way comes near, that is to have nothing in it. */
typedef struct {
    const sp_mesh *mesh;
    sp_vec3 middle, from, to;
    double around2, limit2; /* from the middle; from the point or way itself */
    uint32_t own;
} clearing;

static bool box_may_reach(const void *region, const double low[3], const double high[3])
{
    const clearing *clearing = region;
    return distance2_to(clearing->middle, low, high) <= clearing->around2;
}

static bool leaves_point_clear(const void *region, uint32_t triangle)
{
    const clearing *clearing = region;
    return clearing->mesh->part[triangle] == clearing->own ||
           !sp_triangle_may_be_within(clearing->mesh, triangle, clearing->middle, clearing->around2) ||
           distance2_of(clearing->mesh, triangle, clearing->middle) >= clearing->limit2;
}

bool sp_tracer_is_clear(const sp_tracer *tracer, sp_vec3 point, double clearance, uint32_t own)
{
    double limit2 = clearance * clearance * EXACTLY;
    const clearing ball = {
        .mesh = sp_tracer_mesh(tracer), .middle = point, .around2 = limit2, .limit2 = limit2, .own = own};
    return limit2 <= 0 || sp_tracer_visit(tracer, box_may_reach, leaves_point_clear, &ball);
}

static bool leaves_way_clear(const void *region, uint32_t triangle)
{
    const clearing *clearing = region;
    return !sp_triangle_may_be_within(clearing->mesh, triangle, clearing->middle, clearing->around2) ||
           sp_triangle_way2(clearing->mesh, triangle, clearing->from, clearing->to) > clearing->limit2;
}

bool sp_tracer_way_is_clear(const sp_tracer *tracer, sp_vec3 from, sp_vec3 to, double clearance)
{
    double around = 0.5 * sp_distance(from, to) + clearance;
    const clearing way = {.mesh = sp_tracer_mesh(tracer),
                          .middle = sp_scale(sp_add(from, to), 0.5),
                          .from = from,
                          .to = to,
                          .around2 = around * around * ROUNDED,
                          .limit2 = clearance * clearance * EXACTLY,
                          .own = SP_NONE};
    return sp_tracer_visit(tracer, box_may_reach, leaves_way_clear, &way);
}
