/* Evaluating tells how far it has come, and ends where that is answered with no. */
#include "shapes.h"

#include <sprayplan/deviation.h>
#include <sprayplan/points.h>

static const sp_nozzle_type cone = {.name = "cone",
                                    .pattern = SP_PATTERN_FULL_CONE,
                                    .angle = M_PI / 2,
                                    .flow = 1e-4,
                                    .at = 2e5,
                                    .exponent = 0.5,
                                    .cv = 0.95,
                                    .drop = 1e-3};

/* Who is told: what the stages were, and when to answer no. */
typedef struct {
    const char *stage; /* NULL: all */
    int left;          /* calls at that stage that are answered with yes */
    size_t calls;      /* at that stage */
    double last;
} listener;

static bool listen(void *user, const char *stage, double done)
{
    listener *own = user;
    assert_true(done >= 0 && done <= 1);
    if (own->stage && strcmp(stage, own->stage))
        return true;
    own->calls++;
    own->last = done;
    return own->left-- > 0;
}

typedef struct {
    sp_mesh *mesh;
    sp_surface surfaces[2];
    sp_setup setup;
    sp_evaluator *evaluator;
    sp_layout *layout;
    sp_coverage *coverage;
    listener listener;
} fixture;

/* A room of 2 m with two nozzles, and what they cover; the listener says yes to all so far. */
static void open_room(fixture *f, sp_trajectory trajectory, double film, bool moves)
{
    sp_nozzle nozzles[] = {{.type = &cone, .position = sp_v(0, 0, 0.8), .axis = sp_v(0, 0, -1), .pressure = 2e5},
                           {.type = &cone, .position = sp_v(0.1, 0, 0), .axis = sp_v(1, 0, 0.2), .pressure = 2e5}};
    sp_error error = {0};
    shape s = shape_create();
    shape_part(&s, "room");
    shape_box(&s, sp_v(-1, -1, -1), sp_v(1, 1, 1), true);
    shape_part(&s, "tray");
    shape_sheet(&s, sp_v(-0.2, -0.2, -0.5), sp_v(0.4, 0, 0), sp_v(0, 0.4, 0), 1);
    *f = (fixture){.mesh = shape_mesh(&s),
                   .surfaces = {{true, 0, 1, false}, {true, 0, 1, moves}},
                   .setup = sp_setup_default(),
                   .listener = {.left = 1 << 30}};
    f->setup.mesh = f->mesh;
    f->setup.surfaces = f->surfaces;
    f->setup.cavity = SP_CAVITY_POINT;
    f->setup.criterion.film = film;
    f->setup.fidelity.trajectory = trajectory;
    f->setup.fidelity.method = SP_METHOD_INVERSE;
    f->setup.fidelity.texel = 0.05;
    if (moves)
        f->setup.sweep = (sp_sweep){.from = sp_v(-0.5, 0, 0), .to = sp_v(0.5, 0, 0), .speed = 0.1};
    f->setup.run.progress = listen;
    f->setup.run.user = &f->listener;
    f->evaluator = sp_evaluator_create(&f->setup, &error);
    assert_string_equal(error.message, "");
    f->layout = sp_layout_create(nozzles, 2, &error);
    f->coverage = sp_evaluate(f->evaluator, f->layout, &error);
    assert_string_equal(error.message, "");
    assert_non_null(f->coverage);
}

static void close_room(fixture *f)
{
    sp_coverage_destroy(f->coverage);
    sp_layout_destroy(f->layout);
    sp_evaluator_destroy(f->evaluator);
    sp_mesh_destroy(f->mesh);
}

/* Whether it came to its end; what it found is forgotten. */
typedef bool work(const fixture *f, sp_error *error);

static bool evaluate(const fixture *f, sp_error *error)
{
    sp_coverage *coverage = sp_evaluate(f->evaluator, f->layout, error);
    if (coverage)
        assert_memory_equal(coverage->deposits.flux, f->coverage->deposits.flux,
                            coverage->deposits.count * sizeof(double));
    sp_coverage_destroy(coverage);
    return coverage != NULL;
}

static bool contribute(const fixture *f, sp_error *error)
{
    sp_contributions *made = sp_contributions_create(f->evaluator, f->layout, f->coverage, error);
    sp_contributions_destroy(made);
    return made != NULL;
}

