/* The sweep's loops in terms of SP_LANES floats at a time, held in as many vectors as the including file's instruction
 * set takes for them. Operations on lanes are IEEE's one by one (the project forbids contraction) and their order does
 * not depend on the vectors' width, so that every instruction set gives the same bits. */
#ifndef OPTIMIZER_SWEEP_KERNEL_H
#define OPTIMIZER_SWEEP_KERNEL_H

#include "scoring/sweep.h"

#include <assert.h>
#include <math.h>
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
#define HELPS 0.05f           /* film over what is asked for, below which no other's is hoped to make up for the rest */
#define ENOUGH (1 + 0x1p-20f) /* SP_ENOUGH */
#define OPEN_MORE (1 + 1e-4)  /* more than single precision puts a sum of totals wrong */
#define FLUSH 64              /* vectors of lanes after which single precision goes into double */

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

/* What follows is share.c's, for many patches at a time. */
#define BLUR ((float)SP_SPRAY_BLUR)

INLINE lanes smooth_step(lanes t)
{
    t = greater(lesser(t, all(1)), all(0));
    lanes inner = add(multiply(t, add(scale(t, 6), all(-15))), all(10));
    return multiply(multiply(multiply(t, t), t), inner);
}

/* Of patches one over whose blur's square is `sharp2`. */
INLINE lanes spot_share(float edge2, lanes chord2, lanes sharp2)
{
    return multiply(scale(sharp2, edge2), smooth_step(subtract(all(1), scale(multiply(chord2, sharp2), 0.5f))));
}

INLINE lanes disc_share(const sp_rim *rim, lanes chord2, lanes sharp)
{
    if (rim->edge2 <= 0 || rim->edge2 >= 4)
        return all(rim->edge2 > 0);
    lanes apart = scale(subtract(all(rim->edge2), chord2), rim->steep);
    lanes share = smooth_step(add(all(0.5f), multiply(apart, sharp)));
    lanes sharp2 = scale(multiply(sharp, sharp), 1 / (BLUR * BLUR));
    mask spots = below(scale(sharp2, rim->edge2), all(1)), holes = below(scale(sharp2, 4 - rim->edge2), all(1));
    if (rim->edge2 < 2 && bits_of(spots))
        return choose(spots, spot_share(rim->edge2, chord2, sharp2), share);
    if (rim->edge2 >= 2 && bits_of(holes)) {
        lanes hole = spot_share(4 - rim->edge2, subtract(all(4), chord2), sharp2);
        return choose(holes, subtract(all(1), hole), share);
    }
    return share;
}

/* Squared chords: a sum of small squares, where the cosine would lose the digits that tell narrow cones. */
INLINE lanes chords(const float axis[3], lanes x, lanes y, lanes z)
{
    lanes a = subtract(x, all(axis[0])), b = subtract(y, all(axis[1])), c = subtract(z, all(axis[2]));
    return add(add(multiply(a, a), multiply(b, b)), multiply(c, c));
}

/* What is held, and the shares. */
typedef struct {
    lanes share;
    mask held;
} shares;

IN_MANY_LOOPS shares cone_shares(const sp_region *region, lanes x, lanes y, lanes z, lanes sharp)
{
    lanes chord2 = chords(region->z, x, y, z);
    bool hollow = region->inner.edge2 > 0;
    shares s = {.held = at_least(all(region->outer.edge2 >= 4 ? 5 : region->outer.edge2), chord2)};
    if (hollow)
        s.held = both(s.held, at_least(chord2, all(region->inner.edge2)));
    s.share = disc_share(&region->outer, chord2, sharp);
    if (hollow)
        s.share = greater(subtract(s.share, disc_share(&region->inner, chord2, sharp)), all(0));
    return s;
}

IN_MANY_LOOPS shares fan_shares(const sp_region *region, lanes x, lanes y, lanes z, lanes sharp)
{
    lanes up = dot(x, y, z, region->y), end[2] = {dot(x, y, z, region->end[0]), dot(x, y, z, region->end[1])};
    shares s = {.held = at_least(all(region->height), magnitude(up)), .share = all(1)};
    if (!region->all_round) {
        mask in[2] = {at_least(end[0], all(0)), at_least(end[1], all(0))};
        s.held = both(s.held, region->wide ? either(in[0], in[1]) : both(in[0], in[1]));
    }
    if (region->height <= 1) {
        lanes rise = scale(sharp, region->rise);
        lanes above = smooth_step(add(all(0.5f), multiply(subtract(all(region->height), up), rise)));
        lanes under = smooth_step(add(all(0.5f), multiply(add(all(region->height), up), rise)));
        s.share = greater(subtract(add(above, under), all(1)), all(0));
    }
    if (!region->all_round) {
        lanes rise = scale(sharp, 1 / BLUR);
        lanes ends = add(smooth_step(add(all(0.5f), multiply(end[0], rise))),
                         smooth_step(add(all(0.5f), multiply(end[1], rise))));
        s.share = multiply(s.share, region->wide ? lesser(ends, all(1)) : greater(subtract(ends, all(1)), all(0)));
    }
    return s;
}

