/* Eight numbers in single precision at a time, in whatever instructions the including file is compiled for. A mask has
 * bit i for lane i; comparisons with what is no number are false. */
#ifndef SPRAYPLAN_TRACE_WIDE_H
#define SPRAYPLAN_TRACE_WIDE_H

#include <stdint.h>
#include <string.h>

#ifdef __AVX2__

#include <immintrin.h>

typedef __m256 wide;

static inline wide wide_set(float a)
{
    return _mm256_set1_ps(a);
}
static inline wide wide_load(const float a[8])
{
    return _mm256_loadu_ps(a);
}
static inline void wide_store(float to[8], wide a)
{
    _mm256_storeu_ps(to, a);
}
/* Eight whole numbers 0..255. */
static inline wide wide_bytes(const uint8_t a[8])
{
    return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(const void *)a)));
}
static inline wide wide_add(wide a, wide b)
{
    return _mm256_add_ps(a, b);
}
static inline wide wide_subtract(wide a, wide b)
{
    return _mm256_sub_ps(a, b);
}
static inline wide wide_multiply(wide a, wide b)
{
    return _mm256_mul_ps(a, b);
}
/* a b + c, rounded once where that is cheap. */
static inline wide wide_multiply_add(wide a, wide b, wide c)
{
    return _mm256_fmadd_ps(a, b, c);
}
/* c - a b, likewise. */
static inline wide wide_subtract_product(wide c, wide a, wide b)
{
    return _mm256_fnmadd_ps(a, b, c);
}
static inline wide wide_divide(wide a, wide b)
{
    return _mm256_div_ps(a, b);
}
static inline wide wide_lesser(wide a, wide b)
{
    return _mm256_min_ps(a, b);
}
static inline wide wide_greater(wide a, wide b)
{
    return _mm256_max_ps(a, b);
}
static inline wide wide_absolute(wide a)
{
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a);
}
/* The larger of the two amounts. */
static inline wide wide_greater_amount(wide a, wide b)
{
#ifdef __AVX512DQ__
    return _mm256_range_ps(a, b, 0x0b);
#else
    return wide_greater(wide_absolute(a), wide_absolute(b));
#endif
}
static inline uint32_t wide_at_most(wide a, wide b)
{
#ifdef __AVX512VL__
    return _mm256_cmp_ps_mask(a, b, _CMP_LE_OQ);
#else
    return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ));
#endif
}
/* In each lane: where a is at most b, one, else the other. */
static inline wide wide_where_at_most(wide a, wide b, wide one, wide other)
{
#ifdef __AVX512VL__
    return _mm256_mask_mov_ps(other, _mm256_cmp_ps_mask(a, b, _CMP_LE_OQ), one);
#else
    return _mm256_blendv_ps(other, one, _mm256_cmp_ps(a, b, _CMP_LE_OQ));
#endif
}

/* Writes the numbers of children whose span from..to is one, and these spans as ways and ends, in the order of the
 * bytes of `order`; up to eight places are written over. Returns how many there are. */
static inline int wide_pack_spans(const uint32_t child[8], wide from, wide to, uint64_t order, uint32_t *children,
                                  float *ways, float *ends)
{
    __m256i index = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)order));
    __m256i number = _mm256_permutevar8x32_epi32(_mm256_loadu_si256((const __m256i *)(const void *)child), index);
    from = _mm256_permutevar8x32_ps(from, index);
    to = _mm256_permutevar8x32_ps(to, index);
    uint32_t mask = wide_at_most(from, to);
#ifdef __AVX512VL__
    number = _mm256_maskz_compress_epi32((__mmask8)mask, number);
    from = _mm256_maskz_compress_ps((__mmask8)mask, from);
    to = _mm256_maskz_compress_ps((__mmask8)mask, to);
#else
    uint64_t bytes = _pdep_u64(mask, 0x0101010101010101u) * 255;
    index = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)_pext_u64(0x0706050403020100u, bytes)));
    number = _mm256_permutevar8x32_epi32(number, index);
    from = _mm256_permutevar8x32_ps(from, index);
    to = _mm256_permutevar8x32_ps(to, index);
