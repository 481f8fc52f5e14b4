/* Polygons, cut into triangles: closed forms, random outlines, what is written with holes, and what is no outline. */
#include "mesh/polygon.h"
#include "mesh/soup.h"
#include "mesh/texture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 100000 };

/* An outline in the plane, anticlockwise. */
typedef struct {
    uint32_t count;
    double at[MOST][2];
} outline;

static outline drawn; /* large */
static sp_vec3 points[MOST];
static uint32_t corners[MOST];

static void draw(const double (*at)[2], uint32_t count)
{
    drawn.count = count;
    memcpy(drawn.at, at, count * sizeof *at);
}

static double shoelace(void)
{
    double twice = 0;
    for (uint32_t i = 0; i < drawn.count; i++) {
        const double *a = drawn.at[i], *b = drawn.at[(i + 1) % drawn.count];
        twice += (a[0] - drawn.at[0][0]) * (b[1] - drawn.at[0][1]) - (a[1] - drawn.at[0][1]) * (b[0] - drawn.at[0][0]);
    }
    return twice / 2;
}

/* Square to each other, of length 1; the fourth plane is tilted. */
static const double planes[4][2][3] = {{{1, 0, 0}, {0, 1, 0}},
                                       {{0, 1, 0}, {0, 0, 1}},
                                       {{0, 0, 1}, {1, 0, 0}},
                                       {{2.0 / 3, 2.0 / 3, 1.0 / 3}, {-2.0 / 3, 1.0 / 3, 2.0 / 3}}};

static sp_vec3 axis_of(int plane, int axis)
{
    const double *a = planes[plane][axis];
    return sp_v(a[0], a[1], a[2]);
}

static void place(int plane, uint32_t first, bool backwards)
{
    for (uint32_t i = 0; i < drawn.count; i++) {
        points[i] = sp_along(sp_scale(axis_of(plane, 0), drawn.at[i][0]), drawn.at[i][1], axis_of(plane, 1));
        corners[i] = (backwards ? drawn.count - i + first : i + first) % drawn.count;
    }
}

/* Cuts what was placed into triangles that face the outline's side and together have its area; how many have none. */
static size_t expect_cut(int plane, bool backwards)
{
    sp_facets cut;
    size_t flat = 0;
    double area = 0, expected = shoelace();
    sp_vec3 normal = sp_cross(axis_of(plane, 0), axis_of(plane, 1));
    assert_true(sp_polygon_cut(points, corners, drawn.count, &cut, NULL));
    assert_false(cut.tangled);
    for (size_t i = 0; i + 2 < drawn.count; i++) {
        uint32_t t[3];
        sp_facets_triangle(&cut, i, t);
        assert_true(t[0] < drawn.count && t[1] < drawn.count && t[2] < drawn.count);
        sp_vec3 a = points[corners[t[0]]];
        sp_vec3 own = sp_cross(sp_sub(points[corners[t[1]]], a), sp_sub(points[corners[t[2]]], a));
        double along = (backwards ? -0.5 : 0.5) * sp_dot(own, normal);
        assert_true(along >= -1e-12 * expected);
        flat += !(along > 1e-13 * expected);
        area += 0.5 * sp_length(own);
    }
    assert_true(fabs(area - expected) <= 1e-11 * expected);
    sp_facets_free(&cut);
    return flat;
}

/* From each corner, either way round, in each plane. */
static void expect_cut_anyhow(size_t flat)
{
    for (int plane = 0; plane < 4; plane++)
        for (uint32_t first = 0; first < drawn.count; first++)
            for (int backwards = 0; backwards < 2; backwards++) {
                place(plane, first, backwards);
                assert_true(expect_cut(plane, backwards) <= flat);
            }
}

#define DRAW(...)                                                                                                      \
    do {                                                                                                               \
        static const double at[][2] = {__VA_ARGS__};                                                                   \
        draw(at, sizeof at / sizeof *at);                                                                              \
    } while (0)

