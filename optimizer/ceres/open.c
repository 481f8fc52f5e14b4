/* Arguments are checked here, the module of Ceres solves. */
#include "ceres/least_squares.h"

#include "module/module.h"
#include "ceres/solve.h"

#include <limits.h>

typedef __typeof__(sp_ceres_module_solve) solver;

static solver *find_solver(sp_error *error)
{
    static sp_module module = {.file = "sprayplan-ceres.so", .name = "sp_ceres_module_solve"};
    return (solver *)sp_module_open(&module, error);
}

bool sp_least_squares_ready(sp_error *error)
{
    return find_solver(error) != NULL;
}

bool sp_least_squares_solve(const sp_least_squares *problem, double *x, double *cost, sp_error *error)
{
    if (!problem->unknowns || !problem->residuals || problem->unknowns > INT_MAX || problem->residuals > INT_MAX)
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "a least squares problem of %zu unknowns, %zu residuals",
                       problem->unknowns, problem->residuals);
    solver *solve = find_solver(error);
    return solve && solve(problem, x, cost, error);
}