#endif
    _mm256_storeu_si256((__m256i *)(void *)children, number);
    _mm256_storeu_ps(ways, from);
    _mm256_storeu_ps(ends, to);
    return __builtin_popcount(mask);
}

/* The three-bit numbers of a node's order as bytes. */
static inline uint64_t wide_order(uint32_t bits)
{
    return _pdep_u64(bits, 0x0707070707070707u);
}

#else

typedef struct {
    float lane[8];
} wide;

#define WIDE_EACH(value)                                                                                               \
    wide result;                                                                                                       \
    for (int i = 0; i < 8; i++)                                                                                        \
        result.lane[i] = (value);                                                                                      \
    return result

static inline wide wide_set(float a)
{
    WIDE_EACH(a);
}
static inline wide wide_load(const float a[8])
{
    WIDE_EACH(a[i]);
}
static inline void wide_store(float to[8], wide a)
{
    memcpy(to, a.lane, sizeof a.lane);
}
static inline wide wide_bytes(const uint8_t a[8])
{
    WIDE_EACH((float)a[i]);
}
static inline wide wide_add(wide a, wide b)
{
    WIDE_EACH(a.lane[i] + b.lane[i]);
}
static inline wide wide_subtract(wide a, wide b)
{
    WIDE_EACH(a.lane[i] - b.lane[i]);
}
static inline wide wide_multiply(wide a, wide b)
{
    WIDE_EACH(a.lane[i] * b.lane[i]);
}
static inline wide wide_multiply_add(wide a, wide b, wide c)
{
    WIDE_EACH(a.lane[i] * b.lane[i] + c.lane[i]);
}
static inline wide wide_subtract_product(wide c, wide a, wide b)
{
    WIDE_EACH(c.lane[i] - a.lane[i] * b.lane[i]);
}
static inline wide wide_divide(wide a, wide b)
{
    WIDE_EACH(a.lane[i] / b.lane[i]);
}
static inline wide wide_lesser(wide a, wide b)
{
    WIDE_EACH(a.lane[i] < b.lane[i] ? a.lane[i] : b.lane[i]);
}
static inline wide wide_greater(wide a, wide b)
{
    WIDE_EACH(a.lane[i] > b.lane[i] ? a.lane[i] : b.lane[i]);
}
static inline wide wide_absolute(wide a)
{
    WIDE_EACH(a.lane[i] < 0 ? -a.lane[i] : a.lane[i]);
}
static inline wide wide_greater_amount(wide a, wide b)
{
    return wide_greater(wide_absolute(a), wide_absolute(b));
}
static inline uint32_t wide_at_most(wide a, wide b)
{
    uint32_t mask = 0;
    for (int i = 0; i < 8; i++)
        mask |= (uint32_t)(a.lane[i] <= b.lane[i]) << i;
    return mask;
}
static inline wide wide_where_at_most(wide a, wide b, wide one, wide other)
{
    WIDE_EACH(a.lane[i] <= b.lane[i] ? one.lane[i] : other.lane[i]);
}

static inline int wide_pack_spans(const uint32_t child[8], wide from, wide to, uint64_t order, uint32_t *children,
                                  float *ways, float *ends)
{
    int count = 0;
    for (int i = 0; i < 8; i++) {
        unsigned slot = order >> 8 * i & 7;
        children[count] = child[slot];
        ways[count] = from.lane[slot];
        ends[count] = to.lane[slot];
        count += from.lane[slot] <= to.lane[slot];
    }
    return count;
}
static inline uint64_t wide_order(uint32_t bits)
{
    uint64_t order = 0;
    for (int i = 0; i < 8; i++)
        order |= (uint64_t)(bits >> 3 * i & 7) << 8 * i;
    return order;
}

#undef WIDE_EACH

#endif

/* As wide_pack_spans, but for the ends. */
static inline int wide_pack(const uint32_t child[8], wide from, wide to, uint64_t order, uint32_t *children,
                            float *ways)
{
    float ends[8];
    return wide_pack_spans(child, from, to, order, children, ways, ends);
}

#endif
