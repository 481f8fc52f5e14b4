/* What is proposed can be set, and what is said of it is of just that. */
#include "prepared.h"

#include "refine/settable.h"
#include "scoring/field.h"

#define MILLIMETRE 1e-3
#define BAR 1e5

typedef struct {
    room room;
    sp_nozzle_type cone, fan;
    const sp_nozzle_type *types[2];
    sp_mount mounts[3];
    double pressure;
    sp_place_options options;
} job;

/* A room of 2 m with three lances in its lid, one of which leans, and a cone and a fan to be set. */
static void job_open(job *j)
{
    room_builder b = {0};
    room_box(&b, sp_v(-1, -1, 0), sp_v(1, 1, 2), "walls", "lid");
    *j = (job){.pressure = 2.1 * BAR, .room = {.setup = sp_setup_default()}, .options = room_options()};
    j->room.setup.fidelity.accuracy = ROOM_ACCURACY;
    j->room.setup.cavity = SP_CAVITY_POINT;
    j->room.setup.cavity_point = sp_v(0, 0, 1);
    j->room.setup.criterion.flux = LITRES_PER_MINUTE;
    room_open(&j->room, &b, 0.2);
    j->cone = room_cone("cone", 92 * DEGREE, 20.3);
    j->cone.angle_min = 60 * DEGREE;
    j->cone.angle_max = 130 * DEGREE;
    j->cone.flow_min = 10 * LITRES_PER_MINUTE;
    j->cone.flow_max = 30 * LITRES_PER_MINUTE;
    j->fan = j->cone;
    strcpy(j->fan.name, "fan");
    j->fan.pattern = SP_PATTERN_FLAT_FAN;
    j->fan.thickness = 20 * DEGREE;
    j->types[0] = &j->cone;
    j->types[1] = &j->fan;
    for (int i = 0; i < 3; i++)
        j->mounts[i] = (sp_mount){.kind = SP_MOUNT_PORT,
                                  .name = {'P', (char)('1' + i)},
                                  .position = sp_v(0.6 * (i - 1), 0.2, 2),
                                  .axis = sp_unit(sp_v(0, i == 1 ? 0.3 : 0, -1)),
                                  .tilt = 24 * DEGREE,
                                  .depth_from = 0.1,
                                  .depth_to = 0.7,
                                  .depth_spacing = 0.3};
    j->options.types = j->types;
    j->options.type_count = 2;
    j->options.pressures = &j->pressure;
    j->options.pressure_count = 1;
    j->options.mounts = j->mounts;
    j->options.mount_count = 3;
    j->options.coverage = 0.9;
    j->options.refine =
        (sp_refine){.position = 0.15, .axis = 15 * DEGREE, .roll = true, .angle = INFINITY, .flow = INFINITY};
}

static void give_steps(job *j)
{
    for (int i = 0; i < 3; i++) {
        j->mounts[i].depth_step = (sp_step){20, MILLIMETRE};
        j->mounts[i].tilt_step = (sp_step){7.5, DEGREE};
    }
    for (int i = 0; i < 2; i++) {
        sp_nozzle_type *type = i ? &j->fan : &j->cone;
        type->angle_step = (sp_step){5, DEGREE};
        type->flow_step = (sp_step){0.7, LITRES_PER_MINUTE};
        type->pressure_step = (sp_step){0.25, BAR};
    }
}

static sp_proposal *placed(job *j)
{
    sp_error error = {0};
    sp_proposal *proposal = sp_place(j->room.evaluator, &j->options, &error);
    assert_string_equal(error.message, "");
    room_check(proposal, &j->options);
    return proposal;
}

static void check_whole(double number, const char *what)
{
    if (fabs(number - nearbyint(number)) > 1e-7)
        fail_msg("%s: %.12g steps", what, number);
}

