/* Placement with types whose liquid flies in a way of its own. */
#include "small_room.h"

#define SLOW 1e4 /* Pa: what falls and what does not cover different spots */

static void open_slow(job *j, sp_trajectory scene, sp_trajectory own)
{
    job_open_coarse(j, 0.2);
    sp_evaluator_destroy(j->room.evaluator);
    sp_error error = {0};
    j->room.setup.fidelity.trajectory = scene;
    j->room.evaluator = sp_evaluator_create(&j->room.setup, &error);
    assert_non_null(j->room.evaluator);
    for (int i = 0; i < 3; i++) {
        j->types[i].trajectory = own;
        j->types[i].at = SLOW;
    }
    j->pressure = SLOW;
    j->options.max_nozzles = 2;
    j->options.coverage = 1;
    j->options.objective = SP_OBJECTIVE_MAX_COVERAGE;
}

static void assert_same_proposal(const sp_proposal *a, const sp_proposal *b)
{
    assert_int_equal(a->layout->count, b->layout->count);
    for (size_t i = 0; i < a->layout->count; i++) {
        const sp_nozzle *x = &a->layout->nozzles[i], *y = &b->layout->nozzles[i];
        assert_memory_equal(&x->position, &y->position, sizeof x->position);
        assert_memory_equal(&x->axis, &y->axis, sizeof x->axis);
        assert_string_equal(x->type->name, y->type->name);
    }
    assert_true(a->coverage->covered_area == b->coverage->covered_area);
    assert_true(a->attainable_area == b->attainable_area);
    assert_true(a->certificate.area_bound == b->certificate.area_bound);
    assert_true(a->certificate.every_aim.area_bound == b->certificate.every_aim.area_bound);
    assert_int_equal(a->front_count, b->front_count);
}

/* All of the types by one way are what a scene of that way is, refinement (parabolas) and proofs included. */
static void ways_of_types_are_ways_of_a_scene(void **state)
{
    (void)state;
    static const sp_trajectory ways[] = {SP_TRAJECTORY_PARABOLA, SP_TRAJECTORY_DRAG};
    for (int i = 0; i < 2; i++) {
        job plain, own;
        open_slow(&plain, ways[i], SP_TRAJECTORY_AUTO);
        open_slow(&own, SP_TRAJECTORY_LINE, ways[i]);
        job *jobs[] = {&plain, &own};
        for (int k = 0; k < 2; k++)
            jobs[k]->options.refine = (sp_refine){.position = ways[i] == SP_TRAJECTORY_DRAG ? 0 : 0.1};
        sp_proposal *a = job_place(&plain), *b = job_place(&own);
        assert_same_proposal(a, b);
        sp_proposal_destroy(a);
        sp_proposal_destroy(b);
        room_close(&plain.room);
        room_close(&own.room);
    }
}

/* Types of two ways side by side: the best of all pairs is found and none is excluded by the proof. */
static void types_of_two_ways_compete(void **state)
{
    (void)state;
    double best[2];
    for (int mixed = 0; mixed < 2; mixed++) {
        job j;
        open_slow(&j, SP_TRAJECTORY_PARABOLA, SP_TRAJECTORY_AUTO);
        j.types[0].trajectory = mixed ? SP_TRAJECTORY_LINE : SP_TRAJECTORY_AUTO;
        best[mixed] = best_of_two(&j);
        if (mixed) {
            sp_proposal *proposal = job_place(&j);
            assert_true(proposal->certificate.area_bound >= best[mixed] * (1 - 1e-9));
            assert_true(proposal->coverage->covered_area >= best[mixed] * (1 - 1e-9));
            sp_proposal_destroy(proposal);
        }
        room_close(&j.room);
    }
    assert_true(best[0] != best[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ways_of_types_are_ways_of_a_scene),
        cmocka_unit_test(types_of_two_ways_compete),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
