/* What refinement must find, and never do. */
#include "floor.h"

#ifdef SPRAYPLAN_SANITIZE
#define RIM_TEXEL 0.06 /* at the rim a degree is as far or farther */
#else
#define RIM_TEXEL 0.03
#endif

static void the_aperture_whose_rim_is_just_wet(void **state)
{
    (void)state;
    const double answers[] = {44, 76, 90};
    for (size_t i = 0; i < sizeof answers / sizeof *answers; i++) {
        job j;
        job_open(&j, 6, RIM_TEXEL, rim_flux(20 * LITRES_PER_MINUTE, 0.5 * answers[i] * DEGREE, 2));
        j.type.angle_min = 20 * DEGREE;
        j.type.angle_max = 120 * DEGREE;
        j.options.refine.angle = INFINITY;
        sp_proposal *proposal = job_place(&j);
        assert_int_equal(proposal->layout->count, 1);
        double angle = sp_nozzle_angle(&proposal->layout->nozzles[0]) / DEGREE;
        if (fabs(angle - answers[i]) > 1)
            fail_msg("found an angle of %g deg, expected %g deg", angle, answers[i]);
        sp_proposal_destroy(proposal);
        room_close(&j.room);
    }
}

/* A cone that sprays past the floor's edge is turned and moved back over it. */
static void pose_moves_over_the_floor(void **state)
{
    (void)state;
    job j;
    job_open(&j, 2.2, 0.03, 0);
    j.mount.from.x = j.mount.to.x = 0.4;
    j.mount.tilt = 30 * DEGREE;
    j.mount.axis = sp_unit(sp_v(0.5, 0, -1));
    j.options.refine = (sp_refine){.axis = 15 * DEGREE};
    sp_proposal *proposal = job_place(&j);
    const sp_nozzle *nozzle = &proposal->layout->nozzles[0];
    assert_true(sp_dot(nozzle->axis, j.mount.axis) >= cos(30 * DEGREE) - 1e-9);
    assert_true(nozzle->position.x == 0.4);
    sp_proposal_destroy(proposal);

    /* on a line over the edge, straight down, from a coarse start */
    j.mount = (sp_mount){
        .kind = SP_MOUNT_LINE, .axis = sp_v(0, 0, -1), .spacing = 2, .from = sp_v(-0.9, 0, 1.5), .to = sp_v(1, 0, 1.5)};
    j.options.refine = (sp_refine){.position = 1};
    proposal = job_place(&j);
    nozzle = &proposal->layout->nozzles[0];
    assert_true(nozzle->position.y == 0 && nozzle->position.z == 1.5);
    assert_true(nozzle->position.x >= -0.9 && nozzle->position.x <= 1);
    /* its disc of 0.866 m radius lies on the floor, all of it */
    assert_true(fabs(nozzle->position.x) < 1.1 - 0.866 + 0.03);
    assert_true(proposal->coverage->covered_area > 1.05 * proposal->greedy_coverage->covered_area);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* Neither reaches the target from where it may stand as a candidate. The cone, which is moved, does from the middle,
 * and so does there the cluster, which is not moved but takes less. */
static void the_place_found_for_one_type_may_suit_another(void **state)
{
    (void)state;
    job j;
    job_open(&j, 1.5, 0.03, 0);
    j.type = room_cone("cone", 62 * DEGREE, 20);
    sp_member hole = {.type = room_cone("hole", 61 * DEGREE, 1), .axis = sp_v(0, 0, 1), .share = 1};
    sp_nozzle_type ball = room_cone("ball", 0, 15);
    const sp_nozzle_type *types[] = {&j.type, &ball};
    ball.pattern = SP_PATTERN_CLUSTER;
    ball.members = &hole;
    ball.member_count = 1;
    j.mount = (sp_mount){
        .kind = SP_MOUNT_LINE, .axis = sp_v(0, 0, -1), .spacing = 2, .from = sp_v(-0.9, 0, 2), .to = sp_v(1, 0, 2)};
    j.options.types = types;
    j.options.type_count = 2;
    j.options.objective = SP_OBJECTIVE_MIN_WATER;
    j.options.coverage = 0.9;
    j.options.refine = (sp_refine){.position = 1};
    sp_proposal *proposal = job_place(&j);
    const sp_nozzle *nozzle = &proposal->layout->nozzles[0];
    assert_true(proposal->reached);
    assert_true(proposal->greedy_coverage->covered_area < proposal->target_area);
    assert_int_equal(proposal->layout->count, 1);
    assert_ptr_equal(nozzle->type, &ball);
    assert_true(fabs(nozzle->position.x) < 0.6);
    assert_true(proposal->coverage->flow == ball.flow);
    const sp_certificate *proved = &proposal->certificate;
    assert_true(proved->computed && proved->own > 0);
    assert_true(proved->counted > 0.9 * proved->whole);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* A cone that leans to both sides is the same at every roll: none is asked for. */
static void a_cone_is_not_rolled(void **state)
{
    (void)state;
    job j;
    job_open(&j, 2.2, 0.03, 0);
    j.mount.from = j.mount.to = sp_v(0.4, 0.2, 2);
    j.mount.tilt = 30 * DEGREE;
    j.mount.axis = sp_unit(sp_v(0.5, 0.1, -1));
    j.options.refine = (sp_refine){.axis = 15 * DEGREE, .roll = true};
    sp_proposal *proposal = job_place(&j);
    const sp_nozzle *nozzle = &proposal->layout->nozzles[0];
    assert_true(sp_distance(nozzle->axis, proposal->greedy->nozzles[0].axis) > 1e-3);
    assert_true(nozzle->roll == 0);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

static void flow_is_turned_down_while_the_target_holds(void **state)
{
    (void)state;
    job j;
    double rim = rim_flux(20 * LITRES_PER_MINUTE, 30 * DEGREE, 2);
    job_open(&j, 6, 0.05, 0.7 * rim);
    j.type.flow_min = 0.5 * j.type.flow;
    j.type.flow_max = 1.5 * j.type.flow;
    j.options.objective = SP_OBJECTIVE_MIN_WATER;
    j.options.coverage = 0.98;
    j.options.refine.flow = INFINITY;
    sp_proposal *proposal = job_place(&j);
    assert_true(proposal->coverage->covered_area >= proposal->target_area);
    /* the rim needs 70 % of the flow; 2 % of the area may stay dry, and texels count whole */
    double share = proposal->coverage->flow / j.type.flow;
    assert_true(share > 0.64 && share < 0.73);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* At the candidates' flow the rim falls dry, which wants 1.3 times as much. */
static void flow_is_turned_up_for_what_is_asked(void **state)
{
    (void)state;
    job j;
    double rim = rim_flux(20 * LITRES_PER_MINUTE, 30 * DEGREE, 2), disc = M_PI * pow(2 * tan(30 * DEGREE), 2);
    job_open(&j, 6, 0.05, 1.3 * rim);
    j.type.flow_max = 1.5 * j.type.flow;
    j.options.refine.flow = INFINITY;
    sp_proposal *proposal = job_place(&j);
    assert_true(proposal->greedy_coverage->covered_area < 0.9 * disc);
    assert_true(proposal->coverage->covered_area > 0.97 * disc);
    sp_proposal_destroy(proposal);

    j.options.max_water = 1.15 * j.type.flow;
    proposal = job_place(&j);
    assert_true(proposal->coverage->flow > 1.1 * j.type.flow);
    assert_true(proposal->coverage->covered_area > 1.05 * proposal->greedy_coverage->covered_area);
    sp_proposal_destroy(proposal);

    j.options.max_water = INFINITY;
    j.options.objective = SP_OBJECTIVE_MIN_WATER;
    j.options.coverage = 0.96 * disc / 36;
    proposal = job_place(&j);
    assert_true(proposal->reached);
    assert_true(proposal->coverage->flow < 1.35 * j.type.flow);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* A fan's roll: the long side of a plank. */
static void roll_follows_the_plank(void **state)
{
    (void)state;
    job j;
    *(&j) = (job){.pressure = PRESSURE};
    room_builder b = {0};
    room_part(&b, "plank");
    sp_vec3 along = sp_v(2 * cos(0.2), 2 * sin(0.2), 0), across = sp_v(-0.15 * sin(0.2), 0.15 * cos(0.2), 0);
    room_sheet(&b, sp_scale(sp_add(along, across), -0.5), along, across);
    j.room.setup = sp_setup_default();
    j.room.setup.fidelity.accuracy = ROOM_ACCURACY;
    j.room.setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    room_open(&j.room, &b, 0.02);
    j.type = room_cone("fan", 80 * DEGREE, 10);
    j.type.pattern = SP_PATTERN_FLAT_FAN;
    j.type.thickness = 8 * DEGREE;
    j.mount = (sp_mount){.kind = SP_MOUNT_BOX, .axis = sp_v(0, 0, -1), .from = sp_v(0, 0, 1), .to = sp_v(0, 0, 1)};
    job_ask(&j, 1);
    j.options.refine.roll = true;
    sp_proposal *proposal = job_place(&j);
    const sp_nozzle *nozzle = &proposal->layout->nozzles[0];
    sp_vec3 wide = sp_nozzle_frame(nozzle->axis, nozzle->roll, j.room.setup.up).x;
    assert_true(fabs(sp_dot(wide, sp_unit(along))) > cos(2.5 * DEGREE));
    assert_true(proposal->coverage->covered_area > proposal->greedy_coverage->covered_area);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

#ifdef SPRAYPLAN_SANITIZE
#define SCALED_TEXEL 0.0625 /* times the room's edge */
#else
#define SCALED_TEXEL 0.03125
#endif

/* A room of `edge` m by .8 by .6 of that, and nozzles whose water grows with its area. */
static void open_scaled_room(job *j, double edge)
{
    *j = (job){.pressure = PRESSURE};
    room_builder b = {0};
    room_box(&b, sp_v(0, 0, 0), sp_v(edge, 0.8125 * edge, 0.625 * edge), "walls", "lid");
    j->room.setup = sp_setup_default();
    j->room.setup.fidelity.accuracy = ROOM_ACCURACY;
    j->room.setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    j->room.setup.cavity = SP_CAVITY_POINT;
    j->room.setup.cavity_point = sp_v(0.5 * edge, 0.5 * edge, 0.25 * edge);
    j->room.setup.criterion.flux = 2 * LITRES_PER_MINUTE;
    room_open(&j->room, &b, SCALED_TEXEL * edge);
    j->type = room_cone("set", 100 * DEGREE, 8 * edge * edge);
    j->type.angle_min = 80 * DEGREE;
    j->type.angle_max = 140 * DEGREE;
    j->type.flow_min = 0.5 * j->type.flow;
    j->mount = (sp_mount){.kind = SP_MOUNT_LINE,
                          .axis = sp_v(0, 0, -1),
                          .tilt = 0.5,
                          .spacing = 0.25 * edge,
                          .from = sp_v(0.125 * edge, 0.25 * edge, 0.5 * edge),
                          .to = sp_v(0.875 * edge, 0.5 * edge, 0.5 * edge)};
    job_ask(j, 2);
    j->options.refine =
        (sp_refine){.position = 0.125 * edge, .axis = 0.3, .roll = true, .angle = 40 * DEGREE, .flow = 0.3};
}

/* The solver's tolerances are absolute. Powers of two scale without rounding, so that not a bit may differ. */
static void the_unit_of_length_does_not_matter(void **state)
{
    (void)state;
#ifdef SPRAYPLAN_SANITIZE
    static const int powers[] = {0, -20};
#else
    static const int powers[] = {0, 1, -20};
#endif
    enum { COUNT = sizeof powers / sizeof *powers };
    sp_proposal *first = NULL;
    job jobs[COUNT];
    for (size_t i = 0; i < COUNT; i++) {
        double edge = ldexp(1, powers[i]);
        open_scaled_room(&jobs[i], edge);
        sp_proposal *proposal = job_place(&jobs[i]);
        first = i ? first : proposal;
        assert_int_equal(proposal->layout->count, first->layout->count);
        assert_true(proposal->coverage->fraction == first->coverage->fraction);
        assert_true(proposal->coverage->flow == edge * edge * first->coverage->flow);
        for (size_t n = 0; n < first->layout->count; n++) {
            const sp_nozzle *own = &proposal->layout->nozzles[n], *at_one = &first->layout->nozzles[n];
            assert_true(sp_distance(own->position, sp_scale(at_one->position, edge)) == 0);
            assert_true(sp_distance(own->axis, at_one->axis) == 0);
            assert_true(own->angle == at_one->angle && own->flow == edge * edge * at_one->flow);
        }
        if (i)
            sp_proposal_destroy(proposal);
    }
    assert_true(first->coverage->covered_area > first->greedy_coverage->covered_area);
    sp_proposal_destroy(first);
    for (size_t i = 0; i < COUNT; i++)
        room_close(&jobs[i].room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_aperture_whose_rim_is_just_wet),
        cmocka_unit_test(pose_moves_over_the_floor),
        cmocka_unit_test(the_place_found_for_one_type_may_suit_another),
        cmocka_unit_test(a_cone_is_not_rolled),
        cmocka_unit_test(flow_is_turned_down_while_the_target_holds),
        cmocka_unit_test(flow_is_turned_up_for_what_is_asked),
        cmocka_unit_test(roll_follows_the_plank),
        cmocka_unit_test(the_unit_of_length_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
