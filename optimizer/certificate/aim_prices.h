/* What any nozzle at the candidates' mounting points is worth at given prices of the texels, whichever way it is aimed:
 * bounds over cells of aims, which are split where they are high. */
#ifndef OPTIMIZER_AIM_PRICES_H
#define OPTIMIZER_AIM_PRICES_H

#include "certificate/aim_cells.h"
#include "certificate/pose_prices.h"

typedef struct sp_aim_prices sp_aim_prices;

/* As sp_pose_prices_create; tier_of[mount x kinds + kind][step] is the tier of the least flow of the step in
 * that mount. `poses` are of the same cover. All borrowed. */
sp_aim_prices *sp_aim_prices_create(const sp_search *search, const sp_cover *cover, const sp_aim_kinds *kinds,
                                    const uint32_t *const *tier_of, const size_t *ports, const sp_pose_prices *poses,
                                    sp_error *error);
void sp_aim_prices_destroy(sp_aim_prices *prices);
sp_pricer sp_aim_pricer(sp_aim_prices *prices);
/* Bounds are sought for so much water (units, up to the cover's): where to look closely. They hold for any. */
void sp_aim_prices_seek(sp_aim_prices *prices, size_t water);
/* The bound of one cell at these prices. */
double sp_aim_prices_upper(sp_aim_prices *prices, const sp_aim_cell *cell, const sp_prices *u);

#endif
