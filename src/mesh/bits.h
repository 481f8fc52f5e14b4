/* Rows of bits, 64 to a word, the lowest first. */
#ifndef MESH_BITS_H
#define MESH_BITS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

static inline size_t sp_bits_words(size_t bits)
{
    return (bits + 63) / 64;
}

static inline bool sp_bits_get(const uint64_t *bits, size_t at)
{
    return bits[at / 64] >> (at % 64) & 1;
}

/* Sets [first, first + count). */
static inline void sp_bits_fill(uint64_t *bits, size_t first, size_t count)
{
    if (!count)
        return;
    size_t word = first / 64, last = (first + count - 1) / 64;
    uint64_t from = ~0ull << (first % 64), to = ~0ull >> (63 - (first + count - 1) % 64);
    if (word == last) {
        bits[word] |= from & to;
        return;
    }
    bits[word] |= from;
    while (++word < last)
        bits[word] = ~0ull;
    bits[last] |= to;
}

/* The first bit from `at` on that equals `value`, or `end`. */
static inline size_t sp_bits_find(const uint64_t *bits, size_t at, size_t end, bool value)
{
    if (at >= end)
        return end;
    uint64_t flip = value ? 0 : ~0ull, word = (bits[at / 64] ^ flip) & ~0ull << (at % 64);
    while (!word) {
        at = (at / 64 + 1) * 64;
        if (at >= end)
            return end;
        word = bits[at / 64] ^ flip;
    }
    at = at / 64 * 64 + (size_t)__builtin_ctzll(word);
    return at < end ? at : end;
}

#endif
