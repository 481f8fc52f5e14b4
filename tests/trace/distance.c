/* How far a point is from surfaces: every accelerator as all triangles one by one, and those as closed forms. */
#include "shapes.h"

#include "mesh/distance.h"
#include "trace/distance.h"

enum { POINTS = 400, PARTS = 3 };

/* A box from -1 to 1 along every axis, and beside it two balls, each a part of its own. */
static sp_mesh *make_parts(void)
{
    static const char *const names[PARTS] = {"box", "coarse", "fine"};
    const sp_mesh *balls[2] = {make_ball(10, sp_v(3, 0, 0), 0.7, 0.2), make_ball(40, sp_v(0, 3, 1), 0.5, 0)};
    sp_vec3 points[2000];
    uint32_t triangles[4000][3], part[4000], point_count = 0, count = 0;
    for (uint32_t i = 0; i < 8; i++)
        points[point_count++] = sp_v(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    for (uint32_t axis = 0; axis < 3; axis++)
        for (uint32_t side = 0; side < 2; side++) {
            uint32_t a = side << axis, b = a + (1u << (axis + 1) % 3), c = a + (1u << (axis + 2) % 3), d = b + c - a;
            const uint32_t own[2][3] = {{a, b, d}, {a, d, c}};
            memcpy(triangles[count], own, sizeof own);
            part[count] = part[count + 1] = 0;
            count += 2;
        }
    for (uint32_t k = 0; k < 2; k++) {
        const sp_mesh *ball = balls[k];
        assert_true(point_count + ball->vertex_count <= 2000 && count + ball->triangle_count <= 4000);
        for (size_t t = 0; t < ball->triangle_count; t++, count++) {
            for (int i = 0; i < 3; i++)
                triangles[count][i] = ball->triangles[t][i] + point_count;
            part[count] = 1 + k;
        }
        for (size_t i = 0; i < ball->vertex_count; i++)
            points[point_count++] = ball->vertices[i];
        sp_mesh_destroy((sp_mesh *)(uintptr_t)ball);
    }
    sp_error error = {0};
    sp_mesh *mesh =
        sp_mesh_create(points, point_count, (const uint32_t(*)[3])triangles, count, part, names, PARTS, &error);
    assert_non_null(mesh);
    return mesh;
}

/* Squared: roots of what differs by rounding alone may be the same. */
static double to_triangle(const sp_mesh *mesh, uint32_t triangle, sp_vec3 point)
{
    sp_vec3 away = sp_sub(sp_triangle_nearest(mesh, triangle, point), point);
    return sp_dot(away, away);
}

/* The same from all triangles of a part, or of all but one. */
static double to_all(const sp_mesh *mesh, uint32_t part, uint32_t but, sp_vec3 point)
{
    double least = INFINITY;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        if ((part == SP_NONE || mesh->part[t] == part) && mesh->part[t] != but)
            least = fmin(least, to_triangle(mesh, t, point));
    return least;
}

/* Of a box, from outside and inside. */
static double to_box(sp_vec3 p)
{
    double x = fabs(p.x) - 1, y = fabs(p.y) - 1, z = fabs(p.z) - 1, most = fmax(x, fmax(y, z));
    return most < 0 ? -most : sp_length(sp_v(fmax(x, 0), fmax(y, 0), fmax(z, 0)));
}

/* Some far away, some within, some just at corners and edges, where triangles are equally near. */
static sp_vec3 point_at(random_source *source, const sp_mesh *mesh, int i)
{
    sp_vec3 corner = mesh->vertices[(size_t)draw(source, 0, (double)mesh->vertex_count)];
    return i % 8 == 0   ? draw_point(source, 100)
           : i % 8 == 1 ? corner
           : i % 8 == 2 ? sp_scale(sp_v(corner.x, corner.y, 0), 1.5)
                        : draw_point(source, 4);
}

static void a_box_is_as_far_as_it_is(void **state)
{
    (void)state;
    sp_mesh *mesh = make_parts();
    sp_tracer *tracer = make_tracer(mesh, SP_ACCELERATOR_BVH);
    random_source source = {7};
    for (int i = 0; i < POINTS; i++) {
        sp_vec3 p = point_at(&source, mesh, i);
        double distance = sqrt(to_triangle(mesh, sp_tracer_nearest_triangle(tracer, 0, p), p));
        assert_true(fabs(distance - to_box(p)) < 1e-12 * fmax(1, distance));
    }
    /* past an edge at .5 and .5: .5 √2 away; through a face; beside a face, 0.25 away; ending a corner's way off */
    const sp_vec3 ways[][2] = {{sp_v(-1.5, 2, -5), sp_v(-1.5, 2, 5)},
                               {sp_v(-3, 0.3, 0.2), sp_v(-0.5, 0.3, 0.2)},
                               {sp_v(-1.25, 0, -0.5), sp_v(-1.25, 0.7, 0.5)},
                               {sp_v(-5, -5, -5), sp_v(-2, -2, -2)}};
    const double apart[] = {sqrt(0.25 + 1), 0, 0.25, sqrt(3)};
    for (int i = 0; i < 4; i++) {
        assert_true(sp_tracer_way_is_clear(tracer, ways[i][0], ways[i][1], apart[i] * (1 - 1e-6)) == (apart[i] > 0));
        assert_false(sp_tracer_way_is_clear(tracer, ways[i][0], ways[i][1], apart[i] * (1 + 1e-6)));
    }
    sp_tracer_destroy(tracer);
    sp_mesh_destroy(mesh);
}

static void check(const sp_mesh *mesh, const sp_tracer *tracer)
{
    random_source source = {11};
    for (int i = 0; i < POINTS; i++) {
        sp_vec3 p = point_at(&source, mesh, i), q = point_at(&source, mesh, i + 3);
        for (uint32_t k = 0; k <= PARTS; k++) {
            uint32_t part = k < PARTS ? k : SP_NONE, first = 0;
            double distance = to_all(mesh, part, SP_NONE - 1, p);
            while ((part != SP_NONE && mesh->part[first] != part) || to_triangle(mesh, first, p) > distance)
                first++;
            assert_int_equal(sp_tracer_nearest_triangle(tracer, part, p), first);
            double clear = sqrt(to_all(mesh, SP_NONE, part, p));
            assert_true(sp_tracer_is_clear(tracer, p, clear * (1 - 1e-6), part));
            assert_true(clear <= 0 || !sp_tracer_is_clear(tracer, p, clear * (1 + 1e-6), part));
        }
        double apart = INFINITY;
        for (uint32_t t = 0; t < mesh->triangle_count; t++)
            apart = fmin(apart, sp_triangle_way2(mesh, t, p, q));
        apart = sqrt(apart);
        assert_true(apart * apart <= to_all(mesh, SP_NONE, SP_NONE - 1, p) * (1 + 1e-12));
        assert_true(apart <= 0 || sp_tracer_way_is_clear(tracer, p, q, apart * (1 - 1e-6)));
        assert_false(sp_tracer_way_is_clear(tracer, p, q, apart * (1 + 1e-6)));
    }
    assert_int_equal(sp_tracer_nearest_triangle(tracer, PARTS, sp_v(0, 0, 0)), SP_NONE);
}

static void accelerators_agree_with_all_triangles(void **state)
{
    (void)state;
    static const sp_accelerator accelerators[] = {SP_ACCELERATOR_BVH, SP_ACCELERATOR_SAH, SP_ACCELERATOR_NAIVE,
                                                  SP_ACCELERATOR_NONE};
    sp_mesh *mesh = make_parts();
    for (int i = 0; i < 4; i++) {
        sp_tracer *tracer = make_tracer(mesh, accelerators[i]);
        check(mesh, tracer);
        sp_tracer_destroy(tracer);
    }
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_is_as_far_as_it_is),
        cmocka_unit_test(accelerators_agree_with_all_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
