/* Placements that must come out whole: stopped before they end, where one nozzle alone must cover, or counted again. */
#include "small_room.h"

#include "scoring/visibility.h"

/* Where one nozzle alone must cover, what a proposal covers is what its nozzles cover one by one where liquid adds up,
 * and no two others do better. */
static void one_nozzle_alone_covers(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    j.room.setup.criterion.combine = SP_COMBINE_SINGLE;
    sp_evaluator_destroy(j.room.evaluator);
    sp_error error = {0};
    j.room.evaluator = sp_evaluator_create(&j.room.setup, &error);
    j.options.max_nozzles = 2;
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    for (int refined = 0; refined < 2; refined++) {
        double best = best_of_two(&j);
        if (refined) {
            j.mounts[0].tilt = 40 * DEGREE;
            j.options.refine = sp_place_options_default().refine;
        }
        sp_proposal *proposal = job_place(&j);
        assert_true(proposal->coverage->covered_area >= best * (1 - 1e-9));
        assert_int_equal(proposal->layout->count, 2);
        sp_setup setup = j.room.setup;
        setup.criterion.combine = SP_COMBINE_SUM;
        sp_evaluator *sum = sp_evaluator_create(&setup, &error);
        const sp_patches *patches = sp_evaluator_patches(sum);
        double area = 0, both = 0;
        sp_coverage *alone[2];
        for (int i = 0; i < 2; i++) {
            sp_layout *layout = sp_layout_create(&proposal->layout->nozzles[i], 1, &error);
            alone[i] = sp_evaluate(sum, layout, &error);
            assert_non_null(alone[i]);
            sp_layout_destroy(layout);
        }
        sp_coverage *together = sp_evaluate(sum, proposal->layout, &error);
        both = together->covered_area;
        for (size_t p = 0; p < patches->count; p++)
            area += (1 - (1 - alone[0]->deposits.share[p]) * (1 - alone[1]->deposits.share[p])) * patches->area[p];
        assert_true(fabs(area - proposal->coverage->covered_area) < 1e-9 * area);
        assert_true(both >= area);
        sp_coverage_destroy(alone[0]);
        sp_coverage_destroy(alone[1]);
        sp_coverage_destroy(together);
        sp_evaluator_destroy(sum);
        sp_proposal_destroy(proposal);
    }
    room_close(&j.room);
}

static bool stop_at_greedy(void *user, const char *stage, double done)
{
    (void)done;
    size_t *calls = user;
    (*calls)++;
    return strcmp(stage, "greedy") != 0;
}

