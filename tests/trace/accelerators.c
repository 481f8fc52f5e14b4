/* All accelerators, with all instructions, give the same answers to the last bit, for rays of every kind. */
#include "shapes.h"

#include "trace/bvh/instructions.h"

#ifdef SPRAYPLAN_SANITIZE
enum { RAYS = 300 };
#else
enum { RAYS = 3000 };
#endif

static const double scales[] = {1e-6, 1, 1e6};

/* Triangles of all sizes, some long and thin, some lying across an axis, some twice. */
static sp_mesh *random_triangles(random_source *source, size_t count, double scale, sp_vec3 offset)
{
    sp_vec3 *points = malloc(3 * count * sizeof *points);
    uint32_t(*triangles)[3] = malloc(count * sizeof *triangles);
    assert_non_null(points);
    assert_non_null(triangles);
    for (size_t t = 0; t < count; t++) {
        double size = pow(10, draw(source, -3, 0)), thin = draw(source, 0, 1) < 0.3 ? 1e-4 : 1;
        sp_vec3 p = draw_point(source, 1), a = draw_point(source, size), b = draw_point(source, size * thin);
        double kind = draw(source, 0, 1);
        if (kind < 0.3)
            a.z = b.z = 0;
        if (kind < 0.1)
            p.z = floor(4 * p.z) / 4;
        sp_vec3 corners[3] = {p, sp_add(p, a), sp_add(p, b)};
        for (int i = 0; i < 3; i++) {
            points[3 * t + (size_t)i] = sp_along(offset, scale, corners[i]);
            triangles[t][i] = (uint32_t)(3 * (kind > 0.95 && t ? t - 1 : t)) + (uint32_t)i;
        }
    }
    sp_mesh *mesh = make_mesh(points, 3 * count, (const uint32_t(*)[3])triangles, count);
    free(points);
    free(triangles);
    return mesh;
}

/* n³ little cubes' worth of axis-parallel squares: every plane a candidate, every tie there is. */
static sp_mesh *lattice(uint32_t n, double scale, sp_vec3 offset)
{
    size_t count = 0, room = 6 * (size_t)(n + 1) * n * n;
    uint32_t m = n + 1;
    sp_vec3 *points = malloc((size_t)m * m * m * sizeof *points);
    uint32_t(*triangles)[3] = malloc(room * sizeof *triangles);
    assert_non_null(points);
    assert_non_null(triangles);
    for (uint32_t i = 0; i < m * m * m; i++)
        points[i] = sp_along(offset, scale / n, sp_v(i % m, i / m % m, i / m / m));
    for (uint32_t i = 0; i < m * m * m; i++)
        for (int axis = 0; axis < 3; axis++) {
            static const int other[3][2] = {{1, 2}, {0, 2}, {0, 1}};
            uint32_t place[3] = {i % m, i / m % m, i / m / m}, stride[3] = {1, m, m * m};
            if (place[other[axis][0]] == n || place[other[axis][1]] == n)
                continue;
            uint32_t u = stride[other[axis][0]], v = stride[other[axis][1]];
            memcpy(triangles[count++], (uint32_t[]){i, i + u, i + u + v}, sizeof *triangles);
            memcpy(triangles[count++], (uint32_t[]){i, i + u + v, i + v}, sizeof *triangles);
        }
    assert_true(count <= room);
    sp_mesh *mesh = make_mesh(points, (size_t)m * m * m, (const uint32_t(*)[3])triangles, count);
    free(points);
    free(triangles);
    return mesh;
}

