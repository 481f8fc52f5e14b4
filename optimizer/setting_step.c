/* The nearest of the settings that lie a step apart. */
#include <sprayplan/place.h>

#define DIGITS 12
#define SHIFT_MOST 27 /* of the decimal point: powers of ten up to this are exact in long double */

/* To 12 digits, so that 3 x .2 is .6: settings are to read as people write them. */
static long double tidy(long double number)
{
    long double power = 1;
    for (int i = 0; i < SHIFT_MOST && fabsl(number) * power < 1e11L; i++)
        power *= 10;
    return nearbyintl(number * power) / power;
}

double sp_step_nearest(sp_step step, double from, double value, double low, double high)
{
    double size = sp_step_size(step);
    if (!(size > 0))
        return fmin(high, fmax(low, value));
    double least = ceil((low - from) / size - 1e-9), most = floor((high - from) / size + 1e-9);
    double k = fmin(most, fmax(least, nearbyint((value - from) / size)));
    if (k == 0 || !(least <= most) || !isfinite(k))
        return from;
    return (double)(tidy((long double)from / step.unit + (long double)k * step.count) * step.unit);
}
