/* Lines and parabolas against planes, balls and what else has a formula. */
#include "shapes.h"

static const sp_vec3 none = {0, 0, 0}, down = {0, 0, -9.81};

/* A square of side 2000 m in the plane through `point` across `normal`. */
static sp_mesh *make_plane(sp_vec3 point, sp_vec3 normal)
{
    sp_vec3 n = sp_unit(normal), a = sp_unit(sp_cross(n, fabs(n.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0))),
            b = sp_cross(n, a);
    sp_vec3 points[4];
    for (int i = 0; i < 4; i++)
        points[i] = sp_along(sp_along(point, i == 0 || i == 3 ? -1000 : 1000, a), i < 2 ? -1000 : 1000, b);
    static const uint32_t triangles[][3] = {{0, 1, 2}, {0, 2, 3}};
    return make_mesh(points, 4, triangles, 2);
}

static sp_hit trace_once(const sp_mesh *mesh, sp_ray ray, sp_vec3 gravity)
{
    sp_tracer *tracer = make_tracer(mesh, SP_ACCELERATOR_BVH);
    sp_hit hit = sp_trace_nearest(tracer, &ray, gravity);
    assert_int_equal(sp_trace_occluded(tracer, &ray, gravity), hit.triangle != SP_NONE);
    sp_tracer_destroy(tracer);
    return hit;
}

/* First positive root of a/2 t² + b t + c, by another way than the tracer's: the textbook's, in extended precision. */
static double first_root(long double a, long double b, long double c)
{
    if (a == 0)
        return -c / b > 0 ? (double)(-c / b) : INFINITY;
    long double d = b * b - 2 * a * c;
    if (d < 0)
        return INFINITY;
    long double one = (-b - sqrtl(d)) / a, two = (-b + sqrtl(d)) / a;
    long double low = one < two ? one : two, high = one < two ? two : one;
    return low > 0 ? (double)low : high > 0 ? (double)high : INFINITY;
}

static void planes_of_every_slope(void **state)
{
    (void)state;
    random_source source = {11};
    size_t hits = 0;
    for (int i = 0; i < 3000; i++) {
        sp_vec3 normal = sp_unit(draw_point(&source, 1)), point = draw_point(&source, 1);
        sp_mesh *mesh = make_plane(point, normal);
        sp_ray ray = make_ray(draw_point(&source, 2), draw_point(&source, 5));
        sp_vec3 gravity = i % 3 == 0 ? none : i % 3 == 1 ? down : draw_point(&source, 10);
        double expected = first_root(sp_dot(gravity, normal), sp_dot(ray.velocity, normal),
                                     sp_dot(sp_sub(ray.origin, point), normal));
        sp_vec3 there = sp_ray_point(&ray, gravity, expected);
        if (expected == INFINITY || sp_distance(there, point) < 990) { /* where the square is the plane */
            sp_hit hit = trace_once(mesh, ray, gravity);
            if (expected == INFINITY)
                assert_true(hit.t == INFINITY && hit.triangle == SP_NONE);
            else
                assert_true(fabs(hit.t - expected) <=
                            1e-11 * (1 + expected) /
                                fmin(1, fabs(sp_dot(sp_unit(sp_ray_velocity(&ray, gravity, expected)), normal))));
            hits += expected < INFINITY;
        }
        sp_mesh_destroy(mesh);
    }
    assert_true(hits > 1000);
}

/* Up through a ceiling that is just too high, just low enough, and down on the floor. */
static void apex_at_the_ceiling(void **state)
{
    (void)state;
    double speed = 7, apex = speed * speed / (2 * 9.81);
    static const double gaps[] = {1e-3, 1e-6, 1e-9, -1e-9, -1e-6, -1e-3};
    for (int i = 0; i < 6; i++) {
        sp_mesh *mesh = make_plane(sp_v(0, 0, apex + gaps[i]), sp_v(0, 0, 1));
        for (int k = 0; k < 3; k++) {
            sp_ray ray = make_ray(sp_v(0.1, 0.2, 0), sp_v(k, 0.5 * k, speed));
            sp_hit hit = trace_once(mesh, ray, down);
            assert_int_equal(hit.triangle != SP_NONE, gaps[i] < 0);
            if (gaps[i] < 0)
                assert_true(fabs(speed / 9.81 - sqrt(-2 * gaps[i] / 9.81) - hit.t) < 1e-8);
        }
        sp_mesh_destroy(mesh);
    }
}

