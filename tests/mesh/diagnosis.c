/* Half edges and what is wrong with a mesh as a surface. */
#include "mesh/half_edge.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

static const sp_vec3 cube[8] = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}};
/* Bottom, top, then the sides. */
static const uint32_t sides[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                      {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

static sp_mesh *make(const sp_vec3 *points, size_t points_count, const uint32_t (*triangles)[3], size_t count)
{
    sp_mesh *mesh = sp_mesh_create(points, points_count, triangles, count, NULL, NULL, 0, NULL);
    assert_non_null(mesh);
    return mesh;
}

static sp_mesh_diagnosis diagnose(const sp_vec3 *points, size_t points_count, const uint32_t (*triangles)[3],
                                  size_t count)
{
    sp_mesh *mesh = make(points, points_count, triangles, count);
    sp_mesh_diagnosis d;
    assert_true(sp_mesh_diagnose(mesh, &d, NULL));
    sp_mesh_destroy(mesh);
    return d;
}

static void assert_edges(sp_mesh_diagnosis d, size_t open, size_t flipped, size_t non_manifold)
{
    assert_int_equal(d.open_edges, open);
    assert_int_equal(d.flipped_edges, flipped);
    assert_int_equal(d.non_manifold_edges, non_manifold);
}

static void assert_shells(sp_mesh_diagnosis d, size_t shells, size_t closed)
{
    assert_int_equal(d.shells, shells);
    assert_int_equal(d.closed_shells, closed);
}

static void closed_box(void **state)
{
    (void)state;
    sp_mesh_diagnosis d = diagnose(cube, 8, sides, 12);
    assert_edges(d, 0, 0, 0);
    assert_shells(d, 1, 1);
    assert_int_equal(d.duplicate_triangles, 0);
    assert_int_equal(d.degenerate, 0);
    assert_true(fabs(d.area - 22) < 1e-12);
    assert_true(d.minimum.x == 0 && d.minimum.y == 0 && d.minimum.z == 0);
    assert_true(d.maximum.x == 1 && d.maximum.y == 2 && d.maximum.z == 3);
}

static void open_box(void **state)
{
    (void)state;
    sp_mesh_diagnosis d = diagnose(cube, 8, sides + 2, 10);
    assert_edges(d, 4, 0, 0);
    assert_shells(d, 1, 0);
}

static void two_boxes_one_open(void **state)
{
    (void)state;
    sp_vec3 points[16];
    uint32_t triangles[22][3];
    for (uint32_t i = 0; i < 16; i++)
        points[i] = sp_add(cube[i % 8], sp_v(i < 8 ? 0 : 5, 0, 0));
    for (uint32_t t = 0; t < 22; t++)
        for (int k = 0; k < 3; k++)
            triangles[t][k] = sides[t % 12][k] + (t < 12 ? 0 : 8);
    sp_mesh_diagnosis d = diagnose(points, 16, (const uint32_t(*)[3])triangles, 22);
    assert_shells(d, 2, 1);
    assert_true(d.open_edges > 0);
}

static void one_triangle_turned_over(void **state)
{
    (void)state;
    uint32_t triangles[12][3];
    for (uint32_t t = 0; t < 12; t++)
        for (int k = 0; k < 3; k++)
            triangles[t][k] = sides[t][t == 5 ? 2 - k : k];
    sp_mesh_diagnosis d = diagnose(cube, 8, (const uint32_t(*)[3])triangles, 12);
    assert_edges(d, 0, 3, 0);
    assert_shells(d, 1, 0);
}

/* A strip of ten triangles, closed after half a twist. */
static void moebius_strip(void **state)
{
    (void)state;
    enum { STEPS = 5 };
    sp_vec3 points[2 * STEPS];
    uint32_t triangles[2 * STEPS][3];
    for (uint32_t i = 0; i < STEPS; i++) {
        double turn = 2 * M_PI * i / STEPS, half = turn / 2;
        for (uint32_t side = 0; side < 2; side++) {
            double across = side ? 0.3 : -0.3, r = 1 + across * cos(half);
            points[2 * i + side] = sp_v(r * cos(turn), r * sin(turn), across * sin(half));
        }
        uint32_t a = 2 * i, b = a + 1, c = i + 1 < STEPS ? a + 2 : 1, d = i + 1 < STEPS ? a + 3 : 0;
        const uint32_t pair[2][3] = {{a, c, b}, {b, c, d}};
        for (int k = 0; k < 6; k++)
            triangles[2 * i + (uint32_t)k / 3][k % 3] = pair[k / 3][k % 3];
    }
    sp_mesh_diagnosis d = diagnose(points, 2 * STEPS, (const uint32_t(*)[3])triangles, 2 * STEPS);
    assert_edges(d, 2 * STEPS, 1, 0);
    assert_shells(d, 1, 0);
}

/* Three sheets that meet in one edge, one of them twice. */
static void non_manifold_edge_and_duplicate(void **state)
{
    (void)state;
    static const sp_vec3 points[] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
    static const uint32_t triangles[][3] = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {4, 0, 1}};
    sp_mesh_diagnosis d = diagnose(points, 5, triangles, 4);
    assert_int_equal(d.non_manifold_edges, 1);
    assert_int_equal(d.duplicate_triangles, 1);
    assert_shells(d, 1, 0);
}

static void degenerate_and_unused_are_told(void **state)
{
    (void)state;
    static const sp_vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {-9, -9, -9}};
    static const uint32_t triangles[][3] = {{0, 1, 3}, {0, 1, 2}, {2, 2, 2}};
    sp_mesh_diagnosis d = diagnose(points, 5, triangles, 3);
    assert_int_equal(d.degenerate, 2);
    assert_true(d.minimum.x == 0 && d.maximum.x == 1);
    assert_edges(d, 3, 0, 0);
}

static void empty_mesh(void **state)
{
    (void)state;
    sp_mesh_diagnosis d = diagnose(NULL, 0, NULL, 0);
    assert_shells(d, 0, 0);
    assert_true(d.area == 0 && d.minimum.x == 0 && d.maximum.x == 0);
}

static void half_edges_face_each_other(void **state)
{
    (void)state;
    sp_mesh *mesh = make(cube, 8, sides + 1, 11);
    sp_half_edges half_edges = {0};
    assert_true(sp_half_edges_create(mesh, &half_edges, NULL));
    size_t open = 0;
    for (uint32_t h = 0; h < 33; h++) {
        uint32_t other = half_edges.opposite[h];
        open += other == SP_NONE;
        assert_int_equal(half_edges.kind[h], other == SP_NONE ? SP_EDGE_OPEN : SP_EDGE_PAIRED);
        if (other == SP_NONE)
            continue;
        assert_int_equal(half_edges.opposite[other], h);
        assert_int_equal(sp_half_edge_from(mesh, h), sp_half_edge_to(mesh, other));
        assert_int_equal(sp_half_edge_to(mesh, h), sp_half_edge_from(mesh, other));
    }
    assert_int_equal(open, 3);
    sp_half_edges_destroy(&half_edges);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_box),
        cmocka_unit_test(open_box),
        cmocka_unit_test(two_boxes_one_open),
        cmocka_unit_test(one_triangle_turned_over),
        cmocka_unit_test(moebius_strip),
        cmocka_unit_test(non_manifold_edge_and_duplicate),
        cmocka_unit_test(degenerate_and_unused_are_told),
        cmocka_unit_test(empty_mesh),
        cmocka_unit_test(half_edges_face_each_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