static void check_set(const job *j, const sp_nozzle *nozzle)
{
    size_t at = sp_mount_at(&j->room.setup, j->mounts, 3, nozzle->position);
    assert_true(at < 3);
    const sp_mount *mount = &j->mounts[at];
    const sp_nozzle_type *type = nozzle->type;
    sp_vec3 reach = sp_sub(nozzle->position, mount->position);
    double depth = sp_dot(reach, mount->axis);
    assert_true(sp_distance(reach, sp_scale(mount->axis, depth)) < 1e-8);
    assert_true(depth > 0.1 - 1e-8 && depth < 0.7 + 1e-8);
    check_whole((depth - 0.1) / 0.02, "depth");
    double tilt = acos(fmin(1, sp_dot(nozzle->axis, mount->axis)));
    assert_true(tilt < 24 * DEGREE);
    check_whole(tilt < 1e-7 ? 0 : tilt / (7.5 * DEGREE), "tilt");
    double angle = sp_nozzle_angle(nozzle) / DEGREE, flow = sp_nozzle_flow(nozzle, &j->room.setup.liquid);
    assert_true(angle > 60 - 1e-9 && angle < 130 + 1e-9);
    check_whole((angle - 92) / 5, "angle");
    double rated = flow / sqrt(nozzle->pressure / type->at) / LITRES_PER_MINUTE;
    assert_true(rated > 10 - 1e-9 && rated < 30 + 1e-9);
    check_whole((rated - 20.3) / 0.7, "flow");
    assert_true(nozzle->pressure == 2 * BAR);
}