/* From anywhere in or around the mesh, a corner or an edge, towards the same, or along axes; any span of time. */
static sp_ray draw_ray(random_source *source, const sp_mesh *mesh, double scale, sp_vec3 offset, double time)
{
    sp_vec3 ends[2];
    for (int i = 0; i < 2; i++) {
        double kind = draw(source, 0, 1);
        uint32_t triangle = (uint32_t)draw(source, 0, (double)mesh->triangle_count);
        double u = draw(source, 0, 1), w = kind < 0.4 ? draw(source, 0, 1 - u) : 0;
        ends[i] = sp_along(offset, scale, draw_point(source, kind < 0.55 ? 1 : 3));
        if (kind < 0.5)
            ends[i] = sp_triangle_point(mesh, triangle, kind < 0.2 ? 0 : u, w);
    }
    sp_ray ray = make_ray(ends[0], sp_scale(sp_sub(ends[1], ends[0]), 1 / time));
    double kind = draw(source, 0, 1), away = draw(source, 0, 1);
    if (away < 0.1) /* from afar */
        ray.origin = sp_along(ray.origin, -time * pow(10, draw(source, 0, 6.5)), ray.velocity);
    if (kind < 0.3)
        ray.velocity.x = 0;
    if (kind < 0.1 || kind > 0.9)
        ray.velocity.y = 0;
    if (kind > 0.8)
        ray.velocity.z = 0;
    if (kind > 0.5 && kind < 0.55)
        ray.velocity = sp_v(1e-17 * scale, -1e-19 * scale, kind < 0.52 ? scale : -scale);
    if (kind > 0.6 && kind < 0.7)
        ray.t_max = draw(source, 0, 2 * time);
    if (kind > 0.65 && kind < 0.75)
        ray.t_min = draw(source, -time, time);
    if (kind > 0.72 && kind < 0.78)
        ray.skip = (uint32_t)draw(source, 0, (double)mesh->triangle_count);
    return ray;
}

static void assert_same(sp_hit a, sp_hit b, const char *what)
{
    if (a.t != b.t || a.triangle != b.triangle || a.u != b.u || a.v != b.v)
        fail_msg("%s: %.17g at %u (%.17g, %.17g) but without a tree %.17g at %u (%.17g, %.17g)", what, a.t, a.triangle,
                 a.u, a.v, b.t, b.triangle, b.u, b.v);
}

static void assert_sound(const sp_mesh *mesh, const sp_ray *ray, sp_vec3 gravity, sp_hit hit, double scale)
{
    if (hit.triangle == SP_NONE) {
        assert_true(hit.t == INFINITY);
        return;
    }
    assert_true(hit.triangle < mesh->triangle_count && hit.triangle != ray->skip);
    assert_true(hit.t > ray->t_min && hit.t < ray->t_max);
    assert_true(hit.u >= 0 && hit.v >= 0 && hit.u + hit.v <= 1 + 1e-15);
    sp_vec3 on_ray = sp_ray_point(ray, gravity, hit.t),
            on_triangle = sp_triangle_point(mesh, hit.triangle, hit.u, hit.v);
    double way = sp_length(ray->velocity) * fabs(hit.t) + sp_length(gravity) * hit.t * hit.t + sp_length(on_triangle);
    if (sp_distance(on_ray, on_triangle) > 1e-6 * (way + scale))
        fail_msg("the hit is %g off its triangle, scale %g", sp_distance(on_ray, on_triangle), scale);
}

static const char *const instruction_names[SP_INSTRUCTIONS_COUNT] = {"bvh, portable", "bvh, AVX2", "bvh, AVX-512"};

