/* The order in which the page is told triangles: all of them once, most over an edge of one before, in few bytes. */
#include "report/viewer/triangle_order.h"

#include "tank.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

static void expect_walk(const sp_triangle_order *walk, const sp_mesh *mesh, const sp_atlas *atlas)
{
    bool *triangles = calloc(walk->count, 1), *vertices = calloc(walk->vertex_count, 1);
    uint32_t fresh = 0;
    assert_int_equal(walk->count, mesh->triangle_count);
    assert_int_equal(walk->vertex_count, mesh->vertex_count);
    for (size_t i = 0; i < walk->vertex_count; i++) {
        assert_false(vertices[walk->vertex[i]]);
        vertices[walk->vertex[i]] = true;
    }
    for (size_t i = 0; i < walk->count; i++) {
        uint32_t triangle = walk->triangle[i], gate = walk->gate[i], far = walk->far[i];
        assert_false(triangles[triangle]);
        triangles[triangle] = true;
        assert_int_equal(walk->chart[i], atlas->chart[triangle]);
        for (int k = 0; k < 3; k++) {
            assert_int_equal(walk->vertex[walk->corners[i][k]], mesh->triangles[triangle][k]);
            assert_true(walk->corners[i][k] <= fresh);
            fresh += walk->corners[i][k] == fresh;
        }
        if (gate == SP_NONE)
            continue;
        const uint32_t *other = walk->corners[gate / 3];
        assert_true(gate / 3 < i);
        assert_int_equal(walk->chart[gate / 3], walk->chart[i]);
        assert_int_equal(walk->corners[i][(far + 1) % 3], other[(gate % 3 + 1) % 3]);
        assert_int_equal(walk->corners[i][(far + 2) % 3], other[gate % 3]);
        for (int k = 0; k < 2; k++) {
            assert_true(atlas->uv[triangle][(far + 1) % 3][k] ==
                        atlas->uv[walk->triangle[gate / 3]][(gate % 3 + 1) % 3][k]);
            assert_true(atlas->uv[triangle][(far + 2) % 3][k] == atlas->uv[walk->triangle[gate / 3]][gate % 3][k]);
        }
    }
    free(triangles);
    free(vertices);
}

/* Bytes told, and how many triangles were reached over an edge. */
static size_t walk_over(const sp_mesh *mesh, size_t *reached)
{
    sp_error error = {0};
    sp_charts *charts = sp_charts_create(mesh, INFINITY, &error);
    sp_atlas *atlas = sp_atlas_create(mesh, charts, &(sp_atlas_options){.texel = 0.05}, &error);
    assert_non_null(atlas);
    sp_coder coder;
    sp_triangle_order walk;
    sp_coder_start(&coder);
    assert_true(sp_triangle_order_create(&walk, mesh, atlas, &coder));
    sp_coder_end(&coder);
    expect_walk(&walk, mesh, atlas);
    *reached = 0;
    for (size_t i = 0; i < walk.count; i++)
        *reached += walk.gate[i] != SP_NONE;
    size_t bytes = coder.bytes.length;
    free(coder.bytes.text);
    sp_triangle_order_free(&walk);
    sp_atlas_destroy(atlas);
    sp_charts_destroy(charts);
    return bytes;
}

static void a_closed_surface_takes_a_few_bits_a_triangle(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_mesh *mesh = tank_mesh(96, &error);
    size_t reached, bytes = walk_over(mesh, &reached);
    assert_true(bytes < mesh->triangle_count / 2);
    assert_true(reached > mesh->triangle_count * 9 / 10);
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t *v = mesh->triangles[t], before[3] = {v[0], v[1], v[2]};
        for (int k = 0; k < 3; k++)
            v[k] = before[(k + tank_turn(t)) % 3];
    }
    assert_true(walk_over(mesh, &reached) < mesh->triangle_count);
    sp_mesh_destroy(mesh);
}

/* Triangles without neighbours, three on one edge, two on the same corners, a corner that none has. */
static void any_surface_is_walked(void **state)
{
    (void)state;
    enum { ALONE = 300, COUNT = ALONE + 5, POINTS = 3 * ALONE + 6 };
    static sp_vec3 points[POINTS];
    static uint32_t triangles[COUNT][3], part[COUNT];
    static const char *const names[] = {"soup"};
    sp_error error = {0};
    for (uint32_t i = 0; i < 3 * ALONE; i++) {
        points[i] = sp_v(i % 3 == 1, i % 3 == 2, i / 3);
        triangles[i / 3][i % 3] = i;
    }
    for (uint32_t i = 0; i < 6; i++)
        points[3 * ALONE + i] = sp_v(cos(i), sin(i), -1.0 - i);
    uint32_t o = 3 * ALONE;
    const uint32_t more[5][3] = {
        {o, o + 1, o + 2}, {o + 1, o, o + 3}, {o + 1, o, o + 4}, {o, o + 1, o + 4}, {o + 2, o, o + 1}};
    memcpy(triangles[ALONE], more, sizeof more);
    sp_mesh *mesh =
        sp_mesh_create(points, POINTS, (const uint32_t(*)[3])triangles, COUNT, part, (const char **)names, 1, &error);
    size_t reached;
    assert_non_null(mesh);
    assert_true(walk_over(mesh, &reached) > 0);
    assert_true(reached >= 1 && reached < 5);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_closed_surface_takes_a_few_bits_a_triangle),
        cmocka_unit_test(any_surface_is_walked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
