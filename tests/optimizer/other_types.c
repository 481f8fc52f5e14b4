/* Other types in the place of a nozzle that refinement has left where it is. */
#include "prepared.h"

#include "refine/other_types.h"

#define MOST 8.3 /* L/min that the nozzle there takes */

typedef struct {
    room room;
    sp_nozzle_type narrow, wide;
    const sp_nozzle_type *types[2];
    double pressure;
    sp_mount mount;
    sp_place_options options;
} job;

/* A room with one place in its lid; what is rated for 20 L/min there would cover more. */
static void job_open(job *j)
{
    room_builder b = {0};
    room_box(&b, sp_v(-1, -1, 0), sp_v(1, 1, 2), "walls", "lid");
    *j = (job){.pressure = 2e5, .room = {.setup = sp_setup_default()}, .options = room_options()};
    j->room.setup.criterion.flux = 0.1 * LITRES_PER_MINUTE;
    j->room.setup.run.threads = j->options.run.threads = 1;
    room_open(&j->room, &b, 0.2);
    j->narrow = room_cone("narrow", 40 * DEGREE, MOST);
    j->wide = room_cone("wide", 90 * DEGREE, 20);
    j->types[0] = &j->narrow;
    j->types[1] = &j->wide;
    j->mount = (sp_mount){
        .kind = SP_MOUNT_PORT, .name = "P1", .position = sp_v(0, 0, 2), .axis = sp_v(0, 0, -1), .depth_from = 0.1};
    j->mount.depth_to = j->mount.depth_from;
    j->options.types = j->types;
    j->options.type_count = 2;
    j->options.pressures = &j->pressure;
    j->options.pressure_count = 1;
    j->options.mounts = &j->mount;
    j->options.mount_count = 1;
    j->options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j->options.refine.flow = INFINITY;
}

/* What becomes of the narrow one: the type's name, and L/min. */
static double became(job *j, const sp_nozzle_type **type)
{
    prepared ready;
    sp_partial partial;
    sp_error error = {0};
    prepare(&ready, j->room.evaluator, &j->options);
    sp_front front = {
        .fine = j->room.evaluator, .deadline = &ready.deadline, .objective = j->options.objective, .target = 1e3};
    assert_true(sp_partial_create(&ready.search, &partial, &error));
    assert_true(sp_partial_add_pose(&ready.search, &partial, (sp_pose){0}, &error));
    assert_ptr_equal(partial.items[0].nozzle.type, &j->narrow);
    assert_true(sp_front_measure(&front, &ready.search, &partial, NULL, &error));
    assert_true(sp_try_other_types(&ready.search, &ready.deadline, &front, &error));
    assert_int_equal(front.best.count, 1);
    *type = front.best.items[0].nozzle.type;
    double flow = front.measured.flow / LITRES_PER_MINUTE;
    assert_true(fabs(front.best.items[0].flow / LITRES_PER_MINUTE - flow) < 1e-9);
    sp_partial_free(&partial);
    sp_front_free(&front);
    prepared_free(&ready);
    return flow;
}

static void types_are_set_to_what_the_nozzle_takes(void **state)
{
    (void)state;
    static const struct {
        double least, step; /* L/min */
        bool refined;
        double flow; /* 0: it stays what it is */
    } cases[] = {{20, 0, true, 0}, {5, 0, true, MOST}, {5, 1.5, true, 8}, {9, 0, true, 0}, {5, 0, false, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        job j;
        const sp_nozzle_type *type;
        job_open(&j);
        j.wide.flow_min = cases[i].least * LITRES_PER_MINUTE;
        j.wide.flow_step = (sp_step){cases[i].step, LITRES_PER_MINUTE};
        if (!cases[i].refined)
            j.options.refine = (sp_refine){.roll = true};
        double flow = became(&j, &type);
        bool changed = cases[i].flow > 0;
        assert_ptr_equal(type, changed ? &j.wide : &j.narrow);
        assert_true(fabs(flow - (changed ? cases[i].flow : MOST)) < 1e-6);
        room_close(&j.room);
    }
}

/* The rated flow is tried, too, and a type of less stays at it. */
static void types_rated_for_less_take_that(void **state)
{
    (void)state;
    job j;
    const sp_nozzle_type *type;
    job_open(&j);
    j.wide.flow = j.wide.flow_min = j.wide.flow_max = 7 * LITRES_PER_MINUTE;
    assert_true(fabs(became(&j, &type) - 7) < 1e-6);
    assert_ptr_equal(type, &j.wide);
    room_close(&j.room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(types_are_set_to_what_the_nozzle_takes),
        cmocka_unit_test(types_rated_for_less_take_that),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
