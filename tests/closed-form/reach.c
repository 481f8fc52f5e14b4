/* What a point can reach: order, arcs, sides, cone, obstacles, and the criterion's mark. */
#include "measure.h"

static sp_reach *reach_of(const sp_evaluator *evaluator, sp_vec3 position, double speed, sp_vec3 axis,
                          double half_angle)
{
    sp_error error = {0};
    sp_reach *reach = sp_evaluator_reach(evaluator, position, (sp_launch){.speed = speed}, axis, half_angle, &error);
    assert_no_error(&error);
    assert_non_null(reach);
    return reach;
}

/* Every arrival is one of the closed-form flights to its patch, in order. */
static void assert_in_order(const sp_evaluator *evaluator, const sp_reach *reach, sp_vec3 position, double speed)
{
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    double least = sp_evaluator_setup(evaluator)->criterion.impact_speed;
    for (size_t i = 0; i < reach->count; i++) {
        const sp_arrival *a = &reach->arrivals[i];
        sp_flight flights[2];
        int count =
            sp_flights(position, patches->point[a->patch], speed, sp_evaluator_gravity(evaluator, NULL), flights);
        bool second = i > 0 && reach->arrivals[i - 1].patch == a->patch, high = false;
        for (int k = 0; k < count; k++)
            high = sp_distance(flights[k].direction, a->direction) == 0 ? k == 1 : high;
        assert_true(i == 0 || a->patch >= reach->arrivals[i - 1].patch);
        assert_true(!second || high);
        sp_vec3 w = flights[high].velocity;
        assert_float_equal(a->speed, sp_length(w), 1e-12);
        assert_float_equal(cos(sp_arrival_incidence(a)) * a->speed, fabs(sp_dot(w, patches->normal[a->patch])), 1e-9);
        assert_float_equal(a->transfer * flights[high].spread, fabs(sp_dot(w, patches->normal[a->patch])), 1e-9);
        assert_true(a->passes == (a->speed >= least));
    }
}

static void both_arcs_of_an_open_floor(void **state)
{
    (void)state;
    rectangle floor = level_rectangle(2, 2, 0);
    scene s;
    scene_open(&s, mesh_of_rectangles(&floor, 1), SP_TRAJECTORY_PARABOLA, 0.05 / COARSER);
    s.setup.criterion.impact_speed = 5;
    sp_evaluator *evaluator = scene_evaluator(&s);
    size_t patches = sp_evaluator_patches(evaluator)->count;
    sp_vec3 position = sp_v(0.1, 0, 0.5);
    sp_reach *reach = reach_of(evaluator, position, 5, sp_v(0, 0, -1), M_PI);
    assert_int_equal(reach->count, 2 * patches);
    assert_in_order(evaluator, reach, position, 5);
    sp_reach_destroy(reach);
    reach = reach_of(evaluator, position, 5, sp_v(0, 0, 1), M_PI / 2); /* upwards: all high arcs, and low ones afar */
    assert_true(reach->count >= patches && reach->count < 2 * patches);
    for (size_t i = 0; i < reach->count; i++)
        assert_true(asin(-reach->arrivals[i].direction.z) <= sp_spray_fringe(reach->arrivals[i].breadth) + 1e-9);
    sp_reach_destroy(reach);
    reach = reach_of(evaluator, position, 1, sp_v(0, 0, -1), M_PI); /* a feeble jet: within the envelope alone */
    double radius = 1 / 9.81 * sqrt(1 + 2 * 9.81 * 0.5);
    assert_true(reach->count > 0);
    for (size_t i = 0; i < reach->count; i++) {
        sp_vec3 point = reach->arrivals[i].point;
        assert_true(hypot(point.x - position.x, point.y) <= radius);
        assert_false(reach->arrivals[i].passes);
    }
    sp_reach_destroy(reach);
    sp_reach_destroy(NULL);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* In a closed box every patch can be seen from inside, none from outside; a jet to the lid's outer side is not an
 * arrival. */
static void only_wet_sides_of_a_box(void **state)
{
    (void)state;
    rectangle faces[6];
    box_rectangles(sp_v(0, 0, 0), sp_v(1, 1.2, 0.9), faces);
    scene s;
    scene_open(&s, mesh_of_rectangles(faces, 6), SP_TRAJECTORY_LINE, 0.05 / COARSER);
    s.setup.cavity = SP_CAVITY_POINT;
    s.setup.cavity_point = sp_v(0.5, 0.5, 0.5);
    sp_evaluator *evaluator = scene_evaluator(&s);
    size_t patches = sp_evaluator_patches(evaluator)->count;
    sp_vec3 inside = sp_v(0.31, 0.72, 0.44), outside = sp_v(0.5, 0.5, 2);
    sp_reach *reach = reach_of(evaluator, inside, 10, sp_v(1, 0, 0), M_PI);
    assert_int_equal(reach->count, patches);
    assert_in_order(evaluator, reach, inside, 10);
    sp_reach_destroy(reach);
    reach = reach_of(evaluator, outside, 10, sp_v(0, 0, -1), M_PI);
    assert_int_equal(reach->count, 0);
    sp_reach_destroy(reach);
    sp_evaluator_destroy(evaluator);

    s.setup.cavity = SP_CAVITY_OUTSIDE; /* now the lid's top is all that a point above it sees */
    evaluator = scene_evaluator(&s);
    reach = reach_of(evaluator, outside, 10, sp_v(0, 0, -1), M_PI);
    double seen = 0;
    for (size_t i = 0; i < reach->count; i++)
        seen += sp_evaluator_patches(evaluator)->area[reach->arrivals[i].patch];
    assert_float_equal(seen, 1.2, 1e-9);
    sp_reach_destroy(reach);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* A nozzle on a wall, or a hair off it, is not blocked by that wall. */
static void from_a_wall(void **state)
{
    (void)state;
    rectangle faces[6];
    box_rectangles(sp_v(0, 0, 0), sp_v(1, 1, 1), faces);
    scene s;
    scene_open(&s, mesh_of_rectangles(faces, 6), SP_TRAJECTORY_PARABOLA, 0.05 / COARSER);
    s.setup.cavity = SP_CAVITY_POINT;
    s.setup.cavity_point = sp_v(0.5, 0.5, 0.5);
    sp_evaluator *evaluator = scene_evaluator(&s);
    for (double off = 0; off < 1e-8; off += 5e-9) {
        sp_vec3 position = sp_v(0.4, 0.6, 1 - off);
        sp_reach *reach = reach_of(evaluator, position, 20, sp_v(0, 0, -1), M_PI);
        double seen = 0;
        uint32_t last = SP_NONE;
        for (size_t i = 0; i < reach->count; i++) {
            uint32_t patch = reach->arrivals[i].patch;
            seen += patch != last ? sp_evaluator_patches(evaluator)->area[patch] : 0;
            last = patch;
        }
        assert_true(seen > 4.99);
        sp_reach_destroy(reach);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_arcs_of_an_open_floor),
        cmocka_unit_test(only_wet_sides_of_a_box),
        cmocka_unit_test(from_a_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
