/* What the files of pose pricing share. */
#ifndef OPTIMIZER_POSE_PRICING_STATE_H
#define OPTIMIZER_POSE_PRICING_STATE_H

#include "certificate/pose_pricing.h"
#include "scoring/footprints.h"
#include "scoring/scoring.h"

#define SP_POSE_SLACK 1e-6 /* more than single precision puts an edge, or a flux over its threshold, wrong */

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
    sp_desk *desk;
    const sp_multipliers *multipliers; /* of now */
    sp_field_sweeper fields;           /* of which `worth` holds the arrays */
    float *field;                      /* [field_count] */
    uint32_t *texels;                  /* [2 patch_count], of the row of a field or footprint */
    float *shares;
} sp_pose_scratch;

struct sp_pose_pricing {
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
};

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

/* In pose_rows.c. A field as a row into the arrays, of [2 patch_count]; how many entries it has. */
size_t sp_pose_write_field(const sp_pose_pricing *pricing, const float *field, uint32_t *texels, float *shares);
/* The same of what a pose brings by its own footprint. */
size_t sp_pose_write(const sp_pose_pricing *pricing, sp_pose pose, uint32_t *texels, float *shares);

/* In pose_price.c. What each arrival of a view brings to a variant; returns the variant's region about the site's axis.
 */
sp_region sp_pose_prepare(const sp_pose_pricing *pricing, sp_pose_scratch *own, const sp_view *view,
                          const sp_variant *variant, const sp_frame *frame, const sp_multipliers *u);
/* The price of a pose of that view and region, rounded upwards, by more where it is less than `least`. */
double sp_pose_price(const sp_pose_pricing *pricing, const sp_pose_scratch *own, const sp_view *view, sp_pose pose,
                     sp_region *region, double least);
/* What no pose of the variant made ready can be worth more than, as long as no film is asked for. */
double sp_pose_price_most(const sp_pose_scratch *own);

/* In pose_listing.c. The prices of found nozzles, those that are alive; alive NULL: all. */
void sp_pose_price_found(const sp_pose_order *order, const sp_multipliers *u, const uint8_t *alive, float *price);
/* The other ranks' prices of the blocks of their sites, where `price` is not NULL, and where `bests` is set the best of
 * these. */
bool sp_pose_share_prices(sp_pose_pricing *pricing, float *price, bool bests, sp_error *error);

#endif
