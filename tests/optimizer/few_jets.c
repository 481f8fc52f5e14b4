/* Drafts of layouts by few jets, and their count as the scene says. */
#include "bouncing_room.h"
#include "prepared.h"

#include "search/few_jets.h"

#define TEXEL 0.1
#define JETS 60000
#define SITES 5
#define LAYOUTS 12

typedef struct {
    room room;
    sp_nozzle_type type;
    const sp_nozzle_type *type_list[1];
    double pressure;
    sp_mount mount;
    sp_place_options options;
    prepared ready;
    sp_partial layouts[LAYOUTS];
    sp_front front;
} job;

/* Layout n has the poses whose bits are set in n + 1. */
static void make_layouts(job *j)
{
    sp_error error = {0};
    for (size_t n = 0; n < LAYOUTS; n++) {
        assert_true(sp_partial_create(&j->ready.search, &j->layouts[n], &error));
        for (uint32_t site = 0; site < SITES; site++)
            if ((n + 1) >> site & 1)
                assert_true(sp_partial_add_pose(&j->ready.search, &j->layouts[n], (sp_pose){.site = site}, &error));
    }
}

/* A box of walls that throw liquid back, and cones in a row under its lid. */
static void job_open(job *j)
{
    *j = (job){.pressure = 2e5};
    bouncing_room_open(&j->room, TEXEL, JETS);
    j->type = room_cone("cone", 90 * DEGREE, 4);
    j->type_list[0] = &j->type;
    j->options = room_options();
    j->options.types = j->type_list;
    j->options.type_count = 1;
    j->options.pressures = &j->pressure;
    j->options.pressure_count = 1;
    j->options.mounts = &j->mount;
    j->options.mount_count = 1;
    j->mount = (sp_mount){.kind = SP_MOUNT_LINE,
                          .axis = sp_v(0, 0, -1),
                          .spacing = 0.4,
                          .from = sp_v(-0.8, 0.1, 1),
                          .to = sp_v(0.8, 0.1, 1)};
    prepare(&j->ready, j->room.evaluator, &j->options);
    assert_int_equal(j->ready.sites.count, SITES);
    make_layouts(j);
    j->front = (sp_front){.fine = j->room.evaluator,
                          .draft_jets = sp_few_jets(&j->ready.search, j->room.evaluator),
                          .deadline = &j->ready.deadline,
                          .objective = SP_OBJECTIVE_MIN_WATER};
}

static void job_close(job *j)
{
    sp_front_free(&j->front);
    for (size_t n = 0; n < LAYOUTS; n++)
        sp_partial_free(&j->layouts[n]);
    prepared_free(&j->ready);
    room_close(&j->room);
}

/* m², as the scene says. */
static double area_of(const job *j, const sp_partial *partial)
{
    sp_error error = {0};
    return room_area_of(&j->room, sp_partial_to_layout(&j->ready.search, partial, &error));
}

/* Every case begins with drafts of all layouts. */
static int set_up(void **state)
{
    sp_error error = {0};
    job *j = malloc(sizeof *j);
    assert_non_null(j);
    job_open(j);
    assert_true(sp_front_measure_all(&j->front, &j->ready.search, j->layouts, LAYOUTS, &error));
    *state = j;
    return 0;
}

static int tear_down(void **state)
{
    job_close(*state);
    free(*state);
    return 0;
}

static void many_jets_want_drafts(void **state)
{
    job *j = *state;
    assert_in_range(j->front.draft_jets, JETS / 10, JETS / 2);
}

