/* Which weights of a triangle's corners give the origin, in a plane into which the triangle is projected. */
#ifndef SPRAYPLAN_TRACE_BARYCENTRIC_H
#define SPRAYPLAN_TRACE_BARYCENTRIC_H

#include <math.h>
#include <stdbool.h>

/* a b - c d to the last bit but one: Kahan's algorithm (Jeannerod, Louvet, Muller, "Further analysis of Kahan's
 * algorithm for the accurate computation of 2x2 determinants", 2013). */
static inline double sp_difference_of_products(double a, double b, double c, double d)
{
    double cd = c * d, error = fma(-c, d, cd);
    return fma(a, b, -cd) + error;
}

static inline bool sp_weights_agree(const double weights[3])
{
    bool below = weights[0] < 0 || weights[1] < 0 || weights[2] < 0;
    bool above = weights[0] > 0 || weights[1] > 0 || weights[2] > 0;
    return !(above && below);
}

/* Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2013, in double precision: triangles that share an
 * edge decide by the same numbers on which side of it the origin is, and an origin on the edge belongs to both. False
 * outside. Where the triangle is seen almost edge-on, the plain weights are mostly round-off, and what is averaged by
 * them would be anywhere along the triangle: there they are taken to the last bit. */
static inline bool sp_barycentric(const double x[3], const double y[3], double weights[3])
{
    weights[0] = x[2] * y[1] - y[2] * x[1];
    weights[1] = x[0] * y[2] - y[0] * x[2];
    weights[2] = x[1] * y[0] - y[1] * x[0];
    if (!sp_weights_agree(weights))
        return false;
    double reach = 0;
    for (int i = 0; i < 3; i++)
        reach = fabs(x[i]) + fabs(y[i]) > reach ? fabs(x[i]) + fabs(y[i]) : reach;
    if (fabs(weights[0] + weights[1] + weights[2]) > 0x1p-8 * reach * reach)
        return true;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        weights[i] = sp_difference_of_products(x[k], y[j], y[k], x[j]);
    }
    return sp_weights_agree(weights) && weights[0] + weights[1] + weights[2] != 0;
}

#endif
