/* Nozzles whose bodies would overlap are not proposed, and not proved against, where their types say how wide these
 * are. */
#include "prepared.h"

#include "refine/compass.h"
#include "refine/continuation.h"
#include "refine/settable.h"
#include "scoring/bodies.h"
#include "search/exchange.h"
#include "search/exhaustive.h"
#include "search/find.h"
#include "search/front.h"
#include "search/selection.h"
#include "search/simulated_annealing.h"

#define BODY 0.15
#define TOUCH (BODY * (1 - 1e-6)) /* bodies that touch do not overlap */

typedef struct {
    room room;
    sp_nozzle_type types[2];
    const sp_nozzle_type *listed[2];
    double pressure;
    sp_mount mount;
    sp_place_options options;
} job;

/* A room of 1 m with a line of points 0.1 m apart near its lid. Only two cones in one place, of another type each,
 * bring the floor what it needs. */
static void job_open(job *j, double body)
{
    room_builder b = {0};
    room_box(&b, sp_v(0, 0, 0), sp_v(1, 1, 1), "walls", "lid");
    *j = (job){.pressure = 2e5, .room = {.setup = sp_setup_default()}, .options = room_options()};
    j->room.setup.criterion.flux = 12 * LITRES_PER_MINUTE;
    j->room.setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    j->room.setup.fidelity.accuracy = ROOM_ACCURACY;
    room_open(&j->room, &b, 0.1);
    j->types[0] = room_cone("narrow", 60 * DEGREE, 6);
    j->types[1] = room_cone("wide", 70 * DEGREE, 8);
    for (size_t i = 0; i < 2; i++) {
        j->types[i].body = body;
        j->listed[i] = &j->types[i];
    }
    j->mount = (sp_mount){.kind = SP_MOUNT_LINE,
                          .from = sp_v(0.3, 0.5, 0.9),
                          .to = sp_v(0.7, 0.5, 0.9),
                          .axis = sp_v(0, 0, -1),
                          .spacing = 0.1};
    j->options.types = j->listed;
    j->options.type_count = 2;
    j->options.pressures = &j->pressure;
    j->options.pressure_count = 1;
    j->options.mounts = &j->mount;
    j->options.mount_count = 1;
    j->options.max_nozzles = 2;
    j->options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j->options.coverage = 1;
}

/* What a search of the job's candidates holds, all of it empty at first. */
typedef struct {
    prepared ready;
    sp_partial partial;
    sp_pool pool;
    sp_front front;
} probe;

static void probe_open(probe *p, const job *j)
{
    sp_error error = {0};
    *p = (probe){0};
    prepare(&p->ready, j->room.evaluator, &j->options);
    p->front = (sp_front){.fine = j->room.evaluator,
                          .deadline = &p->ready.deadline,
                          .objective = SP_OBJECTIVE_MAX_COVERAGE,
                          .target = p->ready.search.all};
    assert_true(sp_partial_create(&p->ready.search, &p->partial, &error));
}

/* And the job. */
static void probe_close(probe *p, job *j)
{
    sp_front_free(&p->front);
    sp_pool_free(&p->pool);
    sp_partial_free(&p->partial);
    prepared_free(&p->ready);
    room_close(&j->room);
}

static void probe_add(probe *p, uint32_t site, uint32_t variant)
{
    sp_error error = {0};
    assert_true(
        sp_partial_add_pose(&p->ready.search, &p->partial, (sp_pose){.site = site, .variant = variant}, &error));
}

/* Its two nozzles are a body apart, or nearer where they have none. */
static void check_pair(const sp_partial *partial, bool given)
{
    assert_int_equal(partial->count, 2);
    double distance = sp_distance(partial->items[0].nozzle.position, partial->items[1].nozzle.position);
    assert_true(given ? distance >= TOUCH : distance < TOUCH);
}

/* m between the two nozzles that are nearest. */
static double nearest(const sp_layout *layout)
{
    double distance = INFINITY;
    for (size_t i = 0; i < layout->count; i++)
        for (size_t k = 0; k < i; k++)
            distance = fmin(distance, sp_distance(layout->nozzles[i].position, layout->nozzles[k].position));
    return distance;
}

