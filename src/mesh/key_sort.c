/* Radix sort, least significant digit first: stable and linear (Knuth, TAOCP 3, 5.2.5). */
#include "mesh/key_sort.h"

#include <stdlib.h>
#include <string.h>

#define DIGIT_BITS 11
#define DIGITS (1u << DIGIT_BITS)

static uint64_t largest(const uint64_t *keys, size_t count)
{
    uint64_t most = 0;
    for (size_t i = 0; i < count; i++)
        most = keys[i] > most ? keys[i] : most;
    return most;
}

static uint32_t digit(uint64_t key, int shift)
{
    return (uint32_t)(key >> shift) & (DIGITS - 1);
}

/* start[d] becomes where the first key with digit d goes. */
static void count_digits(const uint64_t *keys, size_t count, int shift, size_t start[DIGITS])
{
    memset(start, 0, DIGITS * sizeof *start);
    for (size_t i = 0; i < count; i++)
        start[digit(keys[i], shift)]++;
    size_t sum = 0;
    for (uint32_t d = 0; d < DIGITS; d++) {
        size_t here = start[d];
        start[d] = sum;
        sum += here;
    }
}

bool sp_sort_keys(uint64_t *keys, size_t count)
{
    uint64_t *other = malloc((count + !count) * sizeof *other);
    if (!other)
        return false;
    uint64_t most = largest(keys, count);
    uint64_t *from = keys, *to = other;
    for (int shift = 0; shift < 64 && most >> shift; shift += DIGIT_BITS) {
        size_t start[DIGITS];
        count_digits(from, count, shift, start);
        for (size_t i = 0; i < count; i++)
            to[start[digit(from[i], shift)]++] = from[i];
        uint64_t *swap = from;
        from = to;
        to = swap;
    }
    if (from != keys)
        memcpy(keys, from, count * sizeof *keys);
    free(other);
    return true;
}

bool sp_order_by_key(const uint64_t *keys, size_t count, uint32_t *order)
{
    uint32_t *other = malloc((count + !count) * sizeof *other);
    if (!other)
        return false;
    uint64_t most = largest(keys, count);
    for (size_t i = 0; i < count; i++)
        order[i] = (uint32_t)i;
    uint32_t *from = order, *to = other;
    for (int shift = 0; shift < 64 && most >> shift; shift += DIGIT_BITS) {
        size_t start[DIGITS];
        count_digits(keys, count, shift, start);
        for (size_t i = 0; i < count; i++)
            to[start[digit(keys[from[i]], shift)]++] = from[i];
        uint32_t *swap = from;
        from = to;
        to = swap;
    }
    if (from != order)
        memcpy(order, from, count * sizeof *order);
    free(other);
    return true;
}
