/* Directions in an order in which neighbours are close. */
#ifndef SPRAYPLAN_TRACE_DIRECTION_ORDER_H
#define SPRAYPLAN_TRACE_DIRECTION_ORDER_H

#include <stddef.h>
#include <stdint.h>

/* The sphere as six sides of a cube of 2^20 cells each. */
enum { SP_DIRECTION_BITS = 10 };

typedef struct {
    uint32_t key, ray;
} sp_direction_entry;

/* The bits of a number below 2^16, each with a zero before it. */
static inline uint32_t sp_spread_bits(uint32_t x)
{
    x = (x | x << 8) & 0x00FF00FF;
    x = (x | x << 4) & 0x0F0F0F0F;
    x = (x | x << 2) & 0x33333333;
    return (x | x << 1) & 0x55555555;
}

/* The cell at (u, v), each -1..1, on one of six sides. */
static inline uint32_t sp_direction_key(uint32_t side, float u, float v)
{
    const float half = 1 << (SP_DIRECTION_BITS - 1), most = (1 << SP_DIRECTION_BITS) - 1;
    float i = (u + 1) * half, j = (v + 1) * half;
    return side << 2 * SP_DIRECTION_BITS | sp_spread_bits((uint32_t)(i < most ? i : most)) |
           sp_spread_bits((uint32_t)(j < most ? j : most)) << 1;
}

/* Sorts order[0] by key, unless most already are next to their neighbours; order[1] is room. */
void sp_direction_sort(sp_direction_entry *order[2], size_t count);

#endif
