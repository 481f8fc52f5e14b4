/* Parabolas of one origin, traced together, get the answers that each gets singly and without a tree. */
#include "shapes.h"

#include "trace/bvh/instructions.h"

#ifdef SPRAYPLAN_SANITIZE
enum { RAYS = 200, PACKETS = 16 };
#else
enum { RAYS = 1000, PACKETS = 60 };
#endif

/* At corners, edges and the inside of triangles, in random order or sorted, at one speed or several, with or without an
 * end, from time 0 or later, some skipping what they aim at. */
static void draw_rays(random_source *source, const sp_mesh *mesh, sp_vec3 origin, sp_vec3 gravity, double scale,
                      sp_ray rays[RAYS])
{
    double time = pow(10, draw(source, -1, 0.5)), spread = draw(source, 0, 1) < 0.5 ? 0 : 1;
    bool cone = draw(source, 0, 1) < 0.5;
    sp_vec3 axis = draw_point(source, 1);
    for (int i = 0; i < RAYS; i++) {
        uint32_t triangle = (uint32_t)draw(source, 0, (double)mesh->triangle_count);
        double kind = draw(source, 0, 1), u = draw(source, 0, 1),
               own = time * pow(10, spread * draw(source, -0.5, 0.5));
        sp_vec3 target = sp_triangle_point(mesh, triangle, kind < 0.3 ? 0 : u, kind < 0.6 ? 0 : draw(source, 0, 1 - u));
        if (cone) /* closer together than triangles are large */
            target = sp_along(origin, scale, sp_along(axis, 0.1, draw_point(source, 1)));
        rays[i] = make_ray(origin, sp_along(sp_scale(sp_sub(target, origin), 1 / own), -0.5 * own, gravity));
        if (kind > 0.5)
            rays[i].t_max = own * (kind < 0.7 ? 1 - 1e-7 : draw(source, 0, 2));
        if (kind > 0.6 && kind < 0.8)
            rays[i].t_min = own * draw(source, 0, 1);
        if (kind > 0.5 && kind < 0.75)
            rays[i].skip = triangle;
        if (kind > 0.99)
            rays[i].velocity = sp_v(0, 0, 0);
        if (kind > 0.98 && kind < 0.985)
            rays[i].velocity = sp_scale(gravity, draw(source, -1, 1));
    }
}

static void compare(const sp_mesh *mesh, sp_tracer *bvh, const sp_tracer *none, const sp_ray rays[RAYS],
                    sp_vec3 gravity, size_t *found)
{
    static sp_hit expected[RAYS], hits[RAYS];
    static bool occluded[RAYS];
    for (int i = 0; i < RAYS; i++) {
        expected[i] = sp_trace_nearest(bvh, &rays[i], gravity);
        if (i % 16)
            continue;
        sp_hit hit = sp_trace_nearest(none, &rays[i], gravity);
        assert_true(hit.t == expected[i].t && hit.triangle == expected[i].triangle);
    }
    for (int set = 0; set < SP_INSTRUCTIONS_COUNT; set++) {
        if (!sp_instructions_available((sp_instructions)set))
            continue;
        sp_tracer_use(bvh, (sp_instructions)set);
        sp_trace_nearest_many(bvh, rays, RAYS, gravity, 1, hits);
        sp_trace_occluded_many(bvh, rays, RAYS, gravity, 1, occluded);
        for (int i = 0; i < RAYS; i++) {
            sp_hit a = hits[i], b = expected[i];
            if (a.t != b.t || a.triangle != b.triangle || a.u != b.u || a.v != b.v)
                fail_msg("ray %d of %zu triangles: %.17g at %u, but singly %.17g at %u", i, mesh->triangle_count, a.t,
                         a.triangle, b.t, b.triangle);
            if (occluded[i] != (b.triangle != SP_NONE))
                fail_msg("ray %d of %zu triangles: occluded %d", i, mesh->triangle_count, occluded[i]);
            *found += set == 0 && b.triangle != SP_NONE;
        }
    }
}

static void as_each_singly(void **state)
{
    (void)state;
    static const sp_vec3 along[] = {{0, 0, -1}, {0, 0, -1}, {0, 1, 0}, {-1, 0, 0}, {0.6, -0.48, 0.64}, {0, 0, -1}};
    static const double scales[] = {1, 1e-6, 1e6};
    random_source source = {41};
    size_t found = 0;
    for (int i = 0; i < PACKETS; i++) {
        static sp_ray rays[RAYS];
        double scale = scales[i % 3];
        sp_vec3 centre = i % 4 == 3 ? sp_v(50 * scale, -20 * scale, 0) : sp_v(0, 0, 0);
        sp_vec3 gravity = sp_scale(along[i % 6], scale * pow(10, draw(&source, -5, 1.5)));
        sp_mesh *mesh = make_ball(i % 5 == 4 ? 100 : 24, centre, scale, i % 2 ? 0.4 : 0);
        sp_tracer *bvh = make_tracer(mesh, SP_ACCELERATOR_BVH), *none = make_tracer(mesh, SP_ACCELERATOR_NONE);
        sp_vec3 origin = sp_along(centre, scale, draw_point(&source, i % 7 == 6 ? 2 : 0.5));
        draw_rays(&source, mesh, origin, gravity, scale, rays);
        compare(mesh, bvh, none, rays, gravity, &found);
        sp_tracer_destroy(bvh);
        sp_tracer_destroy(none);
        sp_mesh_destroy(mesh);
    }
    assert_true(found > RAYS * PACKETS / 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_each_singly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