/* No figure of a draft is left, and the best is the best by what the scene says. */
static void drafts_are_counted(void **state)
{
    job *j = *state;
    sp_error error = {0};
    double asked = 0.5 * sp_evaluator_patches(j->room.evaluator)->total_area, least = INFINITY;
    bool differs = false;
    for (size_t i = 0; i < j->front.by_water.count; i++)
        differs |= j->front.by_water.entries[i].point.area != area_of(j, &j->front.by_water.entries[i].partial);
    assert_true(differs);
    assert_true(sp_count_by_all_jets(&j->front, &j->ready.search, asked, &error));
    assert_int_equal(j->front.draft_jets, 0);
    assert_true(j->front.by_water.count > 2);
    for (size_t i = 0; i < j->front.by_water.count; i++) {
        const sp_front_entry *entry = &j->front.by_water.entries[i];
        assert_true(entry->point.area == area_of(j, &entry->partial));
        if (entry->point.area >= asked)
            least = fmin(least, entry->point.outlay);
    }
    assert_true(isfinite(least) && j->front.measured.outlay == least);
    assert_true(j->front.measured.area == area_of(j, &j->front.best));
}

/* Without time the best is counted, and no draft is told as if it were. */
static void without_time_the_best_is_counted(void **state)
{
    job *j = *state;
    sp_error error = {0};
    size_t nozzles = j->front.best.count;
    j->ready.deadline.run.time_limit = 1e-9;
    assert_true(sp_count_by_all_jets(&j->front, &j->ready.search, 0, &error));
    assert_int_equal(j->front.by_water.count, 1);
    assert_int_equal(j->front.best.count, nozzles);
    assert_true(j->front.measured.area == area_of(j, &j->front.best));
    assert_true(j->ready.deadline.interrupted == false && j->ready.deadline.cut_count == 1);
}

/* Drafts that flatter have to cover more; what then is best is known already. */
static void the_aim_rises_by_what_drafts_flatter(void **state)
{
    job *j = *state;
    sp_error error = {0};
    const sp_front_list *list = &j->front.by_water;
    double most = list->entries[list->count - 1].point.area;
    assert_true(list->count > 2 && j->front.measured.area < most);
    double flattery = 1e-3 * most, target = most - 1.5 * flattery;
    assert_true(sp_aim_by_few_jets(&j->front, &j->ready.search, target, j->front.measured.area - flattery, &error));
    assert_true(fabs(j->front.target - (target + flattery)) < 1e-12);
    assert_true(j->front.measured.area >= j->front.target);
    assert_true(j->front.measured.area == most);
}

/* However short the time is. */
static void what_was_counted_stays(void **state)
{
    job *j = *state;
    sp_error error = {0};
    const sp_front_list *list = &j->front.by_water;
    double most = list->entries[list->count - 1].point.area, told = j->front.measured.area - 1e-3;
    sp_front_point first = j->front.measured;
    assert_true(sp_aim_by_few_jets(&j->front, &j->ready.search, most - 1e-3, told, &error));
    assert_true(j->front.measured.outlay > first.outlay);
    j->ready.deadline.run.time_limit = 1e-9;
    assert_true(sp_count_by_all_jets(&j->front, &j->ready.search, told, &error));
    assert_int_equal(j->front.by_water.count, 2);
    assert_true(j->front.measured.area == told && j->front.measured.outlay == first.outlay);
}

static void what_was_counted_is_not_counted_again(void **state)
{
    job *j = *state;
    sp_error error = {0};
    double told = j->front.measured.area - 1e-3;
    assert_true(sp_aim_by_few_jets(&j->front, &j->ready.search, 0, told, &error));
    j->ready.deadline.run.time_limit = 1e-9;
    assert_true(sp_count_by_all_jets(&j->front, &j->ready.search, 0, &error));
    assert_int_equal(j->front.by_water.count, 1);
    assert_true(j->front.measured.area == told);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(many_jets_want_drafts, set_up, tear_down),
        cmocka_unit_test_setup_teardown(drafts_are_counted, set_up, tear_down),
        cmocka_unit_test_setup_teardown(without_time_the_best_is_counted, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_aim_rises_by_what_drafts_flatter, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_was_counted_stays, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_was_counted_is_not_counted_again, set_up, tear_down)};
    return cmocka_run_group_tests_name("few_jets", tests, NULL, NULL);
}
