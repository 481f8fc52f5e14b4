/* The kernels' loops in terms of SP_LANES floats at a time, the same bits on every instruction set (lanes.h). */
#ifndef OPTIMIZER_PATTERN_KERNEL_LOOPS_H
#define OPTIMIZER_PATTERN_KERNEL_LOOPS_H

#include "nozzle/outline_lanes.h"
#include "scoring/pattern_kernels.h"

#include <assert.h>

#define HELPS 0.05f           /* film over what is asked for, below which no other's is hoped to make up for the rest */
#define ENOUGH (1 + 0x1p-20f) /* SP_ENOUGH */
#define OPEN_MORE (1 + 1e-4)  /* more than single precision puts a sum of totals wrong */
#define FLUSH 64              /* vectors of lanes after which single precision goes into double */

/* How much of its patch every arrival counts for. Where slack leaves open whether it meets the criterion alone, the
 * more of the two. */
INLINE lanes counting(const sp_region *region, bool flat, sp_count count, const sp_view *view, size_t at)
{
    lanes x = load(&view->x[at]), y = load(&view->y[at]), z = load(&view->z[at]), sharp = load(&view->sharp[at]);
    if (count == SP_COUNT_GENEROUS)
        return generous_shares(&region->outline, flat, x, y, z, sharp);
    shares s = outline_shares(&region->outline, flat, x, y, z, sharp);
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
INLINE void sum_run(const sp_region *region, bool flat, sp_count count, const sp_view *view, const sp_weight *weights,
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
        lanes part = counting(region, flat, count, view, i);
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
INLINE uint64_t near_blocks(const sp_bins *bins, const sp_cull *cull, const sp_region *region, bool flat)
{
    uint64_t bits = 0;
    for (size_t i = 0; i < SP_BLOCKS; i += SP_LANES) {
        lanes x = load(&bins->block_x[i]), y = load(&bins->block_y[i]), z = load(&bins->block_z[i]);
        mask near = at_least(dot(x, y, z, region->outline.z), load(&cull->near[i]));
        if (flat)
            near = both(near, at_least(load(&cull->near_latitude[i]), magnitude(dot(x, y, z, region->outline.y))));
        bits |= (uint64_t)bits_of(near) << i;
    }
    return bits;
}

INLINE void look_at_bins(const sp_bins *bins, const sp_cull *cull, const sp_region *region, bool flat,
                         const sp_weight *weights, size_t weight_count, binned *found)
{
    for (uint64_t blocks = near_blocks(bins, cull, region, flat); blocks; blocks &= blocks - 1) {
        size_t b = SP_LANES * (size_t)__builtin_ctzll(blocks);
        lanes x = load(&bins->x[b]), y = load(&bins->y[b]), z = load(&bins->z[b]),
              along = dot(x, y, z, region->outline.z);
        mask cut = both(at_least(along, load(&cull->outside[b])), at_least(load(&cull->inner_outside[b]), along));
        if (flat) {
            lanes up = magnitude(dot(x, y, z, region->outline.y));
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
INLINE void sum_bins(const sp_bins *bins, const sp_cull *cull, const sp_region *region, bool flat, sp_count count,
                     const sp_view *view, const sp_weight *weights, size_t weight_count, double least, double *sums)
{
    tally tally = {0};
    binned found = {.cut = {0}};
    sp_run_of_arrivals runs[SP_BINS];
    look_at_bins(bins, cull, region, flat, weights, weight_count, &found);
    for (size_t k = 0; k < weight_count; k++)
        sums[k] = OPEN_MORE * sum_of(add_narrow(add_narrow((wide_lanes){0}, found.whole[k]), found.open[k]));
    if (sums[0] < least)
        return;
    size_t run_count = join_bins(found.cut, view, runs);
    for (size_t r = 0; r < run_count; r++)
        sum_run(region, flat, count, view, weights, weight_count, runs[r].first, runs[r].end, &tally);
    flush(&tally, weight_count);
    for (size_t k = 0; k < weight_count; k++)
        sums[k] = sum_of(add_narrow(tally.flushed[k], found.whole[k]));
}

/* The shares of one run of arrivals, and what each counts for. */
INLINE void share_run(const sp_region *region, bool flat, const sp_view *view, size_t first, size_t end, float *share,
                      float *counts)
{
    for (size_t i = first; i < end; i += SP_LANES) {
        lanes x = load(&view->x[i]), y = load(&view->y[i]), z = load(&view->z[i]), sharp = load(&view->sharp[i]);
        shares s = outline_shares(&region->outline, flat, x, y, z, sharp);
        store(s.share, &share[i]);
        store(counting(region, flat, SP_COUNT_SHARE, view, i), &counts[i]);
    }
}

INLINE size_t share_bins(const sp_bins *bins, const sp_cull *cull, const sp_region *region, bool flat,
                         const sp_view *view, float *share, float *counts, sp_run_of_arrivals *runs)
{
    binned found = {.cut = {0}};
    look_at_bins(bins, cull, region, flat, NULL, 0, &found);
    for (size_t b = 0; b < SP_BLOCKS; b++)
        found.cut[b] |= found.inside[b];
    size_t count = join_bins(found.cut, view, runs);
    /* rising, so that what a run writes behind its end the next one puts right */
    for (size_t r = 0; r < count; r++)
        share_run(region, flat, view, runs[r].first, runs[r].end, share, counts);
    return count;
}

static size_t kernel_shares(const sp_bins *bins, const sp_cull *cull, const sp_region *region, const sp_view *view,
                            float *share, float *counts, sp_run_of_arrivals *runs)
{
    return region->outline.flat ? share_bins(bins, cull, region, true, view, share, counts, runs)
                                : share_bins(bins, cull, region, false, view, share, counts, runs);
}

/* One loop for every kind of pattern, of counting and number of weights. */
INLINE void sum_counted(const sp_bins *bins, const sp_cull *cull, const sp_region *region, sp_count count,
                        const sp_view *view, const sp_weight *weights, size_t weight_count, double least, double *sums)
{
    if (region->outline.flat && weight_count == 2)
        sum_bins(bins, cull, region, true, count, view, weights, 2, least, sums);
    else if (region->outline.flat)
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
