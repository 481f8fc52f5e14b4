/* Half edges and what is wrong with a mesh as a surface. */
#include "mesh/half_edge.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

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
    assert_int_equal(d.open_edges.count, open);
    assert_int_equal(d.flipped_edges.count, flipped);
    assert_int_equal(d.non_manifold_edges.count, non_manifold);
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
    assert_int_equal(d.duplicate_triangles.count, 0);
    assert_int_equal(d.degenerate.count, 0);
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
    assert_true(d.open_edges.count > 0);
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
    assert_int_equal(d.non_manifold_edges.count, 1);
    assert_int_equal(d.duplicate_triangles.count, 1);
    assert_shells(d, 1, 0);
}

/* Six times the volume of a tetrahedron. */
static double volume6(sp_vec3 a, sp_vec3 b, sp_vec3 c, sp_vec3 d)
{
    return sp_dot(sp_sub(b, a), sp_cross(sp_sub(c, a), sp_sub(d, a)));
}

/* Whether an edge of triangle a runs through the inside of triangle b, with which it has no corner in common. */
static bool pierces(const sp_vec3 *points, const uint32_t a[3], const uint32_t b[3])
{
    for (int i = 0; i < 9; i++)
        if (a[i / 3] == b[i % 3])
            return false;
    sp_vec3 p = points[b[0]], q = points[b[1]], r = points[b[2]];
    for (int k = 0; k < 3; k++) {
        sp_vec3 from = points[a[k]], to = points[a[(k + 1) % 3]];
        double one = volume6(from, to, p, q), two = volume6(from, to, q, r), three = volume6(from, to, r, p);
        if (volume6(p, q, r, from) * volume6(p, q, r, to) < 0 &&
            ((one > 0 && two > 0 && three > 0) || (one < 0 && two < 0 && three < 0)))
            return true;
    }
    return false;
}

/* A ribbon along (t³ - t, t²), which runs through itself where t is 1 and -1: as many pairs as edges say. */
static void crossings_of_a_ribbon(void **state)
{
    (void)state;
    enum { LONG = 40, WIDE = 7 };
    for (int crossed = 0; crossed < 2; crossed++) {
        sp_vec3 points[(LONG + 1) * (WIDE + 1)];
        uint32_t triangles[2 * LONG * WIDE][3];
        for (uint32_t i = 0; i <= LONG; i++)
            for (uint32_t k = 0; k <= WIDE; k++) {
                double t = (crossed ? 2.6 : 1.8) * ((double)i / LONG - 0.5);
                points[i * (WIDE + 1) + k] = sp_v(t * t * t - t, 0.1 * k + 0.03 * t, t * t);
            }
        size_t count = 0, expected = 0;
        for (uint32_t i = 0; i < LONG; i++)
            for (uint32_t k = 0; k < WIDE; k++) {
                uint32_t a = i * (WIDE + 1) + k, b = a + 1, c = a + WIDE + 1, d = c + 1;
                memcpy(triangles[count++], (uint32_t[3]){a, c, b}, sizeof *triangles);
                memcpy(triangles[count++], (uint32_t[3]){b, c, d}, sizeof *triangles);
            }
        for (size_t i = 0; i < count; i++)
            for (size_t k = 0; k < i; k++)
                expected += pierces(points, triangles[i], triangles[k]) || pierces(points, triangles[k], triangles[i]);
        sp_mesh_diagnosis d = diagnose(points, (LONG + 1) * (WIDE + 1), (const uint32_t(*)[3])triangles, count);
        assert_int_equal(d.crossings.count, expected);
        assert_true(crossed == (expected > 10));
    }
}

