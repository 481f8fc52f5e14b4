/* The lesser and the greater of two numbers, neither of them NaN: fmin and fmax are calls into the C library. */
#ifndef MESH_MIN_MAX_H
#define MESH_MIN_MAX_H

static inline double sp_lesser(double a, double b)
{
    return a < b ? a : b;
}

static inline double sp_greater(double a, double b)
{
    return a > b ? a : b;
}

#endif
