/* Least squares, by the module of Ceres, on a problem with certified answers: NIST StRD nonlinear regression, Misra1a.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "ceres/least_squares.h"

#define OBSERVATIONS 14

/* https://www.itl.nist.gov/div898/strd/nls/data/misra1a.shtml: y = b1 (1 - exp(-b2 x)) */
static const double misra_y[OBSERVATIONS] = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                                             44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};
static const double misra_x[OBSERVATIONS] = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                                             378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};

static bool misra(void *user, const double *b, double *residuals, double *jacobian)
{
    size_t *calls = user;
    (*calls)++;
    for (size_t i = 0; i < OBSERVATIONS; i++) {
        double decay = exp(-b[1] * misra_x[i]);
        residuals[i] = b[0] * (1 - decay) - misra_y[i];
        if (jacobian) {
            jacobian[2 * i] = 1 - decay;
            jacobian[2 * i + 1] = b[0] * misra_x[i] * decay;
        }
    }
    return true;
}

static void certified_values(void **state)
{
    (void)state;
    const double starts[2][2] = {{500, 0.0001}, {250, 0.0005}};
    for (size_t s = 0; s < 2; s++) {
        size_t calls = 0;
        sp_least_squares problem = {.unknowns = 2,
                                    .residuals = OBSERVATIONS,
                                    .function = misra,
                                    .user = &calls,
                                    .iterations = 200,
                                    .tolerance = 1e-15};
        double b[2] = {starts[s][0], starts[s][1]}, cost = 0;
        sp_error error = {0};
        assert_true(sp_least_squares_solve(&problem, b, &cost, &error));
        assert_true(calls > 0);
        /* certified to 11 digits; 8 are asked for */
        assert_true(fabs(b[0] / 2.3894212918e+02 - 1) < 1e-8);
        assert_true(fabs(b[1] / 5.5015643181e-04 - 1) < 1e-8);
        assert_true(fabs(2 * cost / 1.2455138894e-01 - 1) < 1e-8);
    }
}

static bool refuses(void *user, const double *x, double *residuals, double *jacobian)
{
    (void)user;
    (void)jacobian;
    residuals[0] = x[0];
    return false;
}

static void failure_is_an_error(void **state)
{
    (void)state;
    sp_least_squares problem = {.unknowns = 1, .residuals = 1, .function = refuses, .iterations = 5, .tolerance = 1e-9};
    double x = 3;
    sp_error error = {0};
    assert_false(sp_least_squares_solve(&problem, &x, NULL, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    assert_true(x == 3);
    problem.unknowns = 0;
    error = (sp_error){0};
    assert_false(sp_least_squares_solve(&problem, &x, NULL, &error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(certified_values), cmocka_unit_test(failure_is_an_error)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
