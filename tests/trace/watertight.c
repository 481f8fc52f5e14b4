/* Nothing leaves a closed mesh unseen: rays aimed at corners, edges and everything else from inside. */
#include "shapes.h"

#ifdef SPRAYPLAN_SANITIZE
enum { TARGETS = 400 };
#else
enum { TARGETS = 8000 };
#endif

/* From `origin` at `target` after one second. */
static sp_ray aim(sp_vec3 origin, sp_vec3 target, sp_vec3 gravity)
{
    return make_ray(origin, sp_along(sp_sub(target, origin), -0.5, gravity));
}

/* A corner, a point of an edge, or one near it. */
static sp_vec3 draw_target(random_source *source, const sp_mesh *mesh)
{
    uint32_t triangle = (uint32_t)draw(source, 0, (double)mesh->triangle_count);
    double kind = draw(source, 0, 1), u = draw(source, 0, 1);
    if (kind < 0.3)
        return mesh->vertices[mesh->triangles[triangle][0]];
    if (kind < 0.6)
        return sp_triangle_point(mesh, triangle, u, 0);
    if (kind < 0.8)
        return sp_triangle_point(mesh, triangle, u, 1 - u);
    return sp_triangle_point(mesh, triangle, u, 1e-15 * draw(source, -1, 1));
}

/* `convex`: nothing can be passed on the way, so that the target is hit or what is before it. */
static void shoot(const sp_mesh *mesh, sp_vec3 centre, double radius, double pull, bool convex, random_source *source)
{
    sp_tracer *tracer = make_tracer(mesh, SP_ACCELERATOR_BVH);
    for (size_t i = 0; i < TARGETS; i++) {
        sp_vec3 gravity = sp_v(0, i % 3 == 2 ? pull : 0, i % 3 == 2 ? 0 : -pull);
        sp_vec3 origin = i % 2 ? sp_add(centre, draw_point(source, 0.5 * radius)) : centre;
        sp_ray ray = aim(origin, draw_target(source, mesh), gravity);
        sp_hit hit = sp_trace_nearest(tracer, &ray, gravity);
        if (!(hit.t <= (convex ? 1 + 1e-9 : 1e9)))
            fail_msg("ray %zu from (%.17g %.17g %.17g) at (%.17g %.17g %.17g), pull %g: hit at %g", i, origin.x,
                     origin.y, origin.z, ray.velocity.x, ray.velocity.y, ray.velocity.z, pull, hit.t);
        assert_true(sp_trace_occluded(tracer, &ray, gravity));
    }
    sp_tracer_destroy(tracer);
}

static void balls(void **state)
{
    (void)state;
    static const double radii[] = {1e-6, 1, 1e6};
    random_source source = {7};
    for (int i = 0; i < 12; i++) {
        double radius = radii[i % 3];
        sp_vec3 centre = i < 6 ? sp_v(0, 0, 0) : sp_v(300 * radius, -200 * radius, 100 * radius);
        double bumps = i % 4 < 2 ? 0 : 0.2;
        sp_mesh *mesh = make_ball(i % 2 ? 12 : 48, centre, radius, bumps);
        shoot(mesh, centre, radius, 0, bumps == 0, &source);
        shoot(mesh, centre, radius, 9.81 * radius, bumps == 0, &source);
        shoot(mesh, centre, radius, 1e-3 * radius, bumps == 0, &source);
        shoot(mesh, centre, radius, 100 * radius, bumps == 0, &source);
        sp_mesh_destroy(mesh);
    }
}

/* A tall narrow tube: long thin triangles, as CAD programs make them. */
static void needles(void **state)
{
    (void)state;
    enum { N = 360 };
    sp_vec3 points[2 * N + 2] = {{0, 0, -10}, {0, 0, 10}};
    uint32_t triangles[4 * N][3];
    for (uint32_t i = 0; i < N; i++) {
        uint32_t a = 2 + i, b = 2 + (i + 1) % N, c = a + N, d = b + N;
        points[a] = sp_v(cos(2 * M_PI * i / N), sin(2 * M_PI * i / N), -10);
        points[c] = sp_v(points[a].x, points[a].y, 10);
        const uint32_t four[4][3] = {{0, b, a}, {1, c, d}, {a, b, d}, {a, d, c}};
        memcpy(triangles[4 * i], four, sizeof four);
    }
    random_source source = {8};
    sp_mesh *mesh = make_mesh(points, 2 * N + 2, (const uint32_t(*)[3])triangles, 4 * N);
    shoot(mesh, sp_v(0, 0, 0), 1, 0, true, &source);
    shoot(mesh, sp_v(0, 0, 0), 1, 9.81, true, &source);
    sp_mesh_destroy(mesh);
}

/* Straight up and down along edges and through corners of a box, and just beside. */
static void vertical_flights(void **state)
{
    (void)state;
    static const sp_vec3 box[8] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                   {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    static const uint32_t sides[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                          {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    sp_mesh *mesh = make_mesh(box, 8, sides, 12);
    sp_tracer *tracer = make_tracer(mesh, SP_ACCELERATOR_BVH);
    for (int i = 0; i < 81; i++) {
        double x = (i % 9 - 4) / 4.0, y = (i / 9 - 4) / 4.0;
        for (int k = 0; k < 6; k++) {
            static const double inwards[] = {0, -1e-17, -1e-9, -1e-300, -1e-12, -5e-324};
            double inward = inwards[k];
            sp_ray up = make_ray(sp_v(x, y, 0), sp_v(x < 0 ? -inward : inward, y < 0 ? -inward : inward, 3));
            sp_vec3 gravity = sp_v(0, 0, -9.81);
            sp_hit fallen = sp_trace_nearest(tracer, &up, gravity), line = sp_trace_nearest(tracer, &up, sp_v(0, 0, 0));
            /* On the walls the flight is in their planes: only floor and ceiling stop it. */
            assert_true(fabs(line.t - 1.0 / 3) < 1e-6 || fabs(x) == 1 || fabs(y) == 1);
            assert_true(fabs(fallen.t - (3 + sqrt(9 + 2 * 9.81)) / 9.81) < 1e-6 || fabs(x) == 1 || fabs(y) == 1);
            assert_true(fallen.triangle != SP_NONE && line.triangle != SP_NONE);
        }
    }
    sp_tracer_destroy(tracer);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls),
        cmocka_unit_test(needles),
        cmocka_unit_test(vertical_flights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