static void compare(const sp_mesh *mesh, random_source *source, double scale, sp_vec3 offset, size_t count)
{
    sp_tracer *sah = make_tracer(mesh, SP_ACCELERATOR_SAH), *naive = make_tracer(mesh, SP_ACCELERATOR_NAIVE);
    sp_tracer *none = make_tracer(mesh, SP_ACCELERATOR_NONE), *bvh = make_tracer(mesh, SP_ACCELERATOR_BVH);
    size_t hits = 0;
    for (size_t i = 0; i < count; i++) {
        static const sp_vec3 pulls[] = {{0, 0, 0},    {0, 0, -9.81}, {0, 0, -1e-9},
                                        {0, 9.81, 0}, {3, -5, 7},    {0, 0, -9.81}};
        sp_vec3 gravity = sp_scale(pulls[i % 6], scale);
        sp_ray ray = draw_ray(source, mesh, scale, offset, i % 2 ? 1 : 0.1);
        sp_hit expected = sp_trace_nearest(none, &ray, gravity);
        assert_same(sp_trace_nearest(sah, &ray, gravity), expected, "sah");
        assert_same(sp_trace_nearest(naive, &ray, gravity), expected, "naive");
        bool occluded = expected.triangle != SP_NONE;
        for (int set = 0; set < SP_INSTRUCTIONS_COUNT; set++) {
            if (!sp_instructions_available((sp_instructions)set))
                continue;
            sp_tracer_use(bvh, (sp_instructions)set);
            assert_same(sp_trace_nearest(bvh, &ray, gravity), expected, instruction_names[set]);
            assert_int_equal(sp_trace_occluded(bvh, &ray, gravity), occluded);
        }
        assert_int_equal(sp_trace_occluded(sah, &ray, gravity), occluded);
        assert_int_equal(sp_trace_occluded(naive, &ray, gravity), occluded);
        assert_int_equal(sp_trace_occluded(none, &ray, gravity), occluded);
        assert_sound(mesh, &ray, gravity, expected, scale);
        hits += occluded;
    }
    assert_true(hits > count / 10);
    sp_tracer_destroy(sah);
    sp_tracer_destroy(naive);
    sp_tracer_destroy(none);
    sp_tracer_destroy(bvh);
}

/* Rays of one origin, which go through the hierarchy together: all kinds of them, and some that end or begin right at
 * a hit. */
static void compare_common_origin(const sp_mesh *mesh, random_source *source, double scale, sp_vec3 offset,
                                  size_t count)
{
    static const sp_vec3 no_pull = {0, 0, 0};
    sp_tracer *none = make_tracer(mesh, SP_ACCELERATOR_NONE), *bvh = make_tracer(mesh, SP_ACCELERATOR_BVH);
    sp_ray *rays = calloc(count, sizeof *rays);
    sp_hit *hits = calloc(count, sizeof *hits), *expected = calloc(count, sizeof *expected);
    bool *occluded = calloc(count, sizeof *occluded);
    assert_true(rays && hits && expected && occluded);
    sp_vec3 origin = draw_ray(source, mesh, scale, offset, 1).origin;
    for (size_t i = 0; i < count; i++) {
        rays[i] = draw_ray(source, mesh, scale, offset, 1);
        rays[i].velocity = sp_sub(sp_along(rays[i].origin, 1, rays[i].velocity), origin);
        rays[i].origin = origin;
        rays[i].t_min = fmax(0, rays[i].t_min);
        double kind = draw(source, 0, 1);
        double t = kind < 0.2 ? sp_trace_nearest(none, &rays[i], no_pull).t : INFINITY;
        if (t < INFINITY && kind < 0.1)
            rays[i].t_max = kind < 0.05 ? t : nextafter(t, INFINITY);
        else if (t < INFINITY)
            rays[i].t_min = kind < 0.15 ? t : nextafter(t, 0);
        expected[i] = sp_trace_nearest(none, &rays[i], no_pull);
    }
    for (int set = 0; set < SP_INSTRUCTIONS_COUNT; set++) {
        if (!sp_instructions_available((sp_instructions)set))
            continue;
        sp_tracer_use(bvh, (sp_instructions)set);
        sp_trace_nearest_many(bvh, rays, count, no_pull, 2, hits);
        sp_trace_occluded_many(bvh, rays, count, no_pull, 1, occluded);
        for (size_t i = 0; i < count; i++) {
            assert_same(hits[i], expected[i], instruction_names[set]);
            assert_int_equal(occluded[i], expected[i].triangle != SP_NONE);
            assert_same(sp_trace_nearest(bvh, &rays[i], no_pull), expected[i], instruction_names[set]);
        }
    }
    free(rays);
    free(hits);
    free(expected);
    free(occluded);
    sp_tracer_destroy(none);
    sp_tracer_destroy(bvh);
}