static bool balance(const fixture *f, sp_error *error)
{
    f->coverage->balance.known = false;
    return sp_evaluate_balance(f->evaluator, f->layout, f->coverage, error);
}

static bool measure(const fixture *f, sp_error *error)
{
    sp_measured_error measured;
    return sp_measure_error(f->evaluator, f->layout, f->coverage, SP_TRAJECTORY_AUTO, 1, &measured, error);
}

static bool find_borderline(const fixture *f, sp_error *error)
{
    sp_borderline borderline;
    return sp_find_borderline(f->evaluator, f->layout, f->coverage, NULL, &borderline, error);
}

static bool bound_lines(const fixture *f, sp_error *error)
{
    double bound;
    return sp_bound_lines(f->evaluator, f->layout, &bound, NULL, error);
}

/* Choosing settings, where all is one stage. */
static bool choose(const fixture *f, sp_error *error)
{
    sp_setup setup = f->setup;
    setup.fidelity.texel = 0;
    sp_evaluator *evaluator = sp_evaluator_create_for(&setup, f->layout, error);
    sp_evaluator_destroy(evaluator);
    return evaluator != NULL;
}

/* Told at the start and at the end, and no later than at the one after the first no. */
static void is_reported_and_stops(fixture *f, const char *stage, work *does)
{
    sp_error error = {0};
    f->listener = (listener){.stage = stage, .left = 1 << 30};
    assert_true(does(f, &error));
    if (f->listener.calls < 2 || f->listener.last != 1)
        fail_msg("%s: %zu calls, the last at %g", stage, f->listener.calls, f->listener.last);
    for (int left = 0; left < 2; left++) {
        f->listener = (listener){.stage = stage, .left = left};
        error = (sp_error){0};
        assert_false(does(f, &error));
        assert_int_equal(error.kind, SP_ERROR_INTERRUPTED);
        assert_string_equal(error.message, "interrupted");
        assert_true(f->listener.calls == (size_t)left + 1);
    }
    f->listener = (listener){.left = 1 << 30};
}

static void evaluations_can_be_interrupted(void **state)
{
    (void)state;
    static const sp_trajectory trajectories[] = {SP_TRAJECTORY_LINE, SP_TRAJECTORY_PARABOLA, SP_TRAJECTORY_DRAG};
    for (int i = 0; i < 3; i++) {
        fixture f;
        open_room(&f, trajectories[i], 0, false);
        is_reported_and_stops(&f, "patches", evaluate);
        is_reported_and_stops(&f, "patches", contribute);
        is_reported_and_stops(&f, "liquid", balance);
        is_reported_and_stops(&f, "measured error", measure);
        is_reported_and_stops(&f, "borderline", find_borderline);
        if (trajectories[i] == SP_TRAJECTORY_LINE)
            is_reported_and_stops(&f, "bound on lines", bound_lines);
        is_reported_and_stops(&f, "settings", choose);
        close_room(&f);
    }
}

static void so_can_those_of_film_and_of_goods_that_move(void **state)
{
    (void)state;
    fixture f;
    open_room(&f, SP_TRAJECTORY_PARABOLA, 1e-5, false);
    is_reported_and_stops(&f, "film", evaluate);
    is_reported_and_stops(&f, "film", measure);
    close_room(&f);
    open_room(&f, SP_TRAJECTORY_PARABOLA, 0, true);
    is_reported_and_stops(&f, "patches", evaluate);
    is_reported_and_stops(&f, "liquid", balance);
    close_room(&f);
}

/* Callbacks come from one thread at a time, and two evaluations of a parallel region know nothing of each other. */
static void within_a_parallel_region_nobody_is_told(void **state)
{
    (void)state;
    fixture f;
    open_room(&f, SP_TRAJECTORY_LINE, 0, false);
    f.listener = (listener){.left = 0};
    int done = 0;
#pragma omp parallel for num_threads(2) reduction(+ : done)
    for (int i = 0; i < 2; i++) {
        sp_error error = {0};
        sp_coverage *coverage = sp_evaluate(f.evaluator, f.layout, &error);
        done += coverage != NULL;
        sp_coverage_destroy(coverage);
    }
    assert_int_equal(done, 2);
    assert_int_equal(f.listener.calls, 0);
    close_room(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(evaluations_can_be_interrupted),
        cmocka_unit_test(so_can_those_of_film_and_of_goods_that_move),
        cmocka_unit_test(within_a_parallel_region_nobody_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
