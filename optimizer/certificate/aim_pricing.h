/* What any nozzle at the candidates' mounting points is worth at given multipliers of the texels, whichever way it is
 * aimed: bounds over cells of aims, which are split where they are high. */
#ifndef OPTIMIZER_AIM_PRICING_H
#define OPTIMIZER_AIM_PRICING_H

#include "certificate/aim_cells.h"
#include "certificate/pose_pricing.h"

typedef struct sp_aim_pricing sp_aim_pricing;

/* As sp_pose_pricing_create; tier_of[mount x kinds + kind][step] is the tier of the least flow of the step in
 * that mount. `poses` are of the same cover. All borrowed. */
sp_aim_pricing *sp_aim_pricing_create(const sp_search *search, const sp_cover *cover, const sp_aim_kinds *kinds,
                                      const uint32_t *const *tier_of, const size_t *ports, const sp_pose_pricing *poses,
                                      sp_error *error);
void sp_aim_pricing_destroy(sp_aim_pricing *pricing);
sp_pricer sp_aim_pricer(sp_aim_pricing *pricing);
/* Bounds are sought for so much water (units, up to the cover's): where to look closely. They hold for any. */
void sp_aim_pricing_seek(sp_aim_pricing *pricing, size_t water);
/* The bound of one cell at these multipliers. */
double sp_aim_pricing_upper(sp_aim_pricing *pricing, const sp_aim_cell *cell, const sp_multipliers *u);

#endif