static void shapes_have_their_area(void **state)
{
    (void)state;
    DRAW({0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}); /* an L */
    assert_true(fabs(shoelace() - 3) < 1e-15);
    expect_cut_anyhow(0);
    DRAW({0, 0}, {1, 0}, {1, 1}, {0.65, 1}, {0.65, 0.3}, {0.35, 0.3}, {0.35, 1}, {0, 1}); /* a U */
    assert_true(fabs(shoelace() - 0.79) < 1e-15);
    expect_cut_anyhow(0);
    DRAW({0, 0}, {1, 0.5}, {0, 2}, {0.5, 0.5}); /* a dart */
    expect_cut_anyhow(0);
    DRAW({0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1.5, 2}, {1.5, 1}, {1, 1}, {0.5, 1}, {0.5, 2}, {0, 2}, {0, 1});
    expect_cut_anyhow(0); /* corners in line are no triangles, nor left on edges of others */
    drawn.count = 10;
    for (int i = 0; i < 10; i++) {
        drawn.at[i][0] = (i % 2 ? 0.3 : 1) * cos(M_PI * i / 5);
        drawn.at[i][1] = (i % 2 ? 0.3 : 1) * sin(M_PI * i / 5);
    }
    expect_cut_anyhow(0);
}

/* A rim and what is cut out of it, joined by an edge there and back; also with points of their own at both ends. */
static void holes_are_cut_out(void **state)
{
    (void)state;
    DRAW({0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1});
    assert_true(fabs(shoelace() - 8) < 1e-15);
    expect_cut_anyhow(0);
    DRAW({0, 0}, {6, 0}, {6, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {4, 1}, {4, 2}, {5, 2}, {5, 1}, {4, 1},
         {2, 1}, {1, 1}); /* one behind the other */
    assert_true(fabs(shoelace() - 16) < 1e-15);
    expect_cut_anyhow(0);
    DRAW({0, 0}, {6, 0}, {6, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}, {0, 0}, {4, 1}, {4, 2}, {5, 2},
         {5, 1}, {4, 1}); /* both from one corner */
    assert_true(fabs(shoelace() - 16) < 1e-15);
    expect_cut_anyhow(0);
    DRAW({0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}); /* nothing is cut out */
    expect_cut_anyhow(2);
    DRAW({0, 0}, {0, 0}, {2, 0}, {2, 0}, {2, 1}, {2, 1}, {1, 1}, {1, 1}, {1, 2}, {1, 2}, {0, 2}, {0, 2});
    expect_cut_anyhow(6);
}

static uint64_t random_state;

/* From 0 to 1; Marsaglia's xorshift. */
static double any(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (double)(random_state >> 11) / 9007199254740992.0;
}

static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Turns what lies between two edges that cross round, until none do: every time the outline is shorter. */
static void untangle(void)
{
    uint32_t n = drawn.count;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = i + 2; k < n; k++) {
            const double *a = drawn.at[i], *b = drawn.at[i + 1], *c = drawn.at[k], *d = drawn.at[(k + 1) % n];
            if (turn(a, b, c) * turn(a, b, d) >= 0 || turn(c, d, a) * turn(c, d, b) >= 0)
                continue;
            for (uint32_t from = i + 1, to = k; from < to; from++, to--)
                for (int axis = 0; axis < 2; axis++) {
                    double swap = drawn.at[from][axis];
                    drawn.at[from][axis] = drawn.at[to][axis];
                    drawn.at[to][axis] = swap;
                }
            i = k = 0;
        }
}

static void any_outline_is_cut(void **state)
{
    (void)state;
    random_state = 88172645463325252u;
    for (int sample = 0; sample < 400; sample++) {
        drawn.count = 4 + (uint32_t)(40 * any());
        for (uint32_t i = 0; i < drawn.count; i++)
            for (int axis = 0; axis < 2; axis++)
                drawn.at[i][axis] = any();
        untangle();
        if (shoelace() < 0) /* mirrored */
            for (uint32_t i = 0; i < drawn.count; i++)
                drawn.at[i][0] = -drawn.at[i][0];
        for (uint32_t first = 0; first < drawn.count; first += 5)
            for (int plane = 0; plane < 4; plane += 3) {
                place(plane, first, sample % 2);
                expect_cut(plane, sample % 2);
            }
    }
}

/* As files had it before, whatever their digits. */
static void convex_ones_are_fans(void **state)
{
    (void)state;
    for (uint32_t n = 3; n < 60; n++)
        for (uint32_t between = 1; between < 4; between++)
            for (int digits = 0; digits < 2; digits++) {
                drawn.count = n * between;
                for (uint32_t i = 0; i < drawn.count; i++) {
                    double from = 2 * M_PI * (i / between) / n, to = 2 * M_PI * (i / between + 1) / n;
                    double along = (double)(i % between) / between;
                    drawn.at[i][0] = 7 + (1 - along) * cos(from) + along * cos(to);
                    drawn.at[i][1] = -3 + (1 - along) * sin(from) + along * sin(to);
                }
                place(3, n % 3, n % 2);
                for (uint32_t i = 0; digits && i < drawn.count; i++)
                    points[i] = sp_v(round(points[i].x * 1e7) / 1e7, round(points[i].y * 1e7) / 1e7,
                                     round(points[i].z * 1e7) / 1e7);
                sp_facets cut;
                assert_true(sp_polygon_cut(points, corners, drawn.count, &cut, NULL));
                assert_null(cut.triangles);
                assert_false(cut.tangled);
                uint32_t t[3];
                sp_facets_triangle(&cut, 0, t);
                assert_true(t[0] == 0 && t[1] == 1 && t[2] == 2);
            }
}

