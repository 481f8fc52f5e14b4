/* Closed-form flights, checked against stepping along the parabola and against the map from directions to points. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <sprayplan/evaluator.h>

static const sp_vec3 down = {0, 0, -9.81};

/* Velocity Verlet, exact for a constant acceleration. */
static void fly(sp_vec3 *x, sp_vec3 *v, sp_vec3 gravity, double time)
{
    const int steps = 1000;
    double h = time / steps;
    for (int i = 0; i < steps; i++) {
        *x = sp_along(sp_along(*x, h, *v), 0.5 * h * h, gravity);
        *v = sp_along(*v, h, gravity);
    }
}

static void assert_arrives(sp_vec3 from, sp_vec3 to, double speed, sp_vec3 gravity, const sp_flight *flight)
{
    sp_vec3 x = from, v = sp_scale(flight->direction, speed);
    fly(&x, &v, gravity, flight->time);
    double path = fmax(sp_distance(from, to), speed * flight->time);
    if (sp_distance(x, to) > 1e-12 * (path + sp_length(from)))
        fail_msg("missed by %g after a path of %g m", sp_distance(x, to), path);
    assert_float_equal(sp_length(flight->direction), 1, 1e-14);
    assert_true(sp_distance(v, flight->velocity) <= 1e-10 * (speed + sp_length(v)));
    assert_true(flight->time > 0);
}

static void both_arcs_arrive(void **state)
{
    (void)state;
    sp_vec3 from = sp_v(0.3, -0.2, 1.1);
    for (int i = 0; i < 500; i++) {
        double a = 0.7 * i, c = cos(1.3 * i), s = sqrt(1 - c * c), r = 0.01 + 0.02 * i;
        sp_vec3 to = sp_along(from, r, sp_v(s * cos(a), s * sin(a), c));
        sp_flight flights[2];
        int count = sp_flights(from, to, 16, down, flights);
        assert_int_equal(count, 2);
        assert_true(flights[0].time < flights[1].time);
        for (int k = 0; k < count; k++)
            assert_arrives(from, to, 16, down, &flights[k]);
    }
}

static void each_flight_can_be_asked_for_by_itself(void **state)
{
    (void)state;
    sp_vec3 from = sp_v(0.3, -0.2, 1.1), none = sp_v(0, 0, 0);
    for (int i = 0; i < 400; i++) {
        sp_vec3 to = sp_along(from, 0.01 * i, sp_v(cos(0.7 * i), sin(0.7 * i), 1.3 * cos(0.3 * i)));
        sp_flight flights[2] = {{.time = 0}}, flight;
        int count = sp_flights(from, to, 4, i % 3 ? down : none, flights);
        for (int k = 0; k < 2; k++) {
            assert_int_equal(sp_flight_on_arc(from, to, 4, i % 3 ? down : none, k, &flight), k < count);
            if (k < count)
                assert_memory_equal(&flight, &flights[k], sizeof flight);
        }
    }
}

static void nothing_reaches_beyond_the_envelope(void **state)
{
    (void)state;
    /* parabola of safety: z = v²/2g - g x²/2v² */
    const double v = 5, g = 9.81;
    sp_flight flights[2];
    for (int i = 0; i < 100; i++) {
        double x = 0.05 * i, z = v * v / (2 * g) - g * x * x / (2 * v * v);
        assert_int_equal(sp_flights(sp_v(0, 0, 0), sp_v(x, 0, z + 1e-9), v, down, flights), 0);
        assert_int_equal(sp_flights(sp_v(0, 0, 0), sp_v(x, 0, z - 1e-9), v, down, flights), 2);
        for (int k = 0; k < 2; k++)
            assert_arrives(sp_v(0, 0, 0), sp_v(x, 0, z - 1e-9), v, down, &flights[k]);
    }
    assert_int_equal(sp_flights(sp_v(0, 0, 0), sp_v(0, 0, 100), v, down, flights), 0);
    assert_int_equal(sp_flights(sp_v(1, 2, 3), sp_v(1, 2, 3), v, down, flights), 0);
}

static void a_line_is_the_limit_of_weak_gravity(void **state)
{
    (void)state;
    sp_vec3 from = sp_v(0, 0, 2), to = sp_v(1, -0.5, 0.3);
    sp_flight line[2], arc[2];
    assert_int_equal(sp_flights(from, to, 10, sp_v(0, 0, 0), line), 1);
    assert_float_equal(line[0].spread, 10 * sp_dot(sp_sub(to, from), sp_sub(to, from)), 1e-12);
    for (double g = 1; g > 1e-14; g /= 10) {
        assert_int_equal(sp_flights(from, to, 10, sp_v(0, 0, -g), arc), 2);
        assert_true(sp_distance(arc[0].direction, line[0].direction) < 0.03 * g + 1e-15);
        assert_true(fabs(arc[0].spread / line[0].spread - 1) < 0.1 * g + 1e-14);
        assert_true(fabs(arc[0].time / line[0].time - 1) < 0.1 * g + 1e-14);
    }
    assert_int_equal(sp_flights(from, to, 10, sp_v(0, 0, -1e-200), arc), 1);
    assert_true(sp_distance(arc[0].direction, line[0].direction) < 1e-15);
}

