/* How many digits of a value are shown. A layout of a small vessel is shown as exactly as one of a large one: decimals
 * that suit the large one would leave a zero of it. */
#include <sprayplan/result.h>

#include <math.h>

#define MOST_DECIMALS 9
#define LEAST 0.5e-9   /* what rounds to more than 0 with these */
#define ROUND_OFF 1e-6 /* of the last decimal, by which what was computed may lie below what it stands for */

int sp_told_decimals(double value, int least, int digits)
{
    double size = fabs(value);
    if (!isfinite(size) || size < LEAST)
        return least;
    int decimals = least;
    /* the smallest number that these decimals show with as many digits, and what rounds up to it */
    while (decimals < MOST_DECIMALS && size < pow(10, digits - 1 - decimals) - 0.5 * pow(10, -decimals - 1))
        decimals++;
    return decimals;
}

/* A length that it is about as large as. */
int sp_place_decimals(const sp_figures *figures, int least)
{
    return sp_told_decimals(sqrt(figures->clean_area), least, least + 1);
}

int sp_area_decimals(const sp_figures *figures, int least)
{
    return sp_told_decimals(figures->clean_area, least, least + 1);
}

int sp_water_decimals(double l_min)
{
    return sp_told_decimals(l_min, 1, 3);
}

double sp_water_at_least(double l_min)
{
    /* 0.09996 would be shown as 0.100, but rounded down is 0.0999 */
    double parts = pow(10, sp_water_decimals(0.995 * l_min));
    return floor(parts * l_min + ROUND_OFF) / parts;
}

double sp_percent_at_most(double part, double whole)
{
    return ceil(1e4 * part / whole - ROUND_OFF) / 100;
}
