/* The smoothed coverage of a layout as a least squares problem in what refinement may change. */
#ifndef OPTIMIZER_SMOOTH_OBJECTIVE_H
#define OPTIMIZER_SMOOTH_OBJECTIVE_H

#include "refine/smooth_arrivals.h"

/* Of a layout's nozzles, with visibility frozen as in sights[i], minimises the sum over the coarse patches of area (1 -
 * smoothed cover)² with Ceres from parameters[i].value, and writes the values that it ends with to values[i]. The
 * flows' sum stays below `budget` (m³/s) by a penalty. Nozzles without parameters keep their fields. */
bool sp_smooth_objective_minimise(const sp_search *search, const sp_partial *partial,
                                  const sp_pose_parameters *parameters, const sp_sight *const *sights, sp_width width,
                                  double budget, double (*values)[SP_UNKNOWNS], sp_error *error);

#endif