static void extremes_keep_their_digits(void **state)
{
    (void)state;
    sp_flight flights[2];
    sp_vec3 origin = sp_v(0, 0, 0), near = sp_v(3e-7, 4e-7, -8e-7), far = sp_v(0.7, -2, 1);
    assert_int_equal(sp_flights(origin, far, 1e6, down, flights), 2); /* a jet of 1000 km/s */
    assert_arrives(origin, far, 1e6, down, &flights[0]);
    assert_float_equal(flights[0].spread / (1e6 * sp_dot(far, far)), 1, 1e-10);
    assert_int_equal(sp_flights(origin, near, 20, down, flights), 2); /* a micrometre away */
    assert_arrives(origin, near, 20, down, &flights[0]);
    assert_float_equal(flights[0].spread / (20 * sp_dot(near, near)), 1, 1e-6);
    sp_vec3 below = sp_v(0, 0, -3), above = sp_v(0, 0, 1); /* straight down and straight up, where the arcs are lines */
    assert_int_equal(sp_flights(origin, below, 6, down, flights), 2);
    assert_float_equal(flights[0].direction.z, -1, 0);
    assert_float_equal(flights[1].direction.z, 1, 0);
    assert_int_equal(sp_flights(origin, above, 6, down, flights), 2);
    assert_float_equal(flights[0].velocity.z, sqrt(36 - 2 * 9.81), 1e-12);
    assert_float_equal(flights[1].velocity.z, -sqrt(36 - 2 * 9.81), 1e-12);
}

/* Where the jet that leaves in direction d passes through the plane about `to`. */
static sp_vec3 through_plane(sp_vec3 from, sp_vec3 d, double speed, sp_vec3 gravity, sp_vec3 to, sp_vec3 n, double time)
{
    for (int i = 0; i < 50; i++) { /* Newton, from the central jet's time */
        sp_vec3 x = sp_along(sp_along(from, speed * time, d), 0.5 * time * time, gravity);
        sp_vec3 w = sp_along(sp_scale(d, speed), time, gravity);
        time -= sp_dot(n, sp_sub(x, to)) / sp_dot(n, w);
    }
    return sp_along(sp_along(from, speed * time, d), 0.5 * time * time, gravity);
}

/* Area of the plane per solid angle about the flight's direction, by central differences. */
static double area_per_angle(sp_vec3 from, sp_vec3 to, double speed, sp_vec3 gravity, sp_vec3 n,
                             const sp_flight *flight)
{
    const double h = 1e-5;
    sp_vec3 d = flight->direction, a = sp_unit(sp_cross(d, fabs(d.x) < 0.6 ? sp_v(1, 0, 0) : sp_v(0, 1, 0)));
    sp_vec3 tangents[2] = {a, sp_cross(d, a)}, step[2];
    for (int k = 0; k < 2; k++) {
        sp_vec3 plus = sp_unit(sp_along(d, h, tangents[k])), minus = sp_unit(sp_along(d, -h, tangents[k]));
        step[k] = sp_sub(through_plane(from, plus, speed, gravity, to, n, flight->time),
                         through_plane(from, minus, speed, gravity, to, n, flight->time));
    }
    return sp_length(sp_cross(step[0], step[1])) / (4 * h * h);
}

static void transfer_is_the_jacobian(void **state)
{
    (void)state;
    sp_vec3 from = sp_v(0, 0, 1), gravities[2] = {down, {0, 0, 0}};
    for (int i = 0; i < 200; i++) {
        double a = 2.1 * i, r = 0.2 + 0.01 * i;
        sp_vec3 to = sp_v(r * cos(a), r * sin(a), 0.004 * i), n = sp_unit(sp_v(0.3 * sin(3.0 * i), 0.4, 1));
        for (int k = 0; k < 2; k++) {
            sp_flight flights[2];
            int count = sp_flights(from, to, 7, gravities[k], flights);
            assert_int_equal(count, k == 0 ? 2 : 1);
            for (int j = 0; j < count; j++) {
                double normal_speed = fabs(sp_dot(n, flights[j].velocity));
                if (normal_speed < 0.1 * sp_length(flights[j].velocity))
                    continue; /* grazing: the differences see the curvature */
                double area = area_per_angle(from, to, 7, gravities[k], n, &flights[j]);
                double transfer = normal_speed / flights[j].spread;
                if (fabs(transfer * area - 1) > 1e-5)
                    fail_msg("target %d: transfer %.9g, differences %.9g", i, transfer, 1 / area);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_arcs_arrive),
        cmocka_unit_test(each_flight_can_be_asked_for_by_itself),
        cmocka_unit_test(nothing_reaches_beyond_the_envelope),
        cmocka_unit_test(a_line_is_the_limit_of_weak_gravity),
        cmocka_unit_test(extremes_keep_their_digits),
        cmocka_unit_test(transfer_is_the_jacobian),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
