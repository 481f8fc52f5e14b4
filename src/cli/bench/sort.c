/* Rays of one origin in the order of their directions, so that neighbours in the order take the same way. */
#include "bench.h"

#include <stdlib.h>
#include <string.h>

/* The sphere in 2^22 cells: with a million jets in a cone, about one jet a cell. */
enum { DIGIT = 11, DIGITS = 2, VALUES = 1 << DIGIT, HALF = 1 << (DIGIT - 1) };

typedef struct {
    uint32_t key, ray;
} entry;

/* The bits of a number below 2^16, each with a zero before it. */
static uint32_t spread_bits(uint32_t x)
{
    x = (x | x << 8) & 0x00FF00FF;
    x = (x | x << 4) & 0x0F0F0F0F;
    x = (x | x << 2) & 0x33333333;
    return (x | x << 1) & 0x55555555;
}

/* The sphere as an octahedron laid flat (Meyer et al., "On floating-point normal vectors", 2010), along a Morton curve.
 */
static uint32_t direction_key(sp_vec3 d)
{
    float x = (float)d.x, y = (float)d.y, z = (float)d.z;
    float scale = 1 / (fabsf(x) + fabsf(y) + fabsf(z)), u = x * scale, v = y * scale;
    if (z < 0) {
        float folded = copysignf(1 - fabsf(v), u);
        v = copysignf(1 - fabsf(u), v);
        u = folded;
    }
    uint32_t i = (uint32_t)((u + 1) * HALF), j = (uint32_t)((v + 1) * HALF);
    return spread_bits(i < 2 * HALF ? i : 2 * HALF - 1) | spread_bits(j < 2 * HALF ? j : 2 * HALF - 1) << 1;
}

static void radix_sort(entry *from, entry *to, size_t count)
{
    uint32_t starts[DIGITS][VALUES] = {{0}};
    for (size_t i = 0; i < count; i++)
        for (int digit = 0; digit < DIGITS; digit++)
            starts[digit][from[i].key >> digit * DIGIT & (VALUES - 1)]++;
    for (int digit = 0; digit < DIGITS; digit++) {
        uint32_t sum = 0;
        for (int value = 0; value < VALUES; value++) {
            uint32_t here = starts[digit][value];
            starts[digit][value] = sum;
            sum += here;
        }
        for (size_t i = 0; i < count; i++)
            to[starts[digit][from[i].key >> digit * DIGIT & (VALUES - 1)]++] = from[i];
        entry *swap = from;
        from = to;
        to = swap;
    }
}

bool bench_sort(const sp_ray *rays, size_t count, sp_ray *sorted, uint32_t *order)
{
    entry *entries = malloc((2 * count + 1) * sizeof *entries);
    if (!entries)
        return false;
    for (size_t i = 0; i < count; i++)
        entries[i] = (entry){direction_key(rays[i].velocity), (uint32_t)i};
    radix_sort(entries, entries + count, count);
    const entry *result = entries + (DIGITS % 2) * count;
    for (size_t i = 0; i < count; i++) {
        order[i] = result[i].ray;
        sorted[i] = rays[result[i].ray];
    }
    free(entries);
    return true;
}
