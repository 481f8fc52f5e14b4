#include "trace/ray/parabola.h"

/* b² - 2 a c. Where the two nearly cancel, with the products' rounding errors (Kahan, "On the Cost of Floating-Point
 * Computation Without Extra-Precise Arithmetic", 2004). */
static double discriminant(double a, double b, double c)
{
    double square = b * b, product = 2 * a * c, difference = square - product;
    if (3 * fabs(difference) >= square + product)
        return difference;
    return difference + (fma(b, b, -square) - fma(2 * a, c, -product));
}

bool sp_quadratic_roots(double a, double b, double c, double roots[2])
{
    double d = discriminant(a, b, c);
    if (!(d >= 0))
        return false;
    /* The sum has no cancellation; the other root follows from the product of both, 2 c / a. */
    double q = -(b + copysign(sqrt(d), b));
    double first = q / a, second = 2 * c / q;
    if (q == 0) /* b = d = 0 */
        first = second = a != 0 ? 0 : NAN;
    bool ordered = first <= second || isnan(second);
    roots[0] = ordered ? first : second;
    roots[1] = ordered ? second : first;
    return true;
}
