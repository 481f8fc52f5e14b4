/* What one placement found, given to another: as far as that one allows it, nothing that it tells is worse. */
#include "small_room.h"

#define NO_TIME 1e-9 /* s: a first layout and no more */

/* A line of three places, where nozzles may lean. */
static void open_leaning(job *j)
{
    job_open_coarse(j, 0.2);
    j->mounts[0].tilt = 20 * DEGREE;
    j->mounts[0].spacing = 0.8;
    j->options.max_nozzles = 2;
    j->options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j->options.coverage = 1;
}

/* And a port in the lid, before it. */
static void add_port(job *j)
{
    j->mounts[1] = j->mounts[0];
    j->mounts[0] =
        (sp_mount){.kind = SP_MOUNT_PORT, .name = "P1", .position = sp_v(0.1, -0.4, 1), .axis = sp_v(0, 0, -1)};
    j->options.mount_count = 2;
}

static sp_proposal *place_knowing(job *j, const sp_proposal *const *known, double time)
{
    j->options.known = known;
    j->options.known_count = 1;
    j->options.run.time_limit = time;
    return job_place(j);
}

/* Every layout of the one front is on the other, or a better one, where each new fitting takes `cost` more, m³/s. The
 * front tells of one of those that take within a hundredth of the same. */
static void check_no_worse(const sp_proposal *proposal, const sp_proposal *known, double cost)
{
    for (size_t i = 0; i < known->front_count; i++) {
        const sp_front_point *point = &known->front[i];
        double outlay = point->flow + cost * (double)point->fittings, most = 0;
        for (size_t k = 0; k < proposal->front_count; k++)
            if (proposal->front[k].outlay <= outlay * 1.01)
                most = proposal->front[k].area;
        assert_true(most >= point->area * (1 - 1e-9));
    }
    assert_true(proposal->coverage->covered_area >= known->coverage->covered_area * (1 - 1e-9));
    for (size_t k = 0; k < proposal->front_count; k++) {
        const sp_front_point *point = &proposal->front[k];
        double outlay = point->flow + cost * (double)point->fittings;
        assert_true(fabs(point->outlay - outlay) <= 1e-9 * outlay);
    }
}

/* Moved by refinement, and of axes that lie closer than where there are more places. */
static void what_is_allowed_is_no_worse(void **state)
{
    (void)state;
    job j;
    open_leaning(&j);
    j.options.refine.axis = 20 * DEGREE;
    const sp_proposal *known = job_place(&j);
    add_port(&j);
    sp_proposal *hasty = place_knowing(&j, &known, NO_TIME);
    check_no_worse(hasty, known, 0);
    sp_proposal_destroy(hasty);
    j.mounts[1].cost = 2 * LITRES_PER_MINUTE;
    hasty = place_knowing(&j, &known, NO_TIME);
    check_no_worse(hasty, known, j.mounts[1].cost);
    sp_proposal_destroy(hasty);
    sp_proposal_destroy((sp_proposal *)known);
    room_close(&j.room);
}

/* Poses that are no candidates here are counted as such. */
static void what_is_proved_holds_for_it(void **state)
{
    (void)state;
    job j;
    open_leaning(&j);
    j.options.refine.axis = 20 * DEGREE;
    const sp_proposal *known = job_place(&j);
    j.options.refine = (sp_refine){0};
    sp_proposal *proposal = place_knowing(&j, &known, 0);
    check_no_worse(proposal, known, 0);
    assert_true(proposal->certificate.computed && proposal->certificate.own > 0);
    assert_false(proposal->certificate.every_layout);
    for (size_t i = 0; i < proposal->front_count; i++)
        assert_true(proposal->front[i].bound >= proposal->front[i].counted * (1 - 1e-9));
    sp_proposal_destroy(proposal);
    sp_proposal_destroy((sp_proposal *)known);
    room_close(&j.room);
}

