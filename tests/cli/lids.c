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

/* A mesh in the workplace, moved along the diagonal; it is destroyed. */
static void write_shape(const char *name, shape *s, double moved)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", workplace, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (size_t i = 0; i < s->point_count; i++)
        fprintf(file, "v %.17g %.17g %.17g\n", s->points[i].x + moved, s->points[i].y + moved, s->points[i].z + moved);
    for (size_t t = 0; t < s->triangle_count; t++) {
        if (t == 0 || s->part[t] != s->part[t - 1])
            fprintf(file, "g %s\n", s->names[s->part[t]]);
        fprintf(file, "f %u %u %u\n", s->triangles[t][0] + 1, s->triangles[t][1] + 1, s->triangles[t][2] + 1);
    }
    assert_int_equal(fclose(file), 0);
    free(s->points);
    free(s->triangles);
    free(s->part);
}

static void write_gap(void)
{
    shape s = shape_create();
    const double hole = RADIUS + GAP, wall[][2] = {{0, 0},       {0.5, 0},     {0.5, 1},      {hole, 1},
                                                   {hole, 1.02}, {0.52, 1.02}, {0.52, -0.02}, {0, -0.02}};
    const double shaft[][2] = {{0, 1.4}, {RADIUS, 1.4}, {RADIUS, 0.3}, {0, 0.3}};
    shape_part(&s, "wall");
    shape_turned(&s, wall, 8, SEGMENTS);
    shape_part(&s, "shaft");
    shape_turned(&s, shaft, 4, SEGMENTS);
    write_shape("gap.obj", &s, 0);
}

