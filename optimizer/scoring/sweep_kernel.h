/* The sweep's loops in terms of SP_LANES floats at a time, held in as many vectors as the including file's instruction
 * set takes for them. Operations on lanes are IEEE's one by one (the project forbids contraction) and their order does
 * not depend on the vectors' width, so that every instruction set gives the same bits. */
#ifndef OPTIMIZER_SWEEP_KERNEL_H
#define OPTIMIZER_SWEEP_KERNEL_H

#include "scoring/sweep.h"

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
#define FLUSH 64 /* vectors of lanes after which single precision goes into double */

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

/* The lanes of sp_region_holds. */
INLINE mask holds(const sp_region *region, bool fan, lanes x, lanes y, lanes z)
{
    lanes along = dot(x, y, z, region->z);
    if (!fan)
        return both(at_least(along, all(region->outer)), at_least(all(region->inner), along));
    lanes up = dot(x, y, z, region->y), across = dot(x, y, z, region->x);
    lanes left = scale(multiply(along, magnitude(along)), region->narrow),
          right = scale(multiply(across, across), region->width);
    return both(at_least(all(region->thickness), magnitude(up)), at_least(left, right));
}

/* A sum in the making. */
typedef struct {
    lanes sum[SP_WEIGHTS];
    wide_lanes flushed[SP_WEIGHTS];
    size_t vectors; /* in `sum` */
} tally;

INLINE void flush(tally *tally, size_t weight_count)
{
    for (size_t k = 0; k < weight_count; k++) {
        tally->flushed[k] = add_narrow(tally->flushed[k], tally->sum[k]);
        tally->sum[k] = all(0);
    }
    tally->vectors = 0;
}

/* One run of arrivals, into the tally. */
INLINE void sum_run(const sp_region *region, bool fan, const sp_view *view, const sp_weight *weights,
                    size_t weight_count, size_t first, size_t end, tally *tally)
{
    size_t i = first;
    for (; i + SP_LANES <= end; i += SP_LANES) {
        mask in = holds(region, fan, load(&view->x[i]), load(&view->y[i]), load(&view->z[i]));
        for (size_t k = 0; k < weight_count; k++)
            tally->sum[k] = add(tally->sum[k], keep(load(&weights[k].item[i]), in));
    }
    if (i < end) {
        mask in = holds(region, fan, load(&view->x[i]), load(&view->y[i]), load(&view->z[i]));
        in = both(in, first_lanes(end - i));
        for (size_t k = 0; k < weight_count; k++)
            tally->sum[k] = add(tally->sum[k], keep(load(&weights[k].item[i]), in));
    }
    tally->vectors += (end - first + SP_LANES - 1) / SP_LANES;
    if (tally->vectors >= FLUSH)
        flush(tally, weight_count);
}

/* Bins wholly inside give their totals; runs of bins that the pattern's edge crosses are gone through. */
INLINE void sum_bins(const sp_bins *bins, const sp_cull *cull, const sp_region *region, bool fan, const sp_view *view,
                     const sp_weight *weights, size_t weight_count, double *sums)
{
    tally tally = {0};
    lanes whole[SP_WEIGHTS] = {{{{0}}}};
    size_t first = 0, end = 0; /* the run in the making */
    for (size_t b = 0; b < SP_BINS; b += SP_LANES) {
        lanes x = load(&bins->x[b]), y = load(&bins->y[b]), z = load(&bins->z[b]), along = dot(x, y, z, region->z);
        mask cut = both(at_least(along, load(&cull->outside[b])), at_least(load(&cull->inner_outside[b]), along));
        if (fan) {
            lanes up = magnitude(dot(x, y, z, region->y));
            cut = both(cut, at_least(load(&cull->latitude[b]), up));
        } else {
            mask inside = both(at_least(along, load(&cull->inside[b])), at_least(load(&cull->inner_inside[b]), along));
            for (size_t k = 0; k < weight_count; k++)
                whole[k] = add(whole[k], keep(load(&weights[k].total[b]), inside));
            cut = but(cut, inside);
        }
        for (unsigned bits = bits_of(cut); bits; bits &= bits - 1) {
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
    flush(&tally, weight_count);
    for (size_t k = 0; k < weight_count; k++)
        sums[k] = sum_of(add_narrow(tally.flushed[k], whole[k]));
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
    for (size_t b = 0; b < SP_BINS; b++) {
        size_t i = view->start[b], end = view->start[b + 1];
        totals[b] = 0;
        if (i == end)
            continue;
        lanes sum = all(0);
        for (; i + SP_LANES <= end; i += SP_LANES)
            sum = add(sum, load(&items[i]));
        if (i < end)
            sum = add(sum, keep(load(&items[i]), first_lanes(end - i)));
        totals[b] = fold(sum);
    }
}

/* Arrays are padded: what stands behind their ends is written, and never read. */
static void kernel_gain(const sp_credit *credit, size_t count, const float *had, const float *area,
                        const float *transfer, float *gain)
{
    const lanes one = all(1);
    for (size_t i = 0; i < count; i += SP_LANES) {
        lanes before = load(&had[i]), flux = scale(load(&transfer[i]), credit->strength);
        lanes has = credit->single ? choose(below(flux, before), before, flux) : add(before, flux);
        lanes worth =
            subtract(choose(at_least(has, one), one, scale(has, credit->credit)), scale(before, credit->credit));
        store(keep(multiply(load(&area[i]), worth), below(before, one)), &gain[i]);
    }
}

static void kernel_room(const sp_credit *credit, size_t count, const float *had, const float *area, float *room)
{
    const lanes one = all(1);
    for (size_t i = 0; i < count; i += SP_LANES) {
        lanes before = load(&had[i]), worth = subtract(one, scale(before, credit->credit));
        store(keep(multiply(load(&area[i]), worth), below(before, one)), &room[i]);
    }
}

#endif