static void cancelling_gives_the_best_so_far(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    size_t calls = 0;
    j.options.run.progress = stop_at_greedy;
    j.options.run.user = &calls;
    sp_proposal *proposal = job_place(&j);
    assert_true(proposal->interrupted);
    assert_true(calls > 0);
    assert_false(proposal->reached);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

typedef struct {
    const char *stage;
    size_t calls, most; /* so many calls of that stage */
} stopper;

static bool stop_in_stage(void *user, const char *stage, double done)
{
    stopper *s = user;
    (void)done;
    return strcmp(stage, s->stage) != 0 || s->calls++ < s->most;
}

/* Wherever it is stopped, what comes out is whole: within its limits, its figures those of its layout, no better than
 * its bounds. */
static void wherever_it_stops_the_best_so_far_is_valid(void **state)
{
    (void)state;
    static const char *const stages[] = {"visibility", "attainable", "greedy",     "exchange",
                                         "front",      "refine",     "certificate"};
#ifdef SPRAYPLAN_SANITIZE
    static const size_t calls[] = {2};
    const double tilt = 20 * DEGREE;
#else
    static const size_t calls[] = {0, 20};
    const double tilt = 40 * DEGREE;
#endif
    size_t stopped = 0;
    for (size_t s = 0; s < sizeof stages / sizeof *stages; s++)
        for (size_t c = 0; c < sizeof calls / sizeof *calls; c++) {
            job j;
            job_open_coarse(&j, 0.2);
            stopper stop = {stages[s], 0, calls[c]};
            j.options.max_nozzles = 3;
            j.options.coverage = 0.7;
            j.mounts[0].tilt = tilt;
            j.mounts[0].spacing = 0.8;
            j.options.refine = sp_place_options_default().refine;
            j.options.run.progress = stop_in_stage;
            j.options.run.user = &stop;
            sp_proposal *proposal = job_place(&j);
            assert_int_equal(proposal->interrupted, stop.calls > stop.most);
            stopped += proposal->interrupted;
            if (s > 2)
                assert_true(proposal->layout->count > 0);
            double area = area_of(&j, proposal->layout->nozzles, proposal->layout->count);
            assert_true(area == proposal->coverage->covered_area);
            assert_true(proposal->reached == (area >= proposal->asked_area));
            sp_proposal_destroy(proposal);
            room_close(&j.room);
        }
    assert_true(stopped > 3 * sizeof calls / sizeof *calls);
}

#define HURRY                                                                                                          \
    90 /* s, for one thread: less than a placement at leisure is given, and more than these small ones take            \
        */

/* Patches that the search sees. */
static size_t count_patches(const job *j)
{
    sp_error error = {0};
    sp_deadline deadline = sp_deadline_start(&j->options.run);
    sp_sites sites = {0};
    sp_candidates candidates = {0};
    sp_evaluator *resampled = NULL;
    sp_visibility visibility;
    assert_true(sp_sites_create(j->room.evaluator, &j->options, &sites, &error));
    assert_true(sp_candidates_create(j->room.evaluator, &j->options, &sites, &candidates, &error));
    assert_true(sp_visibility_fit(j->room.evaluator, &j->options, &sites, &candidates, &deadline, &resampled,
                                  &visibility, &error));
    size_t count = sp_evaluator_patches(visibility.evaluator)->count;
    sp_visibility_free(&visibility);
    sp_evaluator_destroy(resampled);
    sp_candidates_free(&candidates);
    sp_sites_free(&sites);
    return count;
}

static void in_a_hurry_few_patches_are_seen(void **state)
{
    (void)state;
    job j;
    job_open_coarse(&j, 0.05);
    size_t all = sp_evaluator_patches(j.room.evaluator)->count;
    assert_int_equal(count_patches(&j), all);
    j.options.run.time_limit = HURRY;
    assert_true(count_patches(&j) < all / 2);
    room_close(&j.room);
}

/* What the placement has once it would look for other layouts of the candidates. */
static sp_proposal *place_until_exchange(job *j, double time_limit)
{
    stopper stop = {"exchange", 0, 0};
    j->options.run.progress = stop_in_stage;
    j->options.run.user = &stop;
    j->options.run.time_limit = time_limit;
    sp_proposal *proposal = job_place(j);
    assert_true(proposal->interrupted);
    return proposal;
}

/* In a hurry a layout that reaches the target has been refined by then, and none at leisure. */
static void in_a_hurry_the_proposal_comes_first(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    j.options.coverage = 0.7;
    j.mounts[0].tilt = 40 * DEGREE;
    j.options.refine = sp_place_options_default().refine;
    sp_proposal *leisurely = place_until_exchange(&j, 0), *hurried = place_until_exchange(&j, HURRY);
    assert_true(leisurely->coverage->covered_area == leisurely->greedy_coverage->covered_area);
    assert_true(hurried->reached);
    assert_true(hurried->coverage->flow < leisurely->coverage->flow);
    /* with what fewer nozzles do, though no others were looked for */
    assert_true(hurried->greedy->count > 1);
    assert_true(hurried->by_number_count >= hurried->greedy->count);
    assert_true(hurried->coverage->covered_area == area_of(&j, hurried->layout->nozzles, hurried->layout->count));
    sp_proposal_destroy(leisurely);
    sp_proposal_destroy(hurried);
    room_close(&j.room);
}

/* By then it reaches the target for any objective, and where as much as possible is to be covered nothing is lost. */
static void in_a_hurry_any_objective_is_served(void **state)
{
    (void)state;
    static const sp_objective objectives[] = {SP_OBJECTIVE_MIN_WATER, SP_OBJECTIVE_MAX_COVERAGE};
    for (size_t i = 0; i < sizeof objectives / sizeof *objectives; i++) {
        job j;
        job_open_coarse(&j, 0.2);
        j.options.objective = objectives[i];
        j.options.max_nozzles = 4;
        j.options.coverage = 0.4;
        j.mounts[0].tilt = 40 * DEGREE;
        j.mounts[0].spacing = 0.8;
        j.options.refine = sp_place_options_default().refine;
        sp_proposal *proposal = place_until_exchange(&j, HURRY);
        assert_true(proposal->reached);
        if (objectives[i] == SP_OBJECTIVE_MAX_COVERAGE)
            assert_true(proposal->coverage->covered_area >= proposal->greedy_coverage->covered_area);
        sp_proposal_destroy(proposal);
        room_close(&j.room);
    }
}

/* The least flow and the most water let in more nozzles than are counted one by one. */
static void many_nozzles_have_a_certificate(void **state)
{
    (void)state;
    job j;
    job_open_coarse(&j, 0.2);
    j.types[1] = room_cone("drip", 60 * DEGREE, 0.1);
    j.options.max_water = 32 * LITRES_PER_MINUTE;
    sp_proposal *proposal = job_place(&j);
    assert_true(proposal->coverage->flow > 256 * j.types[1].flow);
    assert_true(proposal->certificate.computed);
    for (size_t i = 0; i < proposal->front_count; i++)
        assert_true(proposal->front[i].bound >= proposal->front[i].counted);
    /* two wide ones are all that the water lets in that bring anything */
    assert_true(proposal->certificate.area_bound >= proposal->certificate.counted);
    assert_true(proposal->certificate.area_bound < 0.99 * proposal->certificate.whole);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

#define ACCURACY 1e-5 /* points tell so much, 100,000 texels do not */

/* Where points of the surface do not confirm the coverage, all is counted again on shorter texels until they do. */
static void the_accuracy_holds_on_the_proposal(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    sp_evaluator_destroy(j.room.evaluator);
    sp_error error = {0};
    j.room.setup.fidelity.texel = 0;
    j.room.setup.fidelity.accuracy = ACCURACY;
    j.room.evaluator = sp_evaluator_create(&j.room.setup, &error);
    assert_non_null(j.room.evaluator);
    j.types[1] = room_cone("narrow", 25 * DEGREE, 6); /* of 20 degrees the best place happens to be as exact */
    j.options.types = &j.type_list[1];
    j.options.type_count = 1;
    j.options.max_nozzles = 1;
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    sp_proposal *proposal = job_place(&j);
    const sp_fidelity *first = sp_evaluator_fidelity(j.room.evaluator);
    assert_non_null(proposal->again);
    const sp_fidelity *last = sp_evaluator_fidelity(proposal->again);
    assert_true(last->texel <= 0.5 * first->texel);
    assert_true(proposal->coverage->measured.known);
    assert_true(proposal->coverage->measured.estimate <= ACCURACY);
    /* all that is said is of the new texels */
    size_t patches = sp_evaluator_patches(proposal->again)->count;
    assert_true(patches > 2 * sp_evaluator_patches(j.room.evaluator)->count);
    assert_int_equal(proposal->coverage->deposits.count, patches);
    assert_int_equal(proposal->greedy_coverage->deposits.count, patches);
    assert_true(proposal->asked_area == j.options.coverage * sp_evaluator_patches(proposal->again)->total_area);
    sp_coverage *counted = sp_evaluate(proposal->again, proposal->layout, &error);
    assert_non_null(counted);
    assert_true(counted->covered_area == proposal->coverage->covered_area);
    assert_true(proposal->front[proposal->front_count - 1].area == counted->covered_area);
    sp_coverage_destroy(counted);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

static void out_of_time_there_is_one_nozzle(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    j.options.run.time_limit = 1e-9;
    sp_proposal *proposal = job_place(&j);
    assert_true(proposal->interrupted);
    assert_int_equal(proposal->layout->count, 1);
    assert_int_equal(proposal->front_count, 1);
    assert_false(proposal->certificate.computed);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_nozzle_alone_covers),
        cmocka_unit_test(cancelling_gives_the_best_so_far),
        cmocka_unit_test(wherever_it_stops_the_best_so_far_is_valid),
        cmocka_unit_test(in_a_hurry_few_patches_are_seen),
        cmocka_unit_test(in_a_hurry_the_proposal_comes_first),
        cmocka_unit_test(in_a_hurry_any_objective_is_served),
        cmocka_unit_test(many_nozzles_have_a_certificate),
        cmocka_unit_test(the_accuracy_holds_on_the_proposal),
        cmocka_unit_test(out_of_time_there_is_one_nozzle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
