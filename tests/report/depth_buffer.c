/* What each sample of a picture shows, against lines of sight that are traced one by one. */
#include "report/depth_buffer.h"
#include <sprayplan/trace.h>

#include "../atlas/shapes.h"

#define TRIANGLES 3000
#define WIDTH 90
#define HEIGHT 70
#define SAMPLES ((size_t)4 * WIDTH * HEIGHT)

/* Looks through a third of the triangles, and through the half next to the first corner of another third, from the
 * back only. */
static uint32_t look(const void *user, uint32_t triangle, double u, double v, int back)
{
    (void)user;
    if (triangle % 3 == 0 || (triangle % 3 == 1 && back && u + v < 0.5))
        return SP_LOOK_NOTHING;
    return 2 * triangle + (uint32_t)back;
}

static uint32_t look_at_all(const void *user, uint32_t triangle, double u, double v, int back)
{
    (void)user, (void)u, (void)v, (void)back;
    return triangle;
}

static sp_vec3 random_point(uint64_t *seed, double reach)
{
    double x = random_number(seed), y = random_number(seed), z = random_number(seed);
    return sp_v(reach * (2 * x - 1), reach * (2 * y - 1), reach * (2 * z - 1));
}

/* Small and large triangles about the eye: before, beside, behind and around it. */
static sp_mesh *soup(void)
{
    static sp_vec3 vertices[3 * TRIANGLES];
    static uint32_t triangles[TRIANGLES][3];
    uint64_t seed = 7;
    for (uint32_t t = 0; t < TRIANGLES; ++t) {
        sp_vec3 middle = random_point(&seed, 3);
        for (uint32_t k = 0; k < 3; ++k) {
            vertices[3 * t + k] = sp_add(middle, random_point(&seed, t % 50 ? 0.2 : 2));
            triangles[t][k] = 3 * t + k;
        }
    }
    return mesh_of(vertices, 3 * TRIANGLES, (const uint32_t(*)[3])triangles, TRIANGLES);
}

static sp_camera camera_at(sp_vec3 eye, bool cut)
{
    sp_vec3 forward = sp_unit(sp_v(0.3, 1, -0.2)), right = sp_unit(sp_cross(forward, sp_v(0, 0, 1)));
    return (sp_camera){.eye = eye,
                       .right = right,
                       .up = sp_cross(right, forward),
                       .forward = forward,
                       .reach_x = 0.45,
                       .reach_y = 0.35,
                       .shift_x = 0.07,
                       .shift_y = -0.04,
                       .width = WIDTH,
                       .height = HEIGHT,
                       .cut = cut,
                       .centre = sp_along(eye, 1, forward),
                       .size = 6};
}

/* What the line of sight through a sample meets first that is not looked through. */
static sp_depth_sample traced(const sp_tracer *tracer, const sp_camera *camera, sp_look_at *look, size_t sample)
{
    double x = 0.5 * ((double)(sample % (2 * WIDTH)) + 0.5), y = 0.5 * ((double)(sample / (2 * WIDTH)) + 0.5);
    sp_ray ray = {camera->eye, sp_camera_direction(camera, x, y), camera->cut ? 1 : 0, INFINITY, SP_NONE};
    for (;;) {
        sp_hit hit = sp_trace_nearest(tracer, &ray, sp_v(0, 0, 0));
        if (hit.triangle == SP_NONE)
            return (sp_depth_sample){INFINITY, SP_NONE, SP_LOOK_NOTHING};
        bool back = sp_dot(sp_triangle_normal(sp_tracer_mesh(tracer), hit.triangle), ray.velocity) > 0;
        uint32_t seen = look(NULL, hit.triangle, hit.u, hit.v, back);
        if (seen != SP_LOOK_NOTHING)
            return (sp_depth_sample){hit.t, hit.triangle, seen};
        ray.t_min = hit.t;
        ray.skip = hit.triangle;
    }
}

