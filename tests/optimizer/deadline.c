/* Time and cancelling of a placement. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "clock.h"
#include "deadline/deadline.h"

static void only_its_share_of_the_limit_may_be_spent(void **state)
{
    (void)state;
    sp_run run = {.time_limit = 1e6};
    sp_deadline deadline = sp_deadline_start(&run);
    assert_true(sp_deadline_left(&deadline) > 9e5);
    sp_deadline_allow(&deadline, 0.25);
    assert_true(sp_deadline_left(&deadline) <= 2.5e5);
    assert_true(sp_deadline_goes_on(&deadline, "a", 0));
    sp_deadline_allow(&deadline, 0);
    assert_true(sp_deadline_left(&deadline) < 0);
    assert_false(sp_deadline_has_time(&deadline, "a", 0));
    assert_false(deadline.interrupted);
    assert_int_equal(deadline.cut_count, 0);
    assert_false(sp_deadline_goes_on(&deadline, "a", 0));
    assert_false(sp_deadline_goes_on(&deadline, "a", 0));
    assert_true(deadline.interrupted);
    assert_false(deadline.cancelled);
    assert_int_equal(deadline.cut_count, 1); /* named once */
    assert_string_equal(deadline.cut[0], "a");
    /* what comes next has the rest */
    sp_deadline_allow(&deadline, 1);
    assert_true(sp_deadline_goes_on(&deadline, "b", 0));
    assert_true(deadline.interrupted);
}

static void without_a_limit_there_is_always_time(void **state)
{
    (void)state;
    sp_run run = {0};
    sp_deadline deadline = sp_deadline_start(&run);
    sp_deadline_allow(&deadline, 0);
    assert_true(isinf(sp_deadline_left(&deadline)));
    assert_true(sp_deadline_goes_on(&deadline, "a", 0));
    assert_false(deadline.interrupted);
}

static void short_limits_of_few_threads_make_haste(void **state)
{
    (void)state;
    assert_false(sp_run_hurries(&(sp_run){.threads = 1}));
    assert_true(sp_run_hurries(&(sp_run){.threads = 1, .time_limit = 90}));
    assert_false(sp_run_hurries(&(sp_run){.threads = 1, .time_limit = 170}));
    assert_true(sp_run_hurries(&(sp_run){.threads = 2, .time_limit = 15}));
    assert_false(sp_run_hurries(&(sp_run){.threads = 16, .time_limit = 15}));
}

static bool cancel(void *user, const char *stage, double done)
{
    (void)stage, (void)done;
    ++*(size_t *)user;
    return false;
}

/* A lent share that runs out leaves nothing out, cancelling does. */
static void a_lent_share_is_given_back(void **state)
{
    (void)state;
    size_t calls = 0;
    sp_run run = {.time_limit = 1e6};
    sp_deadline deadline = sp_deadline_start(&run);
    sp_deadline_allow(&deadline, 0.5);
    sp_deadline_lend(&deadline, 0.5);
    double left = sp_deadline_left(&deadline);
    assert_true(left > 2.4e5 && left <= 2.5e5);
    assert_true(sp_deadline_goes_on(&deadline, "a", 0));
    sp_deadline_allow(&deadline, 0.5);
    sp_deadline_lend(&deadline, 0);
    assert_false(sp_deadline_goes_on(&deadline, "a", 0));
    assert_false(deadline.interrupted);
    assert_int_equal(deadline.cut_count, 0);
    sp_deadline_allow(&deadline, 0.5);
    assert_true(sp_deadline_goes_on(&deadline, "a", 0));
    sp_deadline_allow(&deadline, 0);
    sp_deadline_lend(&deadline, 0.5); /* nothing is left to lend of */
    assert_true(sp_deadline_left(&deadline) < 0);
    deadline.run.progress = cancel;
    deadline.run.user = &calls;
    assert_false(sp_deadline_goes_on(&deadline, "a", 0));
    assert_true(deadline.interrupted);
    assert_int_equal(deadline.cut_count, 1);
    sp_deadline endless = sp_deadline_start(&(sp_run){0});
    sp_deadline_lend(&endless, 0);
    assert_true(isinf(sp_deadline_left(&endless)) && sp_deadline_goes_on(&endless, "a", 0));
}

/* By what went before, whatever the machine. */
static void time_presses_where_little_is_left(void **state)
{
    (void)state;
    assert_false(sp_deadline_presses(&(sp_deadline){.share = 1, .start = sp_now() - 1e3}));
    const double limits[] = {1.01e3, 2e4, 1e6};
    const bool presses[] = {true, true, false};
    for (int i = 0; i < 3; i++) {
        sp_deadline deadline = {.run.time_limit = limits[i], .share = 1, .start = sp_now() - 1e3};
        assert_int_equal(sp_deadline_presses(&deadline), presses[i]);
    }
}

static void cancelled_once_it_stays_so(void **state)
{
    (void)state;
    size_t calls = 0;
    sp_run run = {.progress = cancel, .user = &calls};
    sp_deadline deadline = sp_deadline_start(&run);
    assert_false(sp_deadline_has_time(&deadline, "a", 0));
    assert_true(deadline.cancelled && deadline.interrupted);
    assert_false(sp_deadline_goes_on(&deadline, "b", 0));
    assert_int_equal(calls, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_its_share_of_the_limit_may_be_spent),
        cmocka_unit_test(without_a_limit_there_is_always_time),
        cmocka_unit_test(short_limits_of_few_threads_make_haste),
        cmocka_unit_test(a_lent_share_is_given_back),
        cmocka_unit_test(time_presses_where_little_is_left),
        cmocka_unit_test(cancelled_once_it_stays_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