/* The same of the proposal, or of the best on the candidates, whichever is less. */
static double apart(job *j, double *bound)
{
    sp_error error = {0};
    sp_proposal *proposal = sp_place(j->room.evaluator, &j->options, &error);
    assert_string_equal(error.message, "");
    room_check(proposal, &j->options);
    assert_true(proposal->layout->count > 1);
    double distance = fmin(nearest(proposal->layout), nearest(proposal->greedy));
    *bound = proposal->certificate.area_bound;
    assert_true(proposal->certificate.computed);
    sp_proposal_destroy(proposal);
    return distance;
}

/* By every layout looked at, by search, and with refinement. */
static void bodies_keep_clear(void **state)
{
    (void)state;
    static const struct {
        double spacing;
        size_t nozzles;
        double position;
    } cases[] = {{0.1, 2, 0}, {0.005, 3, 0}, {0.1, 2, 0.05}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int given = 0; given <= 1; given++) {
            job j;
            double bound;
            job_open(&j, given ? BODY : 0);
            j.mount.spacing = cases[i].spacing;
            j.options.max_nozzles = cases[i].nozzles;
            j.options.refine.position = cases[i].position;
            double distance = apart(&j, &bound);
            if (given ? distance < TOUCH : distance > 0.5 * BODY)
                fail_msg("case %zu: %g m apart", i, distance);
            room_close(&j.room);
        }
}

/* The bound is of layouts that can be built: looser where two may be in one place. */
static void the_proof_is_of_what_can_be_built(void **state)
{
    (void)state;
    job j;
    double with, without;
    job_open(&j, BODY);
    apart(&j, &with);
    room_close(&j.room);
    job_open(&j, 0);
    apart(&j, &without);
    room_close(&j.room);
    assert_true(with < 0.95 * without);
}

/* A kept nozzle has a body, too. */
static void kept_bodies_keep_clear(void **state)
{
    (void)state;
    for (int given = 0; given <= 1; given++) {
        job j;
        double bound;
        sp_error error = {0};
        job_open(&j, given ? BODY : 0);
        const sp_nozzle own = {.name = "own",
                               .type = &j.types[0],
                               .position = sp_v(0.5, 0.5, 0.9),
                               .axis = sp_v(0, 0, -1),
                               .pressure = j.pressure,
                               .keep = true};
        sp_layout *kept = sp_layout_create(&own, 1, &error);
        j.options.kept = kept;
        double distance = apart(&j, &bound);
        assert_true(given ? distance >= TOUCH : distance < TOUCH);
        sp_layout_destroy(kept);
        room_close(&j.room);
    }
}

/* Where one type has none, two of it may be in one place: looking at each pose once is not all. */
static void without_all_bodies_a_pose_may_be_taken_twice(void **state)
{
    (void)state;
    for (int given = 0; given <= 2; given++) {
        job j;
        probe p;
        sp_exhaustive every;
        sp_error error = {0};
        job_open(&j, given ? BODY : 0);
        j.types[1].body = given == 2 ? BODY : 0;
        probe_open(&p, &j);
        assert_true(sp_exhaustive_create(&p.ready.search, j.room.evaluator, (sp_exhaustive_limits){INFINITY, INFINITY},
                                         &p.ready.deadline, "certificate", &every, &error));
        assert_true(every.count > 0);
        assert_int_equal(every.whole, given == 2);
        sp_exhaustive_free(&every);
        probe_close(&p, &j);
    }
}

typedef bool (*refine_way)(sp_sights *sights, sp_deadline *deadline, sp_partial *partial, sp_error *error);

static bool by_compass(sp_sights *sights, sp_deadline *deadline, sp_partial *partial, sp_error *error)
{
    return sp_compass(sights, 0.25, 0.1, INFINITY, deadline, partial, error);
}

