/* Steps of the primal-dual hybrid gradient method (PDHG) on one set of texels. */
#ifndef OPTIMIZER_ITERATE_H
#define OPTIMIZER_ITERATE_H

#include "bound/dual.h"

/* As sp_dual_solve, on these texels alone, from multipliers and choices that are there. */
bool sp_dual_iterate(sp_dual *dual, const sp_rows *rows, const sp_dual_task *task, sp_error *error);

#endif
