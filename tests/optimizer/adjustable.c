/* Nozzles whose angle and flow can be set: no worse than what is easily set by hand. */
#include "quest.h"

#include "refine/more_water.h"

#define MOUNTS 4

typedef struct {
    room room;
    sp_nozzle_type types[2];
    const sp_nozzle_type *listed[2];
    double pressure;
    sp_mount mounts[MOUNTS];
    sp_place_options options;
} job;

/* A room of 1 m, to be covered with so much flux (L/min per m²), a cone of 10 L/min, and what else the test adds. */
static void job_open(job *j, double flux, double texel)
{
    room_builder b = {0};
    room_box(&b, sp_v(0, 0, 0), sp_v(1, 1, 1), "walls", "lid");
    *j = (job){.pressure = 2e5, .room = {.setup = sp_setup_default()}, .options = sp_place_options_default()};
    j->room.setup.criterion.flux = flux * LITRES_PER_MINUTE;
    j->room.setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    j->room.setup.fidelity.accuracy = ROOM_ACCURACY;
    room_open(&j->room, &b, texel);
    j->types[0] = room_cone("set", 90 * DEGREE, 10);
    j->types[1] = room_cone("fixed", 90 * DEGREE, 12);
    for (size_t i = 0; i < 2; i++)
        j->listed[i] = &j->types[i];
    j->options.types = j->listed;
    j->options.type_count = 1;
    j->options.pressures = &j->pressure;
    j->options.pressure_count = 1;
    j->options.mounts = j->mounts;
    j->options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j->options.coverage = 1;
}

static void job_set(job *j, double angle_low, double angle_high, double flow_low, double flow_high)
{
    sp_nozzle_type *type = &j->types[0];
    type->angle_min = angle_low * DEGREE;
    type->angle_max = angle_high * DEGREE;
    type->flow_min = flow_low * LITRES_PER_MINUTE;
    type->flow_max = flow_high * LITRES_PER_MINUTE;
}

static void job_port(job *j, double x, double y, double from, double to, double tilt)
{
    sp_mount *mount = &j->mounts[j->options.mount_count];
    *mount = (sp_mount){.kind = SP_MOUNT_PORT,
                        .position = sp_v(x, y, 1),
                        .axis = sp_v(0, 0, -1),
                        .depth_from = from,
                        .depth_to = to,
                        .depth_spacing = 0.1,
                        .tilt = tilt * DEGREE};
    snprintf(mount->name, sizeof mount->name, "P%zu", j->options.mount_count++);
}

static sp_nozzle by_hand(const job *j, sp_vec3 position, sp_vec3 axis, double angle, double litres)
{
    return (sp_nozzle){.type = &j->types[0],
                       .position = position,
                       .axis = sp_unit(axis),
                       .pressure = j->pressure,
                       .angle = angle * DEGREE,
                       .flow = litres * LITRES_PER_MINUTE};
}

/* m² that is found to be covered, and in *simple what these nozzles do. */
static double job_search(job *j, const sp_nozzle *nozzles, size_t count, bool hurried, double *simple)
{
    quest q;
    sp_error error = {0};
    sp_layout *layout = sp_layout_create(nozzles, count, &error);
    assert_non_null(layout);
    *simple = room_area_of(&j->room, layout);
    quest_begin(&q, j->room.evaluator, &j->options);
    double area = hurried ? quest_hurry(&q) : quest_finish(&q);
    quest_end(&q);
    room_close(&j->room);
    return area;
}

/* Wide cones that overlap cover more than the candidates' 90 degrees do, and the way there leads over less. */
static void two_wide_cones_facing_each_other(void **state)
{
    (void)state;
    job j;
    double simple;
    job_open(&j, 4, 0.1);
    job_set(&j, 40, 150, 2, 14);
    job_port(&j, 0.3, 0.5, 0.1, 0.1, 60);
    job_port(&j, 0.7, 0.5, 0.1, 0.1, 60);
    j.options.max_nozzles = 2;
    j.options.max_water = 28 * LITRES_PER_MINUTE;
    const sp_nozzle nozzles[] = {by_hand(&j, sp_v(0.3, 0.5, 0.9), sp_v(0.528, 0, -0.849), 135, 14),
                                 by_hand(&j, sp_v(0.7, 0.5, 0.9), sp_v(-0.528, 0, -0.849), 135, 14)};
    assert_true(job_search(&j, nozzles, 2, false, &simple) >= 0.98 * simple);
}

