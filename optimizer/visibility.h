/* Visibility: what each mounting point can reach at each speed, traced once, whatever the nozzle's axis, roll and type.
 */
#ifndef OPTIMIZER_VISIBILITY_H
#define OPTIMIZER_VISIBILITY_H

#include "candidates.h"
#include "watch.h"

#define SP_BINS_EDGE 32
#define SP_BINS (SP_BINS_EDGE * SP_BINS_EDGE)
#define SP_LANES 16 /* floats that a sweep takes at a time: views have as many more, all 0, behind their last */

/* Arrivals that pass the criterion's speed and incidence, sorted by the octahedral bin of their direction, then by
 * patch. */
typedef struct {
    uint32_t count;
    uint32_t *start;  /* [SP_BINS + 1]; NULL: not traced */
    float *x, *y, *z; /* [count + SP_LANES], unit direction at the nozzle */
    float *transfer;  /* [count + SP_LANES], 1/m² */
    uint32_t *patch;  /* [count] */
} sp_view;

/* The bins' cones: all directions of a bin are within acos(cosine) of its centre. */
typedef struct {
    float x[SP_BINS], y[SP_BINS], z[SP_BINS];
    float radius[SP_BINS]; /* rad */
} sp_bins;

typedef struct {
    const sp_evaluator *evaluator; /* borrowed: the coarse one that was traced on */
    size_t site_count, speed_count;
    size_t largest; /* most arrivals of a view */
    double share;   /* of the options' memory that the views take; where it would be above 1, none is kept */
    sp_view *views; /* [site_count x speed_count] */
    sp_bins bins;
} sp_visibility;

/* Half-angle (rad) about the site's axis that holds all that its candidates at this speed can reach; negative: there
 * are none. */
double sp_visibility_needed(const sp_place_options *options, const sp_candidates *candidates, const sp_site *site,
                            size_t speed);
/* Traces all views on patches as fine as time and the options' memory allow: those of *resampled, or of `fine` itself
 * where that stays NULL. The caller destroys it. */
bool sp_visibility_fit(const sp_evaluator *fine, const sp_place_options *options, const sp_sites *sites,
                       const sp_candidates *candidates, sp_watch *watch, sp_evaluator **resampled,
                       sp_visibility *visibility, sp_error *error);
/* Traces all views on the patches of `coarse`. Sites left out when the time ends see nothing. */
bool sp_visibility_create(const sp_evaluator *coarse, const sp_place_options *options, const sp_sites *sites,
                          const sp_candidates *candidates, sp_watch *watch, sp_visibility *visibility, sp_error *error);
void sp_visibility_free(sp_visibility *visibility);

static inline const sp_view *sp_visibility_view(const sp_visibility *visibility, uint32_t site, size_t speed)
{
    return &visibility->views[site * visibility->speed_count + speed];
}

#endif
