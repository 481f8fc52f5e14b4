/* Placement on rooms small enough to try every layout, and what its limits ask. */
#include "small_room.h"

static void two_nozzles_are_the_best_two(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    j.options.max_nozzles = 2;
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    sp_proposal *proposal = job_place(&j);
    assert_int_equal(proposal->positions, 5);
    assert_int_equal(proposal->candidates, 10);
    assert_true(proposal->coverage->covered_area >= best_of_two(&j) * (1 - 1e-9));
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

#ifndef SPRAYPLAN_SANITIZE
/* As much as where no more may be placed: also where less water in more nozzles covers more. */
static void few_nozzles_cover_most_whatever_their_water(void **state)
{
    (void)state;
    job j;
    job_open_coarse(&j, 0.1);
    j.options.type_count = 3;
    j.mounts[0].tilt = 120 * DEGREE;
    j.mounts[0].spacing = 0.8;
    j.options.coverage = 0.9;
    sp_proposal *many = job_place(&j);
    assert_true(many->layout->count > 2);
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    for (size_t n = 1; n <= 2; n++) {
        j.options.max_nozzles = n;
        sp_proposal *few = job_place(&j);
        assert_int_equal(many->by_number[n - 1].nozzles, n);
        assert_true(many->by_number[n - 1].area >= few->coverage->covered_area * (1 - 1e-9));
        sp_proposal_destroy(few);
    }
    sp_proposal_destroy(many);
    room_close(&j.room);
}
#endif

static void least_water_for_a_target(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    j.options.max_nozzles = 2;
    j.options.coverage = 0.3;
    j.options.objective = SP_OBJECTIVE_MIN_WATER;
    sp_proposal *proposal = job_place(&j);
    double best = INFINITY;
    for (int a = 0; a < 10; a++)
        for (int b = -1; b < a; b++) {
            sp_nozzle pair[2];
            size_t count = 0;
            double flow = 0;
            for (int i = 0; i < 2; i++) {
                int pose = i ? b : a;
                if (pose < 0)
                    continue;
                pair[count++] = nozzle_of(&j, pose);
                flow += j.type_list[pose % 2]->flow;
            }
            if (flow < best && area_of(&j, pair, count) >= proposal->target_area)
                best = flow;
        }
    assert_true(isfinite(best));
    assert_true(proposal->reached);
    assert_true(proposal->coverage->covered_area >= proposal->target_area);
    assert_true(proposal->coverage->flow <= best * (1 + 1e-9));
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* Far from all that could be reached, a jet beside the ball adds less than is told apart: it is not proposed but where
 * the most is asked for, and stays on the front. */
static void out_of_reach_hardly_more_is_not_worth_its_water(void **state)
{
    (void)state;
    for (int most = 0; most < 2; most++) {
        job j;
        job_open(&j);
        j.types[1] = room_cone("needle", 4 * DEGREE, 1);
        j.mounts[0] = (sp_mount){.kind = SP_MOUNT_PORT,
                                 .name = "P1",
                                 .position = sp_v(0, 0, 0.6),
                                 .axis = sp_v(0, 0, -1),
                                 .type_count = 1,
                                 .types = &j.type_list[2]};
        j.mounts[1] = (sp_mount){.kind = SP_MOUNT_PORT,
                                 .name = "P2",
                                 .position = sp_v(0.5, 0.2, 0.6),
                                 .axis = sp_unit(sp_v(0.5, 0.42, -0.4)),
                                 .tilt = 20 * DEGREE,
                                 .type_count = 1,
                                 .types = &j.type_list[1]};
        j.options.type_count = 3;
        j.options.mount_count = 2;
        j.options.max_nozzles = 2;
        j.options.coverage = 1;
        j.options.objective = most ? SP_OBJECTIVE_MAX_COVERAGE : SP_OBJECTIVE_MIN_WATER;
        sp_proposal *proposal = job_place(&j);
        const sp_front_point *dearest = &proposal->front[proposal->front_count - 1];
        double whole = proposal->coverage->area;
        assert_true(dearest->area < proposal->target_area);
        assert_int_equal(dearest->nozzles, 2);
        assert_int_equal(proposal->layout->count, most ? 2 : 1);
        if (!most) {
            assert_true(dearest->area > proposal->coverage->covered_area * (1 + 1e-6));
            assert_true(dearest->area <= proposal->coverage->covered_area + SP_COVERAGE_TOLD * whole);
        }
        sp_proposal_destroy(proposal);
        room_close(&j.room);
    }
}

/* The least water with which one or two of them cover so much; infinite where none do. */
static double least_for(const job *j, double area)
{
    double least = INFINITY;
    for (int a = 0; a < 10; a++)
        for (int b = a; b < 11; b++) {
            sp_nozzle pair[2] = {nozzle_of(j, a), nozzle_of(j, b % 10)};
            size_t count = b < 10 ? 2 : 1;
            double flow = pair[0].type->flow + (count > 1 ? pair[1].type->flow : 0);
            if (flow < least && area_of(j, pair, count) >= area)
                least = flow;
        }
    return least;
}

/* Against every layout of one or two, counted on the same patches. */
static void nothing_exceeds_the_certificate(void **state)
{
    (void)state;
    for (int single = 0; single < 2; single++) {
        job j;
        job_open(&j);
        j.room.setup.criterion.combine = single ? SP_COMBINE_SINGLE : SP_COMBINE_SUM;
        sp_evaluator_destroy(j.room.evaluator);
        sp_error error = {0};
        j.room.evaluator = sp_evaluator_create(&j.room.setup, &error);
        j.options.max_nozzles = 2;
        j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
        sp_proposal *proposal = job_place(&j);
        const sp_certificate *certificate = &proposal->certificate;
        double best = best_of_two(&j);
        assert_true(certificate->computed);
        assert_int_equal(certificate->candidates, 10);
        assert_int_equal(certificate->texels, sp_evaluator_patches(j.room.evaluator)->count);
        assert_true(fabs(certificate->counted - proposal->coverage->covered_area) < 1e-5);
        assert_true(certificate->area_bound + 1e-5 >= best);
        assert_true(certificate->area_bound < 1.25 * best);
        assert_true(certificate->area_bound / certificate->whole >= proposal->coverage->fraction);
        for (size_t i = 0; i < proposal->front_count; i++)
            assert_true(proposal->front[i].bound >= proposal->front[i].counted);
        /* with all layouts looked at it still holds, and is no longer above the best there is */
        j.options.prove = true;
        sp_proposal *proved = job_place(&j);
        assert_true(proved->certificate.area_bound <= certificate->area_bound);
        assert_true(proved->certificate.water_bound >= certificate->water_bound);
        assert_true(proved->certificate.area_bound + 1e-5 >= best);
        assert_true(proved->certificate.area_bound <= best * 1.01);
        double least = least_for(&j, proved->certificate.counted - 1e-5);
        assert_true(proved->certificate.water_bound <= least * (1 + 1e-9));
        assert_true(proved->certificate.water_bound >= 0.5 * least);
        for (size_t i = 0; i < proved->front_count; i++)
            assert_true(proved->front[i].bound >= proved->front[i].counted &&
                        proved->front[i].bound <= proposal->front[i].bound);
        sp_proposal_destroy(proved);
        sp_proposal_destroy(proposal);
        room_close(&j.room);
    }
}

/* Two nozzles of 6 L/min in 12 L/min: their flows' sum may come out a little above. */
static void water_allowed_may_be_used_up(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    j.options.types = &j.type_list[1];
    j.options.type_count = 1;
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    double each = sp_type_flow(&j.types[1], j.types[1].flow, PRESSURE, &j.room.setup.liquid);
    for (size_t count = 1; count < 4; count++) {
        j.options.max_water = nextafter(each * (double)count, 0);
        sp_proposal *proposal = job_place(&j);
        assert_int_equal(proposal->layout->count, count);
        sp_proposal_destroy(proposal);
    }
    room_close(&j.room);
}

/* And no more: a little less than two take is enough for one, of all the front. */
static void water_beyond_what_is_allowed_is_not_taken(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    j.options.types = &j.type_list[1];
    j.options.type_count = 1;
    double each = sp_type_flow(&j.types[1], j.types[1].flow, PRESSURE, &j.room.setup.liquid);
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    for (size_t count = 2; count < 4; count++) {
        j.options.max_water = each * (double)count * (1 - (count == 2 ? 1e-7 : 5e-4));
        sp_proposal *proposal = job_place(&j);
        assert_int_equal(proposal->layout->count, count - 1);
        const double most = j.options.max_water * (1 + 1e-9);
        for (size_t i = 0; i < proposal->front_count; i++)
            assert_true(proposal->front[i].flow <= most);
        for (size_t i = 0; i < proposal->by_number_count; i++)
            assert_true(proposal->by_number[i].flow <= most);
        sp_proposal_destroy(proposal);
    }
    room_close(&j.room);
}

static void limits_hold(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    j.options.max_water = 23 * LITRES_PER_MINUTE;
    sp_proposal *proposal = job_place(&j);
    assert_false(proposal->reached);
    assert_true(proposal->water_lacking == 0);
    assert_in_range(proposal->layout->count, 1, 3);
    sp_proposal_destroy(proposal);

    /* nothing fits: no nozzle, no error */
    j.options.max_water = 5 * LITRES_PER_MINUTE;
    proposal = job_place(&j);
    assert_int_equal(proposal->layout->count, 0);
    assert_false(proposal->reached);
    assert_true(proposal->attainable_area == 0);
    double least = INFINITY;
    for (size_t i = 0; i < j.options.type_count; i++)
        least = fmin(least, sp_type_flow(j.options.types[i], j.options.types[i]->flow, PRESSURE, &j.room.setup.liquid));
    assert_true(fabs(proposal->water_lacking - (least - j.options.max_water)) < 1e-9 * least);
    sp_proposal_destroy(proposal);

    /* nor does a further one beside one that is kept, whose water counts */
    sp_nozzle kept = nozzle_of(&j, 1);
    kept.keep = true;
    const sp_layout own = {.count = 1, .nozzles = &kept};
    double taken = sp_nozzle_flow(&kept, &j.room.setup.liquid);
    j.options.kept = &own;
    j.options.max_water = taken + 0.75 * least;
    proposal = job_place(&j);
    assert_int_equal(proposal->layout->count, 1);
    assert_true(fabs(proposal->water_lacking - 0.25 * least) < 1e-9 * least);
    sp_proposal_destroy(proposal);
    j.options.max_water = taken + least;
    proposal = job_place(&j);
    assert_true(proposal->layout->count > 1 && proposal->water_lacking == 0);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* Two ports of equal name, the second only for narrow cones. */
static void open_ports(job *j)
{
    job_open(j);
    j->mounts[0] = (sp_mount){.kind = SP_MOUNT_PORT,
                              .name = "P1",
                              .position = sp_v(-0.5, 0, 1.1),
                              .axis = sp_v(0, 0, -1),
                              .tilt = 30 * DEGREE,
                              .depth_to = 0.4,
                              .depth_spacing = 0.2};
    j->mounts[1] = j->mounts[0];
    j->mounts[1].position.x = 0.5;
    j->mounts[1].types = &j->type_list[1];
    j->mounts[1].type_count = 1;
    j->options.mount_count = 2;
}

static void a_port_holds_one(void **state)
{
    (void)state;
    job j;
    open_ports(&j);
    sp_proposal *proposal = job_place(&j);
    assert_int_equal(proposal->layout->count, 2);
    size_t wide = 0;
    for (size_t i = 0; i < 2; i++) {
        const sp_nozzle *nozzle = &proposal->layout->nozzles[i];
        assert_true(!strcmp(nozzle->name, "P1") || !strcmp(nozzle->name, "P1-2"));
        assert_true(nozzle->axis.z <= -cos(30 * DEGREE) + 1e-9);
        if (nozzle->type == &j.types[0]) {
            wide++;
            assert_true(nozzle->position.x < 0);
        }
    }
    assert_in_range(wide, 0, 1);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* A nozzle that is not in the port P1 is not called P1, though the port stays empty. */
static void no_other_nozzle_is_called_like_a_port(void **state)
{
    (void)state;
    job j;
    open_ports(&j);
    j.mounts[0] = j.mounts[1];
    j.mounts[1] = (sp_mount){
        .kind = SP_MOUNT_LINE, .axis = sp_v(0, 0, -1), .spacing = 1, .from = sp_v(0, 0, 1), .to = sp_v(0, 0, 1)};
    j.options.max_nozzles = 1;
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    sp_proposal *proposal = job_place(&j);
    assert_int_equal(proposal->layout->count, 1);
    const sp_nozzle *nozzle = &proposal->layout->nozzles[0];
    assert_true(nozzle->type == &j.types[0] && nozzle->position.x == 0);
    assert_string_equal(nozzle->name, "P2");
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

static void a_kept_nozzle_takes_its_port(void **state)
{
    (void)state;
    job j;
    open_ports(&j);
    sp_nozzle kept = {.name = "mine",
                      .type = &j.types[2],
                      .position = sp_v(-0.5, 0, 0.9),
                      .axis = sp_v(0, 0, -1),
                      .pressure = PRESSURE,
                      .keep = true};
    sp_nozzle lost = kept;
    lost.keep = false;
    strcpy(lost.name, "lost");
    const sp_nozzle own[2] = {lost, kept};
    sp_error error = {0};
    sp_layout *layout = sp_layout_create(own, 2, &error);
    j.options.kept = layout;
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    sp_proposal *proposal = job_place(&j);
    size_t named = 0;
    for (size_t i = 0; i < proposal->layout->count; i++) {
        const sp_nozzle *nozzle = &proposal->layout->nozzles[i];
        named += !strcmp(nozzle->name, "mine");
        assert_true(!strcmp(nozzle->name, "mine") || nozzle->position.x > 0);
        assert_string_not_equal(nozzle->name, "lost");
    }
    assert_int_equal(named, 1);
    sp_proposal_destroy(proposal);

    /* and counts */
    j.options.max_nozzles = 1;
    proposal = job_place(&j);
    assert_int_equal(proposal->layout->count, 1);
    sp_proposal_destroy(proposal);
    sp_layout_destroy(layout);
    room_close(&j.room);
}

static void attainable_is_what_one_could_cover(void **state)
{
    (void)state;
    job j;
    job_open_coarse(&j, 0.05);
    /* one narrow cone straight down from one point: just its own footprint */
    j.mounts[0].from = j.mounts[0].to = sp_v(0, 0, 1);
    j.options.types = &j.type_list[1];
    j.options.type_count = 1;
    j.options.max_nozzles = 1;
    sp_proposal *proposal = job_place(&j);
    sp_nozzle nozzle = {.type = &j.types[1], .position = sp_v(0, 0, 1), .axis = sp_v(0, 0, -1), .pressure = PRESSURE};
    double alone = area_of(&j, &nozzle, 1);
    assert_true(alone > 0.5);
    assert_true(fabs(proposal->attainable_area - alone) < 0.01 * alone);
    sp_proposal_destroy(proposal);

    /* the flux needed tenfold: ten nozzles at that point could, one could not */
    j.room.setup.criterion.flux *= 10;
    sp_evaluator_destroy(j.room.evaluator);
    sp_error error = {0};
    j.room.evaluator = sp_evaluator_create(&j.room.setup, &error);
    proposal = job_place(&j);
    double one = proposal->attainable_area;
    sp_proposal_destroy(proposal);
    j.options.max_nozzles = 10;
    proposal = job_place(&j);
    assert_true(one < 0.5 * alone);
    assert_true(fabs(proposal->attainable_area - alone) < 0.02 * alone);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* The share asked for is of the whole surface; where less is attainable, that share of it is aimed at, and what was
 * asked for is not reached. */
static void the_target_is_of_the_whole_surface(void **state)
{
    (void)state;
#ifdef SPRAYPLAN_SANITIZE
    static const sp_objective objectives[] = {SP_OBJECTIVE_MIN_WATER};
#else
    static const sp_objective objectives[] = {SP_OBJECTIVE_AREA_PER_WATER, SP_OBJECTIVE_MIN_WATER,
                                              SP_OBJECTIVE_MAX_COVERAGE};
#endif
    job j;
    job_open_coarse(&j, 0.05);
    j.mounts[0].from = j.mounts[0].to = sp_v(0, 0, 1);
    j.options.types = &j.type_list[1];
    j.options.type_count = 1;
    j.options.max_nozzles = 1;
    double whole = sp_evaluator_patches(j.room.evaluator)->total_area;
    for (size_t i = 0; i < sizeof objectives / sizeof *objectives; i++) {
        j.options.objective = objectives[i];
        j.options.coverage = 0.99;
        sp_proposal *proposal = job_place(&j);
        double attainable = proposal->attainable_area;
        assert_true(attainable < 0.2 * whole);
        assert_true(fabs(proposal->asked_area - 0.99 * whole) < 1e-9 * whole);
        /* what is attainable was told by points before anything was placed */
        assert_true(fabs(proposal->target_area - 0.99 * attainable) < 0.03 * attainable);
        assert_true(proposal->coverage->covered_area >= proposal->target_area);
        assert_false(proposal->reached);
        sp_proposal_destroy(proposal);

        j.options.coverage = 0.9 * attainable / whole;
        proposal = job_place(&j);
        assert_true(fabs(proposal->asked_area - 0.9 * attainable) < 1e-9 * whole);
        assert_true(proposal->target_area == proposal->asked_area);
        assert_true(proposal->reached);
        sp_proposal_destroy(proposal);
    }
    room_close(&j.room);
}

/* Inside the steel, on the wall, or somewhere else altogether. */
static void a_kept_nozzle_must_stand_in_the_liquid(void **state)
{
    (void)state;
    static const struct {
        sp_vec3 position;
        bool stands;
    } places[] = {{{0, 0, 1}, true}, {{1, 0, 0.5}, false}, {{3, 0, 0.5}, false}, {{0.999999, 0.7, 0.5}, false}};
    job j;
    job_open_coarse(&j, 0.1);
    j.options.max_nozzles = 2;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        for (int keep = 0; keep < 2; keep++) {
            sp_nozzle own = {.name = "mine",
                             .type = &j.types[1],
                             .position = places[i].position,
                             .axis = sp_v(0, 0, -1),
                             .pressure = PRESSURE,
                             .keep = keep};
            sp_error error = {0};
            sp_layout *layout = sp_layout_create(&own, 1, &error);
            j.options.kept = layout;
            sp_proposal *proposal = sp_place(j.room.evaluator, &j.options, &error);
            assert_int_equal(proposal != NULL, places[i].stands || !keep);
            assert_int_equal(error.kind, proposal ? SP_OK : SP_ERROR_INPUT);
            assert_true(proposal || strstr(error.message, "mine"));
            sp_proposal_destroy(proposal);
            sp_layout_destroy(layout);
        }
    room_close(&j.room);
}

static void bad_options_are_errors(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    for (int i = 0; i < 4; i++) {
        sp_place_options options = j.options;
        if (i == 0)
            options.mount_count = 0;
        if (i == 1)
            options.type_count = 0;
        if (i == 2)
            options.pressure_count = 0;
        if (i == 3)
            options.clearance = 5;
        sp_error error = {0};
        assert_null(sp_place(j.room.evaluator, &options, &error));
        assert_int_equal(error.kind, SP_ERROR_INPUT);
    }
    sp_error error = {.kind = SP_ERROR_FILE};
    assert_null(sp_place(NULL, &j.options, &error));
    assert_int_equal(error.kind, SP_ERROR_FILE);
    sp_proposal_destroy(NULL);
    room_close(&j.room);
}

static void same_layout(const sp_layout *a, const sp_layout *b)
{
    assert_int_equal(a->count, b->count);
    for (size_t i = 0; i < a->count; i++) {
        const sp_nozzle *p = &a->nozzles[i], *q = &b->nozzles[i];
        assert_string_equal(p->name, q->name);
        assert_ptr_equal(p->type, q->type);
        assert_memory_equal(&p->position, &q->position, sizeof p->position);
        assert_memory_equal(&p->axis, &q->axis, sizeof p->axis);
        assert_memory_equal(&p->roll, &q->roll, sizeof p->roll);
        assert_memory_equal(&p->angle, &q->angle, sizeof p->angle);
        assert_memory_equal(&p->flow, &q->flow, sizeof p->flow);
    }
}

/* Of search, refinement, certificate and its layouts one by one. */
#ifdef SPRAYPLAN_SANITIZE
#define THREADS_TEXEL 0.2
#define THREADS_TILT 20
#else
#define THREADS_TEXEL 0.1
#define THREADS_TILT 40
#endif

static void threads_do_not_matter(void **state)
{
    (void)state;
    job j;
    job_open_coarse(&j, THREADS_TEXEL);
    j.mounts[0].tilt = THREADS_TILT * DEGREE;
    j.mounts[0].spacing = 0.8;
    j.types[0].angle_min = 80 * DEGREE;
    j.types[0].flow_min *= 0.8;
    j.types[0].flow_max *= 1.2;
    j.options.refine = sp_place_options_default().refine;
    j.options.max_nozzles = 3;
    j.options.coverage = 0.7;
    sp_proposal *one = job_place(&j);
    j.options.run.threads = 3;
    sp_proposal *three = job_place(&j);
    same_layout(one->layout, three->layout);
    same_layout(one->greedy, three->greedy);
    assert_int_equal(one->front_count, three->front_count);
    assert_memory_equal(one->front, three->front, one->front_count * sizeof *one->front);
    assert_int_equal(one->by_number_count, three->by_number_count);
    assert_memory_equal(one->by_number, three->by_number, one->by_number_count * sizeof *one->by_number);
    const sp_certificate *a = &one->certificate, *b = &three->certificate;
    assert_true(a->computed && b->computed);
    assert_true(a->area_bound == b->area_bound && a->water_bound == b->water_bound && a->gap == b->gap);
    assert_true(a->every_aim.computed == b->every_aim.computed && a->every_aim.area_bound == b->every_aim.area_bound);
    assert_true(a->area_bound < a->whole);
    assert_int_equal(one->coverage->deposits.count, three->coverage->deposits.count);
    assert_memory_equal(one->coverage->deposits.counted, three->coverage->deposits.counted,
                        one->coverage->deposits.count * sizeof(double));
    assert_memory_equal(one->attainable, three->attainable, one->coverage->deposits.count * sizeof(bool));
    sp_proposal_destroy(one);
    sp_proposal_destroy(three);
    room_close(&j.room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_nozzles_are_the_best_two),
#ifndef SPRAYPLAN_SANITIZE /* the search again, and a minute */
        cmocka_unit_test(few_nozzles_cover_most_whatever_their_water),
#endif
        cmocka_unit_test(least_water_for_a_target),
        cmocka_unit_test(out_of_reach_hardly_more_is_not_worth_its_water),
        cmocka_unit_test(nothing_exceeds_the_certificate),
        cmocka_unit_test(water_allowed_may_be_used_up),
        cmocka_unit_test(water_beyond_what_is_allowed_is_not_taken),
        cmocka_unit_test(limits_hold),
        cmocka_unit_test(a_port_holds_one),
        cmocka_unit_test(no_other_nozzle_is_called_like_a_port),
        cmocka_unit_test(a_kept_nozzle_takes_its_port),
        cmocka_unit_test(attainable_is_what_one_could_cover),
        cmocka_unit_test(the_target_is_of_the_whole_surface),
        cmocka_unit_test(a_kept_nozzle_must_stand_in_the_liquid),
        cmocka_unit_test(bad_options_are_errors),
        cmocka_unit_test(threads_do_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
