/* Looks for good multipliers: on groups of texels first where that is asked for, then on all. */
#ifndef OPTIMIZER_SOLVE_H
#define OPTIMIZER_SOLVE_H

#include "bound/dual.h"

/* Goes on from where the last solve ended; rows that are new since then start at 0. Primal-dual hybrid gradient with
 * averages, restarts and diagonal steps: Chambolle and Pock 2011; Pock and Chambolle 2011; Applegate et al., Practical
 * large-scale linear programming using primal-dual hybrid gradient, 2021. */
bool sp_dual_solve(sp_dual *dual, const sp_rows *rows, const sp_dual_task *task, sp_error *error);

#endif