static void thrown_up_it_comes_down(void **state)
{
    (void)state;
    sp_mesh *floor = make_plane(sp_v(0, 0, -1), sp_v(0, 0, 1));
    for (int k = -6; k <= 6; k++) {
        double up = pow(10, k / 2.0);
        sp_hit hit = trace_once(floor, make_ray(sp_v(0.1, 0.2, 0), sp_v(0, 0, up)), down);
        double expected = (up + sqrt(up * up + 2 * 9.81)) / 9.81;
        assert_true(fabs(hit.t - expected) < 1e-13 * expected);
    }
    /* An acceleration so weak that the coefficient is next to nothing: as a line. */
    sp_ray ray = make_ray(sp_v(0, 0, 0), sp_v(0.5, 0.1, -2));
    for (int k = 0; k < 40; k++) {
        double acceleration = pow(10, -8 * k);
        sp_hit hit = trace_once(floor, ray, sp_v(0, 0, -acceleration));
        assert_true(fabs(hit.t - 2 / (2 + sqrt(4 + 2 * acceleration))) < 1e-15);
    }
    sp_mesh_destroy(floor);
}

static void times_are_strict_and_skip_is_skipped(void **state)
{
    (void)state;
    sp_mesh *mesh = make_plane(sp_v(0, 0, 1), sp_v(0, 0, 1));
    for (int curved = 0; curved < 2; curved++) {
        sp_vec3 gravity = curved ? sp_v(0, 0, 1e-3) : none;
        sp_ray ray = make_ray(sp_v(0.25, 0.5, 0), sp_v(0, 0, 2));
        sp_hit hit = trace_once(mesh, ray, gravity);
        assert_true(hit.triangle != SP_NONE);
        sp_ray other = ray;
        other.t_max = hit.t;
        assert_int_equal(trace_once(mesh, other, gravity).triangle, SP_NONE);
        other.t_max = nextafter(hit.t, 1);
        assert_int_equal(trace_once(mesh, other, gravity).triangle, hit.triangle);
        other = ray;
        other.t_min = hit.t;
        assert_int_equal(trace_once(mesh, other, gravity).triangle, SP_NONE);
        other.t_min = nextafter(hit.t, 0);
        assert_int_equal(trace_once(mesh, other, gravity).triangle, hit.triangle);
        other = ray;
        other.skip = hit.triangle;
        assert_int_equal(trace_once(mesh, other, gravity).triangle, SP_NONE);
        other.skip = 1 - hit.triangle;
        assert_int_equal(trace_once(mesh, other, gravity).triangle, hit.triangle);
        other = ray;
        other.origin.z = 2; /* the plane lies behind */
        assert_int_equal(trace_once(mesh, other, gravity).triangle, SP_NONE);
        other.t_min = -INFINITY;
        assert_true(fabs(trace_once(mesh, other, none).t + 0.5) < 1e-15);
    }
    sp_mesh_destroy(mesh);
}

/* A flight that leaves a triangle's plane and returns to it: the same triangle, at the second root. */
static void second_root_of_the_same_triangle(void **state)
{
    (void)state;
    sp_mesh *mesh = make_plane(sp_v(0, 0, 0), sp_v(0, 0, 1));
    sp_ray ray = make_ray(sp_v(-300, 100, 0), sp_v(50, -20, 30));
    ray.t_min = 1e-9;
    sp_hit hit = trace_once(mesh, ray, down);
    assert_true(fabs(hit.t - 60 / 9.81) < 1e-12);
    sp_mesh_destroy(mesh);
}

static void of_equal_times_the_lowest_number(void **state)
{
    (void)state;
    static const sp_vec3 points[] = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    static const uint32_t triangles[][3] = {{2, 3, 0}, {2, 3, 0}, {0, 1, 2}, {1, 2, 0}, {0, 2, 3}};
    sp_mesh *mesh = make_mesh(points, 4, triangles, 5);
    for (int curved = 0; curved < 2; curved++) {
        sp_vec3 gravity = curved ? sp_v(0, 0, -1) : none;
        sp_ray ray = make_ray(sp_v(0.75, 0.25, 0), sp_v(0, 0, 4));
        assert_int_equal(trace_once(mesh, ray, gravity).triangle, 2);
        ray.skip = 2;
        assert_int_equal(trace_once(mesh, ray, gravity).triangle, 3);
        ray = make_ray(sp_v(0.5, 0.5, 0), sp_v(0, 0, 4)); /* on the diagonal, in all */
        assert_int_equal(trace_once(mesh, ray, gravity).triangle, 0);
    }
    sp_mesh_destroy(mesh);
}

