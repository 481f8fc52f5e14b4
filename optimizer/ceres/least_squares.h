/* Nonlinear least squares, by Ceres Solver. */
#ifndef OPTIMIZER_LEAST_SQUARES_H
#define OPTIMIZER_LEAST_SQUARES_H

#include <sprayplan/error.h>

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Residuals at x [unknowns], and where `jacobian` is not NULL their derivatives, [residuals][unknowns] row-major.
 * Returning false ends the solving in an error, as a number does that is not finite. */
typedef bool (*sp_residual_function)(void *user, const double *x, double *residuals, double *jacobian);

typedef struct {
    size_t unknowns, residuals;
    sp_residual_function function;
    void *user;
    int iterations;
    double tolerance; /* of cost, gradient and step, as Ceres defines them */
} sp_least_squares;

/* True where the solver is there, which is looked for once. */
bool sp_least_squares_ready(sp_error *error);

/* Minimises half the sum of squared residuals from x, which it improves in place (x never gets worse).
 * Levenberg-Marquardt, one thread, no logging. Fails where the function ever fails or memory runs out; x is then as it
 * was. */
bool sp_least_squares_solve(const sp_least_squares *problem, double *x, double *cost, sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
