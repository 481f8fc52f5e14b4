/* Points of a front that prices for others say little about have prices of their own. */
#include "prepared.h"

#include "certificate/front_bounds.h"
#include "certificate/proved_waters.h"
#include "scoring/footprints.h"

#define NOZZLES 12
#define GAP 0.15 /* what is left open of the bound between two waters that were priced for */

static void chords_join_what_was_priced(void **state)
{
    (void)state;
    sp_proved_waters waters = {0};
    /* not in their order, one twice */
    static const sp_proved_water noted[] = {{0, 1}, {40, 9}, {10, 5}, {40, 8}, {20, 7}, {10, 6}};
    for (size_t i = 0; i < sizeof noted / sizeof *noted; i++)
        assert_true(sp_proved_waters_note(&waters, noted[i].water, noted[i].bound));
    assert_int_equal(waters.count, 4);
    static const double at[][2] = {{0, 1}, {5, 3}, {10, 5}, {15, 6}, {20, 7}, {30, 7.5}, {40, 8}, {100, 8}};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++)
        assert_true(fabs(sp_proved_waters_chord(&waters, at[i][0]) - at[i][1]) < 1e-12);
    sp_proved_waters_free(&waters);
}

/* A hall with nozzles on a grid under its ceiling. */
typedef struct {
    room room;
    sp_nozzle_type type;
    sp_member hole;
    const sp_nozzle_type *types[1];
    double pressure;
    sp_mount mount;
    sp_place_options options;
    prepared ready;
    sp_front front;
} hall;

/* Of clusters, the first of whose poses alone there was time to trace, or of cones. */
static void hall_open(hall *h, bool clusters)
{
    room_builder b = {0};
    sp_error error = {0};
    *h = (hall){.pressure = 2e5};
    room_box(&b, sp_v(-5, -5, 0), sp_v(5, 5, 4), "walls", "lid");
    h->room.setup = sp_setup_default();
    h->room.setup.cavity = SP_CAVITY_POINT;
    h->room.setup.cavity_point = sp_v(0, 0, 1);
    h->room.setup.criterion.flux = 0.3 * LITRES_PER_MINUTE;
    room_open(&h->room, &b, 0.3);
    h->type = room_cone("cone", 70 * DEGREE, 8);
    h->types[0] = &h->type;
    h->options = room_options();
    h->options.types = h->types;
    h->options.type_count = 1;
    h->options.pressures = &h->pressure;
    h->options.pressure_count = 1;
    h->options.mounts = &h->mount;
    h->options.mount_count = 1;
    h->options.max_nozzles = NOZZLES;
    h->mount = (sp_mount){
        .kind = SP_MOUNT_BOX, .axis = sp_v(0, 0, -1), .spacing = 2.5, .from = sp_v(-4, -4, 3.5), .to = sp_v(4, 4, 3.5)};
    if (clusters) {
        h->hole = (sp_member){.type = h->type, .axis = sp_v(0, 0, 1), .share = 1};
        h->type.pattern = SP_PATTERN_CLUSTER;
        h->type.members = &h->hole;
        h->type.member_count = 1;
        h->mount.spacing = 1;
    }
    prepare(&h->ready, h->room.evaluator, &h->options);
    sp_run none = {.threads = 1, .time_limit = 1e-9};
    sp_deadline over = sp_deadline_start(&none);
    if (clusters)
        assert_true(sp_footprints_fill(h->ready.search.footprints, &over, &error));
    h->front = (sp_front){.fine = h->room.evaluator, .objective = SP_OBJECTIVE_MAX_COVERAGE, .target = INFINITY};
    sp_partial partial;
    assert_true(sp_partial_create(&h->ready.search, &partial, &error));
    assert_true(h->ready.sites.count >= NOZZLES);
    for (uint32_t site = 0; site < NOZZLES; site++)
        assert_true(sp_partial_add_pose(&h->ready.search, &partial, (sp_pose){site, 0, 0, 0}, &error) &&
                    sp_front_measure(&h->front, &h->ready.search, &partial, NULL, &error));
    sp_partial_free(&partial);
}

static void hall_close(hall *h)
{
    sp_front_free(&h->front);
    prepared_free(&h->ready);
    room_close(&h->room);
}

/* How many points lie farther above the chord, and what was found, than that. */
static size_t count_gaps(const sp_certifying *c)
{
    size_t count = 0;
    for (size_t i = 0; i < c->point_count; i++) {
        double water = (double)c->points[i].water, bound = c->bound.by_water[c->points[i].water];
        double least = fmax(sp_proved_waters_chord(&c->proved_waters, water), c->points[i].found);
        assert_true(bound >= c->points[i].found);
        count += bound * (1 - GAP) > least;
    }
    return count;
}

static void points_between_are_priced_for(void **state)
{
    (void)state;
    hall h;
    sp_error error = {0};
    bool possible;
    hall_open(&h, false);
    sp_certifying c = {.deadline = &h.ready.deadline};
    assert_true(sp_problem_create(&h.ready.search, &h.front, &c.problem, &possible, &error) && possible);
    assert_true(sp_certifying_prepare(&c, &error));
    assert_true(c.point_count >= NOZZLES);
    /* prices for all the water that there is, twice, so that inequalities have come into use */
    size_t most = c.problem.cover.water;
    assert_true(sp_lower_bound(&c, most, 2, &error));
    double before = c.bound.by_water[most / 3];
    size_t open = count_gaps(&c);
    assert_true(open >= 3);
    assert_true(sp_lower_gaps(&c, &error));
    assert_int_equal(count_gaps(&c), 0);
    assert_true(c.bound.by_water[most / 3] < 0.8 * before);
    /* few were enough: what is proved for one water holds beyond it */
    assert_true(c.proved_waters.count - 2 < open);
    /* and the reach is what it was */
    assert_true(c.bound.reach >= 1 && c.bound.reach <= 1);
    sp_certifying_free(&c);
    hall_close(&h);
}

/* Poses for which there was no time are none that a bound is of. */
static void what_was_not_traced_is_not_priced(void **state)
{
    (void)state;
    hall h;
    sp_error error = {0};
    bool possible;
    hall_open(&h, true);
    assert_false(sp_footprints_whole(h.ready.search.footprints));
    sp_certifying c = {.deadline = &h.ready.deadline};
    assert_true(sp_problem_create(&h.ready.search, &h.front, &c.problem, &possible, &error) && possible);
    assert_true(sp_problem_poses(&c.problem) < h.ready.candidates.pose_start[h.ready.sites.count]);
    assert_true(sp_certifying_prepare(&c, &error));
    size_t most = c.problem.cover.water;
    assert_true(sp_lower_bound(&c, most, 2, &error));
    assert_true(c.bound.by_water[most] >= sp_partial_counted(&h.ready.search, &h.front.best) * (1 - 1e-9));
    sp_certifying_free(&c);
    hall_close(&h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chords_join_what_was_priced),
        cmocka_unit_test(points_between_are_priced_for),
        cmocka_unit_test(what_was_not_traced_is_not_priced),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
