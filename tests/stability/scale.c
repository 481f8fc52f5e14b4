/* The same room at another size or place gets the same proposal; and of equal candidates the first. */
#include "../optimizer/room.h"

#ifdef SPRAYPLAN_SANITIZE
#define TEXEL 0.125 /* times the room's edge */
#define MOST_NOZZLES 2
#else
#define TEXEL 0.0625
#define MOST_NOZZLES 3
#endif

typedef struct {
    room room;
    sp_nozzle_type types[2];
    const sp_nozzle_type *type_list[2];
    double pressure;
    sp_mount mounts[3];
    sp_place_options options;
} job;

/* A room of 1 m × 0.8125 m × 0.625 m times `edge`, moved by `shift`, the sprays of which go with its size: lengths,
 * speeds and gravity by `edge`, flows by its square. */
static void job_open(job *j, double edge, sp_vec3 shift, bool refined)
{
    *j = (job){.pressure = 2e5 * edge * edge};
    room_builder b = {0};
    sp_vec3 size = sp_v(edge, 0.8125 * edge, 0.625 * edge);
    room_box(&b, shift, sp_add(shift, size), "walls", "lid");
    room_part(&b, "sheet");
    room_sheet(&b, sp_add(shift, sp_v(0.4375 * edge, 0.25 * edge, 0)), sp_v(0, 0.3125 * edge, 0),
               sp_v(0.0625 * edge, 0, 0.25 * edge));
    j->room.setup = sp_setup_default();
    j->room.setup.fidelity.accuracy = ROOM_ACCURACY;
    j->room.setup.gravity = 9.81 * edge;
    j->room.setup.cavity = SP_CAVITY_POINT;
    j->room.setup.cavity_point = sp_add(shift, sp_v(0.25 * edge, 0.5 * edge, 0.25 * edge));
    j->room.setup.criterion.flux = 2 * LITRES_PER_MINUTE;
    j->room.setup.criterion.impact_speed = 3 * edge;
    j->room.setup.run.threads = 1;
    room_open(&j->room, &b, TEXEL * edge);
    for (int i = 0; i < 2; i++) {
        j->types[i] = room_cone(i ? "fan" : "cone", (i ? 90 : 100) * DEGREE, 8 * edge * edge);
        j->types[i].at = j->pressure;
        j->type_list[i] = &j->types[i];
    }
    j->types[0].angle_min = 80 * DEGREE;
    j->types[0].angle_max = 140 * DEGREE;
    j->types[0].flow_min = 0.5 * j->types[0].flow;
    j->types[1].pattern = SP_PATTERN_FLAT_FAN;
    j->types[1].thickness = 40 * DEGREE;
    j->mounts[0] = (sp_mount){.kind = SP_MOUNT_LINE,
                              .axis = sp_v(0, 0, -1),
                              .tilt = 0.25,
                              .spacing = 0.25 * edge,
                              .from = sp_add(shift, sp_v(0.125 * edge, 0.25 * edge, 0.5 * edge)),
                              .to = sp_add(shift, sp_v(0.875 * edge, 0.5 * edge, 0.5 * edge))};
    j->mounts[1] = (sp_mount){
        .kind = SP_MOUNT_SURFACE, .part = 0, .spacing = 0.75 * edge, .standoff = 0.03125 * edge, .tilt = 0.25};
    j->mounts[2] = (sp_mount){.kind = SP_MOUNT_PORT,
                              .name = "M",
                              .axis = sp_v(0, 0, -1),
                              .position = sp_add(shift, sp_v(0.75 * edge, 0.625 * edge, 0.625 * edge)),
                              .depth_from = 0.0625 * edge,
                              .depth_to = 0.25 * edge,
                              .depth_spacing = 0.0625 * edge,
                              .tilt = 0.2};
    j->options = room_options();
    j->options.run.threads = 1;
    j->options.types = j->type_list;
    j->options.type_count = 2;
    j->options.pressures = &j->pressure;
    j->options.pressure_count = 1;
    j->options.mounts = j->mounts;
    j->options.mount_count = 3;
    j->options.clearance = 0.015625 * edge;
    j->options.max_nozzles = MOST_NOZZLES;
    j->options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    if (refined)
        j->options.refine =
            (sp_refine){.position = 0.125 * edge, .axis = 0.3, .roll = true, .angle = 40 * DEGREE, .flow = 0.3};
}

