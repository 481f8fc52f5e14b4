/* The sweep's loops in terms of vectors of SP_LANES floats, which the compiler maps onto what the including file's
 * instruction set has. Operations on lanes are IEEE's one by one (the project forbids contraction), so that every
 * instruction set gives the same bits. */
#ifndef OPTIMIZER_SWEEP_KERNEL_H
#define OPTIMIZER_SWEEP_KERNEL_H

#include "sweep.h"

#include <string.h>
#ifdef __SSE2__
#include <immintrin.h>
#endif

typedef float lanes __attribute__((vector_size(4 * SP_LANES)));
typedef float half_lanes __attribute__((vector_size(2 * SP_LANES)));
typedef float quarter_lanes __attribute__((vector_size(SP_LANES)));
typedef int32_t mask __attribute__((vector_size(4 * SP_LANES)));
typedef double wide_lanes __attribute__((vector_size(8 * SP_LANES)));
/* the same anywhere in memory */
typedef float loose_lanes __attribute__((vector_size(4 * SP_LANES), aligned(4), may_alias));

#define INLINE static inline __attribute__((always_inline))

INLINE lanes load(const float *from)
{
    return *(const loose_lanes *)from;
}
INLINE lanes all(float value)
{
    return value - (lanes){0};
}
INLINE lanes keep(lanes value, mask where)
{
    return (lanes)((mask)value & where);
}
INLINE lanes choose(mask where, lanes yes, lanes no)
{
    return (lanes)(((mask)yes & where) | ((mask)no & ~where));
}
INLINE lanes magnitude(lanes value)
{
    return (lanes)((mask)value & 0x7fffffff);
}
INLINE lanes dot(lanes x, lanes y, lanes z, const float v[3])
{
    return x * v[0] + y * v[1] + z * v[2];
}

/* The sum of all lanes, halves upon halves. */
INLINE float fold(lanes value)
{
    half_lanes half[2];
    memcpy(half, &value, sizeof half);
    half[0] += half[1];
    quarter_lanes quarter[2];
    memcpy(quarter, &half[0], sizeof quarter);
    quarter[0] += quarter[1];
    return (quarter[0][0] + quarter[0][2]) + (quarter[0][1] + quarter[0][3]);
}

/* Bit i: lane i of a mask. */
INLINE unsigned bits_of(mask m)
{
#if defined __AVX512DQ__ && SP_LANES == 16
    return _mm512_movepi32_mask((__m512i)m);
#elif defined __AVX2__ && SP_LANES == 16
    __m256 half[2];
    memcpy(half, &m, sizeof half);
    return (unsigned)_mm256_movemask_ps(half[0]) | (unsigned)_mm256_movemask_ps(half[1]) << 8;
#elif defined __SSE2__ && SP_LANES == 16
    __m128 quarter[4];
    memcpy(quarter, &m, sizeof quarter);
    unsigned bits = 0;
    for (int i = 0; i < 4; i++)
        bits |= (unsigned)_mm_movemask_ps(quarter[i]) << 4 * i;
    return bits;
#else
    unsigned bits = 0;
    for (int i = 0; i < SP_LANES; i++)
        bits |= (unsigned)(m[i] & 1) << i;
    return bits;
#endif
}

/* The lanes of sp_region_holds. */
INLINE mask holds(const sp_region *region, bool fan, lanes x, lanes y, lanes z)
{
    lanes along = dot(x, y, z, region->z);
    if (!fan)
        return (along >= all(region->outer)) & (along <= all(region->inner));
    lanes up = dot(x, y, z, region->y), across = dot(x, y, z, region->x);
    return (magnitude(up) <= all(region->thickness)) &
           (along * magnitude(along) * region->narrow >= across * across * region->width);
}

typedef struct {
    wide_lanes sum[SP_WEIGHTS];
} tally;

/* One run of arrivals, into the tally. */
INLINE void sum_run(const sp_region *region, bool fan, const sp_view *view, const sp_weight *weights,
                    size_t weight_count, size_t first, size_t end, tally *tally)
{
    static const mask number = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    lanes sum[SP_WEIGHTS] = {{0}};
    size_t i = first;
    for (; i + SP_LANES <= end; i += SP_LANES) {
        mask in = holds(region, fan, load(&view->x[i]), load(&view->y[i]), load(&view->z[i]));
        for (size_t k = 0; k < weight_count; k++)
            sum[k] += keep(load(&weights[k].item[i]), in);
    }
    if (i < end) {
        mask in =
            holds(region, fan, load(&view->x[i]), load(&view->y[i]), load(&view->z[i])) & (number < (int32_t)(end - i));
        for (size_t k = 0; k < weight_count; k++)
            sum[k] += keep(load(&weights[k].item[i]), in);
    }
    for (size_t k = 0; k < weight_count; k++)
        tally->sum[k] += __builtin_convertvector(sum[k], wide_lanes);
}

