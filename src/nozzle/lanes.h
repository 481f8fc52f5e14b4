/* SP_LANES floats at a time, held in as many vectors as the including file's instruction set takes for them. Operations
 * on lanes are IEEE's one by one (the project forbids contraction) and their order does not depend on the vectors'
 * width, so that every instruction set gives the same bits. */
#ifndef NOZZLE_LANES_H
#define NOZZLE_LANES_H

#include "outline.h"

#include <math.h>
#include <stdint.h>
#include <string.h>
#ifdef __SSE2__
#include <immintrin.h>
#endif

#if defined __AVX512DQ__
#define WIDTH 16
#elif defined __AVX2__
#define WIDTH 8
#else
#define WIDTH 4
#endif
#define PARTS (SP_LANES / WIDTH)

typedef float floats __attribute__((vector_size(4 * WIDTH)));
typedef int32_t integers __attribute__((vector_size(4 * WIDTH)));
typedef double doubles __attribute__((vector_size(8 * WIDTH)));
/* the same anywhere in memory */
typedef float loose_floats __attribute__((vector_size(4 * WIDTH), aligned(4), may_alias));

typedef struct {
    floats part[PARTS];
} lanes;
typedef struct {
    integers part[PARTS]; /* all bits of a lane are set, or none */
} mask;
typedef struct {
    doubles part[PARTS];
} wide_lanes;

#define INLINE static inline __attribute__((always_inline))
#ifdef __SANITIZE_ADDRESS__
#define IN_MANY_LOOPS static /* or compiling would take three times as long */
#else
#define IN_MANY_LOOPS INLINE
#endif
#define EACH_PART(i) for (int i = 0; i < PARTS; i++)

INLINE lanes load(const float *from)
{
    lanes r;
    EACH_PART(i) r.part[i] = *(const loose_floats *)(from + i * WIDTH);
    return r;
}
INLINE void store(lanes a, float *to)
{
    EACH_PART(i) * (loose_floats *)(to + i * WIDTH) = a.part[i];
}
INLINE lanes all(float value)
{
    lanes r;
    EACH_PART(i) r.part[i] = value - (floats){0};
    return r;
}
INLINE lanes add(lanes a, lanes b)
{
    EACH_PART(i) a.part[i] += b.part[i];
    return a;
}
INLINE lanes subtract(lanes a, lanes b)
{
    EACH_PART(i) a.part[i] -= b.part[i];
    return a;
}
INLINE lanes multiply(lanes a, lanes b)
{
    EACH_PART(i) a.part[i] *= b.part[i];
    return a;
}
INLINE lanes scale(lanes a, float b)
{
    EACH_PART(i) a.part[i] *= b;
    return a;
}
INLINE lanes magnitude(lanes a)
{
    EACH_PART(i) a.part[i] = (floats)((integers)a.part[i] & 0x7fffffff);
    return a;
}
INLINE mask at_least(lanes a, lanes b)
{
    mask r;
    EACH_PART(i) r.part[i] = a.part[i] >= b.part[i];
    return r;
}
INLINE mask below(lanes a, lanes b)
{
    mask r;
    EACH_PART(i) r.part[i] = a.part[i] < b.part[i];
    return r;
}
INLINE mask both(mask a, mask b)
{
    EACH_PART(i) a.part[i] &= b.part[i];
    return a;
}
INLINE mask but(mask a, mask b)
{
    EACH_PART(i) a.part[i] &= ~b.part[i];
    return a;
}
INLINE lanes keep(lanes a, mask where)
{
    EACH_PART(i) a.part[i] = (floats)((integers)a.part[i] & where.part[i]);
    return a;
}
INLINE lanes choose(mask where, lanes yes, lanes no)
{
    EACH_PART(i)
    yes.part[i] = (floats)(((integers)yes.part[i] & where.part[i]) | ((integers)no.part[i] & ~where.part[i]));
    return yes;
}
INLINE wide_lanes add_narrow(wide_lanes a, lanes b)
{
    EACH_PART(i) a.part[i] += __builtin_convertvector(b.part[i], doubles);
    return a;
}
INLINE lanes dot(lanes x, lanes y, lanes z, const float v[3])
{
    return add(add(scale(x, v[0]), scale(y, v[1])), scale(z, v[2]));
}

/* The first `count` lanes. */
INLINE mask first_lanes(size_t count)
{
    static const int32_t number[SP_LANES] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    mask r;
    memcpy(&r, number, sizeof r);
    EACH_PART(i) r.part[i] = r.part[i] < (int32_t)count;
    return r;
}

/* The sum of all lanes, in double precision from the first to the last, or, where that would take too long, in single
 * precision by halves. */
INLINE double sum_of(wide_lanes a)
{
    double lane[SP_LANES], sum = 0;
    memcpy(lane, &a, sizeof lane);
    for (int i = 0; i < SP_LANES; i++)
        sum += lane[i];
    return sum;
}
INLINE float fold(lanes a)
{
    typedef float eight __attribute__((vector_size(32)));
    typedef float four __attribute__((vector_size(16)));
    eight half[2];
    memcpy(half, &a, sizeof half);
    half[0] += half[1];
    four quarter[2];
    memcpy(quarter, &half[0], sizeof quarter);
    quarter[0] += quarter[1];
    return (quarter[0][0] + quarter[0][2]) + (quarter[0][1] + quarter[0][3]);
}

/* Bit i: lane i of a mask. */
INLINE unsigned bits_of(mask m)
{
    unsigned bits = 0;
#if defined __AVX512DQ__
    bits = _mm512_movepi32_mask((__m512i)m.part[0]);
#elif defined __AVX2__
    EACH_PART(i) bits |= (unsigned)_mm256_movemask_ps((__m256)m.part[i]) << i * WIDTH;
#elif defined __SSE2__
    EACH_PART(i) bits |= (unsigned)_mm_movemask_ps((__m128)m.part[i]) << i * WIDTH;
#else
    int32_t lane[SP_LANES];
    memcpy(lane, &m, sizeof lane);
    for (int i = 0; i < SP_LANES; i++)
        bits |= (unsigned)(lane[i] & 1) << i;
#endif
    return bits;
}

INLINE lanes divide(lanes a, lanes b)
{
    EACH_PART(i) a.part[i] /= b.part[i];
    return a;
}
INLINE lanes lesser(lanes a, lanes b)
{
    return choose(below(a, b), a, b);
}
INLINE lanes greater(lanes a, lanes b)
{
    return choose(below(a, b), b, a);
}
INLINE mask either(mask a, mask b)
{
    EACH_PART(i) a.part[i] |= b.part[i];
    return a;
}
INLINE lanes root(lanes a)
{
#if defined __AVX512DQ__
    EACH_PART(i) a.part[i] = (floats)_mm512_sqrt_ps((__m512)a.part[i]);
#elif defined __AVX2__
    EACH_PART(i) a.part[i] = (floats)_mm256_sqrt_ps((__m256)a.part[i]);
#elif defined __SSE2__
    EACH_PART(i) a.part[i] = (floats)_mm_sqrt_ps((__m128)a.part[i]);
#else
    EACH_PART(i)
    for (int k = 0; k < WIDTH; k++)
        a.part[i][k] = sqrtf(a.part[i][k]);
#endif
    return a;
}

#endif
