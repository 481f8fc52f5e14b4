/* What the library asks of the module that calls Ceres Solver. */
#ifndef OPTIMIZER_CERES_SOLVE_H
#define OPTIMIZER_CERES_SOLVE_H

#include "ceres/least_squares.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The one function of the module: as sp_least_squares_solve, with counts from 1 to INT_MAX. */
bool sp_ceres_module_solve(const sp_least_squares *problem, double *x, double *cost, sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
