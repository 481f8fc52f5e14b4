/* The price of one pose, rounded upwards. */
#ifndef OPTIMIZER_POSE_PRICE_H
#define OPTIMIZER_POSE_PRICE_H

#include "certificate/pose_pricing.h"

/* What each arrival of a view brings to a nozzle of a strength, flux over threshold per transfer, from `least` to
 * `most`, rounded upwards (worth, [view->count]); and each bin in all (total, [SP_BINS]). */
void sp_pose_pricing_worth(const sp_pose_pricing *pricing, const sp_view *view, float least, float most,
                           const sp_multipliers *u, float *worth, float *total);
/* What each arrival of a view brings to a variant; returns the variant's region about the site's axis.
 */
sp_region sp_pose_prepare(const sp_pose_pricing *pricing, sp_pose_scratch *own, const sp_view *view,
                          const sp_variant *variant, const sp_frame *frame, const sp_multipliers *u);
/* The price of a pose of that view and region, rounded upwards, by more where it is less than `least`. */
double sp_pose_price(const sp_pose_pricing *pricing, const sp_pose_scratch *own, const sp_view *view, sp_pose pose,
                     sp_region *region, double least);
/* What no pose of the variant made ready can be worth more than, as long as no film is asked for. */
double sp_pose_price_most(const sp_pose_scratch *own);

#endif
