/* Welding, joining, transforming. */
#include <sprayplan/mesh.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void equal_points_are_one_vertex(void **state)
{
    (void)state;
    static const sp_vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {0, 1, 0}, {0, 0, 1}, {7, 7, 7}};
    static const uint32_t triangles[][3] = {{0, 1, 2}, {3, 4, 5}};
    sp_mesh *mesh = sp_mesh_create(points, 7, triangles, 2, NULL, NULL, 0, NULL);
    assert_non_null(mesh);
    assert_int_equal(mesh->vertex_count, 5);
    assert_int_equal(mesh->triangles[1][0], 0);
    assert_int_equal(mesh->triangles[1][1], 2);
    assert_int_equal(mesh->triangles[1][2], 3);
    assert_int_equal(mesh->part_count, 1);
    assert_string_equal(mesh->parts[0].name, "default");
    assert_true(fabs(sp_mesh_area(mesh) - 1) < 1e-15);
    sp_mesh_destroy(mesh);
}

static void points_a_rounding_apart_are_two(void **state)
{
    (void)state;
    const sp_vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nextafter(1, 2), 0, 0}, {0, -1, 0}};
    static const uint32_t triangles[][3] = {{0, 1, 2}, {0, 4, 3}};
    sp_mesh *mesh = sp_mesh_create(points, 5, triangles, 2, NULL, NULL, 0, NULL);
    assert_int_equal(mesh->vertex_count, 5);
    sp_mesh_destroy(mesh);
}

/* Equal corners, corners in a line (exactly and but for round-off), and beside them thin but proper triangles. */
static void degenerate_triangles_are_kept_out(void **state)
{
    (void)state;
    static const sp_vec3 points[] = {{0, 0, 0},       {1, 0, 0},       {0, 1, 0},       {2, 0, 0},
                                     {0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.7, 0.7, 0.7}, {0.5, 1e-9, 0},
                                     {1e-6, 0, 0},    {0, 1e-6, 0},    {0.5, 1e-18, 0}};
    static const uint32_t triangles[][3] = {{0, 1, 1}, {0, 1, 2}, {0, 1, 3}, {4, 5, 6},
                                            {0, 1, 7}, {0, 8, 9}, {0, 1, 10}};
    static const uint32_t part[] = {0, 1, 0, 1, 0, 1, 0};
    static const char *const names[] = {"a", "b"};
    sp_mesh *mesh = sp_mesh_create(points, 11, triangles, 7, part, names, 2, NULL);
    assert_int_equal(mesh->source_triangle_count, 7);
    assert_int_equal(mesh->triangle_count, 3);
    static const uint32_t kept[] = {1, 4, 5};
    for (int t = 0; t < 3; t++) {
        assert_int_equal(mesh->source[t], kept[t]);
        assert_int_equal(mesh->part[t], part[kept[t]]);
        assert_memory_equal(mesh->triangles[t], triangles[kept[t]], sizeof *triangles);
        assert_true(fabs(sp_length(sp_triangle_normal(mesh, (uint32_t)t)) - 1) < 1e-12);
    }
    for (int t = 0; t < 7; t++)
        assert_int_equal(mesh->source_part[t], part[t]);
    sp_mesh_destroy(mesh);
}

