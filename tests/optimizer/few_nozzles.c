/* Layouts of one or two nozzles on a lid: as good as what is soon found by hand, wherever on the lid that is. */
#include "quest.h"

#define TEXEL 0.1

enum { C60, C90, C120, BALL, TYPES };

typedef struct {
    room room;
    sp_nozzle_type types[TYPES];
    const sp_nozzle_type *listed[TYPES];
    double pressure;
    sp_mount mounts[2];
    sp_place_options options;
} job;

/* A room of 2 m x 2 m x 1.6 m with a block and a post in it; a lid and a bar to mount on. */
static void job_open(job *j)
{
    room_builder b = {0};
    room_box(&b, sp_v(0, 0, 0), sp_v(2, 2, 1.6), "walls", "lid");
    room_box(&b, sp_v(0.8, 0.7, 0.3), sp_v(1.2, 1.3, 0.7), "block", "block_top");
    room_box(&b, sp_v(0.3, 1.4, 0), sp_v(0.5, 1.6, 1), "post", "post_top");
    *j = (job){.pressure = 2e5, .room = {.setup = sp_setup_default()}, .options = sp_place_options_default()};
    j->room.setup.cavity = SP_CAVITY_POINT;
    j->room.setup.cavity_point = sp_v(1, 1, 1.2);
    j->room.setup.criterion.flux = 1 * LITRES_PER_MINUTE;
    j->room.setup.criterion.incidence = 80 * DEGREE;
    j->room.setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    j->room.setup.fidelity.accuracy = ROOM_ACCURACY;
    room_open(&j->room, &b, TEXEL);
    j->types[C60] = room_cone("c60", 60 * DEGREE, 6);
    j->types[C90] = room_cone("c90", 90 * DEGREE, 12);
    j->types[C120] = room_cone("c120", 120 * DEGREE, 18);
    j->types[BALL] = room_cone("ball", 360 * DEGREE, 40);
    for (size_t i = 0; i < TYPES; i++)
        j->listed[i] = &j->types[i];
    j->mounts[0] =
        (sp_mount){.kind = SP_MOUNT_SURFACE, .part = 1, .spacing = 0.4, .standoff = 0.06, .tilt = 40 * DEGREE};
    j->mounts[1] = (sp_mount){.kind = SP_MOUNT_LINE,
                              .from = sp_v(0.1, 0.1, 0.8),
                              .to = sp_v(1.9, 0.1, 0.8),
                              .spacing = 0.3,
                              .axis = sp_v(0, 1, 0),
                              .tilt = 30 * DEGREE};
    j->options.types = j->listed;
    j->options.type_count = TYPES;
    j->options.pressures = &j->pressure;
    j->options.pressure_count = 1;
    j->options.mounts = j->mounts;
    j->options.mount_count = 2;
    j->options.clearance = 0.02;
    j->options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j->options.coverage = 1;
}

typedef struct {
    size_t type;
    sp_vec3 position, axis;
} by_hand;

/* What these cover, m². */
static double area_of(const job *j, const by_hand *placed, size_t count)
{
    sp_nozzle nozzles[2] = {0};
    sp_error error = {0};
    for (size_t i = 0; i < count; i++)
        nozzles[i] = (sp_nozzle){.type = j->listed[placed[i].type],
                                 .position = placed[i].position,
                                 .axis = sp_unit(placed[i].axis),
                                 .pressure = j->pressure};
    sp_layout *layout = sp_layout_create(nozzles, count, &error);
    assert_non_null(layout);
    return room_area_of(&j->room, layout);
}

/* With so many nozzles, and so much water, what is found covers no less than the share given of what these do. */
static void expect_as_good(const by_hand *placed, size_t count, size_t most, double litres, double share)
{
    job j;
    quest q;
    job_open(&j);
    j.options.max_nozzles = most;
    j.options.max_water = litres * LITRES_PER_MINUTE;
    double simple = area_of(&j, placed, count);
    quest_begin(&q, j.room.evaluator, &j.options);
    double found = quest_finish(&q);
    if (found < share * simple)
        fail_msg("found %.4f m2, by hand %.4f m2", found, simple);
    assert_true(q.front.best.count <= most);
    quest_end(&q);
    room_close(&j.room);
}

/* As the candidates stand, a cone of 18 L/min covers more than the ball does. */
static void one_ball(void **state)
{
    (void)state;
    const by_hand placed = {BALL, sp_v(1.055, 0.993, 1.54), sp_v(0.131, 0.347, -0.929)};
    expect_as_good(&placed, 1, 1, 100, 0.995);
}

/* Also where two of 6 L/min are allowed, which cover more as the candidates stand. */
static void one_cone(void **state)
{
    (void)state;
    const by_hand placed = {C90, sp_v(1.438, 0.471, 1.54), sp_v(-0.431, 0.477, -0.766)};
    for (size_t most = 1; most <= 2; most++)
        expect_as_good(&placed, 1, most, 12, 0.995);
}

/* What one nozzle can do is found where two are allowed, beside what two can. */
static void one_ball_beside_two(void **state)
{
    (void)state;
    const by_hand placed = {BALL, sp_v(1.055, 0.993, 1.54), sp_v(0.131, 0.347, -0.929)};
    job j;
    quest q;
    double one = 0;
    job_open(&j);
    j.options.max_nozzles = 2;
    quest_begin(&q, j.room.evaluator, &j.options);
    double two = quest_finish(&q);
    for (size_t i = 0; i < q.front.by_number.count; i++)
        if (q.front.by_number.entries[i].partial.count == 1)
            one = q.front.by_number.entries[i].point.area;
    assert_true(one >= 0.995 * area_of(&j, &placed, 1) && two > 1.5 * one);
    quest_end(&q);
    room_close(&j.room);
}

static void one_on_the_lid_one_on_the_bar(void **state)
{
    (void)state;
    const by_hand placed[] = {{C120, sp_v(0.588, 0.88, 1.54), sp_v(0.532, -0.171, -0.829)},
                              {C120, sp_v(1.463, 0.1, 0.8), sp_v(-0.485, 0.866, 0.121)}};
    expect_as_good(placed, 2, 2, 36, 0.995);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_ball),
        cmocka_unit_test(one_cone),
        cmocka_unit_test(one_ball_beside_two),
        cmocka_unit_test(one_on_the_lid_one_on_the_bar),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
