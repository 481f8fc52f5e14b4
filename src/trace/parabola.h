/* Parabolas against triangles and through kd-trees. */
#ifndef SPRAYPLAN_TRACE_PARABOLA_H
#define SPRAYPLAN_TRACE_PARABOLA_H

#include "trace/bvh.h"
#include "trace/kd_tree.h"
#include "trace/search.h"

/* A flight x(t) = origin + velocity t + gravity t²/2. */
typedef struct {
    double origin[3], velocity[3], gravity[3];
    double speed, pull; /* lengths of velocity and gravity */
    double farthest;    /* m, largest distance along an axis from the origin to the box around all triangles */
    double first, last; /* s, the flight is not in that box before or after */
} sp_parabola;

/* False where nothing can be hit: numbers that are not finite, or a time span that is empty. `low` and `high` are the
 * box around all triangles. `gravity` is not zero. */
bool sp_parabola_start(sp_parabola *parabola, const sp_ray *ray, sp_vec3 gravity, const double low[3],
                       const double high[3]);
/* x, along one axis, and all that it is summed from, m. */
static inline double sp_parabola_coordinate(const sp_parabola *p, int axis, double t)
{
    return p->origin[axis] + t * (p->velocity[axis] + 0.5 * t * p->gravity[axis]);
}
static inline double sp_parabola_summed(const sp_parabola *p, double t)
{
    return p->farthest + fabs(t) * (p->speed + 0.5 * fabs(t) * p->pull);
}

/* The real roots of a/2 t² + b t + c = 0 in ascending order, two of them, equal where they are one; false where there
 * are none. A root beyond all range is infinite or NaN. */
bool sp_quadratic_roots(double a, double b, double c, double roots[2]);

/* Hits are at most this far from their triangle, relative to what the position is summed from. */
#define SP_PARABOLA_GRAZING 0x1p-24

/* How thick every plane is taken up to time t, m: more than hits are off. */
static inline double sp_parabola_margin(const sp_parabola *p, double t)
{
    return 8 * SP_PARABOLA_GRAZING * sp_parabola_summed(p, t);
}

/* When the flight next turns along an axis after `from`, or its last time. */
double sp_parabola_turn(const sp_parabola *parabola, double from);
/* Cuts a piece without turns to when the coordinate is between low and high; false where nothing is left. */
bool sp_parabola_cut(const sp_parabola *parabola, int axis, double low, double high, double *from, double *to);

/* Tests one triangle. */
void sp_parabola_test(const sp_parabola *parabola, const sp_corners corners, uint32_t triangle, sp_search *search);
/* Searches all triangles, or the `count` of them that `references` names. */
void sp_parabola_search_all(const sp_parabola *parabola, const sp_corners *corners, size_t count, sp_search *search);
void sp_parabola_search_some(const sp_parabola *parabola, const sp_corners *corners, const uint32_t *references,
                             size_t count, sp_search *search);
/* Searches those that the flight passes in the tree. */
void sp_parabola_search_tree(const sp_parabola *parabola, const sp_corners *corners, const sp_kd_tree *tree,
                             sp_search *search);

/* Likewise in the wide hierarchy. */
void sp_parabola_search_bvh(const sp_parabola *parabola, const sp_bvh *bvh, sp_search *search);

#endif