static void wrong_arrays_are_refused(void **state)
{
    (void)state;
    sp_vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    uint32_t triangle[][3] = {{0, 1, 2}}, part[] = {1};
    sp_error error = {0};
    assert_null(sp_mesh_create(points, 2, (const uint32_t(*)[3])triangle, 1, NULL, NULL, 0, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    assert_null(sp_mesh_create(points, 3, (const uint32_t(*)[3])triangle, 1, part, NULL, 1, NULL));
    points[1].y = NAN;
    assert_null(sp_mesh_create(points, 3, (const uint32_t(*)[3])triangle, 1, NULL, NULL, 0, NULL));
    points[1].y = -INFINITY;
    assert_null(sp_mesh_create(points, 3, (const uint32_t(*)[3])triangle, 1, NULL, NULL, 0, NULL));
    sp_mesh_destroy(NULL);
}

static void rotation_is_rodrigues(void **state)
{
    (void)state;
    sp_transform transform = sp_transform_default();
    sp_vec3 p = sp_transform_point(&transform, sp_v(1, 2, 3));
    assert_true(p.x == 1 && p.y == 2 && p.z == 3);
    sp_transform_rotation(&transform, sp_v(0, 0, 5), M_PI / 2);
    transform.scale = 2;
    transform.translate = sp_v(10, 0, 0);
    p = sp_transform_point(&transform, sp_v(1, 0, 1));
    assert_true(sp_distance(p, sp_v(10, 2, 2)) < 1e-15);
    sp_transform_rotation(&transform, sp_v(1, 1, 1), 2 * M_PI / 3);
    transform.scale = 1;
    transform.translate = sp_v(0, 0, 0);
    assert_true(sp_distance(sp_transform_point(&transform, sp_v(1, 2, 3)), sp_v(3, 1, 2)) < 1e-14);
}

static sp_mesh *two_triangles(const char *name)
{
    static const sp_vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    static const uint32_t triangles[][3] = {{0, 1, 1}, {0, 1, 2}, {0, 2, 3}};
    static const uint32_t part[] = {0, 0, 1};
    const char *names[] = {name, "other"};
    return sp_mesh_create(points, 4, triangles, 3, part, names, 2, NULL);
}

static void joined_meshes_keep_order_parts_and_vertices(void **state)
{
    (void)state;
    sp_mesh *meshes[] = {two_triangles("a"), two_triangles("b")};
    sp_transform transforms[] = {sp_transform_default(), sp_transform_default()};
    transforms[1].translate = sp_v(0, 0, 3);
    sp_mesh *mesh = sp_mesh_join((const sp_mesh *const *)meshes, transforms, 2, NULL);
    assert_non_null(mesh);
    assert_int_equal(mesh->vertex_count, 8);
    assert_int_equal(mesh->triangle_count, 4);
    assert_int_equal(mesh->source_triangle_count, 6);
    assert_int_equal(mesh->part_count, 4);
    assert_string_equal(mesh->parts[2].name, "b");
    assert_int_equal(mesh->parts[1].geometry, 0);
    assert_int_equal(mesh->parts[2].geometry, 1);
    assert_int_equal(mesh->triangles[2][0], 4);
    assert_int_equal(mesh->part[3], 3);
    assert_int_equal(mesh->source[2], 4);
    assert_int_equal(mesh->source_triangles[3][1], 5);
    assert_int_equal(mesh->source_part[5], 3);
    assert_true(mesh->vertices[4].z == 3);
    sp_mesh_destroy(mesh);
    transforms[1].translate = sp_v(0, 0, 0);
    mesh = sp_mesh_join((const sp_mesh *const *)meshes, transforms, 2, NULL);
    assert_int_equal(mesh->vertex_count, 8); /* different meshes are not welded */
    sp_mesh_destroy(mesh);
    sp_mesh_destroy(meshes[0]);
    sp_mesh_destroy(meshes[1]);
}

/* Far away, rounding makes points equal and triangles flat: the join must notice. */
static void what_a_transform_flattens_is_kept_out(void **state)
{
    (void)state;
    static const sp_vec3 points[] = {{0, 0, 0}, {1e-9, 0, 0}, {0, 1e-9, 0}, {1, 0, 0}, {0, 1, 0}};
    static const uint32_t triangles[][3] = {{0, 1, 2}, {0, 3, 4}};
    sp_mesh *small = sp_mesh_create(points, 5, triangles, 2, NULL, NULL, 0, NULL);
    assert_int_equal(small->triangle_count, 2);
    sp_transform transform = sp_transform_default();
    transform.translate = sp_v(1e9, 1e9, 0);
    sp_mesh *mesh = sp_mesh_join((const sp_mesh *const[]){small}, &transform, 1, NULL);
    assert_int_equal(mesh->vertex_count, 3);
    assert_int_equal(mesh->triangle_count, 1);
    assert_int_equal(mesh->source[0], 1);
    sp_mesh_destroy(mesh);
    sp_mesh_destroy(small);
}

static void impossible_transforms_are_refused(void **state)
{
    (void)state;
    sp_mesh *mesh = two_triangles("a");
    const sp_mesh *meshes[] = {mesh};
    sp_transform mirror = sp_transform_default(), huge = mirror, flat = mirror;
    mirror.rotate[2][2] = -1;
    huge.scale = 1e300;
    flat.scale = 0;
    assert_null(sp_mesh_join(meshes, &mirror, 1, NULL));
    assert_null(sp_mesh_join(meshes, &huge, 1, NULL));
    assert_null(sp_mesh_join(meshes, &flat, 1, NULL));
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_points_are_one_vertex),
        cmocka_unit_test(points_a_rounding_apart_are_two),
        cmocka_unit_test(degenerate_triangles_are_kept_out),
        cmocka_unit_test(wrong_arrays_are_refused),
        cmocka_unit_test(rotation_is_rodrigues),
        cmocka_unit_test(joined_meshes_keep_order_parts_and_vertices),
        cmocka_unit_test(what_a_transform_flattens_is_kept_out),
        cmocka_unit_test(impossible_transforms_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
