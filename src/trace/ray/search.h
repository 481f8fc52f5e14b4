/* What a ray is looking for, and what it has found. */
#ifndef SPRAYPLAN_TRACE_SEARCH_H
#define SPRAYPLAN_TRACE_SEARCH_H

#include "mesh/min_max.h"

#include <sprayplan/trace.h>

#include <float.h>
#include <string.h>

/* Corners of a triangle, m. */
typedef double sp_corners[3][3];

typedef struct {
    double t_min; /* hits are later than this */
    double limit; /* and not later than this: the best so far, or at first the last time before t_max */
    uint32_t skip;
    bool any; /* the first hit found will do */
    sp_hit best;
} sp_ray_search;

/* The last time before t_max. */
static inline double sp_ray_search_limit(const sp_ray *ray)
{
    if (!(ray->t_max > 0))
        return nextafter(ray->t_max, -INFINITY);
    uint64_t bits; /* of a positive number, one less for the number before it */
    double limit;
    memcpy(&bits, &ray->t_max, sizeof bits);
    bits--;
    memcpy(&limit, &bits, sizeof limit);
    return limit;
}

static inline sp_ray_search sp_ray_search_start(const sp_ray *ray, bool any)
{
    return (sp_ray_search){ray->t_min, sp_ray_search_limit(ray), ray->skip, any, {INFINITY, 0, 0, SP_NONE}};
}

/* Of equal times the lowest triangle wins, in whatever order they come. */
static inline bool sp_ray_search_wants(const sp_ray_search *search, double t, uint32_t triangle)
{
    return t > search->t_min && (t < search->limit || (t == search->limit && triangle < search->best.triangle));
}

static inline void sp_ray_search_take(sp_ray_search *search, double t, double u, double v, uint32_t triangle)
{
    search->limit = t;
    search->best = (sp_hit){t, u, v, triangle};
}

static inline bool sp_ray_search_done(const sp_ray_search *search)
{
    return search->any && search->best.triangle != SP_NONE;
}

static inline void sp_to_array(sp_vec3 p, double array[3])
{
    array[0] = p.x;
    array[1] = p.y;
    array[2] = p.z;
}

#endif