static void expect_fan(bool tangled)
{
    for (int plane = 0; plane < 4; plane++)
        for (uint32_t first = 0; first < drawn.count; first++) {
            sp_facets cut;
            place(plane, first, first % 2);
            assert_true(sp_polygon_cut(points, corners, drawn.count, &cut, NULL));
            assert_null(cut.triangles);
            assert_int_equal(cut.tangled, tangled);
        }
}

static void what_is_no_outline_is_a_fan(void **state)
{
    (void)state;
    DRAW({1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1});
    expect_fan(false);
    DRAW({0, 0}, {3, 0}, {1, 0}, {7, 0}, {2, 0});
    expect_fan(false);
    DRAW({0, 0}, {1, 1}, {1, 0}, {0, 1}); /* as much on either side */
    expect_fan(true);
    DRAW({0, 0}, {2, 2}, {2, 0}, {0, 1}); /* and more on one */
    expect_fan(true);
    DRAW({0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, -1}, {2, -1}, {2, 4}, {0, 4});
    expect_fan(true);
    drawn.count = 5; /* twice round */
    for (int i = 0; i < 5; i++) {
        drawn.at[i][0] = cos(4 * M_PI * i / 5);
        drawn.at[i][1] = sin(4 * M_PI * i / 5);
    }
    expect_fan(true);
}

/* However far off, large or small: the scale is a power of two. */
static void scale_is_no_matter(void **state)
{
    (void)state;
    DRAW({0, 0}, {1, 0}, {1, 1}, {0.65, 1}, {0.65, 0.3}, {0.35, 0.3}, {0.35, 1}, {0, 1});
    place(3, 3, false);
    sp_facets cut, other;
    assert_true(sp_polygon_cut(points, corners, drawn.count, &cut, NULL));
    assert_non_null(cut.triangles);
    for (int power = -900; power <= 900; power += 300) {
        place(3, 3, false);
        for (uint32_t i = 0; i < drawn.count; i++)
            points[i] = sp_scale(points[i], ldexp(1, power));
        assert_true(sp_polygon_cut(points, corners, drawn.count, &other, NULL));
        assert_memory_equal(cut.triangles, other.triangles, (drawn.count - 2) * sizeof *cut.triangles);
        sp_facets_free(&other);
    }
    sp_facets_free(&cut);
    place(3, 3, false);
    for (uint32_t i = 0; i < drawn.count; i++)
        points[i] = sp_add(points[i], sp_v(1048576, -2097152, 524288));
    assert_true(sp_polygon_cut(points, corners, drawn.count, &cut, NULL));
    assert_non_null(cut.triangles);
    sp_facets_free(&cut);
}

/* A comb, a star, a spiral, and a tangle that is larger than what is searched for crossings. */
static void very_long_ones_come_to_an_end(void **state)
{
    (void)state;
    enum { TEETH = 10000 };
    random_state = 88172645463325252u;
    drawn.count = TEETH;
    for (uint32_t i = 0; i + 2 < TEETH; i++) {
        drawn.at[i][0] = TEETH - i;
        drawn.at[i][1] = i % 2 ? 1 : 1000;
    }
    memcpy(drawn.at[TEETH - 2], (double[2]){0, 0}, sizeof *drawn.at);
    memcpy(drawn.at[TEETH - 1], (double[2]){TEETH, 0}, sizeof *drawn.at);
    for (int plane = 0; plane < 4; plane += 3) {
        place(plane, 5, false);
        expect_cut(plane, false);
    }
    drawn.count = MOST;
    for (uint32_t i = 0; i < MOST; i++) {
        double r = i % 2 ? 0.1 + 0.8 * any() : 1;
        drawn.at[i][0] = r * cos(2 * M_PI * i / MOST);
        drawn.at[i][1] = r * sin(2 * M_PI * i / MOST);
    }
    place(0, 1, true);
    expect_cut(0, true);
    for (uint32_t i = 0; i < MOST / 2; i++) {
        double a = 2 * M_PI * i / 100, r = 1 + 0.01 * a;
        for (int side = 0; side < 2; side++) {
            uint32_t at = side ? MOST - 1 - i : i;
            drawn.at[at][0] = (r + (side ? -0.02 : 0)) * cos(a);
            drawn.at[at][1] = (r + (side ? -0.02 : 0)) * sin(a);
        }
    }
    place(0, 1, false);
    expect_cut(0, false);
    for (uint32_t i = 0; i < MOST; i++)
        points[i] = sp_v(any(), any() + 1e-4 * i, 0);
    sp_facets cut;
    assert_true(sp_polygon_cut(points, corners, MOST, &cut, NULL));
    assert_true(cut.tangled);
    sp_facets_free(&cut);
}

