/* The smoothed coverage of a design as a least squares problem in what refinement may change. */
#ifndef OPTIMIZER_SOFT_H
#define OPTIMIZER_SOFT_H

#include "freedom.h"

/* How soft: the width (in logarithm of flux over threshold) of the step from dry to covered, and of the pattern's edge.
 */
typedef struct {
    double level;
    double edge; /* rad */
} sp_width;

/* With visibility frozen at freedoms[i].start, minimises the sum over the coarse patches of area (1 - soft cover)² with
 * Ceres, and writes the values that it ends with to values[i]. The flows' sum stays below `budget` (m³/s) by a penalty.
 */
bool sp_soft_solve(const sp_search *search, const sp_freedom *freedoms, size_t count, sp_width width, double budget,
                   double (*values)[SP_UNKNOWNS], sp_error *error);

#endif