static bool by_continuation(sp_sights *sights, sp_deadline *deadline, sp_partial *partial, sp_error *error)
{
    return sp_continuation(sights, 0, SP_WIDTHS, INFINITY, deadline, partial, error);
}

/* The two go towards each other as far as their bodies let them. */
static void no_move_brings_bodies_together(void **state)
{
    (void)state;
    static const refine_way ways[] = {by_compass, by_continuation};
    for (size_t way = 0; way < sizeof ways / sizeof *ways; way++)
        for (int given = 0; given <= 1; given++) {
            job j;
            probe p;
            sp_sights sights;
            sp_error error = {0};
            job_open(&j, given ? BODY : 0);
            j.options.refine.position = 0.2;
            probe_open(&p, &j);
            probe_add(&p, 1, 0);
            probe_add(&p, 3, 1);
            assert_true(sp_sights_create(&p.ready.search, 4, true, &sights, &error));
            assert_true(ways[way](&sights, &p.ready.deadline, &p.partial, &error));
            check_pair(&p.partial, given);
            assert_true(sp_partial_clear(&p.ready.search, &p.partial));
            sp_sights_free(&sights);
            probe_close(&p, &j);
        }
}

/* The first nozzle of a port, so far from it along its axis, between settings. */
static void probe_add_at(probe *p, uint32_t mount, double depth)
{
    const sp_mount *port = &p->ready.search.options->mounts[mount];
    uint32_t site = 0;
    while (p->ready.sites.items[site].mount != mount)
        site++;
    probe_add(p, site, 0);
    sp_placed *placed = &p->partial.items[p->partial.count - 1];
    placed->site.position = placed->nozzle.position = sp_along(port->position, depth, port->axis);
}

/* Lances that end 0.149 m apart, and would 0.1 m at the nearest settings, are set to others. */
static void settings_keep_bodies_clear(void **state)
{
    (void)state;
    job j;
    probe p;
    sp_error error = {0};
    job_open(&j, 0.14);
    sp_mount ports[] = {{.kind = SP_MOUNT_PORT, .name = "top", .position = sp_v(0.5, 0.5, 1), .axis = sp_v(0, 0, -1)},
                        {.kind = SP_MOUNT_PORT, .name = "side", .position = sp_v(0, 0.5, 0.6), .axis = sp_v(1, 0, 0)}};
    for (size_t i = 0; i < 2; i++) {
        ports[i].depth_from = 0.1;
        ports[i].depth_to = 0.8;
        ports[i].depth_spacing = 0.1;
        ports[i].depth_step = (sp_step){0.1, 1};
    }
    j.options.mounts = ports;
    j.options.mount_count = 2;
    probe_open(&p, &j);
    assert_true(sp_front_measure(&p.front, &p.ready.search, &p.partial, NULL, &error));
    probe_add_at(&p, 0, 0.26);
    probe_add_at(&p, 1, 0.46);
    assert_true(sp_front_measure(&p.front, &p.ready.search, &p.partial, NULL, &error));
    assert_int_equal(p.front.best.count, 2);
    assert_true(sp_set_front(&p.ready.search, &p.ready.deadline, &p.front, &error));
    assert_int_equal(p.front.best.count, 2);
    probe_close(&p, &j);
}

/* Two in one place are not taken into the front. */
static void what_overlaps_is_not_on_the_front(void **state)
{
    (void)state;
    for (int given = 0; given <= 1; given++) {
        job j;
        probe p;
        sp_error error = {0};
        job_open(&j, given ? BODY : 0);
        probe_open(&p, &j);
        assert_true(sp_front_measure(&p.front, &p.ready.search, &p.partial, NULL, &error));
        for (uint32_t k = 0; k < 2; k++) {
            sp_body body = sp_pose_body(&p.ready.search, &(sp_pose){.site = 2, .variant = k});
            assert_int_equal(sp_body_clear(&p.ready.search, &p.partial, body), !given || k == 0);
            probe_add(&p, 2, k);
        }
        assert_true(sp_front_measure(&p.front, &p.ready.search, &p.partial, NULL, &error));
        assert_int_equal(p.front.best.count, given ? 0 : 2);
        probe_close(&p, &j);
    }
}

