/* sprayplan atlas: texels of its own choice and texels asked for. */
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_long_part_gets_texels_that_fit),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