/* All of a patch that any aim may give any share of. */
IN_MANY_LOOPS lanes generous_shares(const sp_region *region, bool fan, lanes x, lanes y, lanes z, lanes sharp)
{
    lanes breadth = divide(all(1), sharp), spread = scale(breadth, (float)SP_VIEW_CORNER); /* corners of fans */
    if (!fan) {
        mask slim = at_least(all(region->narrowest), scale(breadth, (float)SP_VIEW_SPOT));
        spread = choose(slim, scale(breadth, (float)SP_VIEW_BLUR), scale(breadth, (float)SP_VIEW_FRINGE));
        lanes chord = root(chords(region->z, x, y, z));
        mask in = at_least(add(spread, all(region->outer.edge2 >= 4 ? 5 : sqrtf(region->outer.edge2))), chord);
        if (region->inner.edge2 > 0)
            in = both(in, at_least(add(chord, scale(breadth, (float)SP_VIEW_FRINGE)), all(sqrtf(region->inner.edge2))));
        return keep(all(1), in);
    }
    mask in = at_least(add(all(region->height), spread), magnitude(dot(x, y, z, region->y)));
    if (!region->all_round) {
        lanes short_of = subtract(all(0), spread);
        mask end[2] = {at_least(dot(x, y, z, region->end[0]), short_of),
                       at_least(dot(x, y, z, region->end[1]), short_of)};
        in = both(in, region->wide ? either(end[0], end[1]) : both(end[0], end[1]));
    }
    return keep(all(1), in);
}

/* How much of its patch every arrival counts for. Where slack leaves open whether it meets the criterion alone, the
 * more of the two. */
