/* What every candidate pose is worth at given multipliers of the texels: swept from what was traced, no pose's row
 * stored. */
#ifndef OPTIMIZER_POSE_PRICING_H
#define OPTIMIZER_POSE_PRICING_H

#include "bound/bound.h"
#include "scoring/partial.h"
#include "certificate/pose_order.h"

#include <math.h>

/* Fields rounded in single precision, and those of so many nozzles added up so, lie off by less than this share: every
 * sum by half a unit in the last place. */
static inline double sp_field_margin(size_t nozzles)
{
    return fmax(2e-5, 0x1p-24 * ((double)nozzles + 40));
}

typedef struct sp_pose_pricing sp_pose_pricing;

/* For the cover of `search`, its texels the coarse patches: tier_of [mounts x variants], the tier of each variant's
 * outlay in a mount; need [texels], flux over threshold that a texel lacks, 0 where it is not to be counted; film_need
 * the same of film, NULL where that is not asked for; ports [mounts], the port that a mount is, SP_NO_PORT where it is
 * none. All borrowed. */
sp_pose_pricing *sp_pose_pricing_create(const sp_search *search, const sp_cover *cover, const uint32_t *tier_of,
                                        const float *need, const float *film_need, const size_t *ports,
                                        sp_error *error);
void sp_pose_pricing_destroy(sp_pose_pricing *pricing);
/* The list of all poses and of order->own, whose arrays stay the order's, which is borrowed. Goes before the pricer:
 * the keys of rows are positions. */
bool sp_pose_list(sp_pose_pricing *pricing, const sp_pose_order *order, sp_candidate_list *list, sp_error *error);
sp_pricer sp_pose_pricer(sp_pose_pricing *pricing);
/* What the pricer found everything to be worth when it last priced all, by position of the list, rounded upwards: a
 * little, or by more where it is far from what it must be to raise the bound. */
const float *sp_pose_pricing_last(const sp_pose_pricing *pricing);
/* What each arrival of a view brings to a nozzle of a strength, flux over threshold per transfer, from `least` to
 * `most`, rounded upwards (worth, [view->count]); and each bin in all (total, [SP_BINS]). */
void sp_pose_pricing_worth(const sp_pose_pricing *pricing, const sp_view *view, float least, float most,
                           const sp_multipliers *u, float *worth, float *total);
/* Appends a field (see sp_placed) as a row. */
bool sp_pose_pricing_row(const sp_pose_pricing *pricing, const float *field, uint64_t key, size_t port, uint32_t tier,
                         sp_rows *rows, sp_error *error);
/* Appends what a nozzle of a layout that was found brings, as SP_OWN_KEY. */
bool sp_pose_pricing_found(const sp_pose_pricing *pricing, const sp_placed *placed, uint32_t tier, sp_rows *rows,
                           sp_error *error);
/* Appends the row of a pose. */
bool sp_pose_pricing_add(const sp_pose_pricing *pricing, sp_pose pose, sp_rows *rows, sp_error *error);

#endif