/* A room of 1 m with a lid of `cells` by `cells`, of which every third of every third row is a hole. */
static void write_room(const char *name, int cells, double moved)
{
    const sp_vec3 low = sp_v(0, 0, 0), x = sp_v(1, 0, 0), y = sp_v(0, 1, 0), z = sp_v(0, 0, 1);
    double cell = 1.0 / cells;
    shape s = shape_create();
    shape_part(&s, "room");
    for (int i = 0; i < cells * cells; i++)
        if (i % cells % 3 != 1 || i / cells % 3 != 1)
            shape_sheet(&s, sp_v(cell * (i % cells), cell * (i / cells), 1), sp_scale(x, cell), sp_scale(y, cell), 1);
    shape_sheet(&s, low, x, y, 1);
    shape_sheet(&s, low, z, x, 1);
    shape_sheet(&s, low, y, z, 1);
    shape_sheet(&s, y, x, z, 1);
    shape_sheet(&s, x, z, y, 1);
    write_shape(name, &s, moved);
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

static size_t count_of(const json_t *object, const char *key)
{
    return json_array_size(json_object_get(object, key));
}

/* Far from the origin of coordinates all that is printed is told apart still, and the cap that is to be pasted shuts
 * what it did. */
static void a_cap_that_is_pasted_shuts_far_away(void **state)
{
    (void)state;
    for (double moved = 0; moved < 1e7; moved = 10 * moved + 54321) {
        char scene[512], capped_scene[1024], low[128];
        write_room("far.obj", 3, moved);
        snprintf(scene, sizeof scene, "geometry: [{file: far.obj}]\ncavity: [%.1f m, %.1f m, %.1f m]\n", moved + 0.4,
                 moved + 0.6, moved + 0.5);
        write_file("far.yaml", scene);
        outcome told = run_program("check far.yaml " COARSE);
        assert_null(strstr(told.out, "e+"));
        snprintf(low, sizeof low, "%.0f, %.0f, %.0f", moved, moved, moved);
        assert_non_null(strstr(told.out, low));
        snprintf(low, sizeof low, " %.0f, %.0f, %.0f\n", moved + 1, moved + 1, moved + 1);
        assert_non_null(strstr(told.out, low));
        char *cap = strstr(told.out, "{point:");
        assert_non_null(cap);
        *strchr(cap, '\n') = '\0';
        snprintf(capped_scene, sizeof capped_scene, "%scaps: [%s]\n", scene, cap);
        write_file("far.yaml", capped_scene);
        forget(&told);
        json_t *shut = expect_json("check far.yaml --json " COARSE, 0);
        assert_int_equal(count_of(shut, "openings"), 0);
        assert_int_equal(count_of(shut, "warnings"), 0);
        assert_float_equal(number(shut, "clean_area_m2"), 6 - 1.0 / 9, 1e-6);
        json_decref(shut);
        snprintf(scene, sizeof scene, "geometry: [{file: far.obj}]\ncavity: [%.1f m, %.1f m, %.1f m]\n", moved + 0.4,
                 moved + 0.6, moved);
        write_file("far.yaml", scene);
        outcome refused = run_program("check far.yaml");
        snprintf(low, sizeof low, "the point (%.12g m, %.12g m, %.12g m);", moved + 0.4, moved + 0.6, moved);
        assert_non_null(strstr(refused.err, low));
        forget(&refused);
    }
}

static void openings_that_are_not_listed_are_counted(void **state)
{
    (void)state;
    write_room("screen.obj", 15, 0);
    write_file("screen.yaml", "geometry: [{file: screen.obj}]\ncavity: [0.4 m, 0.6 m, 0.5 m]\n");
    json_t *object = expect_json("check screen.yaml --json " COARSE, 0);
    size_t listed = count_of(object, "openings");
    assert_int_equal(listed, SP_OPENINGS);
    assert_int_equal(number(object, "more_openings"), 25 - SP_OPENINGS);
    json_decref(object);
    outcome told = run_program("check screen.yaml " COARSE);
    assert_non_null(strstr(told.out, "\nand at least 9 more"));
    forget(&told);
}

/* One cap lies in the midst of the liquid, one out in the sky, and one may part the room. */
static void write_mistyped(int radius)
{
    char scene[512];
    snprintf(scene, sizeof scene,
             "geometry: [{file: open.obj}]\ncavity: [0.4 m, 0.6 m, 0.2 m]\ncaps:\n"
             "  - {point: [0.5 m, 0.5 m, 0.7 m], normal: [0, 0, 1], radius: 200 mm}\n"
             "  - {point: [0.5 m, 0.5 m, 70 m], normal: [0, 0, 1], radius: 200 mm}\n"
             "  - {point: [0.5 m, 0.5 m, 0.4 m], normal: [0, 0, 1], radius: %d mm}\n",
             radius);
    write_file("mistyped.yaml", scene);
}

static void caps_that_shut_nothing_are_reported(void **state)
{
    (void)state;
    write_room("open.obj", 3, 0);
    write_mistyped(800);
    json_t *object = expect_json("check mistyped.yaml --json " COARSE, 0);
    assert_int_equal(count_of(object, "warnings"), 2);
    assert_float_equal(number(object, "beyond_caps_m2"), 6 - 1.0 / 9 - 2.6, 1e-6);
    json_decref(object);
    write_mistyped(200);
    outcome told = run_program("check mistyped.yaml " COARSE);
    assert_non_null(strstr(told.out, "caps        3; beyond them 0.0000 m2"));
    assert_non_null(strstr(told.out, "warning: caps: the one at [0.5 m, 0.5 m, 0.7 m] shuts nothing: liquid passes"));
    assert_non_null(strstr(told.out, "warning: caps: the one at [0.5 m, 0.5 m, 70 m] shuts nothing: no liquid comes"));
    assert_non_null(strstr(told.out, "warning: caps: the one at [0.5 m, 0.5 m, 0.4 m] shuts nothing: liquid passes"));
    forget(&told);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_says_where_it_leaks),
        cmocka_unit_test(a_cap_shuts_it),
        cmocka_unit_test(a_cap_that_is_pasted_shuts_far_away),
        cmocka_unit_test(openings_that_are_not_listed_are_counted),
        cmocka_unit_test(caps_that_shut_nothing_are_reported),
        cmocka_unit_test(the_picture_is_the_same_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, open_with_gap, close_workplace);
}