INLINE lanes counting(const sp_region *region, bool fan, sp_count count, const sp_view *view, size_t at)
{
    lanes x = load(&view->x[at]), y = load(&view->y[at]), z = load(&view->z[at]), sharp = load(&view->sharp[at]);
    if (count == SP_COUNT_GENEROUS)
        return generous_shares(region, fan, x, y, z, sharp);
    shares s = fan ? fan_shares(region, x, y, z, sharp) : cone_shares(region, x, y, z, sharp);
    lanes held = keep(all(1), s.held), transfer = load(&view->transfer[at]);
    lanes open = choose(at_least(transfer, all(region->alone_from)), greater(s.share, held), held);
    return choose(at_least(transfer, all(region->alone)), s.share, open);
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

/* One run of arrivals, into the tally. A third of the vectors weigh nothing, as all of their patches are covered
 * already: they need not be looked at. */
INLINE void sum_run(const sp_region *region, bool fan, sp_count count, const sp_view *view, const sp_weight *weights,
                    size_t weight_count, size_t first, size_t end, tally *tally)
{
    for (size_t i = first; i < end; i += SP_LANES) {
        lanes weight[SP_WEIGHTS];
        mask own = first_lanes(end - i), any = {0};
        for (size_t k = 0; k < weight_count; k++) {
            weight[k] = load(&weights[k].item[i]);
            any = either(any, below(all(0), weight[k]));
        }
        if (!bits_of(both(any, own)))
            continue;
        lanes part = counting(region, fan, count, view, i);
        for (size_t k = 0; k < weight_count; k++)
            tally->sum[k] = add(tally->sum[k], keep(multiply(weight[k], part), own));
    }
    tally->vectors += (end - first + SP_LANES - 1) / SP_LANES;
    if (tally->vectors >= FLUSH)
        flush(tally, weight_count);
}

/* What the bins have that a pattern may hold. */
typedef struct {
    unsigned cut[SP_BLOCKS];    /* bit i of each: bin i of these lanes, which the pattern's edge crosses */
    unsigned inside[SP_BLOCKS]; /* the same: which is wholly inside */
    lanes whole[SP_WEIGHTS];    /* of the bins that are wholly inside */
    lanes open[SP_WEIGHTS];     /* of those that are cut */
} binned;

/* Bit i: block i, of whose bins the pattern may hold any. Most lie on another side of the nozzle. */
INLINE uint64_t near_blocks(const sp_bins *bins, const sp_cull *cull, const sp_region *region, bool fan)
{
    uint64_t bits = 0;
    for (size_t i = 0; i < SP_BLOCKS; i += SP_LANES) {
        lanes x = load(&bins->block_x[i]), y = load(&bins->block_y[i]), z = load(&bins->block_z[i]);
        mask near = at_least(dot(x, y, z, region->z), load(&cull->near[i]));
        if (fan)
            near = both(near, at_least(load(&cull->near_latitude[i]), magnitude(dot(x, y, z, region->y))));
        bits |= (uint64_t)bits_of(near) << i;
    }
    return bits;
}

INLINE void look_at_bins(const sp_bins *bins, const sp_cull *cull, const sp_region *region, bool fan,
                         const sp_weight *weights, size_t weight_count, binned *found)
{
    for (uint64_t blocks = near_blocks(bins, cull, region, fan); blocks; blocks &= blocks - 1) {
        size_t b = SP_LANES * (size_t)__builtin_ctzll(blocks);
        lanes x = load(&bins->x[b]), y = load(&bins->y[b]), z = load(&bins->z[b]), along = dot(x, y, z, region->z);
        mask cut = both(at_least(along, load(&cull->outside[b])), at_least(load(&cull->inner_outside[b]), along));
        if (fan) {
            lanes up = magnitude(dot(x, y, z, region->y));
            cut = both(cut, at_least(load(&cull->latitude[b]), up));
        } else {
            mask inside = both(at_least(along, load(&cull->inside[b])), at_least(load(&cull->inner_inside[b]), along));
            for (size_t k = 0; k < weight_count; k++)
                found->whole[k] = add(found->whole[k], keep(load(&weights[k].total[b]), inside));
            cut = but(cut, inside);
            found->inside[b / SP_LANES] = bits_of(inside);
        }
        for (size_t k = 0; k < weight_count; k++)
            found->open[k] = add(found->open[k], keep(load(&weights[k].total[b]), cut));
        found->cut[b / SP_LANES] = bits_of(cut);
    }
}

/* Arrivals of the bins that are set, as runs that rise. */
INLINE size_t join_bins(const unsigned bins[SP_BLOCKS], const sp_view *view, sp_run_of_arrivals *runs)
{
    size_t count = 0;
    for (size_t b = 0; b < SP_BLOCKS; b++)
        for (unsigned bits = bins[b]; bits; bits &= bits - 1) {
            size_t bin = b * SP_LANES + (size_t)__builtin_ctz(bits);
            uint32_t first = view->start[bin], end = view->start[bin + 1];
            if (count && runs[count - 1].end == first)
                runs[count - 1].end = end;
            else if (first < end)
                runs[count++] = (sp_run_of_arrivals){first, end};
        }
    return count;
}

/* Bins wholly inside give their totals; runs of bins that the pattern's edge crosses are gone through. */
INLINE void sum_bins(const sp_bins *bins, const sp_cull *cull, const sp_region *region, bool fan, sp_count count,
                     const sp_view *view, const sp_weight *weights, size_t weight_count, double least, double *sums)
{
    tally tally = {0};
    binned found = {.cut = {0}};
    sp_run_of_arrivals runs[SP_BINS];
    look_at_bins(bins, cull, region, fan, weights, weight_count, &found);
    for (size_t k = 0; k < weight_count; k++)
        sums[k] = OPEN_MORE * sum_of(add_narrow(add_narrow((wide_lanes){0}, found.whole[k]), found.open[k]));
    if (sums[0] < least)
        return;
    size_t run_count = join_bins(found.cut, view, runs);
    for (size_t r = 0; r < run_count; r++)
        sum_run(region, fan, count, view, weights, weight_count, runs[r].first, runs[r].end, &tally);
    flush(&tally, weight_count);
    for (size_t k = 0; k < weight_count; k++)
        sums[k] = sum_of(add_narrow(tally.flushed[k], found.whole[k]));
}

/* The shares of one run of arrivals, and what each counts for. */
INLINE void share_run(const sp_region *region, bool fan, const sp_view *view, size_t first, size_t end, float *share,
                      float *counts)
{
    for (size_t i = first; i < end; i += SP_LANES) {
        lanes x = load(&view->x[i]), y = load(&view->y[i]), z = load(&view->z[i]), sharp = load(&view->sharp[i]);
        shares s = fan ? fan_shares(region, x, y, z, sharp) : cone_shares(region, x, y, z, sharp);
        store(s.share, &share[i]);
        store(counting(region, fan, SP_COUNT_SHARE, view, i), &counts[i]);
    }
}

INLINE size_t share_bins(const sp_bins *bins, const sp_cull *cull, const sp_region *region, bool fan,
                         const sp_view *view, float *share, float *counts, sp_run_of_arrivals *runs)
{
    binned found = {.cut = {0}};
    look_at_bins(bins, cull, region, fan, NULL, 0, &found);
    for (size_t b = 0; b < SP_BLOCKS; b++)
        found.cut[b] |= found.inside[b];
    size_t count = join_bins(found.cut, view, runs);
    /* rising, so that what a run writes behind its end the next one puts right */
    for (size_t r = 0; r < count; r++)
        share_run(region, fan, view, runs[r].first, runs[r].end, share, counts);
    return count;
}

static size_t kernel_shares(const sp_bins *bins, const sp_cull *cull, const sp_region *region, const sp_view *view,
                            float *share, float *counts, sp_run_of_arrivals *runs)
{
    return region->fan ? share_bins(bins, cull, region, true, view, share, counts, runs)
                       : share_bins(bins, cull, region, false, view, share, counts, runs);
}

/* One loop for every kind of pattern, of counting and number of weights. */
INLINE void sum_counted(const sp_bins *bins, const sp_cull *cull, const sp_region *region, sp_count count,
                        const sp_view *view, const sp_weight *weights, size_t weight_count, double least, double *sums)
{
    if (region->fan && weight_count == 2)
        sum_bins(bins, cull, region, true, count, view, weights, 2, least, sums);
    else if (region->fan)
        sum_bins(bins, cull, region, true, count, view, weights, 1, least, sums);
    else if (weight_count == 2)
        sum_bins(bins, cull, region, false, count, view, weights, 2, least, sums);
    else
        sum_bins(bins, cull, region, false, count, view, weights, 1, least, sums);
}

static void kernel_sum(const sp_bins *bins, const sp_cull *cull, const sp_region *region, const sp_view *view,
                       const sp_weight *weights, size_t weight_count, double least, double *sums)
{
    assert(weight_count > 0 && weight_count <= SP_WEIGHTS && view->start[SP_BINS] == view->count);
    if (region->count == SP_COUNT_SHARE)
        sum_counted(bins, cull, region, SP_COUNT_SHARE, view, weights, weight_count, least, sums);
    else
        sum_counted(bins, cull, region, SP_COUNT_GENEROUS, view, weights, weight_count, least, sums);
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

/* The worth per m² that a patch has still to gain. */
INLINE lanes lacking(const sp_credit *credit, lanes wet, lanes dry)
{
    lanes worth = multiply(dry, subtract(all(1), scale(wet, credit->credit)));
    return keep(worth, below(wet, all(ENOUGH)));
}

/* As sp_pour and sp_worth have it, of as many patches as there are lanes. */
INLINE void score_lanes(const sp_credit *credit, const float *const at[7], wide_lanes *gain, wide_lanes *room)
{
    lanes none = all(0), area = load(at[0]), had = load(at[1]), ran = load(at[2]), dry = load(at[4]),
          brings = load(at[5]), runs = load(at[6]);
    lanes more = greater(brings, none), hit = credit->single ? greater(more, had) : add(had, more);
    lanes before = lacking(credit, load(at[3]), dry);
    lanes after = lacking(credit, greater(hit, add(ran, runs)), multiply(dry, add(all(1), lesser(brings, none))));
    mask any = either(either(below(brings, none), below(none, brings)), below(all(HELPS), runs));
    *gain = add_narrow(*gain, multiply(area, subtract(before, after)));
    *room = add_narrow(*room, keep(multiply(area, before), any));
}

static void kernel_score(const sp_credit *credit, const sp_wetted *wetted, const float *field, const float *film,
                         double sums[2])
{
    const float *columns[7] = {wetted->area, wetted->hit, wetted->film, wetted->wet, wetted->dry, field, film};
    wide_lanes gain = {0}, room = {0};
    float tail[7][SP_LANES] = {0};
    size_t whole = wetted->count / SP_LANES * SP_LANES;
    for (size_t p = 0; p < wetted->count; p += SP_LANES) {
        const float *at[7];
        for (int k = 0; k < 7; k++) {
            at[k] = p < whole ? columns[k] + p : tail[k];
            if (p == whole)
                memcpy(tail[k], columns[k] + p, (wetted->count - p) * sizeof(float));
        }
        score_lanes(credit, at, &gain, &room);
    }
    sums[0] = sum_of(gain);
    sums[1] = sum_of(room);
}

#endif
