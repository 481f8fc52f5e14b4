/* What every candidate pose is worth at given multipliers of the texels: summed from what was traced, no pose's row
 * stored. What its files share: rows (pose_rows.h), the price of one pose (pose_price.h), all of them as a list
 * (pose_list.h), and the best for a bound (best_poses.h). */
#ifndef OPTIMIZER_POSE_PRICING_H
#define OPTIMIZER_POSE_PRICING_H

#include "bound/bound.h"
#include "certificate/pose_order.h"
#include "scoring/partial.h"
#include "scoring/scoring.h"

#include <math.h>

#define SP_POSE_SLACK 1e-6 /* more than single precision puts an edge, or a flux over its threshold, wrong */

/* Fields rounded in single precision, and those of so many nozzles added up so, lie off by less than this share: every
 * sum by half a unit in the last place. */
static inline double sp_field_margin(size_t nozzles)
{
    return fmax(2e-5, 0x1p-24 * ((double)nozzles + 40));
}

/* The pose of highest price of a site and variant. */
typedef struct {
    sp_pose pose;
    double price;
} sp_pose_best;

/* One thread's own. */
typedef struct {
    float *worth; /* [2 x (arrivals of a view + 2 SP_LANES)], price that it brings to a variant */
    float total[SP_BINS];
    sp_cull cull;
    sp_view_buffer *buffer;
    const sp_multipliers *multipliers; /* of now */
    sp_field_scratch fields;           /* of which `worth` holds the arrays */
    float *field;                      /* [field_count] */
    uint32_t *texels;                  /* [2 patch_count], of the row of a field or footprint */
    float *shares;
} sp_pose_scratch;

typedef struct {
    const sp_search *search;
    const sp_cover *cover;
    const uint32_t *tier_of;
    const float *need, *film_need;
    const size_t *ports;
    const sp_pose_order *order; /* NULL until a list is asked for */
    float *last;                /* [order->list.count], see sp_pose_pricing_last */
    sp_pose_best *bests;        /* [sites x variants] */
    int threads;
    sp_pose_scratch *scratches; /* [threads] */
    float upwards;              /* more than a share may lie off */
    bool bent;                  /* flights are, so that two arcs may come to a cell */
} sp_pose_pricing;

static inline uint32_t sp_pose_tier(const sp_pose_pricing *pricing, uint32_t site, uint32_t variant)
{
    return pricing
        ->tier_of[pricing->search->sites->items[site].mount * pricing->search->candidates->variant_count + variant];
}

static inline sp_ranks *sp_pose_ranks(const sp_pose_pricing *pricing)
{
    return pricing->search->options->run.ranks;
}

/* The share of what a texel needs that a flux brings, rounded upwards. */
static inline float sp_pose_share(const sp_pose_pricing *pricing, uint32_t texel, float flux, bool twice)
{
    float ratio = flux / pricing->need[texel] * pricing->upwards;
    if (ratio >= 1)
        return 1;
    if (!(ratio > 0))
        return 0;
    /* two arcs of one nozzle add up, even where one nozzle alone must do */
    return pricing->search->single && !twice ? 0 : ratio;
}

/* For the cover of `search`, its texels the coarse patches: tier_of [mounts x variants], the tier of each variant's
 * outlay in a mount; need [texels], flux over threshold that a texel lacks, 0 where it is not to be counted; film_need
 * the same of film, NULL where that is not asked for; ports [mounts], the port that a mount is, SP_NO_PORT where it is
 * none. All borrowed. */
sp_pose_pricing *sp_pose_pricing_create(const sp_search *search, const sp_cover *cover, const uint32_t *tier_of,
                                        const float *need, const float *film_need, const size_t *ports,
                                        sp_error *error);
void sp_pose_pricing_destroy(sp_pose_pricing *pricing);

#endif
