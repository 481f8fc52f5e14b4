/* The ways of jets that readers see, against the laws that they follow. */
#include "shapes.h"

#include "spray/paths.h"

#define HEIGHT 1.0
#define SPEED 19.0 /* of 0.95 √(2 · 2 bar / 1000 kg/m³) */

static const sp_nozzle_type cone = {.name = "cone",
                                    .pattern = SP_PATTERN_FULL_CONE,
                                    .angle = M_PI / 3,
                                    .flow = 1e-4,
                                    .at = 2e5,
                                    .exponent = 0.5,
                                    .drop = 1e-3,
                                    .cv = 0.95};

typedef struct {
    sp_mesh *mesh;
    sp_surface surface;
    sp_evaluator *evaluator;
    sp_paths paths;
} flown;

/* Jets of a nozzle a metre over a floor of 4 m × 4 m that throws them back. */
static flown fly(const sp_nozzle *nozzle, sp_trajectory trajectory, double restitution, int reflections)
{
    shape s = shape_create();
    shape_part(&s, "floor");
    shape_sheet(&s, sp_v(-2, -2, 0), sp_v(4, 0, 0), sp_v(0, 4, 0), 4);
    flown all = {.mesh = shape_mesh(&s), .surface = {.clean = true, .restitution = restitution, .rebound = 1}};
    sp_setup setup = sp_setup_default();
    setup.mesh = all.mesh;
    setup.surfaces = &all.surface;
    setup.fidelity.method = SP_METHOD_FORWARD;
    setup.fidelity.trajectory = trajectory;
    setup.fidelity.reflections = reflections;
    setup.fidelity.texel = 0.2;
    setup.fidelity.jets = 1000;
    sp_error error = {0};
    all.evaluator = sp_evaluator_create(&setup, &error);
    assert_string_equal(error.message, "");
    assert_true(sp_paths_fly(all.evaluator, nozzle, &all.paths, &error));
    return all;
}

static void put_away(flown *all)
{
    sp_paths_free(&all->paths);
    sp_evaluator_destroy(all->evaluator);
    sp_mesh_destroy(all->mesh);
}

static sp_nozzle hung(const sp_nozzle_type *type, sp_vec3 axis)
{
    return (sp_nozzle){.type = type, .position = sp_v(0, 0, HEIGHT), .axis = axis, .pressure = 2e5};
}

static void assert_near(double found, double expected, double tolerance)
{
    if (!(fabs(found - expected) <= tolerance))
        fail_msg("found %.9g, expected %.9g within %g", found, expected, tolerance);
}

/* With what velocity a leg sets out: its control point lies where that would lead in half of its time. */
static sp_vec3 setting_out(sp_vec3 from, const sp_path_leg *leg, double *time)
{
    sp_vec3 control = sp_scale(sp_add(from, leg->end), 0.5);
    control.z += leg->rise;
    *time = sqrt(4 * leg->rise / 9.81);
    return sp_scale(sp_sub(control, from), 2 / *time);
}

static void lines_go_straight_to_the_floor(void **state)
{
    (void)state;
    sp_nozzle nozzle = hung(&cone, sp_v(0, 0, -1));
    flown all = fly(&nozzle, SP_TRAJECTORY_LINE, 0, 0);
    assert_int_equal(all.paths.jet_count, SP_PATH_JETS);
    assert_int_equal(all.paths.leg_count, SP_PATH_JETS);
    double farthest = 0;
    for (size_t i = 0; i < all.paths.leg_count; i++) {
        const sp_path_leg *leg = &all.paths.legs[i];
        assert_int_equal(leg->jet, i);
        assert_near(leg->end.z, 0, 1e-9);
        assert_near(leg->rise, 0, 0);
        farthest = fmax(farthest, hypot(leg->end.x, leg->end.y));
    }
    assert_true(farthest <= HEIGHT * tan(M_PI / 6) + 1e-9 && farthest > 0.8 * HEIGHT * tan(M_PI / 6));
    put_away(&all);
}

static void parabolas_leave_at_the_nozzles_speed(void **state)
{
    (void)state;
    sp_nozzle nozzle = hung(&cone, sp_v(1, 0, 0));
    flown all = fly(&nozzle, SP_TRAJECTORY_PARABOLA, 0, 0);
    size_t landed = 0;
    for (size_t i = 0; i < all.paths.leg_count; i++) {
        double time;
        assert_near(sp_length(setting_out(nozzle.position, &all.paths.legs[i], &time)), SPEED, 1e-6 * SPEED);
        landed += fabs(all.paths.legs[i].end.z) < 1e-9;
    }
    assert_true(landed > 0 && landed < all.paths.leg_count); /* others fly over the floor's end */
    put_away(&all);
}