/* Both layouts; and the figures, the front's and the certificate's are the settings' own. */
static void what_is_proposed_can_be_set(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    give_steps(&j);
    sp_proposal *proposal = placed(&j);
    const sp_layout *layout = proposal->layout;
    assert_true(layout->count > 0);
    for (size_t i = 0; i < layout->count; i++)
        check_set(&j, &layout->nozzles[i]);
    for (size_t i = 0; i < proposal->greedy->count; i++)
        check_set(&j, &proposal->greedy->nozzles[i]);
    sp_error error = {0};
    sp_coverage *again = sp_evaluate(j.room.evaluator, layout, &error);
    assert_true(again->fraction == proposal->coverage->fraction && again->flow == proposal->coverage->flow);
    assert_true(proposal->coverage->covered_area >= proposal->greedy_coverage->covered_area ||
                proposal->coverage->flow < proposal->greedy_coverage->flow);
    double most = 0;
    for (size_t i = 0; i < proposal->front_count; i++)
        if (proposal->front[i].flow <= again->flow * (1 + 1e-9))
            most = proposal->front[i].area;
    assert_true(fabs(most - again->covered_area) < 1e-9);
    assert_true(proposal->certificate.computed);
    assert_true(fabs(proposal->certificate.counted - again->covered_area) < 0.02 * again->covered_area);
    sp_coverage_destroy(again);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

static bool stop_refining(void *user, const char *stage, double done)
{
    (void)done;
    size_t *calls = user;
    return strcmp(stage, "refine") != 0 || ++*calls < 40;
}

/* The most that the points cover with no more nozzles, or no more water; m². */
static double most_with(const sp_front_point *points, size_t count, size_t nozzles, double flow)
{
    double most = 0;
    for (size_t i = 0; i < count; i++)
        if (points[i].nozzles <= nozzles && points[i].flow <= flow)
            most = fmax(most, points[i].area);
    return most;
}

/* Candidates stand at settings: what they cover stays known where no time is left to set anything. */
static void what_stands_at_settings_is_kept_when_cut_short(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    give_steps(&j);
    size_t calls = 0;
    j.options.run.progress = stop_refining;
    j.options.run.user = &calls;
    sp_proposal *proposal = placed(&j);
    const sp_coverage *greedy = proposal->greedy_coverage;
    double area = greedy->covered_area * (1 - 1e-6), flow = greedy->flow * (1 + 1e-9);
    assert_true(proposal->interrupted && proposal->greedy->count > 1);
    assert_true(most_with(proposal->front, proposal->front_count, SIZE_MAX, flow) >= area);
    assert_true(most_with(proposal->by_number, proposal->by_number_count, proposal->greedy->count, INFINITY) >= area);
    assert_int_equal(proposal->by_number[0].nozzles, 1);
    for (size_t i = 0; i < proposal->layout->count; i++)
        check_set(&j, &proposal->layout->nozzles[i]);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

static bool stop_after_one(void *user, const char *stage, double done)
{
    (void)stage, (void)done;
    size_t *calls = user;
    return ++*calls < 2;
}

/* A nozzle of one place with each of these flows, into the front; the first just reaches the target. */
static void note_flows(const prepared *ready, const double *flows, size_t count, sp_front *front)
{
    sp_error error = {0};
    for (size_t i = 0; i < count; i++) {
        sp_partial partial;
        sp_front_point point;
        assert_true(sp_partial_create(&ready->search, &partial, &error));
        assert_true(sp_partial_add_pose(&ready->search, &partial, (sp_pose){0}, &error));
        sp_placed *placed = &partial.items[0];
        placed->nozzle.flow = placed->flow = flows[i] * LITRES_PER_MINUTE;
        assert_true(sp_field_nozzle(&ready->search, &placed->nozzle, NULL, placed->field, &error));
        sp_partial_refresh(&ready->search, &partial);
        assert_true(sp_front_measure(front, &ready->search, &partial, &point, &error));
        if (i == 0)
            assert_true(sp_front_aim(front, &ready->search, point.area, &error));
        sp_partial_free(&partial);
    }
}

/* There is time to set one layout besides the best: of those that reach the target the one that has little to spare,
 * where as much as possible is to be covered that of most besides. */
static void what_may_be_proposed_is_set_first(void **state)
{
    (void)state;
    const double flows[] = {15.5, 18, 22, 28.3};
    for (int most = 0; most < 2; most++) {
        job j;
        prepared ready;
        sp_error error = {0};
        size_t calls = 0;
        bool found = false;
        job_open(&j);
        give_steps(&j);
        j.options.objective = most ? SP_OBJECTIVE_MAX_COVERAGE : SP_OBJECTIVE_MIN_WATER;
        prepare(&ready, j.room.evaluator, &j.options);
        sp_deadline deadline = sp_deadline_start(&(sp_run){.progress = stop_after_one, .user = &calls});
        sp_front front = {
            .fine = j.room.evaluator, .deadline = &deadline, .objective = j.options.objective, .target = 1e3};
        note_flows(&ready, flows, 4, &front);
        assert_int_equal(front.by_water.count, 4);
        assert_true(sp_set_front(&ready.search, &deadline, &front, &error));
        /* the best and one more, each with flows to either side */
        const double best = flows[most ? 3 : 0], next = flows[most ? 2 : 1];
        for (size_t i = 0; i < front.by_water.count; i++) {
            double flow = front.by_water.entries[i].point.flow / LITRES_PER_MINUTE;
            assert_true(fabs(flow - best) < 0.7 || fabs(flow - next) < 0.7);
            found |= fabs(flow - next) < 0.7;
        }
        assert_true(found);
        sp_front_free(&front);
        free(deadline.stages);
        prepared_free(&ready);
        room_close(&j.room);
    }
}

/* Flows are not turned up beyond the water that may be taken. */
static void settings_keep_to_the_water(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    give_steps(&j);
    j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j.options.max_water = 33 * LITRES_PER_MINUTE;
    sp_proposal *proposal = placed(&j);
    assert_true(proposal->layout->count > 0);
    for (size_t i = 0; i < proposal->layout->count; i++)
        check_set(&j, &proposal->layout->nozzles[i]);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* A setting is the value of the number that a person would write for it. */
static void settings_are_short_numbers(void **state)
{
    (void)state;
    const sp_step fifth = {0.2, LITRES_PER_MINUTE}, five = {5, DEGREE}, none = {0, 1};
    const double unit = LITRES_PER_MINUTE;
    for (int k = 1; k < 500; k++) {
        double tenths = 2 * k;
        double expected = (double)((long double)tenths / 10 * unit);
        assert_true(sp_step_nearest(fifth, 0, (0.2 * k + 0.07) * unit, 0, 1) == expected);
        assert_true(sp_step_nearest(fifth, 0, (0.2 * k - 0.07) * unit, 0, 1) == expected);
    }
    assert_true(sp_step_nearest(five, 92 * DEGREE, 1, 60 * DEGREE, 130 * DEGREE) == (double)(62.L * DEGREE));
    assert_true(sp_step_nearest(five, 92 * DEGREE, 0, 60 * DEGREE, 130 * DEGREE) == (double)(62.L * DEGREE));
    assert_true(sp_step_nearest(five, 92 * DEGREE, 9, 60 * DEGREE, 130 * DEGREE) == (double)(127.L * DEGREE));
    assert_true(sp_step_nearest(five, 0.3, 0.31, 0, 1) == 0.3);
    assert_true(sp_step_nearest(none, 0, 0.31, 0, 1) == 0.31 && sp_step_nearest(none, 0, 3, 0, 1) == 1);
    assert_true(sp_step_nearest((sp_step){1, 1e-310}, 0.5, 1, 0, INFINITY) == 0.5);
    assert_true(sp_step_nearest(fifth, 0.5 * unit, 0, 0.45 * unit, 0.55 * unit) == 0.5 * unit);
}

/* A body that does not pass a port's bore is not offered there, and one that sits there is refused. */
static void bodies_pass_the_bore(void **state)
{
    (void)state;
    job j;
    sp_error error = {0};
    job_open(&j);
    j.options.refine = (sp_refine){0};
    j.cone.body = 0.06;
    j.fan.body = 0.05;
    for (int i = 0; i < 3; i++) {
        j.mounts[i].bore = i < 2 ? 0.05 : 0;
        j.mounts[i].tilt = 0;
    }
    sp_proposal *proposal = placed(&j);
    bool cone = false;
    for (size_t i = 0; i < proposal->layout->count; i++) {
        const sp_nozzle *nozzle = &proposal->layout->nozzles[i];
        cone |= nozzle->type == &j.cone;
        assert_true(nozzle->type == &j.fan || sp_mount_at(&j.room.setup, j.mounts, 3, nozzle->position) == 2);
        assert_true(sp_mounts_admit(&j.room.setup, j.mounts, 3, nozzle, &error));
    }
    assert_true(cone);
    sp_proposal_destroy(proposal);
    sp_nozzle wide = {.name = "N1",
                      .type = &j.cone,
                      .position = sp_v(-0.6, 0.2, 1.7),
                      .axis = sp_v(0, 0, -1),
                      .pressure = BAR,
                      .keep = true};
    assert_false(sp_mounts_admit(&j.room.setup, j.mounts, 3, &wide, &error));
    assert_string_equal(error.message, "nozzles: N1, of type 'cone', is 60 mm wide, expected no more than the bore of "
                                       "port P1, 50 mm");
    sp_layout own = {1, &wide};
    error = (sp_error){0};
    j.options.kept = &own;
    assert_null(sp_place(j.room.evaluator, &j.options, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    wide.position.y = 0.5;
    assert_true(sp_mounts_admit(&j.room.setup, j.mounts, 3, &wide, &error));
    room_close(&j.room);
}

static void mounts_are_recognised(void **state)
{
    (void)state;
    job j;
    job_open(&j);
    const sp_mount mounts[] = {
        {.kind = SP_MOUNT_BOX, .from = sp_v(-0.5, -0.5, 0.5), .to = sp_v(0.5, 0.5, 1.5)},
        {.kind = SP_MOUNT_LINE, .from = sp_v(-0.5, 0, 1), .to = sp_v(0.8, 0, 1)},
        {.kind = SP_MOUNT_SURFACE, .part = 0, .standoff = 0.05},
        {.kind = SP_MOUNT_SURFACE, .part = SP_NONE, .standoff = 0.04},
        j.mounts[0],
    };
    const struct {
        sp_vec3 place;
        size_t mount;
    } places[] = {{{0.2, 0.1, 1}, 0},
                  {{0.2, 0, 1}, 1},
                  {{0.7, 0, 1}, 1},
                  {{0.96, 0, 1}, 2},
                  {{0, 0, 1.97}, 3},
                  {{-0.6, 0.2, 1.5}, 4},
                  {{-0.6, 0.2, 1.2}, SIZE_MAX},
                  {{0.7, 0.1, 1}, SIZE_MAX}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        assert_int_equal(sp_mount_at(&j.room.setup, mounts, 5, places[i].place), places[i].mount);
    room_close(&j.room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settings_are_short_numbers),
        cmocka_unit_test(what_is_proposed_can_be_set),
        cmocka_unit_test(what_stands_at_settings_is_kept_when_cut_short),
        cmocka_unit_test(what_may_be_proposed_is_set_first),
        cmocka_unit_test(settings_keep_to_the_water),
        cmocka_unit_test(bodies_pass_the_bore),
        cmocka_unit_test(mounts_are_recognised),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
