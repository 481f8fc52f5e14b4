/* All poses and found nozzles as one list, by whose positions they are priced and written down. */
#ifndef OPTIMIZER_POSE_LIST_H
#define OPTIMIZER_POSE_LIST_H

#include "certificate/pose_pricing.h"

/* The list of all poses and of order->own, whose arrays stay the order's, which is borrowed. Goes before the pricer:
 * the keys of rows are positions. */
bool sp_pose_list(sp_pose_pricing *pricing, const sp_pose_order *order, sp_candidate_list *list, sp_error *error);
/* The prices of found nozzles, those that are alive; alive NULL: all. */
void sp_pose_price_found(const sp_pose_order *order, const sp_multipliers *u, const uint8_t *alive, float *price);
/* The other ranks' prices of the blocks of their sites, where `price` is not NULL, and where `bests` is set the best of
 * these. */
bool sp_pose_share_prices(sp_pose_pricing *pricing, float *price, bool bests, sp_error *error);

#endif
