/* Where the circles of two caps cross, the crossing and the two centres are the corners of a spherical triangle: its
 * angles are how far the circles reach into the other cap, and the caps have in common their sectors between the
 * crossings less twice the triangle. Half-angle formulas and L'Huilier's theorem (Todhunter, Spherical Trigonometry,
 * 1886, §45 and §102) keep the digits of thin jets. */
#include "caps.h"

#include <sprayplan/vector.h>

double sp_cap_height(double low, double high)
{
    return 2 * sin(0.5 * (high - low)) * sin(0.5 * (high + low));
}

/* The triangle's angle between the sides b and c, across from a. */
static double corner(double a, double b, double c)
{
    double half = 0.5 * (a + b + c);
    return 2 * atan2(sqrt(fmax(0, sin(half - b) * sin(half - c))), sqrt(fmax(0, sin(half) * sin(half - a))));
}

double sp_cap_arc(double circle, double cap, double apart)
{
    if (cap >= circle + apart || cap >= 2 * M_PI - circle - apart)
        return M_PI;
    return cap <= fabs(circle - apart) ? 0 : corner(cap, circle, apart);
}

static double excess(double a, double b, double c)
{
    double half = 0.5 * (a + b + c);
    double square = tan(0.5 * half) * tan(0.5 * (half - a)) * tan(0.5 * (half - b)) * tan(0.5 * (half - c));
    return 4 * atan(sqrt(fmax(0, square)));
}

static double cap_area(double radius)
{
    return 2 * M_PI * sp_cap_height(0, radius);
}

double sp_cap_overlap(double one, double other, double apart)
{
    if (one + other <= apart || one <= 0 || other <= 0)
        return 0;
    if (one + apart <= other || other + apart <= one)
        return cap_area(fmin(one, other));
    if (one + other + apart >= 2 * M_PI)
        return cap_area(one) + cap_area(other) - 4 * M_PI;
    double sectors =
        sp_cap_arc(one, other, apart) * sp_cap_height(0, one) + sp_cap_arc(other, one, apart) * sp_cap_height(0, other);
    return 2 * (sectors - excess(one, other, apart));
}