/* As they are at the size of 1 m. */
static sp_proposal *job_place(job *j, double edge, bool refined)
{
    sp_error error = {0};
    job_open(j, edge, sp_v(0, 0, 0), refined);
    sp_proposal *proposal = sp_place(j->room.evaluator, &j->options, &error);
    assert_string_equal(error.message, "");
    assert_non_null(proposal);
    room_check(proposal, &j->options);
    return proposal;
}

#ifdef SPRAYPLAN_SANITIZE
#define REFINED false /* what is tested is the same, and refining takes minutes */
#define FLOORS 1
#define SIZES 0 /* beside the powers of two */
#else
#define REFINED true
#define FLOORS 4
#define SIZES 1
#endif
static bool all_sizes; /* asked for by an argument, whatever it says: minutes */

static void same_layout(const sp_layout *own, const sp_layout *at_one, double edge)
{
    assert_int_equal(own->count, at_one->count);
    for (size_t i = 0; i < own->count; i++) {
        const sp_nozzle *a = &own->nozzles[i], *b = &at_one->nozzles[i];
        assert_string_equal(a->type->name, b->type->name);
        assert_true(sp_distance(a->position, sp_scale(b->position, edge)) == 0);
        assert_true(sp_distance(a->axis, b->axis) == 0);
        assert_true(a->roll == b->roll && a->angle == b->angle && a->flow == edge * edge * b->flow);
    }
}

static void a_power_of_two_changes_no_bit_of_the_proposal(void **state)
{
    (void)state;
    static const int powers[] = {0, -20, 20, 1};
    size_t count = all_sizes ? 4 : 2;
    job jobs[4];
    sp_proposal *found[4];
    for (size_t i = 0; i < count; i++) {
        double edge = ldexp(1, powers[i]), area = edge * edge;
        found[i] = job_place(&jobs[i], edge, REFINED);
        const sp_proposal *own = found[i], *home = found[0];
        const sp_certificate *proof = &own->certificate;
        same_layout(own->layout, home->layout, edge);
        same_layout(own->greedy, home->greedy, edge);
        assert_true(own->coverage->fraction == home->coverage->fraction);
        assert_true(own->coverage->flow == area * home->coverage->flow);
        assert_true(own->greedy_coverage->fraction == home->greedy_coverage->fraction);
        assert_true(own->attainable_area == area * home->attainable_area);
        assert_int_equal(own->candidates, home->candidates);
        assert_true(proof->computed && home->certificate.computed);
        assert_true(proof->area_bound == area * home->certificate.area_bound);
        assert_true(proof->water_bound == area * home->certificate.water_bound);
        assert_true(proof->counted == area * home->certificate.counted);
        assert_int_equal(own->front_count, home->front_count);
        for (size_t k = 0; k < own->front_count; k++)
            assert_true(own->front[k].flow == area * home->front[k].flow &&
                        own->front[k].area == area * home->front[k].area);
    }
    assert_true(!REFINED || found[0]->coverage->covered_area > found[0]->greedy_coverage->covered_area);
    for (size_t i = 0; i < count; i++) {
        sp_proposal_destroy(found[i]);
        room_close(&jobs[i].room);
    }
}

/* What `edge` and `shift` make of the room is as good as what the room of 1 m at (0, 0, 0) gets. */
static void as_good(const sp_proposal *home, double edge, sp_vec3 shift, bool refined)
{
    job j;
    sp_error error = {0};
    job_open(&j, edge, shift, refined);
    sp_proposal *own = sp_place(j.room.evaluator, &j.options, &error);
    assert_string_equal(error.message, "");
    double coverage = own->coverage->fraction - home->coverage->fraction,
           water = own->coverage->flow / (edge * edge * home->coverage->flow) - 1;
    print_message("size %g m, moved by %g m: coverage %+.2g, water %+.2g\n", edge, sp_length(shift), coverage, water);
    assert_true(fabs(coverage) < 1e-9 && fabs(water) < 1e-9);
    assert_true(fabs(own->greedy_coverage->fraction - home->greedy_coverage->fraction) < 1e-9);
    sp_proposal_destroy(own);
    room_close(&j.room);
}

static void any_size_and_place_get_as_good_a_proposal(void **state)
{
    (void)state;
    static const double sizes[2][4] = {{0.1, 3, 1e-3, 1e3}, {0.3, 1e-6, 1e5}};
    static const double far[] = {1.7e3, 1e6};
    for (int refined = 0; refined <= (all_sizes && REFINED); refined++) {
        job j;
        sp_proposal *home = job_place(&j, 1, refined);
        for (size_t i = 0; i < (all_sizes ? 4 : SIZES) && sizes[refined][i] > 0; i++)
            as_good(home, sizes[refined][i], sp_v(0, 0, 0), refined);
        as_good(home, 1, sp_scale(sp_v(0.8, -0.7, 0.31), far[refined]), refined);
        sp_proposal_destroy(home);
        room_close(&j.room);
    }
}

