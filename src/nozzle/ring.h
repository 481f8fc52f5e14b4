/* Patterns that fill a ring about the axis, or a cone. Polar angles in rad. */
#ifndef NOZZLE_RING_H
#define NOZZLE_RING_H

#include <sprayplan/nozzle.h>

/* How far inside of a ring a polar angle lies. One without an edge keeps every direction as far inside as can be: π. */
static inline double sp_ring_margin(double low, double high, double polar)
{
    return fmin(high < M_PI ? high - polar : M_PI, low > 0 ? polar - low : M_PI);
}
/* Direction i of `count` along the outer edge of a spray. */
static inline sp_vec3 sp_ring_rim(const sp_spray *spray, int i, int count)
{
    double edge = spray->high, turn = 2 * M_PI * i / count;
    return sp_v(sin(edge) * cos(turn), sin(edge) * sin(turn), cos(edge));
}

#endif