/* Bins wholly inside give their totals; runs of bins that the pattern's edge crosses are gone through. */
INLINE void sum_bins(const sp_bins *bins, const sp_cull *cull, const sp_region *region, bool fan, const sp_view *view,
                     const sp_weight *weights, size_t weight_count, double *sums)
{
    tally tally = {0};
    lanes whole[SP_WEIGHTS] = {{0}};
    size_t first = 0, end = 0; /* the run in the making */
    for (size_t b = 0; b < SP_BINS; b += SP_LANES) {
        lanes x = load(&bins->x[b]), y = load(&bins->y[b]), z = load(&bins->z[b]);
        lanes along = dot(x, y, z, region->z);
        mask met = (along >= load(&cull->outside[b])) & (along <= load(&cull->inner_outside[b])), inside = {0};
        if (fan) {
            met &= magnitude(dot(x, y, z, region->y)) <= load(&cull->latitude[b]);
        } else {
            inside = (along >= load(&cull->inside[b])) & (along <= load(&cull->inner_inside[b]));
            for (size_t k = 0; k < weight_count; k++)
                whole[k] += keep(load(&weights[k].total[b]), inside);
        }
        for (unsigned bits = bits_of(met & ~inside); bits; bits &= bits - 1) {
            size_t bin = b + (size_t)__builtin_ctz(bits);
            if (view->start[bin] != end) {
                if (first < end)
                    sum_run(region, fan, view, weights, weight_count, first, end, &tally);
                first = view->start[bin];
            }
            end = view->start[bin + 1];
        }
    }
    if (first < end)
        sum_run(region, fan, view, weights, weight_count, first, end, &tally);
    for (size_t k = 0; k < weight_count; k++) {
        wide_lanes sum = tally.sum[k] + __builtin_convertvector(whole[k], wide_lanes);
        sums[k] = 0;
        for (int i = 0; i < SP_LANES; i++)
            sums[k] += sum[i];
    }
}

static void kernel_sum(const sp_bins *bins, const sp_cull *cull, const sp_region *region, const sp_view *view,
                       const sp_weight *weights, size_t weight_count, double *sums)
{
    if (region->fan && weight_count == 2)
        sum_bins(bins, cull, region, true, view, weights, 2, sums);
    else if (region->fan)
        sum_bins(bins, cull, region, true, view, weights, 1, sums);
    else if (weight_count == 2)
        sum_bins(bins, cull, region, false, view, weights, 2, sums);
    else
        sum_bins(bins, cull, region, false, view, weights, 1, sums);
}

static void kernel_total(const sp_view *view, const float *items, float *totals)
{
    static const mask number = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    for (size_t b = 0; b < SP_BINS; b++) {
        size_t i = view->start[b], end = view->start[b + 1];
        totals[b] = 0;
        if (i == end)
            continue;
        lanes sum = {0};
        for (; i + SP_LANES <= end; i += SP_LANES)
            sum += load(&items[i]);
        if (i < end)
            sum += keep(load(&items[i]), number < (int32_t)(end - i));
        totals[b] = fold(sum);
    }
}

/* Arrays are padded: what stands behind their ends is written, and never read. */
static void kernel_gain(const sp_credit *credit, size_t count, const float *had, const float *area,
                        const float *transfer, float *gain)
{
    const lanes one = all(1);
    for (size_t i = 0; i < count; i += SP_LANES) {
        lanes before = load(&had[i]), flux = load(&transfer[i]) * credit->strength;
        lanes has = credit->single ? choose(before > flux, before, flux) : before + flux;
        lanes worth = choose(has >= one, one, has * credit->credit) - before * credit->credit;
        *(loose_lanes *)&gain[i] = keep(load(&area[i]) * worth, before < one);
    }
}

static void kernel_room(const sp_credit *credit, size_t count, const float *had, const float *area, float *room)
{
    const lanes one = all(1);
    for (size_t i = 0; i < count; i += SP_LANES) {
        lanes before = load(&had[i]);
        *(loose_lanes *)&room[i] = keep(load(&area[i]) * (one - before * credit->credit), before < one);
    }
}

#endif
