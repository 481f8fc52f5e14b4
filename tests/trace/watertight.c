/* Nothing leaves a closed mesh unseen: rays aimed at corners, edges and everything else from inside. With a number as
 * its argument, the program shoots so many lines and so many parabolas instead and counts what it misses. */
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
static void shoot(const sp_mesh *mesh, sp_vec3 centre, double radius, double acceleration, bool convex,
                  random_source *source)
{
    sp_tracer *tracer = make_tracer(mesh, SP_ACCELERATOR_BVH);
    for (size_t i = 0; i < TARGETS; i++) {
        sp_vec3 gravity = sp_v(0, i % 3 == 2 ? acceleration : 0, i % 3 == 2 ? 0 : -acceleration);
        sp_vec3 origin = i % 2 ? sp_add(centre, draw_point(source, 0.5 * radius)) : centre;
        sp_ray ray = aim(origin, draw_target(source, mesh), gravity);
        sp_hit hit = sp_trace_nearest(tracer, &ray, gravity);
        if (!(hit.t <= (convex ? 1 + 1e-9 : 1e9)))
            fail_msg("ray %zu from (%.17g %.17g %.17g) at (%.17g %.17g %.17g), acceleration %g: hit at %g", i, origin.x,
                     origin.y, origin.z, ray.velocity.x, ray.velocity.y, ray.velocity.z, acceleration, hit.t);
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
static sp_mesh *make_tube(void)
{
    enum { N = 360 };
    static sp_vec3 points[2 * N + 2] = {{0, 0, -10}, {0, 0, 10}};
    static uint32_t triangles[4 * N][3];
    for (uint32_t i = 0; i < N; i++) {
        uint32_t a = 2 + i, b = 2 + (i + 1) % N, c = a + N, d = b + N;
        points[a] = sp_v(cos(2 * M_PI * i / N), sin(2 * M_PI * i / N), -10);
        points[c] = sp_v(points[a].x, points[a].y, 10);
        const uint32_t four[4][3] = {{0, b, a}, {1, c, d}, {a, b, d}, {a, d, c}};
        memcpy(triangles[4 * i], four, sizeof four);
    }
    return make_mesh(points, 2 * N + 2, (const uint32_t(*)[3])triangles, 4 * N);
}

static sp_mesh *make_box(void)
{
    static const sp_vec3 box[8] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                   {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    static const uint32_t sides[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                          {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    return make_mesh(box, 8, sides, 12);
}

static void needles(void **state)
{
    (void)state;
    random_source source = {8};
    sp_mesh *mesh = make_tube();
    shoot(mesh, sp_v(0, 0, 0), 1, 0, true, &source);
    shoot(mesh, sp_v(0, 0, 0), 1, 9.81, true, &source);
    sp_mesh_destroy(mesh);
}

/* Straight up and down along edges and through corners of a box, and just beside. */
static void vertical_flights(void **state)
{
    (void)state;
    sp_mesh *mesh = make_box();
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

enum { SHAPES = 6, INSIDE = 64, BATCH = 256 };

/* A closed mesh, its normals outwards, and points inside it. */
typedef struct {
    sp_mesh *mesh;
    sp_tracer *tracer;
    sp_vec3 inside[INSIDE];
    double size; /* m */
} closed;

/* NULL where the file is not here. */
static sp_mesh *make_shape(int i, const char **name)
{
    static const char *const names[SHAPES] = {"ball", "bumpy ball", "tube", "box", "horse", "elephant"};
    static const char *const paths[] = {DATA_DIR "/horse.obj", DATA_DIR "/elephant.obj"};
    *name = names[i];
    if (i < 2)
        return make_ball(48, sp_v(0, 0, 0), 1, i ? 0.2 : 0);
    if (i < 4)
        return i == 2 ? make_tube() : make_box();
    return access(paths[i - 4], R_OK) == 0 ? sp_mesh_load(paths[i - 4], 1, NULL) : NULL;
}

/* Halfway from the middle of a triangle to what lies opposite. */
static void find_inside(closed *shape, random_source *source)
{
    sp_mesh_diagnosis diagnosis;
    assert_true(sp_mesh_diagnose(shape->mesh, &diagnosis, NULL));
    assert_int_equal(diagnosis.closed_shells, 1);
    assert_int_equal(diagnosis.shells, 1);
    shape->size = sp_distance(diagnosis.minimum, diagnosis.maximum);
    for (int i = 0; i < INSIDE; i++) {
        uint32_t triangle = (uint32_t)draw(source, 0, (double)shape->mesh->triangle_count);
        sp_ray ray = make_ray(sp_triangle_point(shape->mesh, triangle, 1.0 / 3, 1.0 / 3),
                              sp_scale(sp_triangle_normal(shape->mesh, triangle), -1));
        ray.skip = triangle;
        sp_hit hit = sp_trace_nearest(shape->tracer, &ray, sp_v(0, 0, 0));
        assert_true(hit.t < shape->size);
        shape->inside[i] = sp_along(ray.origin, 0.5 * hit.t, ray.velocity);
    }
}

/* Whether a ray from inside, aimed to be at its target after one second, is not stopped there or before, or comes
 * through a wall from outside: a flight that brushes an edge of a wall that bulges inwards may go on inside, but leaves
 * in the end. */
static bool slips(const closed *shape, const sp_ray *ray, sp_vec3 gravity, sp_hit hit)
{
    if (hit.triangle == SP_NONE)
        return true;
    sp_vec3 velocity = sp_ray_velocity(ray, gravity, hit.t);
    double outwards = sp_dot(velocity, sp_triangle_normal(shape->mesh, hit.triangle));
    return fabs(hit.t - 1) > 1e-6 && outwards < -1e-6 * sp_length(velocity);
}

/* Rays of one origin, together or one by one. */
static void trace_batch(const closed *shape, const sp_ray rays[BATCH], sp_vec3 gravity, bool together,
                        sp_hit hits[BATCH], bool occluded[BATCH])
{
    if (together) {
        sp_trace_nearest_many(shape->tracer, rays, BATCH, gravity, 1, hits);
        sp_trace_occluded_many(shape->tracer, rays, BATCH, gravity, 1, occluded);
    }
    for (int i = 0; i < BATCH && !together; i++) {
        hits[i] = sp_trace_nearest(shape->tracer, &rays[i], gravity);
        occluded[i] = i % 4 || sp_trace_occluded(shape->tracer, &rays[i], gravity);
    }
}

static size_t count_misses(const closed *shape, size_t shots, bool curved, random_source *source)
{
    static const sp_vec3 along[] = {{0, 0, -1}, {0, 0, -1}, {0, -1, 0}, {0.6, -0.48, 0.64}};
    static const double pulls[] = {1, 0.1, 10, 1e-3, 100};
    size_t misses = 0;
    for (size_t batch = 0; batch * BATCH < shots; batch++) {
        sp_ray rays[BATCH];
        sp_hit hits[BATCH];
        bool occluded[BATCH];
        sp_vec3 gravity = curved ? sp_scale(along[batch % 4], shape->size * pulls[batch % 5]) : sp_v(0, 0, 0);
        sp_vec3 origin = shape->inside[(size_t)draw(source, 0, INSIDE)];
        for (int i = 0; i < BATCH; i++)
            rays[i] = aim(origin, draw_target(source, shape->mesh), gravity);
        trace_batch(shape, rays, gravity, batch % 3 > 0, hits, occluded);
        for (int i = 0; i < BATCH; i++) {
            if (!slips(shape, &rays[i], gravity, hits[i]) && occluded[i])
                continue;
            if (misses++ < 10)
                printf("missed: (%a %a %a) (%a %a %a) acceleration (%a %a %a)\n", origin.x, origin.y, origin.z,
                       rays[i].velocity.x, rays[i].velocity.y, rays[i].velocity.z, gravity.x, gravity.y, gravity.z);
        }
    }
    return misses;
}

/* So many lines and so many parabolas, shared out among the shapes. */
static size_t shoot_shapes(size_t shots, uint64_t seed)
{
    size_t misses = 0;
    random_source source = {seed};
    for (int i = 0; i < SHAPES; i++) {
        const char *name;
        closed shape = {.mesh = make_shape(i, &name)};
        if (!shape.mesh) {
            print_message("no %s here\n", name);
            continue;
        }
        shape.tracer = make_tracer(shape.mesh, SP_ACCELERATOR_BVH);
        find_inside(&shape, &source);
        for (int curved = 0; curved < 2; curved++) {
            size_t missed = count_misses(&shape, shots / SHAPES + 1, curved, &source);
            print_message("%s: %zu of %zu %s missed\n", name, missed, shots / SHAPES + 1,
                          curved ? "parabolas" : "lines");
            misses += missed;
        }
        sp_tracer_destroy(shape.tracer);
        sp_mesh_destroy(shape.mesh);
    }
    return misses;
}

static void from_inside_closed_meshes(void **state)
{
    (void)state;
    assert_int_equal(shoot_shapes(10 * TARGETS, 9), 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls),
        cmocka_unit_test(needles),
        cmocka_unit_test(vertical_flights),
        cmocka_unit_test(from_inside_closed_meshes),
    };
    if (argc > 1) /* how many, and what to begin the random numbers with */
        return shoot_shapes(strtoull(argv[1], NULL, 10), argc > 2 ? strtoull(argv[2], NULL, 10) : 1) > 0;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
