/* How patterns' edges are blurred for patches that they cut. A patch is small against the way to it, and looks at most
 * as broad from the nozzle as its breadth says; the spray's edge is blurred by as much. The blur is odd about the edge
 * in a coordinate in which solid angle is even (the squared chord to a cone's axis; the height over a fan's middle,
 * Archimedes), so that over patches side by side the shares come to the region's own solid angle, however thin it is; a
 * plain test of the points would let it fall between them. */
#ifndef NOZZLE_BLUR_H
#define NOZZLE_BLUR_H

#include <math.h>

/* 0 to 1, with two even derivatives at either end (Perlin, Improving noise, 2002): what is left of a lattice's own
 * wavelengths after it is under 1 %. */
static inline double sp_blur_step(double t)
{
    t = fmin(1, fmax(0, t));
    return t * t * t * (10 + t * (6 * t - 15));
}

#endif