/* As the candidates have them a cone of 12 L/min covers more than one that can be turned up to all that is allowed. */
static void one_cone_turned_up(void **state)
{
    (void)state;
    job j;
    double simple;
    job_open(&j, 5, 0.1);
    j.types[0].angle = 100 * DEGREE;
    job_set(&j, 70, 130, 6, 20);
    j.options.type_count = 2;
    job_port(&j, 0.21, 0.47, 0.1, 0.1, 180);
    job_port(&j, 0.8, 0.81, 0.1, 0.3, 60);
    j.options.max_nozzles = 2;
    j.options.max_water = 18 * LITRES_PER_MINUTE;
    const sp_nozzle nozzle = by_hand(&j, sp_v(0.8, 0.81, 0.8), sp_v(-0.578, -0.586, -0.568), 92, 18);
    assert_true(job_search(&j, &nozzle, 1, false, &simple) >= 0.99 * simple);
}

/* Whether others are looked for, and how many times that has begun. */
typedef struct {
    bool looking;
    int rounds;
} looks;

static bool stop_at_second_round(void *user, const char *stage, double done)
{
    (void)done;
    looks *l = user;
    bool looking = !strcmp(stage, "front");
    l->rounds += looking && !l->looking;
    l->looking = looking;
    return l->rounds < 2;
}

/* Three take more water than the two that the candidates have the room for. */
static void find_as_many_as_are_allowed(looks *hurried)
{
    job j;
    double simple;
    job_open(&j, 6, 0.1);
    job_set(&j, 60, 120, 3, 20);
    j.options.type_count = 2;
    job_port(&j, 0.63, 0.3, 0.1, 0.3, 60);
    job_port(&j, 0.33, 0.26, 0.1, 0.3, 180);
    job_port(&j, 0.41, 0.48, 0.1, 0.3, 60);
    job_port(&j, 0.6, 0.43, 0.1, 0.1, 60);
    j.options.max_nozzles = 3;
    if (hurried) {
        j.options.run.progress = stop_at_second_round;
        j.options.run.user = hurried;
    }
    j.options.max_water = 27 * LITRES_PER_MINUTE;
    sp_nozzle nozzles[] = {by_hand(&j, sp_v(0.33, 0.26, 0.8), sp_v(0.725, 0.576, -0.378), 68.6, 6.9),
                           by_hand(&j, sp_v(0.63, 0.3, 0.9), sp_v(-0.687, 0.472, -0.553), 69.6, 8),
                           by_hand(&j, sp_v(0.6, 0.43, 0.9), sp_v(-0.086, 0.344, -0.935), 90, 12)};
    nozzles[2].type = &j.types[1];
    assert_true(job_search(&j, nozzles, 3, hurried != NULL, &simple) >= 0.98 * simple);
}

static void as_many_as_are_allowed(void **state)
{
    (void)state;
    find_as_many_as_are_allowed(NULL);
}

/* What covers most is tried first. */
static void as_many_as_are_allowed_in_a_hurry(void **state)
{
    (void)state;
    looks l = {0};
    find_as_many_as_are_allowed(&l);
    assert_int_equal(l.rounds, 2);
}

/* How many variants there are of a type at an angle, and what they take together, L/min. */
static size_t variants_at(const sp_candidates *candidates, const sp_nozzle_type *type, double angle, double *litres)
{
    size_t count = 0;
    *litres = 0;
    for (size_t k = 0; k < candidates->variant_count; k++) {
        const sp_variant *variant = &candidates->variants[k];
        if (variant->type != type || fabs(variant->angle - angle * DEGREE) > 1e-9)
            continue;
        count++;
        *litres += variant->flow / LITRES_PER_MINUTE;
        assert_true(fabs(variant->reach - 0.5 * variant->angle) < 1e-9);
        assert_true(fabs(variant->spray.solid_angle - 2 * M_PI * (1 - cos(0.5 * variant->angle))) < 1e-9);
    }
    return count;
}

/* Of what stands at other settings the certificate must not take another candidate for it, nor look beyond them. */
static void settled_is_no_candidate(const prepared *ready, const sp_tuned *tuned)
{
    sp_error error = {0};
    size_t count = ready->candidates.variant_count;
    for (size_t i = 0; i < tuned->pool.count; i++) {
        sp_pose pose = tuned->pool.items[i];
        const sp_variant *variant = &tuned->candidates.variants[pose.variant];
        sp_partial partial;
        assert_true(sp_partial_create(&tuned->search, &partial, &error));
        assert_true(sp_partial_add_pose(&tuned->search, &partial, pose, &error));
        sp_tuned_settle(tuned, &partial);
        const sp_placed *placed = &partial.items[0];
        assert_true(placed->pose.variant < count);
        assert_int_equal(sp_placed_is_candidate(placed), pose.variant < count);
        assert_true(sp_nozzle_angle(&placed->nozzle) == variant->angle);
        assert_true(fabs(placed->flow - variant->flow) <= 1e-12 * variant->flow);
        assert_true(sp_nozzle_angle(&placed->origin) == ready->candidates.variants[placed->pose.variant].angle);
        sp_partial_free(&partial);
    }
}

