/* A filtered determinant, then its exact expansion: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and
 * Fast Robust Geometric Predicates" (1997). */
#include "mesh/predicate.h"

#include <math.h>

#define TERMS 12

/* Adds `value` to an expansion of `count` terms that do not overlap, smallest first (Shewchuk's grow-expansion). */
static int grow(double *terms, int count, double value)
{
    double sum = value;
    for (int i = 0; i < count; i++) {
        double a = sum, b = terms[i];
        sum = a + b;
        double b_part = sum - a, a_part = sum - b_part;
        terms[i] = (a - a_part) + (b - b_part);
    }
    terms[count] = sum;
    return count + 1;
}

static double exact_orientation(const double a[2], const double b[2], const double c[2])
{
    const double factors[6][2] = {{a[0], b[1]},  {-a[0], c[1]}, {-c[0], b[1]},
                                  {-a[1], b[0]}, {a[1], c[0]},  {c[1], b[0]}};
    double terms[TERMS];
    int count = 0;
    for (int i = 0; i < 6; i++) {
        double product = factors[i][0] * factors[i][1];
        count = grow(terms, count, fma(factors[i][0], factors[i][1], -product));
        count = grow(terms, count, product);
    }
    while (count > 1 && terms[count - 1] == 0)
        count--;
    return terms[count - 1];
}

double sp_orientation(const double a[2], const double b[2], const double c[2])
{
    double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]);
    double determinant = left - right, bound = 3.3306690738754716e-16 * (fabs(left) + fabs(right));
    return fabs(determinant) > bound ? determinant : exact_orientation(a, b, c);
}
