/* The smoothed coverage is maximised, by Ceres: a disc over a square floor comes to lie in its middle. */
#include "floor.h"
#include "prepared.h"

#include "refine/continuation.h"
#include "refine/smooth_objective.h"

#define HEIGHT 2.0
#define EDGE 2.2
#define REACH 1.3 /* the disc's radius: beyond the floor's sides, short of its corners, so that one place is best */

typedef struct {
    job job;
    prepared ready;
    sp_sights sights;
    sp_partial partial; /* one cone, 0.3 m off the middle */
} bench;

static void bench_open(bench *b)
{
    sp_error error = {0};
    *b = (bench){.partial = {0}};
    job *j = &b->job;
    job_open(j, EDGE, 0.05, 0);
    j->type = room_cone("set", 2 * atan(REACH / HEIGHT), 20);
    j->mount = (sp_mount){.kind = SP_MOUNT_LINE,
                          .axis = sp_v(0, 0, -1),
                          .spacing = 2,
                          .from = sp_v(-0.3, 0, HEIGHT),
                          .to = sp_v(0.9, 0, HEIGHT)};
    j->options.refine = (sp_refine){.position = 1};
    prepare(&b->ready, j->room.evaluator, &j->options);
    assert_true(sp_sights_create(&b->ready.search, 4, false, &b->sights, &error));
    assert_true(sp_partial_create(&b->ready.search, &b->partial, &error));
    assert_true(sp_partial_add_pose(&b->ready.search, &b->partial, (sp_pose){0, 0, 0, 0}, &error));
}

static void bench_close(bench *b)
{
    sp_partial_free(&b->partial);
    sp_sights_free(&b->sights);
    prepared_free(&b->ready);
    room_close(&b->job.room);
}

/* However blurred: what is left out lies alike on both sides. */
static void one_solve_goes_to_the_middle(void **state)
{
    (void)state;
    const sp_width widths[] = {{0.8, 0.085}, {0.2, 0.042}};
    for (size_t w = 0; w < sizeof widths / sizeof *widths; w++) {
        bench b;
        sp_error error = {0};
        double values[1][SP_UNKNOWNS];
        bench_open(&b);
        const sp_placed *placed = &b.partial.items[0];
        sp_pose_parameters parameters = sp_pose_parameters_create(&b.ready.search, placed);
        const sp_sight *sight = sp_sights_look(&b.sights, placed, &error);
        assert_int_equal(parameters.count, 1);
        memcpy(values[0], parameters.value, sizeof values[0]);
        assert_true(sp_smooth_objective_minimise(&b.ready.search, &b.partial, &parameters, &sight, widths[w], INFINITY,
                                                 values, &error));
        sp_nozzle found = sp_pose_parameters_nozzle(&parameters, values[0]);
        print_message("from %g to %g m\n", placed->nozzle.position.x, found.position.x);
        assert_true(fabs(placed->nozzle.position.x) > 0.25 && fabs(found.position.x) < 1e-3);
        bench_close(&b);
    }
}

static void annealing_ends_there(void **state)
{
    (void)state;
    bench b;
    sp_error error = {0};
    bench_open(&b);
    double before = b.partial.covered;
    assert_true(sp_continuation(&b.sights, 0, SP_WIDTHS, INFINITY, &b.ready.deadline, &b.partial, &error));
    print_message("at %g m, %g m2 for %g\n", b.partial.items[0].nozzle.position.x, b.partial.covered, before);
    assert_true(fabs(b.partial.items[0].nozzle.position.x) < 0.01);
    assert_true(b.partial.covered > before);
    bench_close(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_solve_goes_to_the_middle),
        cmocka_unit_test(annealing_ends_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