#define LID                                                                                                            \
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv .65 1 0\nv .65 .3 0\nv .35 .3 0\nv .35 1 0\nv 0 1 0\n"                               \
    "vt 0 0\nvt 1 0\nvt 1 1\nvt .65 1\nvt .65 .3\nvt .35 .3\nvt .35 1\nvt 0 1\n"

/* The same cut whatever the unit, of a file whose texture coordinates are those of its corners. */
static void texture_coordinates_follow(void **state)
{
    (void)state;
    static const char text[] = LID "f 3/3 4/4 5/5 6/6 7/7 8/8 1/1 2/2\nf -3/-3 -2/-2 -1/-1 -8/-8 -7/-7 -6/-6 -5/-5 "
                                   "-4/-4\nf 1/1 2/2 3/3\nf 1/1 2/2 3/3 8/8\n";
    static const double units[] = {1, 1e-3, 0.0254};
    for (int unit = 0; unit < 3; unit++) {
        sp_soup soup = {0};
        sp_texture texture;
        assert_true(sp_obj_read("lid.obj", text, sizeof text - 1, units[unit], &soup, NULL));
        assert_true(sp_texture_read("lid.obj", text, sizeof text - 1, &texture, NULL));
        assert_int_equal(soup.triangle_count, 15);
        assert_int_equal(texture.triangle_count, 15);
        assert_int_equal(soup.tangled, 0);
        for (size_t t = 0; t < 15; t++)
            for (int k = 0; k < 3; k++) {
                sp_vec3 p = soup.vertices[soup.triangles[t][k]];
                assert_true(fabs(p.x - units[unit] * texture.uv[t][k][0]) < 1e-15);
                assert_true(fabs(p.y - units[unit] * texture.uv[t][k][1]) < 1e-15);
            }
        sp_texture_free(&texture);
        sp_mesh *mesh = sp_soup_mesh(&soup, NULL);
        assert_true(fabs(sp_mesh_area(mesh) / (units[unit] * units[unit]) - 3.08) < 1e-14);
        sp_mesh_destroy(mesh);
        sp_soup_clear(&soup);
    }
}

static void ply_is_cut_alike(void **state)
{
    (void)state;
    static const char text[] =
        "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\nelement face "
        "2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n.65 1 0\n.65 .3 0\n.35 .3 0\n.35 "
        "1 0\n0 1 0\n8 2 3 4 5 6 7 0 1\n4 0 2 1 7\n";
    sp_soup soup = {0};
    assert_true(sp_ply_read("lid.ply", text, sizeof text - 1, 1, &soup, NULL));
    assert_int_equal(soup.tangled, 1);
    soup.triangle_count -= 2;
    sp_mesh *mesh = sp_soup_mesh(&soup, NULL);
    assert_true(fabs(sp_mesh_area(mesh) - 0.79) < 1e-14);
    assert_int_equal(mesh->tangled, 1);
    const sp_mesh *const both[] = {mesh, mesh};
    const sp_transform transforms[] = {sp_transform_default(), sp_transform_default()};
    sp_mesh *joined = sp_mesh_join(both, transforms, 2, NULL);
    assert_int_equal(joined->tangled, 2);
    sp_mesh_destroy(joined);
    sp_mesh_destroy(mesh);
    sp_soup_clear(&soup);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes_have_their_area),
        cmocka_unit_test(holes_are_cut_out),
        cmocka_unit_test(any_outline_is_cut),
        cmocka_unit_test(convex_ones_are_fans),
        cmocka_unit_test(what_is_no_outline_is_a_fan),
        cmocka_unit_test(scale_is_no_matter),
        cmocka_unit_test(very_long_ones_come_to_an_end),
        cmocka_unit_test(texture_coordinates_follow),
        cmocka_unit_test(ply_is_cut_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
