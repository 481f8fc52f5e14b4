/* Numbers drawn from a seed. */
#ifndef NOZZLE_SCRAMBLE_H
#define NOZZLE_SCRAMBLE_H

#include <stdint.h>

/* Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014: SplitMix64's finaliser. */
static inline uint64_t sp_scramble(uint64_t x)
{
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/* A fixed-point fraction of 2^64 as a number in (0, 1). */
static inline double sp_fraction(uint64_t bits)
{
    return ((double)(bits >> 12) + 0.5) * 0x1p-52;
}

#endif
