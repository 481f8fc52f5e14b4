/* The sweep: sums, over what a mounting point reaches, of what lies inside a pattern. One loop a pose, whatever is
 * summed; the widest vectors that the processor has, and the same bits on all of them. */
#ifndef OPTIMIZER_SWEEP_H
#define OPTIMIZER_SWEEP_H

#include "scoring/visibility.h"

#define SP_WEIGHTS 2 /* most quantities that one sweep sums */

/* A posed pattern: which directions it holds. DESIGN's regions without an inverse trigonometric function. */
typedef struct {
    bool fan;
    float x[3], y[3], z[3]; /* the nozzle's frame in world coordinates; cones need z alone */
    float inner, outer;     /* cones: cosines of the polar angles */
    float width, narrow;    /* fans: w|w| of the cosine of the half-width, and the square of its sine */
    float thickness;        /* fans: sine of the half-thickness */
} sp_region;

/* For every bin the cosines, between its centre and the pattern's axis, from which it lies wholly outside or wholly
 * inside the pattern; for fans the sine of the latitude beyond which it lies outside. */
typedef struct {
    float outside[SP_BINS], inside[SP_BINS]; /* less than `outside`: missed; `inside` or more: not cut off */
    float inner_outside[SP_BINS], inner_inside[SP_BINS]; /* the same for the hole of a hollow cone, downwards */
    float latitude[SP_BINS];
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

/* The loops, compiled for one instruction set. Every sum is made in SP_LANES lanes, in single precision over at most 64
 * vectors and the run of neighbouring bins that ends them, in double precision between these, in the same order on
 * every instruction set: relative to the sum of magnitudes its error is below 2^-24 (68 + n / SP_LANES), n being the
 * arrivals of the longest run. */
typedef struct {
    const char *name;
    bool (*available)(void);
    /* sums[k] = Σ weights[k].item over the arrivals in the region. weight_count is 1 or 2. */
    void (*sum)(const sp_bins *bins, const sp_cull *cull, const sp_region *region, const sp_view *view,
                const sp_weight *weights, size_t weight_count, double *sums);
    /* totals[bin] = Σ items */
    void (*total)(const sp_view *view, const float *items, float *totals);
    /* gain[i] = what an arrival adds per DESIGN's worth to a patch of `area` that has `had`; room[i] = what it could
     * add at most. */
    void (*gain)(const sp_credit *credit, size_t count, const float *had, const float *area, const float *transfer,
                 float *gain);
    void (*room)(const sp_credit *credit, size_t count, const float *had, const float *area, float *room);
} sp_sweep_set;

/* All that were compiled, the widest first; the last, which every processor runs, ends the list. */
extern const sp_sweep_set *const sp_sweep_sets[];
extern const size_t sp_sweep_set_count;
/* The widest that this processor has. */
const sp_sweep_set *sp_sweep_best(void);

sp_region sp_region_create(const sp_spray *spray, const sp_frame *frame);
/* Brings the region into another frame. */
void sp_region_turn(sp_region *region, const sp_frame *frame);
void sp_cull_create(const sp_bins *bins, const sp_spray *spray, sp_cull *cull);
/* Whether the region holds a direction, as the sweep decides it. */
bool sp_region_holds(const sp_region *region, float x, float y, float z);

#endif