/* One limit less, `which`, than what was found keeps to: on nozzles, on water, on the mount's own number. */
static void check_limited(job j, int which, const sp_proposal *known)
{
    j.options.mounts = j.mounts;
    j.options.max_nozzles = which == 0 ? 1 : 2;
    j.options.max_water = which == 1 ? 17 * LITRES_PER_MINUTE : INFINITY;
    j.mounts[0].most = which == 2;
    sp_proposal *proposal = place_knowing(&j, &known, NO_TIME);
    assert_int_equal(proposal->layout->count, 1);
    assert_true(proposal->coverage->covered_area >= known->by_number[0].area * (1 - 1e-9));
    sp_proposal_destroy(proposal);
}

static void check_same(const sp_proposal *a, const sp_proposal *b)
{
    assert_int_equal(a->front_count, b->front_count);
    for (size_t i = 0; i < a->front_count; i++)
        assert_true(a->front[i].area == b->front[i].area && a->front[i].outlay == b->front[i].outlay);
}

/* Another type alone, or a line that is not the same. */
static void check_of_no_use(job j, bool type, const sp_proposal *known)
{
    j.options.mounts = j.mounts;
    j.options.types = &j.type_list[type];
    j.mounts[0].spacing = type ? 0.8 : 0.6;
    sp_proposal *knowing = place_knowing(&j, &known, NO_TIME);
    j.options.known_count = 0;
    sp_proposal *alone = job_place(&j);
    check_same(knowing, alone);
    sp_proposal_destroy(alone);
    sp_proposal_destroy(knowing);
}

static void what_is_not_allowed_is_left_out(void **state)
{
    (void)state;
    job j;
    open_leaning(&j);
    j.options.type_count = 1;
    const sp_proposal *known = job_place(&j);
    assert_int_equal(known->layout->count, 2);
    for (int which = 0; which < 3; which++)
        check_limited(j, which, known);
    check_of_no_use(j, true, known);
    check_of_no_use(j, false, known);
    sp_proposal_destroy((sp_proposal *)known);
    room_close(&j.room);
}

/* A cluster at a place that there was no time to look at. */
static void a_cluster_is_traced_where_it_is_known(void **state)
{
    (void)state;
    job j;
    open_leaning(&j);
    sp_member hole = {.type = room_cone("hole", 60 * DEGREE, 1), .axis = sp_v(0, 0, 1), .share = 1};
    sp_nozzle_type ball = room_cone("holes", 0, 16);
    const sp_nozzle_type *types[] = {&ball};
    ball.pattern = SP_PATTERN_CLUSTER;
    ball.members = &hole;
    ball.member_count = 1;
    j.options.types = types;
    j.options.type_count = 1;
    const sp_proposal *known = job_place(&j);
    sp_proposal *hasty = place_knowing(&j, &known, NO_TIME);
    check_no_worse(hasty, known, 0);
    j.options.known_count = 0;
    sp_proposal *alone = job_place(&j);
    assert_true(alone->coverage->covered_area < 0.9 * known->coverage->covered_area);
    sp_proposal_destroy(alone);
    sp_proposal_destroy(hasty);
    sp_proposal_destroy((sp_proposal *)known);
    room_close(&j.room);
}

static bool count_greedy(void *user, const char *stage, double done)
{
    (void)done;
    *(size_t *)user += !strcmp(stage, "greedy");
    return true;
}

/* Out of time nothing is put together for the first time where something is known: it was asked once whether to. */
static void what_is_known_takes_no_time(void **state)
{
    (void)state;
    size_t calls = 0;
    job j;
    open_leaning(&j);
    const sp_proposal *known = job_place(&j);
    j.options.run.progress = count_greedy;
    j.options.run.user = &calls;
    sp_proposal *hasty = place_knowing(&j, &known, NO_TIME);
    check_no_worse(hasty, known, 0);
    assert_int_equal(calls, 1);
    sp_proposal_destroy(hasty);
    sp_proposal_destroy((sp_proposal *)known);
    room_close(&j.room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_allowed_is_no_worse),     cmocka_unit_test(what_is_proved_holds_for_it),
        cmocka_unit_test(what_is_not_allowed_is_left_out), cmocka_unit_test(a_cluster_is_traced_where_it_is_known),
        cmocka_unit_test(what_is_known_takes_no_time),
    };
    return cmocka_run_group_tests_name("known layouts", tests, NULL, NULL);
}
