/* Parts of work, and who does them. */
#include "team.h"

#include <sched.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

#include <cmocka.h>

#define PARTS 64
#define THREADS 4
#define YIELDS_MOST 10000000 /* that a part waits for another thread: far more than any takes to come */
#define NO_PIECE (-1)

/* The piece of work that a thread is at, whose parts are done in the meantime. */
static _Thread_local int piece_of_thread = NO_PIECE;

typedef struct {
    int piece;
    atomic_int done[PARTS];    /* how often each part was done */
    atomic_bool busy[THREADS]; /* whether a thread is doing one */
    atomic_bool came[THREADS]; /* whether it has done any */
    atomic_int threads;        /* that have */
    atomic_int wrong;          /* parts on a thread that should have done none */
    int size;                  /* that was told */
    int together;              /* threads that a part waits for */
} record;

static void do_part(void *user, size_t part)
{
    record *all = user;
    int own = omp_get_thread_num();
    if (own >= all->size || own >= THREADS || atomic_exchange(&all->busy[own], true) ||
        (piece_of_thread != NO_PIECE && piece_of_thread != all->piece)) {
        atomic_fetch_add(&all->wrong, 1);
        return;
    }
    atomic_fetch_add(&all->done[part], 1);
    if (!atomic_exchange(&all->came[own], true))
        atomic_fetch_add(&all->threads, 1);
    for (int i = 0; atomic_load(&all->threads) < all->together && i < YIELDS_MOST; i++)
        sched_yield();
    atomic_store(&all->busy[own], false);
}

/* How many parts were not done just once, or on a wrong thread. */
static int count_faults(const record *all)
{
    int faults = all->wrong;
    for (size_t i = 0; i < PARTS; i++)
        faults += all->done[i] != 1;
    return faults;
}

static void alone_a_team_of_its_own_does_them(void **state)
{
    (void)state;
    record all = {.together = THREADS, .size = sp_team_size(PARTS, THREADS)};
    assert_int_equal(all.size, THREADS);
    sp_team_do(PARTS, THREADS, do_part, &all);
    assert_int_equal(count_faults(&all), 0);
    assert_int_equal(all.threads, THREADS);
}

static void no_more_threads_than_parts(void **state)
{
    (void)state;
    assert_int_equal(sp_team_size(3, THREADS), 3);
    assert_int_equal(sp_team_size(0, THREADS), 1);
    record none = {.size = 1};
    sp_team_do(0, THREADS, do_part, &none);
    assert_int_equal(none.threads, 0);
}

/* One long piece of work in a loop for four threads: the other three, which have none, do parts of it, and all are done
 * when it goes on. */
static void idle_threads_of_a_team_do_them(void **state)
{
    (void)state;
    record all = {.together = THREADS};
    int faults = 0;
#pragma omp parallel for num_threads(THREADS) schedule(dynamic, 1) reduction(+ : faults)
    for (int piece = 0; piece < 1; piece++) {
        all.size = sp_team_size(PARTS, 1);
        sp_team_do(PARTS, 1, do_part, &all);
        faults += count_faults(&all);
    }
    assert_int_equal(faults, 0);
    assert_int_equal(all.size, THREADS);
    assert_int_equal(all.threads, THREADS);
}

/* Pieces side by side, each with what belongs to its thread: one that waits for its own parts begins no other piece's.
 */
static void pieces_side_by_side_keep_apart(void **state)
{
    (void)state;
    record all[2 * THREADS] = {0};
    int faults = 0;
#pragma omp parallel for num_threads(THREADS) schedule(dynamic, 1) reduction(+ : faults)
    for (int piece = 0; piece < 2 * THREADS; piece++) {
        all[piece].piece = piece_of_thread = piece;
        all[piece].size = THREADS;
        sp_team_do(PARTS, THREADS, do_part, &all[piece]);
        piece_of_thread = NO_PIECE;
        faults += count_faults(&all[piece]);
    }
    assert_int_equal(faults, 0);
}

int main(void)
{
#ifndef _OPENMP
    print_message("built without OpenMP: there is but one thread\n");
    return 0;
#endif
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alone_a_team_of_its_own_does_them),
        cmocka_unit_test(no_more_threads_than_parts),
        cmocka_unit_test(idle_threads_of_a_team_do_them),
        cmocka_unit_test(pieces_side_by_side_keep_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