static void random_meshes(void **state)
{
    (void)state;
    random_source source = {1};
    for (size_t i = 0; i < 12; i++) {
        double scale = scales[i % 3];
        sp_vec3 offset = i < 6 ? sp_v(0, 0, 0) : sp_v(100 * scale, -1000 * scale, 10 * scale);
        sp_mesh *mesh = random_triangles(&source, i % 2 ? 40 : 700, scale, offset);
        compare(mesh, &source, scale, offset, RAYS);
        for (int round = 0; round < 5; round++)
            compare_common_origin(mesh, &source, scale, offset, RAYS / 2);
        sp_mesh_destroy(mesh);
    }
}

static void lattices(void **state)
{
    (void)state;
    random_source source = {2};
    for (size_t i = 0; i < 3; i++) {
        sp_vec3 offset = sp_v(-0.5 * scales[i], -0.25 * scales[i], 0);
        sp_mesh *mesh = lattice(5, scales[i], offset);
        compare(mesh, &source, scales[i], offset, RAYS);
        for (int round = 0; round < 5; round++)
            compare_common_origin(mesh, &source, scales[i], offset, RAYS / 2);
        sp_mesh_destroy(mesh);
    }
}

static void needles_around_a_vertex(void **state)
{
    (void)state;
    enum { N = 500 };
    sp_vec3 points[N + 1] = {{0, 0, 0}};
    uint32_t triangles[N][3];
    for (uint32_t i = 0; i < N; i++) {
        points[i + 1] = sp_v(cos(2 * M_PI * i / N), sin(2 * M_PI * i / N), 0.1 * (i % 2));
        memcpy(triangles[i], (uint32_t[]){0, i + 1, (i + 1) % N + 1}, sizeof *triangles);
    }
    random_source source = {3};
    sp_mesh *mesh = make_mesh(points, N + 1, (const uint32_t(*)[3])triangles, N);
    compare(mesh, &source, 1, sp_v(0, 0, 0), RAYS);
    for (int round = 0; round < 5; round++)
        compare_common_origin(mesh, &source, 1, sp_v(0, 0, 0), RAYS);
    sp_mesh_destroy(mesh);
}

static void one_triangle_and_none(void **state)
{
    (void)state;
    static const sp_vec3 points[] = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    static const uint32_t triangle[][3] = {{0, 1, 2}};
    for (size_t count = 0; count < 2; count++) {
        sp_mesh *mesh = make_mesh(points, 3, triangle, count);
        for (int a = SP_ACCELERATOR_BVH; a <= SP_ACCELERATOR_NONE; a++) {
            sp_tracer *tracer = make_tracer(mesh, (sp_accelerator)a);
            sp_ray ray = make_ray(sp_v(0.25, 0.25, 0), sp_v(0, 0, 2));
            assert_int_equal(sp_trace_nearest(tracer, &ray, sp_v(0, 0, 0)).triangle, count ? 0 : SP_NONE);
            assert_int_equal(sp_trace_occluded(tracer, &ray, sp_v(0, 0, -1)), count == 1);
            assert_ptr_equal(sp_tracer_mesh(tracer), mesh);
            assert_true(sp_tracer_bytes(tracer) > 0);
            sp_tracer_destroy(tracer);
        }
        sp_mesh_destroy(mesh);
    }
    assert_null(sp_tracer_create(NULL, SP_ACCELERATOR_SAH, 0, NULL));
    sp_tracer_destroy(NULL);
}

