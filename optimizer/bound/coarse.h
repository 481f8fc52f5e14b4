/* The same multipliers sought on groups of texels first: within a group each texel's multiplier is its part of the
 * group's by area. What they prove is as true as of any multipliers, and steps take a fraction of the time. */
#ifndef OPTIMIZER_COARSE_H
#define OPTIMIZER_COARSE_H

#include "bound/dual.h"

/* Solves on the groups from where `dual` stands, and leaves it where that led. Takes the texels' inequalities as they
 * are. */
bool sp_coarse_solve(sp_dual *dual, const sp_rows *rows, const sp_dual_task *task, sp_error *error);

#endif