static void weights_are_of_the_second_and_third_corner(void **state)
{
    (void)state;
    static const sp_vec3 points[] = {{3, 0, 1}, {0, 4, 2}, {-1, -2, 5}};
    static const uint32_t triangle[][3] = {{0, 1, 2}};
    sp_mesh *mesh = make_mesh(points, 3, triangle, 1);
    for (int i = 0; i < 100; i++) {
        double u = (i % 10 + 0.5) / 20, v = (i / 10 + 0.5) / 20;
        sp_vec3 target = sp_triangle_point(mesh, 0, u, v), origin = sp_v(0.3, 0.2, 20), gravity = i % 2 ? none : down;
        sp_ray ray = make_ray(origin, sp_along(sp_sub(target, origin), -0.5, gravity)); /* there after one second */
        sp_hit hit = trace_once(mesh, ray, gravity);
        assert_true(fabs(hit.u - u) < 1e-12 && fabs(hit.v - v) < 1e-12 && fabs(hit.t - 1) < 1e-12);
    }
    sp_mesh_destroy(mesh);
}

/* A fine ball lies within its own sagitta of the sphere: radius (1 - cos(pi/n)) is the most that a facet is inside. */
static void a_ball_is_nearly_a_sphere(void **state)
{
    (void)state;
    enum { N = 200 };
    double radius = 2, sagitta = radius * (1 - cos(1.5 * M_PI / N));
    sp_mesh *mesh = make_ball(N, sp_v(0, 0, 0), radius, 0);
    sp_tracer *tracer = make_tracer(mesh, SP_ACCELERATOR_BVH);
    random_source source = {13};
    for (int i = 0; i < 5000; i++) {
        sp_vec3 gravity = i % 2 ? none : down;
        sp_ray ray = make_ray(draw_point(&source, 0.9), draw_point(&source, 4));
        sp_hit hit = sp_trace_nearest(tracer, &ray, gravity);
        double distance = sp_length(sp_ray_point(&ray, gravity, hit.t));
        assert_true(distance < radius + 1e-9 && distance > radius - sagitta);
        for (int k = 1; k < 20; k++) /* and not outside before */
            assert_true(sp_length(sp_ray_point(&ray, gravity, hit.t * k / 20)) < radius + 1e-9);
    }
    sp_tracer_destroy(tracer);
    sp_mesh_destroy(mesh);
}

/* From 1000 km away, lines still find the millimetre that they are aimed at. */
static void from_far_away(void **state)
{
    (void)state;
    sp_mesh *mesh = make_ball(16, sp_v(0, 0, 0), 1, 0);
    sp_tracer *tracer = make_tracer(mesh, SP_ACCELERATOR_BVH);
    random_source source = {17};
    for (int i = 0; i < 1000; i++) {
        sp_vec3 origin = sp_scale(sp_unit(draw_point(&source, 1)), 1e6), target = draw_point(&source, 0.5);
        sp_ray ray = make_ray(origin, sp_sub(target, origin));
        sp_hit hit = sp_trace_nearest(tracer, &ray, none);
        assert_true(hit.t < 1 && hit.t > 1 - 2e-6);
        sp_vec3 aside = sp_unit(sp_cross(ray.velocity, sp_v(0, 0, 1)));
        ray.origin = sp_along(ray.origin, 2, aside);
        assert_false(sp_trace_occluded(tracer, &ray, none));
    }
    sp_tracer_destroy(tracer);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_of_every_slope),
        cmocka_unit_test(apex_at_the_ceiling),
        cmocka_unit_test(thrown_up_it_comes_down),
        cmocka_unit_test(times_are_strict_and_skip_is_skipped),
        cmocka_unit_test(second_root_of_the_same_triangle),
        cmocka_unit_test(of_equal_times_the_lowest_number),
        cmocka_unit_test(weights_are_of_the_second_and_third_corner),
        cmocka_unit_test(a_ball_is_nearly_a_sphere),
        cmocka_unit_test(from_far_away),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
