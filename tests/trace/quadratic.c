/* Roots of a/2 t² + b t + c where textbook formulas lose their digits. */
#include "trace/ray/parabola.h"

#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

static void assert_roots(double a, double b, double c, double low, double high)
{
    double roots[2];
    if (!sp_quadratic_roots(a, b, c, roots))
        fail_msg("%g %g %g has no roots", a, b, c);
    if (!(fabs(roots[0] - low) <= 4 * DBL_EPSILON * fabs(low) && fabs(roots[1] - high) <= 4 * DBL_EPSILON * fabs(high)))
        fail_msg("%g %g %g: %.17g %.17g, not %.17g %.17g", a, b, c, roots[0], roots[1], low, high);
}

static void plain_roots(void **state)
{
    (void)state;
    assert_roots(2, -3, 2, 1, 2);
    assert_roots(-2, 3, -2, 1, 2);
    assert_roots(2, 3, 2, -2, -1);
    assert_roots(2, 0, -4, -2, 2);
    assert_roots(2, 5, 0, -5, 0);
    assert_roots(2, -5, 0, 0, 5);
    assert_roots(2, 0, 0, 0, 0);
}

static void small_and_large_root_keep_their_digits(void **state)
{
    (void)state;
    assert_roots(2, -1e8 - 1e-8, 1, 1e-8, 1e8);
    assert_roots(2e-20, -1, 1, 1, 1e20);
    assert_roots(-2e-20, 1, 1, -1, 1e20);
}

/* (n t - 1)² - t², whose roots 1/(n - 1) and 1/(n + 1) are close: b² and 2 a c agree in nearly all digits. */
static void close_roots_keep_their_digits(void **state)
{
    (void)state;
    for (double n = 8; n < 9e7; n *= 2)
        assert_roots(2 * (n * n - 1), -2 * n, 1, 1 / (n + 1), 1 / (n - 1));
}

static void no_roots(void **state)
{
    (void)state;
    double roots[2];
    assert_false(sp_quadratic_roots(2, 1, 1, roots));
    assert_false(sp_quadratic_roots(-2, 0, -1, roots));
    /* b² is less than 2 a c by less than the rounding of either. */
    assert_false(
        sp_quadratic_roots(2, 2 * (1 + DBL_EPSILON), (1 + DBL_EPSILON) * (1 + DBL_EPSILON) + DBL_EPSILON, roots));
}

/* Without curvature one root is real; the other is at infinity or no number, and no time that a ray could have. */
static void lines(void **state)
{
    (void)state;
    static const double zeros[] = {0.0, -0.0};
    for (int i = 0; i < 2; i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double roots[2];
            assert_true(sp_quadratic_roots(zeros[i], 2.0 * sign, 3, roots));
            assert_true((roots[0] == -1.5 * sign && !isfinite(roots[1])) ||
                        (roots[1] == -1.5 * sign && !isfinite(roots[0])));
        }
    double roots[2];
    assert_true(!sp_quadratic_roots(0, 0, 1, roots) || !isfinite(roots[0]));
    assert_true(!sp_quadratic_roots(0, 0, 0, roots) || !isfinite(roots[0]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_roots),
        cmocka_unit_test(small_and_large_root_keep_their_digits),
        cmocka_unit_test(close_roots_keep_their_digits),
        cmocka_unit_test(no_roots),
        cmocka_unit_test(lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