/* Both variants at one site. */
static void pool_pair(probe *p)
{
    sp_error error = {0};
    for (uint32_t k = 0; k < 2; k++)
        assert_true(sp_pool_add(&p->pool, (sp_pose){.site = 2, .variant = k}, &error));
}

/* Nor chosen from the matrix. */
static void what_overlaps_is_not_selected(void **state)
{
    (void)state;
    for (int given = 0; given <= 1; given++) {
        job j;
        probe p;
        sp_coverage_matrix matrix;
        sp_selection selection;
        sp_error error = {0};
        job_open(&j, given ? BODY : 0);
        probe_open(&p, &j);
        pool_pair(&p);
        assert_true(sp_coverage_matrix_create(&p.ready.search, &p.pool, NULL, 0, &matrix, &error));
        assert_true(sp_selection_create(&matrix, &selection, &error));
        assert_true(sp_selection_gain(&selection, 1, INFINITY) > 0);
        sp_selection_add(&selection, 0);
        assert_int_equal(sp_selection_gain(&selection, 1, INFINITY) > 0, !given);
        sp_selection_free(&selection);
        sp_coverage_matrix_free(&matrix);
        probe_close(&p, &j);
    }
}

/* Greedy goes on with what keeps clear. */
static void greedy_takes_what_keeps_clear(void **state)
{
    (void)state;
    for (int given = 0; given <= 1; given++) {
        job j;
        probe p;
        sp_partial first;
        sp_error error = {0};
        job_open(&j, given ? BODY : 0);
        probe_open(&p, &j);
        assert_true(sp_find_first(&p.ready.search, 1, &p.ready.deadline, &p.front, &p.pool, &first, &error));
        check_pair(&first, given);
        sp_partial_free(&first);
        probe_close(&p, &j);
    }
}

/* Nor does annealing bring them together, which takes nozzles out and puts others in. */
static void annealing_puts_in_what_keeps_clear(void **state)
{
    (void)state;
    for (int given = 0; given <= 1; given++) {
        job j;
        probe p;
        sp_error error = {0};
        job_open(&j, given ? BODY : 0);
        probe_open(&p, &j);
        probe_add(&p, 0, 0);
        probe_add(&p, 4, 1);
        assert_true(sp_simulated_annealing(&p.ready.search, INFINITY, 1e6, 1, &p.ready.deadline, &p.partial, &error));
        check_pair(&p.partial, given);
        probe_close(&p, &j);
    }
}

/* Nor does exchange. */
static void no_exchange_brings_bodies_together(void **state)
{
    (void)state;
    for (int given = 0; given <= 1; given++) {
        job j;
        probe p;
        sp_pool_gains gains;
        sp_error error = {0};
        job_open(&j, given ? BODY : 0);
        probe_open(&p, &j);
        pool_pair(&p);
        probe_add(&p, 2, 0);
        assert_true(sp_pool_gains_create(&p.ready.search, &p.pool, &gains, &error));
        assert_true(sp_improve(&p.ready.search, &gains, INFINITY, &p.ready.deadline, &p.partial, &error));
        assert_int_equal(p.partial.count, given ? 1 : 2);
        sp_pool_gains_free(&gains);
        probe_close(&p, &j);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_keep_clear),
        cmocka_unit_test(the_proof_is_of_what_can_be_built),
        cmocka_unit_test(kept_bodies_keep_clear),
        cmocka_unit_test(without_all_bodies_a_pose_may_be_taken_twice),
        cmocka_unit_test(no_move_brings_bodies_together),
        cmocka_unit_test(settings_keep_bodies_clear),
        cmocka_unit_test(what_overlaps_is_not_on_the_front),
        cmocka_unit_test(what_overlaps_is_not_selected),
        cmocka_unit_test(greedy_takes_what_keeps_clear),
        cmocka_unit_test(annealing_puts_in_what_keeps_clear),
        cmocka_unit_test(no_exchange_brings_bodies_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
