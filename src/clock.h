/* Clocks. */
#ifndef SPRAYPLAN_CLOCK_H
#define SPRAYPLAN_CLOCK_H

#include <time.h>

/* s; 0 of a clock that there is none of. */
static inline double sp_clock(clockid_t clock)
{
    struct timespec time = {0};
    clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* s, of a clock that nobody sets. */
static inline double sp_now(void)
{
    return sp_clock(CLOCK_MONOTONIC);
}

#endif
