/* Pattern kernels: sums, over what a mounting point reaches, of what lies inside a pattern. One loop a pose, whatever
 * is summed; the widest vectors that the processor has, and the same bits on all of them. */
#ifndef OPTIMIZER_PATTERN_KERNELS_H
#define OPTIMIZER_PATTERN_KERNELS_H

#include "scoring/visibility.h"

#define SP_WEIGHTS 2 /* most quantities that are summed at once */

/* How a kernel counts a patch at a pattern's edge. */
typedef enum {
    SP_COUNT_SHARE,    /* by what share of it lies inside, as the measure has it */
    SP_COUNT_GENEROUS, /* whole, if it may have any share */
} sp_count;

/* A posed pattern, and what an arrival has to bring to cover alone. */
typedef struct {
    sp_outline outline;
    float alone_from; /* a view's transfer from which an arrival may meet the criterion alone */
    float alone;      /* from which it surely does */
    sp_count count;
} sp_region;

/* For every bin the cosines, between its centre and the pattern's axis, from which what it has lies wholly outside or
 * wholly inside the pattern; for fans the sine of the latitude beyond which it lies outside. */
typedef struct {
    float outside[SP_BINS], inside[SP_BINS]; /* less than `outside`: missed; `inside` or more: not cut off */
    float inner_outside[SP_BINS], inner_inside[SP_BINS]; /* the same for the hole of a hollow cone, downwards */
    float latitude[SP_BINS];
    /* the same as `outside` and `latitude` of a block's centre, for all of its bins */
    float near[SP_BLOCKS], near_latitude[SP_BLOCKS];
} sp_cull;

/* What to sum: a weight per arrival (padded by SP_LANES) and its sums per bin, as `total` makes them. */
typedef struct {
    const float *item;  /* [view->count + SP_LANES] */
    const float *total; /* [SP_BINS] */
} sp_weight;

/* What `gain` needs to know of a search. */
typedef struct {
    bool single;
    float credit;
    float strength; /* flux over threshold per unit transfer */
} sp_credit;

/* Patches as a partial layout leaves them, [patch_count] each (see sp_partial), for `score`. */
typedef struct {
    size_t count;
    const float *area, *hit, *film, *wet, *dry;
} sp_wetted;

/* Neighbours in a view. */
typedef struct {
    uint32_t first, end;
} sp_run_of_arrivals;

/* The loops, compiled for one instruction set. Every sum is made in SP_LANES lanes, in single precision over at most 64
 * vectors and the run of neighbouring bins that ends them, in double precision between these, in the same order on
 * every instruction set: relative to the sum of magnitudes its error is below 2^-24 (68 + n / SP_LANES), n being the
 * arrivals of the longest run. */
typedef struct {
    const char *name;
    bool (*available)(void);
    /* sums[k] = Σ weights[k].item times its patch's share in the region, or where an arrival does not meet the
     * criterion alone, over those whose direction the region holds (see sp_wetting). weight_count is 1 or 2. Weights
     * are not negative; where bins alone tell that sums[0] is less than `least`, sums are no less than these. */
    void (*sum)(const sp_bins *bins, const sp_cull *cull, const sp_region *region, const sp_view *view,
                const sp_weight *weights, size_t weight_count, double least, double *sums);
    /* Lists what the region may hold as at most SP_BINS runs, and returns how many. Of all that is in them: share, the
     * patch's in the region; counts, what sum() takes it for. Both [view->count + SP_LANES]; the rest is undefined. */
    size_t (*shares)(const sp_bins *bins, const sp_cull *cull, const sp_region *region, const sp_view *view,
                     float *share, float *counts, sp_run_of_arrivals *runs);
    /* totals[bin] = Σ items */
    void (*total)(const sp_view *view, const float *items, float *totals);
    /* gain[i] = what an arrival is worth to a patch of `area` that has `had`; room[i] = what it could add at
     * most. */
    void (*gain)(const sp_credit *credit, size_t count, const float *had, const float *area, const float *transfer,
                 float *gain);
    void (*room)(const sp_credit *credit, size_t count, const float *had, const float *area, float *room);
    /* What a field and its film add to a partial layout: sums[0]; and could add if others helped, where it is worth
     * hoping for: sums[1]. */
    void (*score)(const sp_credit *credit, const sp_wetted *wetted, const float *field, const float *film,
                  double sums[2]);
} sp_pattern_kernels;

/* All that were compiled, the widest first; the last, which every processor runs, ends the list. */
extern const sp_pattern_kernels *const sp_pattern_kernel_sets[];
extern const size_t sp_pattern_kernel_set_count;
/* The widest that this processor has. */
const sp_pattern_kernels *sp_pattern_kernels_best(void);

/* `strength`: flux over threshold per transfer of a view. `slack`: how far beyond (rad, and as a share of the
 * transfer) an edge may lie, for sums that must not be too small. */
sp_region sp_region_create(const sp_spray *spray, const sp_frame *frame, double strength, double slack);
/* For the arrivals of one view. */
void sp_cull_create(const sp_bins *bins, const sp_view *view, const sp_spray *spray, sp_count count, sp_cull *cull);

#endif
