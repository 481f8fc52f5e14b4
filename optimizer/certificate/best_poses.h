/* The best poses for a bound, site by site. */
#ifndef OPTIMIZER_BEST_POSES_H
#define OPTIMIZER_BEST_POSES_H

#include "certificate/pose_pricing.h"

/* Goes after the list: the keys of rows are its positions. */
sp_pricer sp_best_poses(sp_pose_pricing *pricing);
/* What the pricer found everything to be worth when it last priced all, by position of the list, rounded upwards: a
 * little, or by more where it is far from what it must be to raise the bound. */
const float *sp_pose_pricing_last(const sp_pose_pricing *pricing);

#endif
