/* The smoothed coverage of a layout as a least squares problem in what refinement may change. */
#ifndef OPTIMIZER_SOFT_H
#define OPTIMIZER_SOFT_H

#include "refine/level.h"

/* Of a layout's nozzles, with visibility frozen as in sights[i], minimises the sum over the coarse patches of area (1 -
 * soft cover)² with Ceres from parameters[i].value, and writes the values that it ends with to values[i]. The flows'
 * sum stays below `budget` (m³/s) by a penalty. Nozzles without any keep their fields. */
bool sp_soft_solve(const sp_search *search, const sp_partial *partial, const sp_pose_parameters *parameters,
                   const sp_sight *const *sights, sp_width width, double budget, double (*values)[SP_UNKNOWNS],
                   sp_error *error);

#endif
