/* A parabola x(t) = origin + velocity t + gravity t²/2 against half-spaces and triangles. */
#ifndef TRACE_PARABOLA_H
#define TRACE_PARABOLA_H

#include <sprayplan/trace.h>

/* fmin and fmax without their rule for NaN, which costs a call. */
static inline double lesser(double a, double b) { return a < b ? a : b; }
static inline double greater(double a, double b) { return a > b ? a : b; }

/* The real roots of a t² + b t + c, ascending; returns how many (2 where they coincide). The discriminant is computed with its
 * round-off (Kahan, "On the Cost of Floating-Point Computation Without Extra-Precise Arithmetic", 2004), the roots without
 * cancellation. */
static inline int parabola_roots(double a, double b, double c, double roots[2])
{
    if (a == 0) {
        if (b == 0)
            return 0;
        roots[0] = -c / b;
        return 1;
    }
    double ac = 4 * a * c, discriminant = b * b - ac;
    if (fabs(discriminant) < 1e-3 * (b * b + fabs(ac)))
        discriminant = (b * b - ac) + (fma(b, b, -(b * b)) - fma(4 * a, c, -ac));
    if (discriminant < 0)
        return 0;
    double q = -0.5 * (b + copysign(sqrt(discriminant), b));
    double first = q / a, second = q == 0 ? 0 : c / q;
    roots[0] = lesser(first, second);
    roots[1] = greater(first, second);
    return 2;
}

/* Shrinks [*from, *to] to the hull of the times in it at which `height` + `speed` t + `pull` t²/2 ≤ 0; false where there are
 * none. */
static inline bool parabola_below(double height, double speed, double pull, double *from, double *to)
{
    double roots[2];
    int count = parabola_roots(0.5 * pull, speed, height, roots);
    if (count == 0) /* never crosses: below all the time or never */
        return pull < 0 || (pull == 0 && height <= 0);
    if (count == 1) {
        if (speed > 0)
            *to = lesser(*to, roots[0]);
        else
            *from = greater(*from, roots[0]);
    } else if (pull > 0) { /* below between the roots */
        *from = greater(*from, roots[0]);
        *to = lesser(*to, roots[1]);
    } else { /* below before the first and after the second */
        if (*from > roots[0])
            *from = greater(*from, roots[1]);
        if (*to < roots[1])
            *to = lesser(*to, roots[0]);
    }
    return *from <= *to;
}

/* What a triangle's test needs besides its corner: made once. */
typedef struct {
    double corner[3], normal[3]; /* the normal as long as twice the area */
    double slack;                /* of the weights, dimensionless: round-off at the coordinates' size */
    int axis;                    /* the normal's largest component: projected along it */
    double e1[2], e2[2];         /* edges to the second and third corner, projected */
    double inverse;              /* 1 / cross(e1, e2) */
} parabola_plane;

/* The times of crossing the plane, ascending; u and v where it is crossed within the triangle. Edges belong to both
 * neighbours. */
static inline bool parabola_triangle(const parabola_plane *plane, const double origin[3], const double velocity[3],
                                     const double gravity[3], double t_min, double t_max, uint32_t triangle,
                                     sp_hit *hit)
{
    double c = 0, b = 0, a = 0, roots[2];
    for (int k = 0; k < 3; k++) {
        c += plane->normal[k] * (origin[k] - plane->corner[k]);
        b += plane->normal[k] * velocity[k];
        a += plane->normal[k] * gravity[k];
    }
    int count = parabola_roots(0.5 * a, b, c, roots);
    int kx = (plane->axis + 1) % 3, ky = (plane->axis + 2) % 3;
    for (int i = 0; i < count; i++) {
        double t = roots[i];
        if (!(t > t_min && t < t_max))
            continue;
        double x = origin[kx] + velocity[kx] * t + 0.5 * gravity[kx] * t * t - plane->corner[kx];
        double y = origin[ky] + velocity[ky] * t + 0.5 * gravity[ky] * t * t - plane->corner[ky];
        double u = (x * plane->e2[1] - y * plane->e2[0]) * plane->inverse;
        double v = (plane->e1[0] * y - plane->e1[1] * x) * plane->inverse;
        if (u < -plane->slack || v < -plane->slack || u + v > 1 + plane->slack)
            continue;
        *hit = (sp_hit){t, lesser(greater(u, 0), 1), lesser(greater(v, 0), 1), triangle};
        if (hit->u + hit->v > 1)
            hit->v = 1 - hit->u;
        return true;
    }
    return false;
}

#endif
