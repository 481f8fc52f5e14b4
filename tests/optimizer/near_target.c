/* Layouts of less water than the best that all but reach the target: which these are, and that they are brought there.
 */
#include "floor.h"
#include "prepared.h"

#include "refine/saving.h"

#define EDGE 2.0
#define TEXEL 0.05
#define LACKS 0.003 /* of the target */

typedef struct {
    job job;
    prepared ready;
    sp_pool pool; /* empty */
    sp_front front;
} plan;

/* A cone above a floor that it covers most of where it points straight down. */
static void plan_open(plan *p)
{
    *p = (plan){0};
    job_open(&p->job, EDGE, TEXEL, 0);
    p->job.options.objective = SP_OBJECTIVE_MIN_WATER;
    p->job.options.max_nozzles = 2;
    p->job.mount.tilt = 20 * DEGREE;
    p->job.options.refine.axis = 5 * DEGREE;
    prepare(&p->ready, p->job.room.evaluator, &p->job.options);
    p->front =
        (sp_front){.fine = p->job.room.evaluator, .deadline = &p->ready.deadline, .objective = SP_OBJECTIVE_MIN_WATER};
}

static void plan_close(plan *p)
{
    sp_front_free(&p->front);
    prepared_free(&p->ready);
    room_close(&p->job.room);
}

/* m² of one cone in that of its poses. */
static double area_of(const plan *p, uint32_t axis)
{
    sp_error error = {0};
    sp_partial partial;
    assert_true(sp_partial_create(&p->ready.search, &partial, &error));
    assert_true(sp_partial_add_pose(&p->ready.search, &partial, (sp_pose){.axis = axis}, &error));
    double area = room_area_of(&p->job.room, sp_partial_to_layout(&p->ready.search, &partial, &error));
    sp_partial_free(&partial);
    return area;
}

static void measure(plan *p, const uint32_t *axes, size_t count)
{
    sp_error error = {0};
    sp_partial partial;
    assert_true(sp_partial_create(&p->ready.search, &partial, &error));
    for (size_t i = 0; i < count; i++)
        assert_true(sp_partial_add_pose(&p->ready.search, &partial, (sp_pose){.axis = axes[i]}, &error));
    assert_true(sp_front_measure(&p->front, &p->ready.search, &partial, NULL, &error));
    sp_partial_free(&partial);
}

/* The pose that covers most, and the one that covers most of those that cover clearly less. */
static void find_axes(const plan *p, uint32_t *straight, uint32_t *askew)
{
    size_t count = sp_candidates_axes(&p->ready.candidates, 0, 0)->count;
    double most = 0, less = 0;
    for (uint32_t i = 0; i < count; i++)
        if (area_of(p, i) > most) {
            *straight = i;
            most = area_of(p, i);
        }
    for (uint32_t i = 0; i < count; i++)
        if (area_of(p, i) < most * (1 - 2 * LACKS) && area_of(p, i) > less) {
            *askew = i;
            less = area_of(p, i);
        }
    assert_true(less > 0);
}

/* Two cones reach what one of them lacks little of askew, and would reach straight. */
static void what_lacks_little_is_brought_there(void **state)
{
    (void)state;
    plan p;
    sp_error error = {0};
    plan_open(&p);
    uint32_t straight = 0, askew = 0;
    find_axes(&p, &straight, &askew);
    p.front.target = area_of(&p, askew) / (1 - LACKS);
    measure(&p, &askew, 1);
    measure(&p, (const uint32_t[]){straight, askew}, 2);
    assert_int_equal(p.front.best.count, 2);
    assert_true(sp_front_saves(&p.front));
    sp_refining refining = {
        .search = &p.ready.search, .pool = &p.pool, .deadline = &p.ready.deadline, .front = &p.front, .error = &error};
    assert_true(sp_local_search_create(&p.ready.search, &p.pool, p.job.room.evaluator, &p.ready.deadline,
                                       &refining.local_search, &error));
    assert_true(sp_reach_target(&refining));
    assert_int_equal(p.front.best.count, 1);
    assert_true(p.front.measured.area >= p.front.target);
    sp_local_search_free(&refining.local_search);
    plan_close(&p);
}

/* Neither what reaches it nor what lacks much, nor what takes as much as the best; and none may take more than that. */
static void near_is_what_lacks_little_for_less(void **state)
{
    (void)state;
    sp_front_entry entries[] = {{.point = {.area = 0.9, .outlay = 1}},
                                {.point = {.area = 0.996, .outlay = 5}},
                                {.point = {.area = 0.998, .outlay = 9.9}},
                                {.point = {.area = 0.999, .outlay = 10}},
                                {.point = {.area = 1, .outlay = 9}}};
    static const bool near[] = {false, true, true, false, false};
    const sp_front front = {.target = 1,
                            .best = {.outlay = 10},
                            .by_water = {.count = sizeof entries / sizeof *entries, .entries = entries}};
    for (size_t i = 0; i < front.by_water.count; i++)
        assert_int_equal(sp_is_near_target(&front, i), near[i]);
    assert_true(sp_near_budget(&front, 1) > 5 && sp_near_budget(&front, 1) < 5.5);
    assert_true(sp_near_budget(&front, 2) == 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_lacks_little_is_brought_there),
                                       cmocka_unit_test(near_is_what_lacks_little_for_less)};
    return cmocka_run_group_tests_name("near_target", tests, NULL, NULL);
}
