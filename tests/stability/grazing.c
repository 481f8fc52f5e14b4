/* Rays that all but lie in the walls: none slips out of a closed mesh, and every accelerator meets the same. With a
 * number as its argument the program shoots so many, and counts what it misses. */
#include "../trace/shapes.h"

#ifdef SPRAYPLAN_SANITIZE
enum { RAYS = 2000 };
#else
enum { RAYS = 200000 };
#endif

enum { BATCH = 4096, COMPARED = 16 };

/* From 10^-14 to 10^-1 of the size above a triangle, at 10^-16 to 10^-1 rad to it: nearer, round-off tells the sides.
 */
static sp_ray graze(random_source *source, const sp_mesh *mesh, double size)
{
    uint32_t t = (uint32_t)draw(source, 0, (double)mesh->triangle_count);
    double u = draw(source, 0, 1), v = draw(source, 0, 1 - u);
    sp_vec3 normal = sp_triangle_normal(mesh, t), other = draw_point(source, 1);
    sp_vec3 along = sp_unit(sp_along(other, -sp_dot(other, normal), normal));
    double height = size * pow(10, draw(source, -14, -1)), angle = pow(10, draw(source, -16, -1));
    if (draw(source, 0, 1) < 0.1)
        angle = 0;
    return make_ray(sp_along(sp_triangle_point(mesh, t, u, v), -height, normal),
                    sp_along(along, draw(source, 0, 1) < 0.5 ? angle : -angle, normal));
}

/* A ray that starts within round-off of its wall may begin outside of it: then, and only then, it may meet nothing. */
static bool starts_inside(const sp_tracer *tracer, const sp_ray *ray, random_source *source)
{
    for (int i = 0; i < 64; i++) {
        sp_ray other = make_ray(ray->origin, draw_point(source, 1));
        if (sp_trace_nearest(tracer, &other, sp_v(0, 0, 0)).triangle == SP_NONE)
            return false;
    }
    return true;
}

static size_t shoot(const sp_mesh *mesh, double size, size_t count, random_source *source)
{
    sp_tracer *bvh = make_tracer(mesh, SP_ACCELERATOR_BVH), *sah = make_tracer(mesh, SP_ACCELERATOR_SAH);
    sp_ray *rays = malloc(BATCH * sizeof *rays);
    sp_hit *hits = malloc(BATCH * sizeof *hits);
    size_t missed = 0;
    for (size_t first = 0; first < count; first += BATCH) {
        sp_vec3 gravity = first / BATCH % 2 ? sp_v(0, 0, -1e-3 * size) : sp_v(0, 0, 0);
        for (int i = 0; i < BATCH; i++)
            rays[i] = graze(source, mesh, size);
        sp_trace_nearest_many(bvh, rays, BATCH, gravity, 0, hits);
        for (int i = 0; i < BATCH; i++) {
            missed += hits[i].triangle == SP_NONE && starts_inside(bvh, &rays[i], source);
            if (i % (BATCH / COMPARED))
                continue;
            sp_hit hit = sp_trace_nearest(sah, &rays[i], gravity);
            assert_true(hit.triangle == hits[i].triangle && hit.t == hits[i].t);
            assert_true(sp_trace_occluded(bvh, &rays[i], gravity) == (hit.triangle != SP_NONE));
        }
    }
    free(rays);
    free(hits);
    sp_tracer_destroy(bvh);
    sp_tracer_destroy(sah);
    return missed;
}

static size_t shoot_all(size_t count)
{
    static const double radii[] = {1, 1e-6, 1e6};
    random_source source = {11};
    size_t missed = 0;
    for (int i = 0; i < 3; i++) {
        sp_mesh *mesh = make_ball(24, sp_v(0.3 * radii[i], 0, 0), radii[i], 0);
        size_t own = shoot(mesh, radii[i], count / 3 + 1, &source);
        print_message("grazing, a ball of %g m: %zu of %zu rays missed\n", radii[i], own, count / 3 + 1);
        missed += own;
        sp_mesh_destroy(mesh);
    }
    return missed;
}

static void none_slips_out(void **state)
{
    (void)state;
    assert_int_equal(shoot_all(RAYS), 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(none_slips_out)};
    if (argc > 1)
        return shoot_all(strtoull(argv[1], NULL, 10)) > 0;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
