/* sprayplan atlas: texels of its own choice and texels asked for; and the unit of a mesh. */
#include "workplace.h"

#include <math.h>

/* A rail of 6 m by 20 mm by 20 mm. */
static const char rail_obj[] =
    "v 0 0 0\nv 6 0 0\nv 6 .02 0\nv 0 .02 0\nv 0 0 .02\nv 6 0 .02\nv 6 .02 .02\nv 0 .02 .02\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

static void expect_refused(const char *arguments, const char *complaint)
{
    outcome result = run_program(arguments);
    if (result.status != 3 || strcmp(result.err, complaint) != 0)
        fail_msg("sprayplan %s: status %d, %s", arguments, result.status, result.err);
    forget(&result);
}

/* A million texels for its surface would be so short that its length takes 8,863 of them. */
static void a_long_part_gets_texels_that_fit(void **state)
{
    (void)state;
    write_file("rail.obj", rail_obj);
    json_t *object = expect_json("atlas rail.obj --json", 0);
    double texel = json_number_value(json_object_get(object, "texel_m"));
    assert_true(fabs(texel * 4094 - hypot(6, 0.02)) < 1e-9);
    json_decref(object);
    expect_refused(
        "atlas rail.obj --texel 1mm",
        "rail.obj: a flat piece of the surface of 6 m by 0.02 m does not fit a page of 4096 texels of 0.001 m; "
        "expected a texel of at least 0.001466 m\n");
    json_decref(expect_json("atlas rail.obj --texel 1.466mm --json", 0));
}

/* Lengths asked for are in m all the same, and so is what is written. */
static void a_mesh_may_be_in_mm(void **state)
{
    (void)state;
    write_file("mm.obj", "v 0 0 0\nv 1500 0 0\nv 1500 500 0\nv 0 500 0\nf 1 2 3 4\n");
    json_t *object = expect_json("atlas mm.obj --unit mm --texel 10mm -o m.obj --json", 0);
    assert_int_equal(json_integer_value(json_object_get(object, "texels")), 150 * 50);
    json_decref(object);
    object = expect_json("atlas m.obj --reuse --json", 0);
    assert_int_equal(json_integer_value(json_object_get(object, "texels")), 150 * 50);
    assert_true(fabs(json_number_value(json_object_get(object, "texel_m")) - 0.01) < 1e-12);
    json_decref(object);
    object = expect_json("atlas m.obj --reuse --unit mm --json", 0);
    assert_true(fabs(json_number_value(json_object_get(object, "texel_m")) - 1e-5) < 1e-15);
    json_decref(object);
}

/* Before anything is unfolded, which could take minutes. */
static void too_many_texels_are_refused(void **state)
{
    (void)state;
    expect_refused(
        "atlas room.obj --unit km --texel 10mm",
        "room.obj: found 6e+10 texels of 0.01 m on a surface of 6e+06 m2, expected at most 1e+09 of them, or "
        "another unit of the file's coordinates, as --unit mm\n");
}

/* The room has 6 m2 and a diagonal of 1.7 m. */
static void texels_longer_than_all_are_refused(void **state)
{
    (void)state;
    expect_refused("atlas room.obj --texel 1e308",
                   "room.obj: found a texel of 1e+308 m on a surface with a diagonal of 1.732 m, expected no more than "
                   "that, or another unit of the file's coordinates, as --unit mm\n");
    expect_refused("atlas room.obj --texel 1.74", "room.obj: found a texel of 1.74 m on a surface with a diagonal of "
                                                  "1.732 m, expected no more than that, or another unit of the file's "
                                                  "coordinates, as --unit mm\n");
    json_decref(expect_json("atlas room.obj --texel 1.73 --json", 0));
}

static void texels_too_short_to_count_are_refused(void **state)
{
    (void)state;
    expect_refused("atlas room.obj --texel 1e-30",
                   "room.obj: found 6e+60 texels of 1e-30 m on a surface of 6 m2, expected at most 1e+09 of them, or "
                   "another unit of the file's coordinates, as --unit mm\n");
    outcome result = run_program("atlas room.obj --texel 1e-308");
    assert_int_equal(result.status, 2);
    assert_non_null(strstr(result.err, "--texel: found \"1e-308\", expected a length above 0 (1e-30 m at least)"));
    forget(&result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_long_part_gets_texels_that_fit),      cmocka_unit_test(a_mesh_may_be_in_mm),
        cmocka_unit_test(too_many_texels_are_refused),           cmocka_unit_test(texels_longer_than_all_are_refused),
        cmocka_unit_test(texels_too_short_to_count_are_refused),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