/* Two sheets a hair apart at their common edge. */
static void a_crack_is_found(void **state)
{
    (void)state;
    static const double gaps[] = {1e-5, 1e-2};
    for (int i = 0; i < 2; i++) {
        const sp_vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, gaps[i]}, {1, 0, gaps[i]}, {1, 1, 0}};
        static const uint32_t triangles[][3] = {{0, 1, 2}, {3, 4, 5}};
        sp_mesh_diagnosis d = diagnose(points, 6, triangles, 2);
        assert_int_equal(d.cracks.count, i == 0 ? 4 : 0);
        assert_true(i > 0 || sp_distance(d.cracks.place[0], points[1]) <= 0);
    }
}

typedef struct {
    double size;
    sp_vec3 at;
    bool turned;
} body;

/* Boxes within and beside each other. */
static sp_mesh_diagnosis diagnose_bodies(const body *bodies, uint32_t count)
{
    sp_vec3 points[8 * 3];
    uint32_t triangles[12 * 3][3];
    for (uint32_t i = 0; i < count; i++) {
        for (int v = 0; v < 8; v++)
            points[8 * i + v] = sp_along(bodies[i].at, bodies[i].size, cube[v]);
        for (int t = 0; t < 12; t++)
            for (int k = 0; k < 3; k++)
                triangles[12 * i + t][k] = 8 * i + sides[t][bodies[i].turned ? 2 - k : k];
    }
    return diagnose(points, 8 * count, (const uint32_t(*)[3])triangles, 12 * count);
}

/* A void in a body is drawn with its front inwards, what lies in the void outwards again. */
static void bodies_inside_out(void **state)
{
    (void)state;
    const sp_vec3 origin = {0, 0, 0}, inner = {0.1, 0.2, 0.3}, innermost = {0.2, 0.4, 0.6}, beside = {3, 0, 0};
    const body hollow[] = {{1, origin, false}, {0.8, inner, true}, {0.5, innermost, false}};
    const body wrong[] = {{1, origin, false}, {0.8, inner, true}, {0.5, beside, true}};
    const body room[] = {{1, origin, true}, {0.8, inner, false}};
    assert_int_equal(diagnose_bodies(hollow, 3).inside_out.count, 0);
    sp_mesh_diagnosis d = diagnose_bodies(wrong, 3);
    assert_int_equal(d.inside_out.count, 1);
    assert_true(d.inside_out.place[0].x >= beside.x);
    assert_int_equal(diagnose_bodies(room, 2).inside_out.count, 1);
    assert_int_equal(d.crossings.count, 0);
}

/* More than there is room for places of. */
static void loose_bits_are_counted(void **state)
{
    (void)state;
    enum { BITS = SP_PLACES + 3 };
    sp_vec3 points[3 * (BITS + 1)] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    uint32_t triangles[BITS + 1][3];
    for (uint32_t i = 0; i <= BITS; i++)
        for (uint32_t k = 0; k < 3; k++) {
            triangles[i][k] = 3 * i + k;
            points[3 * i + k] = i ? sp_along(sp_v(i, 2, 0), 1e-3, points[k]) : points[k];
        }
    sp_mesh_diagnosis d = diagnose(points, 3 * (BITS + 1), (const uint32_t(*)[3])triangles, BITS + 1);
    assert_int_equal(d.bits.count, BITS);
    assert_true(fabs(d.bits.place[SP_PLACES - 1].x - SP_PLACES) < 1e-3 && !d.bits.more);
}

static void degenerate_and_unused_are_reported(void **state)
{
    (void)state;
    static const sp_vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {-9, -9, -9}};
    static const uint32_t triangles[][3] = {{0, 1, 3}, {0, 1, 2}, {2, 2, 2}};
    sp_mesh_diagnosis d = diagnose(points, 5, triangles, 3);
    assert_int_equal(d.degenerate.count, 2);
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
        cmocka_unit_test(crossings_of_a_ribbon),
        cmocka_unit_test(a_crack_is_found),
        cmocka_unit_test(bodies_inside_out),
        cmocka_unit_test(loose_bits_are_counted),
        cmocka_unit_test(degenerate_and_unused_are_reported),
        cmocka_unit_test(empty_mesh),
        cmocka_unit_test(half_edges_face_each_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