/* Two floors alike with a mounting point above each: which is better is round-off alone. */
static void of_equal_candidates_the_first_is_taken(void **state)
{
    (void)state;
    static const double edges[] = {0.3, 1e-6}, away[] = {2.3, 11.1};
    for (size_t i = 0; i < FLOORS; i++)
        for (int swapped = 0; swapped < 2; swapped++) {
            job j = {.pressure = 2e5};
            sp_error error = {0};
            room_builder b = {0};
            double edge = edges[i % 2];
            sp_vec3 places[2] = {{0.1 * edge, 0.2 * edge, 0}, {away[i / 2] * edge, -0.3 * edge, 0.7 * edge}};
            room_part(&b, "floors");
            for (int k = 0; k < 2; k++) {
                const sp_mount above = {.kind = SP_MOUNT_BOX,
                                        .axis = sp_v(0, 0, -1),
                                        .tilt = 0.2,
                                        .from = sp_add(places[k], sp_v(0.4 * edge, 0.3 * edge, 0.5 * edge)),
                                        .to = sp_add(places[k], sp_v(0.4 * edge, 0.3 * edge, 0.5 * edge))};
                room_sheet(&b, places[k], sp_v(edge, 0, 0), sp_v(0, edge, 0));
                j.mounts[swapped ? 1 - k : k] = above;
            }
            j.room.setup = sp_setup_default();
            j.room.setup.fidelity.accuracy = ROOM_ACCURACY;
            j.room.setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
            j.room.setup.criterion.flux = 2 * LITRES_PER_MINUTE;
            j.room.setup.run.threads = 1;
            room_open(&j.room, &b, 0.07 * edge);
            j.types[0] = room_cone("cone", 60 * DEGREE, 2 * edge * edge);
            j.type_list[0] = &j.types[0];
            j.options = room_options();
            j.options.types = j.type_list;
            j.options.type_count = 1;
            j.options.pressures = &j.pressure;
            j.options.pressure_count = 1;
            j.options.mounts = j.mounts;
            j.options.mount_count = 2;
            j.options.max_nozzles = 1;
            j.options.objective = SP_OBJECTIVE_MAX_COVERAGE;
            sp_proposal *proposal = sp_place(j.room.evaluator, &j.options, &error);
            assert_non_null(proposal);
            assert_int_equal(proposal->greedy->count, 1);
            assert_true(sp_distance(proposal->greedy->nozzles[0].position, j.mounts[0].from) == 0);
            sp_proposal_destroy(proposal);
            room_close(&j.room);
        }
}

/* A kept nozzle sits in the port at the depth of its lance, and next to it no more than a share of the machine off;
 * whatever its size, only one nozzle is fitted there. */
static void a_kept_nozzle_sits_in_its_port(void **state)
{
    (void)state;
    static const double edges[] = {1e-3, 0x1p-20, 1, 1e3, 0x1p20}, off[] = {0, 1e-4, 3e-3};
    for (size_t i = 0; i < (all_sizes ? 5 : 1); i++)
        for (int k = 0; k < 3; k++) {
            job j;
            sp_error error = {0};
            double edge = edges[i];
            job_open(&j, edge, sp_v(0, 0, 0), false);
            sp_nozzle kept = {.name = "K",
                              .type = &j.types[0],
                              .position = sp_v((0.75 + off[k]) * edge, 0.625 * edge, 0.5 * edge),
                              .axis = sp_v(0, 0, -1),
                              .pressure = j.pressure,
                              .keep = true};
            sp_layout *own = sp_layout_create(&kept, 1, &error);
            j.options.kept = own;
            j.options.mounts = &j.mounts[2];
            j.options.mount_count = 1;
            sp_proposal *proposal = sp_place(j.room.evaluator, &j.options, &error);
            assert_non_null(proposal);
            assert_int_equal(proposal->layout->count, k == 2 ? 2 : 1);
            sp_proposal_destroy(proposal);
            sp_layout_destroy(own);
            room_close(&j.room);
        }
}

int main(int argc, char **argv)
{
    (void)argv;
    all_sizes = argc > 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_equal_candidates_the_first_is_taken),
        cmocka_unit_test(a_kept_nozzle_sits_in_its_port),
        cmocka_unit_test(a_power_of_two_changes_no_bit_of_the_proposal),
        cmocka_unit_test(any_size_and_place_get_as_good_a_proposal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
