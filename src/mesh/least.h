/* The lesser and the greater of two numbers, neither of them NaN: fmin and fmax are calls into the C library. */
#ifndef MESH_LEAST_H
#define MESH_LEAST_H

static inline double sp_least(double a, double b)
{
    return a < b ? a : b;
}

static inline double sp_most(double a, double b)
{
    return a > b ? a : b;
}

#endif