static void assert_as_traced(const sp_mesh *mesh, const sp_camera *camera, sp_look_at *look)
{
    sp_error error = {0};
    sp_tracer *tracer = sp_tracer_create(mesh, SP_ACCELERATOR_BVH, 1, &error);
    sp_depth_sample *samples = malloc(SAMPLES * sizeof *samples);
    assert_non_null(tracer);
    assert_true(sp_depth_buffer_fill(samples, mesh, camera, look, NULL, 1, &error));
    size_t seen = 0;
    for (size_t i = 0; i < SAMPLES; ++i) {
        sp_depth_sample expected = traced(tracer, camera, look, i);
        assert_int_equal(samples[i].triangle, expected.triangle);
        assert_int_equal(samples[i].look, expected.look);
        if (expected.triangle == SP_NONE)
            continue;
        assert_true(fabs(samples[i].depth - expected.depth) < 1e-9 * expected.depth);
        seen++;
    }
    assert_true(seen > SAMPLES / 2);
    free(samples);
    sp_tracer_destroy(tracer);
}

static void samples_show_what_lines_of_sight_meet(void **state)
{
    (void)state;
    sp_mesh *mesh = soup();
    for (int cut = 0; cut < 2; ++cut) {
        sp_camera camera = camera_at(sp_v(0.1, -0.4, 0.3), cut);
        assert_as_traced(mesh, &camera, look);
    }
    sp_mesh_destroy(mesh);
}

/* Of both triangles corners lie before and behind the eye. */
static void a_floor_shows_that_reaches_behind_the_eye(void **state)
{
    (void)state;
    const sp_vec3 corners[] = {{-90, -80, -1}, {70, -60, -1}, {80, 90, -1}, {-60, 70, -1}};
    sp_mesh *mesh = mesh_of(corners, 4, (const uint32_t[][3]){{0, 1, 2}, {0, 2, 3}}, 2);
    sp_camera camera = camera_at(sp_v(0, 0, 0), false);
    assert_as_traced(mesh, &camera, look_at_all);
    sp_mesh_destroy(mesh);
}

static void samples_do_not_depend_on_threads(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_mesh *mesh = soup();
    sp_camera camera = camera_at(sp_v(0.1, -0.4, 0.3), false);
    sp_depth_sample *one = malloc(SAMPLES * sizeof *one), *three = malloc(SAMPLES * sizeof *three);
    assert_true(sp_depth_buffer_fill(one, mesh, &camera, look, NULL, 1, &error));
    assert_true(sp_depth_buffer_fill(three, mesh, &camera, look, NULL, 3, &error));
    assert_memory_equal(one, three, SAMPLES * sizeof *one);
    free(one);
    free(three);
    sp_mesh_destroy(mesh);
}

/* Strips before the eye, from beyond one rim of the picture to beyond the other, whose edges run through the middle of
 * samples, along rows or columns. */
static sp_mesh *strips(const sp_camera *camera, bool rows)
{
    enum { STRIPS = 12 };
    sp_vec3 vertices[2 * (STRIPS + 1)];
    uint32_t triangles[2 * STRIPS][3];
    for (int k = 0; k < 2 * (STRIPS + 1); ++k) {
        double at = 0.25 + (k / 2 - 1) * (rows ? HEIGHT : WIDTH) / 10.0, rim = k % 2 ? -1.75 : 91.25;
        vertices[k] = sp_scale(rows ? sp_camera_direction(camera, rim, at) : sp_camera_direction(camera, at, rim), 3);
    }
    for (uint32_t s = 0; s < STRIPS; ++s) {
        memcpy(triangles[2 * s], (uint32_t[]){2 * s, 2 * s + 1, 2 * s + 2}, sizeof *triangles);
        memcpy(triangles[2 * s + 1], (uint32_t[]){2 * s + 1, 2 * s + 3, 2 * s + 2}, sizeof *triangles);
    }
    return mesh_of(vertices, 2 * (STRIPS + 1), (const uint32_t(*)[3])triangles, 2 * STRIPS);
}

static void nothing_shows_between_neighbours(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_camera camera = camera_at(sp_v(0, 0, 0), false);
    sp_depth_sample *samples = malloc(SAMPLES * sizeof *samples);
    for (int rows = 0; rows < 2; ++rows) {
        sp_mesh *mesh = strips(&camera, rows);
        assert_true(sp_depth_buffer_fill(samples, mesh, &camera, look_at_all, NULL, 1, &error));
        for (size_t i = 0; i < SAMPLES; ++i)
            assert_true(samples[i].triangle != SP_NONE);
        sp_mesh_destroy(mesh);
    }
    free(samples);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_show_what_lines_of_sight_meet),
        cmocka_unit_test(a_floor_shows_that_reaches_behind_the_eye),
        cmocka_unit_test(samples_do_not_depend_on_threads),
        cmocka_unit_test(nothing_shows_between_neighbours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
