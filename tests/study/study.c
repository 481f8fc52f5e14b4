/* Studies through the library: fits and fronts of known series, what jets that walls throw back are compared with, and
 * ending before the end. */
#include "../optimizer/small_room.h"

#include <sprayplan/study.h>

static void slopes_of_known_series(void **state)
{
    (void)state;
    double x[5], y[5];
    for (int i = 0; i < 5; i++) {
        x[i] = 0.04 / pow(2, i);
        y[i] = 3 * pow(x[i], 1.5);
    }
    assert_float_equal(sp_study_slope(x, y, 5), 1.5, 1e-12);
    /* what is not known is left out, and three points are the fewest */
    y[1] = 0;
    y[3] = NAN;
    assert_float_equal(sp_study_slope(x, y, 5), 1.5, 1e-12);
    y[4] = -1;
    assert_true(isnan(sp_study_slope(x, y, 5)));
    const double one_place[] = {2, 2, 2}, values[] = {1, 2, 3};
    assert_true(isnan(sp_study_slope(one_place, values, 3)));
    /* least squares: log y = 0, 1, 0, 1 at log x = 0, 1, 2, 3 has slope 1/5 */
    const double steps[] = {1, M_E, M_E * M_E, M_E * M_E * M_E}, zigzag[] = {1, M_E, 1, M_E};
    assert_float_equal(sp_study_slope(steps, zigzag, 4), 0.2, 1e-12);
}

/* Of a series that misjudges nothing there is none. */
static void an_order_that_is_not_known_is_a_dash(void **state)
{
    (void)state;
    sp_fidelity fidelity = sp_setup_default().fidelity;
    sp_study_run run = {.fidelity = fidelity};
    sp_study_order order = {.fidelity = fidelity, .count = 3, .error = NAN, .misjudged = NAN};
    const sp_study found = {.run_count = 1, .runs = &run, .order_count = 1, .orders = &order};
    char *text = sp_study_text(&found, NULL);
    assert_non_null(strstr(text, "orders of convergence"));
    assert_non_null(strstr(text, "          -           -\n"));
    assert_null(strstr(text, "nan"));
    free(text);
}

static void the_front_of_a_known_set(void **state)
{
    (void)state;
    const double cost[] = {1, 2, 3, 4, 2, 1, NAN, 5, 1}, loss[] = {9, 4, 5, 1, 4, 10, 0, 1, 9};
    /* equal ones stay side by side; as much loss at more cost goes, and so does more loss at equal cost */
    const bool expected[] = {true, true, false, true, true, false, false, false, true};
    bool on[9];
    sp_study_front(cost, loss, 9, on);
    for (int i = 0; i < 9; i++)
        assert_int_equal(on[i], expected[i]);
    sp_study_front(cost, loss, 0, on);
}

/* What is minimised where mounts cost something stands beside the water, and nowhere else is spoken of. */
static void prices_of_placements_are_reported(void **state)
{
    (void)state;
    sp_study_place place = {
        .fidelity = sp_setup_default().fidelity, .water = 20 / 6e4, .outlay = 27.5 / 6e4, .costly = true, .seconds = 1};
    const sp_study found = {.place_count = 1, .places = &place};
    char *texts[] = {sp_study_text(&found, NULL), sp_study_place_csv(&found, NULL),
                     sp_study_json(&found, "room.yaml", NULL), sp_study_html(&found, "room.yaml", NULL)};
    assert_non_null(strstr(texts[0], "water L/min price L/min"));
    assert_non_null(strstr(texts[0], "20.0        27.5"));
    assert_non_null(strstr(texts[1], ",water_l_min,price_l_min,coverage,"));
    assert_non_null(strstr(texts[1], ",20,27.5,"));
    assert_non_null(strstr(texts[2], "\"price_l_min\": 27.5"));
    assert_non_null(strstr(texts[3], "Price: water and mounts, L/min"));
    assert_non_null(strstr(texts[3], "<td>27.5</td>"));
    place = (sp_study_place){.fidelity = place.fidelity, .water = place.water, .outlay = place.water};
    char *plain = sp_study_text(&found, NULL);
    assert_null(strstr(plain, "price"));
    free(plain);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        free(texts[i]);
}

/* One cone from the middle of the lid, on texels and with jets that are few. */
typedef struct {
    job job;
    sp_nozzle nozzle;
    sp_layout layout;
    sp_setup setup;
} study_room;

static void open_study(study_room *r)
{
    job_open(&r->job);
    r->nozzle = (sp_nozzle){
        .name = "N", .type = &r->job.types[0], .position = {0.1, 0.05, 1}, .axis = {0, 0, -1}, .pressure = PRESSURE};
    r->layout = (sp_layout){1, &r->nozzle};
    r->setup = r->job.room.setup;
    r->setup.fidelity.texel = 0.05;
    r->setup.fidelity.jets = 200000;
    r->setup.fidelity.accuracy = 0.1;
}

