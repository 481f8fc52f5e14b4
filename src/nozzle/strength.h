/* How strong a spray is against what a patch asks for. */
#ifndef NOZZLE_STRENGTH_H
#define NOZZLE_STRENGTH_H

#include <math.h>

/* The intensity of a flow (m³/s) that fills a solid angle (sr) evenly, over `unit`. Where that is the flux (m/s) that a
 * criterion asks for it is what one of transfer (1/m²) comes to as a share of it, m²; INFINITY where the criterion asks
 * for none, as any liquid covers. */
static inline double sp_strength(double flow, double solid_angle, double unit)
{
    return unit > 0 ? flow / (solid_angle * unit) : INFINITY;
}

#endif
