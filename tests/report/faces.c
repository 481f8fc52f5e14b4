/* How the page is told which vertices triangles have: by whichever is shorter. */
#include "report/viewer/faces.h"

#include "tank.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

/* The first word, and whether all of it is shorter than differences would be. */
static uint32_t way_of(sp_mesh *mesh, size_t *length)
{
    sp_packed packed = {0};
    uint32_t way;
    assert_true(sp_faces_pack(mesh, &packed));
    memcpy(&way, packed.text, sizeof way);
    *length = packed.length;
    free(packed.text);
    return way;
}

static void what_repeats_itself_is_told_by_differences(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_mesh *mesh = tank_mesh(96, &error);
    size_t length;
    assert_int_equal(way_of(mesh, &length), 0);
    assert_int_equal(length, 4 + 12 * mesh->triangle_count);
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t *v = mesh->triangles[t], before[3] = {v[0], v[1], v[2]};
        for (int k = 0; k < 3; k++)
            v[k] = before[(k + tank_turn(t)) % 3];
    }
    assert_int_equal(way_of(mesh, &length), 1);
    assert_true(length < 8 * mesh->triangle_count);
    sp_mesh_destroy(mesh);
}

/* No neighbours, and neighbours that are too far back. */
static void triangles_may_stand_alone(void **state)
{
    (void)state;
    enum { COUNT = 900 };
    static sp_vec3 points[3 * COUNT];
    static uint32_t triangles[COUNT][3], part[COUNT];
    static const char *const names[] = {"soup"};
    sp_error error = {0};
    for (uint32_t i = 0; i < 3 * COUNT; i++) {
        points[i] = sp_v(i % 3 == 1, i % 3 == 2, i / 3);
        triangles[i / 3][i % 3] = i;
    }
    triangles[COUNT - 1][0] = triangles[0][1];
    triangles[COUNT - 1][1] = triangles[0][0];
    sp_mesh *mesh = sp_mesh_create(points, 3 * COUNT, (const uint32_t(*)[3])triangles, COUNT, part,
                                   (const char **)names, 1, &error);
    size_t length;
    assert_non_null(mesh);
    assert_int_equal(mesh->triangle_count, COUNT);
    way_of(mesh, &length);
    assert_true(length > 0);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_repeats_itself_is_told_by_differences),
        cmocka_unit_test(triangles_may_stand_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