static void jets_are_the_reference_where_walls_throw_back(void **state)
{
    (void)state;
    study_room r;
    open_study(&r);
    sp_surface bouncing[8];
    for (size_t i = 0; i < r.setup.mesh->part_count; i++)
        bouncing[i] = (sp_surface){.clean = true, .restitution = 0.6, .rebound = 1};
    r.setup.surfaces = bouncing;
    r.setup.fidelity.trajectory = SP_TRAJECTORY_PARABOLA;
    r.setup.fidelity.method = SP_METHOD_FORWARD;
    sp_error error = {0};
    sp_study_options options = {.run = {.threads = 2}};
    sp_study *study = sp_study_create(&r.setup, &r.layout, NULL, &options, &error);
    assert_non_null(study);
    assert_int_equal(study->run_count, 5); /* 0, 1, 2, 4 reflections, and the scene's own */
    assert_true(study->reference.reflections == 8 && study->reference.seed != r.setup.fidelity.seed);
    /* as good as its jets are, where points can tell */
    assert_true(fabs(study->reference_check) < 0.01);
    const sp_study_run *runs = study->runs;
    assert_true(runs[0].error < -0.02); /* liquid that is not followed is missed */
    for (int i = 1; i < 4; i++) {
        assert_true(runs[i].coverage > runs[i - 1].coverage - 1e-12);
        assert_true(runs[i].misjudged < runs[i - 1].misjudged + 0.002);
    }
    assert_true(fabs(runs[3].error) < 0.01);
    /* the mean difference is what the coverages differ by, but for the points being a sample */
    for (int i = 0; i < 5; i++)
        assert_float_equal(runs[i].error, runs[i].coverage - study->reference_coverage, 0.02);
    sp_study_destroy(study);
    room_close(&r.job.room);
}

/* Ends the study at a part of a stage. */
typedef struct {
    const char *stage;
    double from;
} ending;

static bool ends_there(void *user, const char *stage, double done)
{
    const ending *end = user;
    return strcmp(stage, end->stage) != 0 || done < end->from;
}

static void cancelled_it_keeps_what_there_is(void **state)
{
    (void)state;
    study_room r;
    open_study(&r);
    r.setup.fidelity.method = SP_METHOD_INVERSE;
    static const struct {
        ending end;
        size_t runs, places;
    } cases[] = {{{"reference", 0}, 0, 0},
                 {{"runs", 0}, 0, 0},
                 {{"runs", 0.5}, 2, 0},
                 {{"place", 0}, 3, 0},
                 {{"place", 0.01}, 3, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ending end = cases[i].end;
        sp_study_options options = {.run = {.threads = 1, .progress = ends_there, .user = &end}};
        sp_error error = {0};
        sp_study *study = sp_study_create(&r.setup, &r.layout, &r.job.options, &options, &error);
        if (cases[i].runs == 0) {
            assert_null(study);
            assert_int_equal(error.kind, SP_ERROR_INTERRUPTED);
            continue;
        }
        assert_non_null(study);
        assert_true(study->interrupted);
        assert_int_equal(error.kind, SP_OK);
        assert_int_equal(study->run_count, cases[i].runs);
        assert_true(study->place_count <= cases[i].places);
        char *page = sp_study_html(study, "room <b>", &error), *csv = sp_study_csv(study, &error);
        assert_non_null(strstr(page, "ended before it was done"));
        assert_non_null(strstr(page, "room &lt;b&gt;"));
        assert_non_null(csv);
        free(page);
        free(csv);
        sp_study_destroy(study);
    }
    room_close(&r.job.room);
}

static void nothing_to_study_is_an_error(void **state)
{
    (void)state;
    study_room r;
    open_study(&r);
    r.layout.count = 0;
    sp_error error = {0};
    sp_study_options options = {.run = {.threads = 1}};
    assert_null(sp_study_create(&r.setup, &r.layout, NULL, &options, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    assert_null(sp_study_create(NULL, &r.layout, NULL, &options, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    room_close(&r.job.room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slopes_of_known_series),
        cmocka_unit_test(the_front_of_a_known_set),
        cmocka_unit_test(prices_of_placements_are_reported),
        cmocka_unit_test(an_order_that_is_not_known_is_a_dash),
        cmocka_unit_test(jets_are_the_reference_where_walls_throw_back),
        cmocka_unit_test(cancelled_it_keeps_what_there_is),
        cmocka_unit_test(nothing_to_study_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
