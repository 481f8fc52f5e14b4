/* Parabolas against triangles and through kd-trees. */
#ifndef SPRAYPLAN_TRACE_PARABOLA_H
#define SPRAYPLAN_TRACE_PARABOLA_H

#include "trace/kd/kd_tree.h"
#include "trace/ray/search.h"

/* The acceleration of a flight, gravity or with drag that of a piece of it, prepared for tests. */
typedef struct {
    double vector[3]; /* m/s² */
    double strength;  /* its length */
    double down[3];   /* its direction */
} sp_acceleration;

/* Without gravity there is no strength, and no direction. */
sp_acceleration sp_acceleration_of(sp_vec3 gravity);

/* A flight x(t) = origin + velocity t + gravity t²/2. Three products with a point's way from the origin tell all that
 * matters of it: how far it is beside the vertical plane of the flight, when the flight comes above or below it, and
 * how deep it lies. A flight that hardly leaves its vertical line is taken to be on it; then the first two are places
 * across it. */
typedef struct {
    double origin[3], velocity[3], gravity[3];
    double beside[3];    /* m²/s: horizontal, across the horizontal velocity, and as long */
    double ahead[3];     /* s/m: the horizontal velocity over its square */
    double down[3];      /* 1 */
    bool vertical;       /* then beside and ahead are horizontal directions (1) */
    double fall;         /* m/s, downward speed at t = 0 */
    double across;       /* m²/s², square of the horizontal speed */
    double acceleration; /* m/s² */
    double speed;        /* m/s, at t = 0, all components added up */
    double farthest;     /* m, largest distance along an axis from the origin to the box around all triangles */
} sp_parabola;

/* False where nothing can be hit: numbers that are not finite. `low` and `high` are the box around all triangles. */
bool sp_parabola_start(sp_parabola *parabola, const sp_ray *ray, const sp_acceleration *acceleration,
                       const double low[3], const double high[3]);
/* Leaves the search no times at which the flight is not in that box; false where there are no others. */
bool sp_parabola_limit(const sp_parabola *parabola, sp_ray_search *search);
/* x, along one axis, and all that it is summed from, m. */
static inline double sp_parabola_coordinate(const sp_parabola *p, int axis, double t)
{
    return p->origin[axis] + t * (p->velocity[axis] + 0.5 * t * p->gravity[axis]);
}
static inline double sp_parabola_summed(const sp_parabola *p, double t)
{
    return p->farthest + fabs(t) * (p->speed + 0.5 * fabs(t) * p->acceleration);
}

/* The real roots of a/2 t² + b t + c = 0 in ascending order, two of them, equal where they are one; false where there
 * are none. A root beyond all range is infinite or NaN. */
bool sp_quadratic_roots(double a, double b, double c, double roots[2]);

/* Where the flight is at the time of a hit, it is at most this far from the triangle, relative to what the position is
 * summed from: some operations' rounding, and what a flight taken to be vertical is off its line. */
#define SP_PARABOLA_ROUNDING 0x1p-40

/* How thick every plane is taken up to time t, m: more than hits are off. */
static inline double sp_parabola_margin(const sp_parabola *p, double t)
{
    return 8 * SP_PARABOLA_ROUNDING * sp_parabola_summed(p, t);
}

/* When the flight next turns along an axis after `from`; `last` where it does not before. */
double sp_parabola_turn(const sp_parabola *parabola, double from, double last);
/* Cuts a piece without turns to when the coordinate is between low and high; false where nothing is left. */
bool sp_parabola_cut(const sp_parabola *parabola, int axis, double low, double high, double *from, double *to);

/* Takes the first hit of this triangle, if it is better than what was found. */
void sp_parabola_test(const sp_parabola *parabola, const sp_corners corners, uint32_t triangle, sp_ray_search *search);
/* Searches all triangles. */
void sp_parabola_search_all(const sp_parabola *parabola, const sp_corners *corners, size_t count,
                            sp_ray_search *search);
/* Searches those that the flight passes in the tree. */
void sp_parabola_search_tree(const sp_parabola *parabola, const sp_corners *corners, const sp_kd_tree *tree,
                             sp_ray_search *search);

#endif
