/* A scene whose vessel leaks through the gap around its shaft: check says where, a cap in the scene file shuts it, and
 * the picture of what is wet. */
#include "results.h"

#include "../spray/shapes.h"

#include <math.h>

#define SEGMENTS 24
#define RADIUS 0.05 /* m, of the shaft */
#define GAP 0.01    /* m, around it in the lid, which is 20 mm thick */

static const char leaking[] = "geometry:\n  - file: gap.obj\ncavity: [0.3 m, 0 m, 0.5 m]\nsimulate: {texel: 20 mm}\n";
static const char capped[] = "caps:\n  - {point: [0 m, 0 m, 1.01 m], normal: [0, 0, 1], radius: 70 mm}\n";

static void write_gap(void)
{
    shape s = shape_create();
    const double hole = RADIUS + GAP, wall[][2] = {{0, 0},       {0.5, 0},     {0.5, 1},      {hole, 1},
                                                   {hole, 1.02}, {0.52, 1.02}, {0.52, -0.02}, {0, -0.02}};
    const double shaft[][2] = {{0, 1.4}, {RADIUS, 1.4}, {RADIUS, 0.3}, {0, 0.3}};
    char path[1024];
    snprintf(path, sizeof path, "%s/gap.obj", workplace);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    shape_turned(&s, wall, 8, SEGMENTS);
    size_t of_wall = s.triangle_count;
    shape_turned(&s, shaft, 4, SEGMENTS);
    for (size_t i = 0; i < s.point_count; i++)
        fprintf(file, "v %.17g %.17g %.17g\n", s.points[i].x, s.points[i].y, s.points[i].z);
    for (size_t t = 0; t < s.triangle_count; t++)
        fprintf(file, "%sf %u %u %u\n",
                t == 0         ? "g wall\n"
                : t == of_wall ? "g shaft\n"
                               : "",
                s.triangles[t][0] + 1, s.triangles[t][1] + 1, s.triangles[t][2] + 1);
    assert_int_equal(fclose(file), 0);
    free(s.points);
    free(s.triangles);
    free(s.part);
}

static int open_with_gap(void **state)
{
    if (open_workplace(state))
        return -1;
    char scene[512];
    write_gap();
    write_file("leaking.yaml", leaking);
    snprintf(scene, sizeof scene, "%s%s", leaking, capped);
    write_file("capped.yaml", scene);
    return 0;
}

/* What of the vessel lies within, and the two walls of the gap through the lid. */
static double wet_inside(double *in_hole)
{
    const double c = cos(M_PI / SEGMENTS), d = sin(M_PI / SEGMENTS), hole = RADIUS + GAP;
    *in_hole = 2 * SEGMENTS * d * (hole + RADIUS) * 0.02;
    return SEGMENTS * c * d * (2 * 0.5 * 0.5 - hole * hole + RADIUS * RADIUS) + 2 * SEGMENTS * d * 0.5 +
           2 * SEGMENTS * d * RADIUS * 0.7;
}

static void check_says_where_it_leaks(void **state)
{
    (void)state;
    double in_hole, inside = wet_inside(&in_hole);
    json_t *object = expect_json("check leaking.yaml --json", 0);
    json_t *opening = json_array_get(json_object_get(object, "openings"), 0);
    assert_true(number(object, "outdoors_m2") > 0);
    assert_int_equal(json_array_size(json_object_get(object, "warnings")), 1);
    const char *warning = json_string_value(json_array_get(json_object_get(object, "warnings"), 0));
    assert_non_null(strstr(warning, "`caps:`"));
    assert_true(json_is_null(json_object_get(opening, "cap"))); /* a ring around the shaft */
    assert_true(number(opening, "width_m") > 0.5 * GAP && number(opening, "width_m") < 3 * GAP);
    double clean = number(object, "clean_area_m2");
    assert_true(clean > 0.998 * inside && clean < 1.002 * (inside + in_hole));
    json_decref(object);
}

static void a_cap_shuts_it(void **state)
{
    (void)state;
    double in_hole, inside = wet_inside(&in_hole);
    json_t *object = expect_json("check capped.yaml --json", 0);
    assert_true(number(object, "outdoors_m2") == 0);
    assert_int_equal(json_array_size(json_object_get(object, "openings")), 0);
    assert_int_equal(json_array_size(json_object_get(object, "warnings")), 0);
    /* the cap halves the shaft's side in the hole; the hole's wall is one face or two from end to end */
    double clean = number(object, "clean_area_m2");
    assert_true(clean > inside + 0.4 * in_hole && clean < inside + 1.01 * in_hole);
    json_decref(object);
}

static void the_picture_is_the_same_for_any_number_of_threads(void **state)
{
    (void)state;
    size_t size[2];
    char *bytes[2], *listed;
    for (int i = 0; i < 2; i++) {
        json_decref(expect_json(
            i ? "check capped.yaml --json --threads 3 -o three" : "check capped.yaml --json --threads 1 -o one", 0));
        listed = list_folder(i ? "three" : "one");
        assert_string_equal(listed, "wet.png\n");
        free(listed);
        bytes[i] = read_file(i ? "three/wet.png" : "one/wet.png", &size[i]);
        assert_non_null(bytes[i]);
    }
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(bytes[0], bytes[1], size[0]);
    assert_memory_equal(bytes[0], "\x89PNG", 4);
    free(bytes[0]);
    free(bytes[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_says_where_it_leaks),
        cmocka_unit_test(a_cap_shuts_it),
        cmocka_unit_test(the_picture_is_the_same_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, open_with_gap, close_workplace);
}