/* Beside others that fall. */
static void types_fly_in_their_own_way(void **state)
{
    (void)state;
    sp_nozzle_type straight = cone, held = cone;
    straight.trajectory = SP_TRAJECTORY_LINE;
    held.trajectory = SP_TRAJECTORY_DRAG;
    sp_nozzle one = hung(&straight, sp_v(1, 0, 0)), other = hung(&held, sp_v(1, 0, 0));
    flown lines = fly(&one, SP_TRAJECTORY_PARABOLA, 0, 0), drops = fly(&other, SP_TRAJECTORY_PARABOLA, 0, 0);
    for (size_t i = 0; i < lines.paths.leg_count; i++)
        assert_near(lines.paths.legs[i].rise, 0, 0);
    assert_true(drops.paths.leg_count > drops.paths.jet_count);
    put_away(&lines);
    put_away(&drops);
}

static void bounces_keep_their_share_of_the_speed(void **state)
{
    (void)state;
    sp_nozzle nozzle = hung(&cone, sp_v(0, 0, -1));
    flown all = fly(&nozzle, SP_TRAJECTORY_PARABOLA, 0.5, 10);
    sp_vec3 from = nozzle.position, arrived = {0};
    size_t bounced = 0;
    for (size_t i = 0; i < all.paths.leg_count; i++) {
        const sp_path_leg *leg = &all.paths.legs[i];
        double time;
        from = leg->bounce ? from : nozzle.position;
        sp_vec3 out = setting_out(from, leg, &time);
        assert_true(leg->bounce <= SP_PATH_BOUNCES);
        assert_true(leg->bounce == 0 || all.paths.legs[i - 1].jet == leg->jet);
        if (leg->bounce) {
            bounced++;
            assert_near(out.z, -0.5 * arrived.z, 1e-4 * SPEED);
            assert_near(out.x, arrived.x, 1e-4 * SPEED);
        }
        arrived = sp_v(out.x, out.y, out.z - 9.81 * time);
        from = leg->end;
    }
    assert_true(bounced >= all.paths.jet_count);
    put_away(&all);
}

static void drops_are_held_back(void **state)
{
    (void)state;
    sp_nozzle nozzle = hung(&cone, sp_v(1, 0, 0));
    flown free_ones = fly(&nozzle, SP_TRAJECTORY_PARABOLA, 0, 0), held = fly(&nozzle, SP_TRAJECTORY_DRAG, 0, 0);
    assert_int_equal(held.paths.jet_count, free_ones.paths.jet_count);
    assert_int_equal(held.paths.leg_count % held.paths.jet_count, 0);
    size_t legs = held.paths.leg_count / held.paths.jet_count, shorter = 0;
    assert_true(legs > 1);
    for (size_t i = 0; i < held.paths.jet_count; i++) {
        const sp_path_leg *last = &held.paths.legs[(i + 1) * legs - 1], *alone = &free_ones.paths.legs[i];
        if (fabs(last->end.z) > 1e-3 || fabs(alone->end.z) > 1e-6)
            continue;
        assert_true(last->end.x < alone->end.x);
        shorter++;
    }
    assert_true(shorter > 0);
    put_away(&held);
    put_away(&free_ones);
}

static void of_many_holes_some_are_reported(void **state)
{
    (void)state;
    enum { HOLES = 100 };
    sp_member holes[HOLES];
    for (int i = 0; i < HOLES; i++)
        holes[i] = (sp_member){.type = cone, .offset = sp_v(0.01 * i, 0, 0), .axis = sp_v(0, 0, 1), .share = 1};
    sp_nozzle_type ball = cone;
    ball.pattern = SP_PATTERN_CLUSTER;
    ball.angle = 0;
    ball.member_count = HOLES;
    ball.members = holes;
    sp_nozzle nozzle = hung(&ball, sp_v(0, 0, -1));
    flown all = fly(&nozzle, SP_TRAJECTORY_LINE, 0, 0);
    assert_true(all.paths.jet_count > SP_PATH_JETS / 2 && all.paths.jet_count <= SP_PATH_JETS);
    for (size_t i = 1; i < all.paths.jet_count; i++)
        assert_true(all.paths.pattern[i] > all.paths.pattern[i - 1] && all.paths.pattern[i] < HOLES);
    put_away(&all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_go_straight_to_the_floor),        cmocka_unit_test(parabolas_leave_at_the_nozzles_speed),
        cmocka_unit_test(bounces_keep_their_share_of_the_speed), cmocka_unit_test(drops_are_held_back),
        cmocka_unit_test(of_many_holes_some_are_reported),       cmocka_unit_test(types_fly_in_their_own_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