static void settings_between_the_candidates(void **state)
{
    (void)state;
    static const double angles[] = {40, 65, 90, 120, 150};
    job j;
    prepared ready;
    sp_tuned tuned;
    sp_pool pool = {0};
    sp_error error = {0};
    double litres;
    job_open(&j, 4, 0.1);
    job_set(&j, 40, 150, 2, 14);
    job_port(&j, 0.3, 0.5, 0.1, 0.1, 60);
    j.options.type_count = 2;
    prepare(&ready, j.room.evaluator, &j.options);
    for (uint32_t k = 0; k < ready.candidates.variant_count; k++)
        assert_true(sp_pool_add(&pool, (sp_pose){.variant = k}, &error));
    assert_true(sp_tuned_create(&ready.search, &pool, &tuned, &error));
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        /* five evenly from 2 to 14, and the candidates' 10 */
        assert_int_equal(variants_at(&tuned.candidates, &j.types[0], angles[i], &litres), 6);
        assert_true(fabs(litres - 50) < 1e-9);
    }
    assert_int_equal(variants_at(&tuned.candidates, &j.types[1], 90, &litres), 1);
    assert_int_equal(tuned.pool.count, 31);
    settled_is_no_candidate(&ready, &tuned);
    sp_tuned_free(&tuned);
    sp_pool_free(&pool);
    prepared_free(&ready);
    room_close(&j.room);
}

/* In place; borrows both. The caller frees its local search. */
static void refining_begin(sp_refining *refining, quest *q, sp_error *error)
{
    *refining = (sp_refining){.search = &q->ready.search,
                              .pool = &q->pool,
                              .deadline = &q->ready.deadline,
                              .front = &q->front,
                              .error = error};
    assert_true(sp_local_search_create(refining->search, refining->pool, q->front.fine, refining->deadline,
                                       &refining->local_search, error));
}

/* A layout that greedy found is annealed where all that water can do is asked for. */
static void the_best_is_annealed(void **state)
{
    (void)state;
    job j;
    quest q;
    sp_error error = {0};
    job_open(&j, 5, 0.1);
    j.options.refine = (sp_refine){0};
    job_port(&j, 0.3, 0.5, 0.1, 0.1, 60);
    job_port(&j, 0.7, 0.5, 0.1, 0.1, 60);
    job_port(&j, 0.5, 0.3, 0.1, 0.1, 60);
    quest_begin(&q, j.room.evaluator, &j.options);
    sp_refining refining;
    refining_begin(&refining, &q, &error);
    double before = q.front.measured.area;
    assert_true(sp_cover_more(&refining));
    assert_true(q.front.measured.area > 1.01 * before);
    sp_local_search_free(&refining.local_search);
    quest_end(&q);
    room_close(&j.room);
}

/* A layout is refined once for as much water as it can take, where least is asked of it, and again for more. */
static void more_water_is_another_trial(void **state)
{
    (void)state;
    job j;
    quest q;
    sp_error error = {0};
    sp_trials trials = {0};
    job_open(&j, 5, 0.1);
    job_set(&j, 90, 90, 2, 20);
    job_port(&j, 0.3, 0.5, 0.1, 0.1, 60);
    j.options.max_nozzles = 1;
    quest_begin(&q, j.room.evaluator, &j.options);
    sp_refining refining;
    refining_begin(&refining, &q, &error);
    static const double budgets[] = {10, 15, 15, 30, 25};
    for (size_t i = 0; i < 5; i++) {
        assert_true(sp_try_also(&refining, &trials, &q.front.best, budgets[i] * LITRES_PER_MINUTE, SP_TRIAL_BY_TURNS));
        trials.items[i].turn = SP_STARTS;
    }
    assert_true(sp_local_search_run(&refining.local_search, trials.items, trials.count, &error));
    assert_true(trials.items[1].better && trials.items[1].partial.flow > 11 * LITRES_PER_MINUTE);
    assert_true(trials.items[4].better && trials.items[4].partial.flow > 16 * LITRES_PER_MINUTE);
    assert_true(trials.items[2].repeats && trials.items[3].repeats);
    assert_false(trials.items[0].repeats || trials.items[1].repeats || trials.items[4].repeats);
    sp_trials_free(&trials);
    sp_local_search_free(&refining.local_search);
    quest_end(&q);
    room_close(&j.room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_wide_cones_facing_each_other), cmocka_unit_test(one_cone_turned_up),
        cmocka_unit_test(as_many_as_are_allowed),           cmocka_unit_test(as_many_as_are_allowed_in_a_hurry),
        cmocka_unit_test(settings_between_the_candidates),  cmocka_unit_test(the_best_is_annealed),
        cmocka_unit_test(more_water_is_another_trial),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