/* Rays that are no rays hit nothing and do no harm. */
static void nonsense_hits_nothing(void **state)
{
    (void)state;
    static const double odd[] = {NAN, INFINITY, -INFINITY, 1e308, -1e308, 5e-324, 0};
    sp_mesh *mesh = make_ball(16, sp_v(0, 0, 0), 1, 0.1);
    for (int a = SP_ACCELERATOR_BVH; a <= SP_ACCELERATOR_NONE; a++) {
        sp_tracer *tracer = make_tracer(mesh, (sp_accelerator)a);
        for (size_t i = 0; i < 7 * 7 * 7 * 3; i++) {
            double x = odd[i % 7], y = odd[i / 7 % 7], z = odd[i / 49 % 7];
            sp_vec3 gravity = sp_v(0, 0, i % 2 ? -9.81 : 0), odd_vector = sp_v(x, y, z);
            sp_ray ray = make_ray(sp_v(0.1, 0.2, 0.3), sp_v(1, 2, 3));
            *(i / 343 == 0 ? &ray.origin : i / 343 == 1 ? &ray.velocity : &gravity) = odd_vector;
            sp_hit hit = sp_trace_nearest(tracer, &ray, gravity);
            assert_true(hit.triangle == SP_NONE ? hit.t == INFINITY : isfinite(hit.t));
        }
        sp_ray still = make_ray(sp_v(0, 0, 0), sp_v(0, 0, 0));
        assert_false(sp_trace_occluded(tracer, &still, sp_v(0, 0, 0)));
        assert_true(sp_trace_occluded(tracer, &still, sp_v(0, 0, -9.81)));
        sp_tracer_destroy(tracer);
    }
    sp_mesh_destroy(mesh);
}

static void the_horse(void **state)
{
    (void)state;
    static const char path[] = DATA_DIR "/horse.obj";
    if (access(path, R_OK) != 0) {
        print_message("no %s here\n", path);
        skip();
    }
    sp_mesh *mesh = sp_mesh_load(path, 1, NULL);
    assert_non_null(mesh);
    assert_int_equal(mesh->triangle_count, 39698);
    random_source source = {4};
    compare(mesh, &source, 0.5, sp_v(0, 0, 0), RAYS / 20);
    compare_common_origin(mesh, &source, 0.5, sp_v(0, 0, 0), RAYS / 3);
    sp_mesh_destroy(mesh);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    enum { COUNT = 5000 };
    sp_ray *rays = calloc(COUNT, sizeof *rays);
    sp_hit *hits[2] = {calloc(COUNT, sizeof **hits), calloc(COUNT, sizeof **hits)};
    bool *occluded[2] = {calloc(COUNT, sizeof **occluded), calloc(COUNT, sizeof **occluded)};
    assert_true(rays && hits[0] && hits[1] && occluded[0] && occluded[1]);
    sp_mesh *mesh = make_ball(40, sp_v(0, 0, 0), 1, 0.3);
    sp_tracer *tracer = make_tracer(mesh, SP_ACCELERATOR_BVH);
    random_source source = {5};
    for (size_t i = 0; i < COUNT; i++)
        rays[i] = draw_ray(&source, mesh, 1, sp_v(0, 0, 0), 1);
    for (int curved = 0; curved < 2; curved++) {
        sp_vec3 gravity = sp_v(0, 0, -5.0 * curved);
        for (int i = 0; i < 2; i++) {
            sp_trace_nearest_many(tracer, rays, COUNT, gravity, i ? 7 : 1, hits[i]);
            sp_trace_occluded_many(tracer, rays, COUNT, gravity, i ? 0 : 1, occluded[i]);
        }
        for (size_t i = 0; i < COUNT; i++) {
            assert_same(hits[1][i], hits[0][i], "threads");
            assert_same(sp_trace_nearest(tracer, &rays[i], gravity), hits[0][i], "one by one");
            assert_int_equal(occluded[0][i], occluded[1][i]);
        }
    }
    sp_tracer_destroy(tracer);
    sp_mesh_destroy(mesh);
    for (int i = 0; i < 2; i++) {
        free(hits[i]);
        free(occluded[i]);
    }
    free(rays);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_meshes),           cmocka_unit_test(lattices),
        cmocka_unit_test(needles_around_a_vertex), cmocka_unit_test(one_triangle_and_none),
        cmocka_unit_test(nonsense_hits_nothing),   cmocka_unit_test(the_horse),
        cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
