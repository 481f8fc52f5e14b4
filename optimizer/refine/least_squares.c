/* Arguments are checked here, the module of Ceres solves. */
#include "refine/least_squares.h"

#include "module/module.h"
#include "refine/ceres/solve.h"

#include <limits.h>

bool sp_least_squares_solve(const sp_least_squares *problem, double *x, double *cost, sp_error *error)
{
    static sp_module module = {.file = "sprayplan-ceres.so", .name = "sp_ceres_module_solve"};
    if (!problem->unknowns || !problem->residuals || problem->unknowns > INT_MAX || problem->residuals > INT_MAX)
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "a least squares problem of %zu unknowns, %zu residuals",
                       problem->unknowns, problem->residuals);
    __typeof__(sp_ceres_module_solve) *solve = (__typeof__(solve))sp_module_open(&module, error);
    return solve && solve(problem, x, cost, error);
}
