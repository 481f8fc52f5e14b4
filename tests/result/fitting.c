/* The numbers of a sheet: as fine as what can be set and as small parts need, and in agreement with one another. */
#include "../scene/scratch.h"

#include <sprayplan/result.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

/* A nozzle on a lance straight down. */
typedef struct {
    const char *scale;         /* of a tetrahedron of 1 m */
    const char *mouth, *depth; /* of the lance */
    const char *step;          /* of its port, "" for none */
    const char *position, *axis;
    const char *type; /* of the nozzle's */
} lance;

static const char set_type[] = "pattern: full_cone, angle: 90 deg, flow: 12 L/min, at: 2 bar";

static sp_scene *scene_of(const lance *l)
{
    char text[1000];
    sp_error error = {0};
    snprintf(text, sizeof text, "nozzles:\n  - {name: cone, %s}\n", l->type ? l->type : set_type);
    scratch_write("set.yaml", text);
    snprintf(text, sizeof text,
             "geometry:\n  - {file: tank.obj, scale: %s}\n"
             "criterion: {flux: 1 L/min/m2}\ncatalogue: set.yaml\n"
             "nozzles:\n  - {name: N1, type: cone, position: [0, 0, %s], axis: %s, pressure: 2 bar}\n"
             "place:\n  max_nozzles: 1\n  pressure: 2 bar\n  mounts:\n"
             "    - port: {name: P1, position: [0, 0, %s], tilt: 40 deg, depth: {from: %s, to: %s}%s}\n",
             l->scale, l->position, l->axis, l->mouth, l->depth, l->depth, l->step);
    scratch_write("scene.yaml", text);
    sp_scene *scene = sp_scene_load("scene.yaml", &error);
    if (!scene)
        fail_msg("%s", error.message);
    return scene;
}

static sp_fitting_sheet *sheet_of(const sp_scene *scene)
{
    const sp_place_options place = sp_scene_place_options(scene);
    sp_error error = {0};
    sp_fitting_sheet *sheet =
        sp_fitting_sheet_create(sp_scene_layout(scene), sp_scene_setup(scene), place.mounts, place.mount_count, &error);
    if (!sheet)
        fail_msg("%s", error.message);
    return sheet;
}

/* What its row says from the mounting on. */
static void expect_row(const lance *l, const char *expected)
{
    sp_error error = {0};
    sp_scene *scene = scene_of(l);
    sp_fitting_sheet *sheet = sheet_of(scene);
    char *csv = sp_nozzles_csv(sheet, &error), *row = strstr(csv, ",port,");
    assert_non_null(row);
    assert_string_equal(row, expected);
    free(csv);
    sp_fitting_sheet_destroy(sheet);
    sp_scene_destroy(scene);
}

static void settings_are_reported_as_they_are_set(void **state)
{
    (void)state;
    lance l = {.scale = "1",
               .mouth = "2 m",
               .depth = "102.5 mm",
               .step = ", step: {depth: 2.5 mm, tilt: 0.25 deg}",
               .position = "1.8975 m",
               .axis = "[0, 0.378649, -0.925540]"};
    expect_row(&l, ",port,P1,102.5,,0,0,2000,0,0,0,0,1897.5,0,0,22.25,90,,1,12\n");
    /* without a step as ever, and without a contradiction */
    l.step = "";
    expect_row(&l, ",port,P1,103,,0,0,2000,0,0,0,0,1897,0,0,22.3,90,,1,12\n");
}

static void small_parts_are_reported_as_well(void **state)
{
    (void)state;
    const lance l = {
        .scale = "0.005", .mouth = "5 mm", .depth = "0.5 mm", .step = "", .position = "4.5 mm", .axis = "[0, 0, -1]"};
    expect_row(&l, ",port,P1,0.5,,0,0,5,0,0,0,0,4.5,0,0,0,0,,1,12\n");
}

/* As many decimals as a step and what it counts from need, as few as ever where these do. */
static void decimals_follow_the_steps(void **state)
{
    (void)state;
    static const struct {
        const char *scale, *depth, *step;
        int mm, deg;
    } lances[] = {
        {"1", "102.5 mm", ", step: {depth: 2.5 mm, tilt: 0.25 deg}", 1, 2},
        {"1", "50 mm", ", step: {depth: 10 mm, tilt: 15 deg}", 0, 1},
        {"1", "50.8 mm", ", step: {depth: 10 mm}", 1, 1},
        {"1", "50.8 mm", "", 0, 1},
        {"1", "1 in", ", step: {depth: 0.25 in, tilt: 0.125 deg}", 2, 3},
        {"1", "1 in", ", step: {depth: 0.0625 in}", 4, 1},
        /* what no decimals tell: to a ten-thousandth of a step */
        {"1", "33.33333333 mm", ", step: {depth: 5 mm, tilt: 0.01 rad}", 4, 5},
        {"0.1", "1 mm", ", step: {depth: 1 mm}", 1, 1},
        {"0.005", "1 mm", "", 3, 1},
    };
    for (size_t i = 0; i < sizeof lances / sizeof *lances; i++) {
        const lance l = {lances[i].scale, "0.2 m", lances[i].depth, lances[i].step, "0.1 m", "[0, 0, -1]", NULL};
        sp_scene *scene = scene_of(&l);
        sp_fitting_sheet *sheet = sheet_of(scene);
        if (sheet->decimals.mm != lances[i].mm || sheet->decimals.deg != lances[i].deg)
            fail_msg("%s%s: %d and %d", l.depth, l.step, sheet->decimals.mm, sheet->decimals.deg);
        assert_int_equal(sheet->decimals.angle_deg, 1);
        assert_int_equal(sheet->decimals.bar, 2);
        assert_int_equal(sheet->decimals.l_min, 2);
        sp_fitting_sheet_destroy(sheet);
        sp_scene_destroy(scene);
    }
}

static void types_have_steps_as_well(void **state)
{
    (void)state;
    const lance l = {"1",
                     "0.2 m",
                     "1 mm",
                     "",
                     "0.1 m",
                     "[0, 0, -1]",
                     "pattern: full_cone, angle: 62.25 deg, flow: 12 L/min, at: 2 bar, angle_range: [60 deg, 90 deg], "
                     "flow_range: [8 L/min, 16 L/min], step: {angle: 0.5 deg, flow: 0.125 L/min, pressure: 1 mbar}"};
    sp_scene *scene = scene_of(&l);
    sp_fitting_sheet *sheet = sheet_of(scene);
    assert_int_equal(sheet->decimals.angle_deg, 2);
    assert_int_equal(sheet->decimals.bar, 3);
    assert_int_equal(sheet->decimals.l_min, 3);
    sp_fitting_sheet_destroy(sheet);
    sp_scene_destroy(scene);
}

/* Whatever lies where: what is between two heights as they are told is the depth as it is told. */
static void depth_and_heights_agree(void **state)
{
    (void)state;
    const lance l = {"1", "2 m", "0.1 m", "", "1.9 m", "[0, 0, -1]", NULL};
    sp_scene *scene = scene_of(&l);
    sp_mount port = sp_scene_place_options(scene).mounts[0];
    sp_nozzle nozzle = sp_scene_layout(scene)->nozzles[0];
    const sp_layout layout = {.count = 1, .nozzles = &nozzle};
    port.depth_from = 0;
    port.depth_to = 1;
    for (int i = 0; i < 400; i++) {
        double depth = 0.1 + 1e-4 * (i % 20), sign = i % 2 ? 1 : -1;
        port.axis = sp_v(0, 0, sign);
        port.position = sp_v(0, 0, sign + 1e-4 * (i / 20));
        nozzle.position = sp_along(port.position, depth, port.axis);
        sp_error error = {0};
        sp_fitting_sheet *sheet = sp_fitting_sheet_create(&layout, sp_scene_setup(scene), &port, 1, &error);
        assert_non_null(sheet);
        const sp_fitting_row *row = sheet->rows;
        assert_true(fabs(row->depth_mm - 1e3 * depth) < 0.501);
        assert_true(fabs(row->tip.height_mm - 1e3 * nozzle.position.z) < 1.001);
        if (row->at.height_mm + sign * row->depth_mm != row->tip.height_mm)
            fail_msg("%g, %g, %g", row->at.height_mm, row->depth_mm, row->tip.height_mm);
        sp_fitting_sheet_destroy(sheet);
    }
    sp_scene_destroy(scene);
}

/* The same of a wall that lies 0.4 mm below the datum. */
static void standoff_and_heights_agree(void **state)
{
    (void)state;
    const lance l = {"1", "2 m", "0.1 m", "", "1.9 m", "[0, 0, -1]", NULL};
    sp_scene *scene = scene_of(&l);
    sp_setup setup = *sp_scene_setup(scene);
    sp_nozzle nozzle = sp_scene_layout(scene)->nozzles[0];
    const sp_layout layout = {.count = 1, .nozzles = &nozzle};
    const sp_mount wall = {.kind = SP_MOUNT_SURFACE, .part = 0, .spacing = 1, .standoff = 0.0106, .tilt = 1};
    nozzle.position = sp_v(0.3, 0.3, 0.0106);
    setup.datum.origin = sp_v(0, 0, 4e-4);
    sp_error error = {0};
    sp_fitting_sheet *sheet = sp_fitting_sheet_create(&layout, &setup, &wall, 1, &error);
    assert_non_null(sheet);
    assert_true(sheet->rows[0].at.height_mm == 0);
    assert_true(sheet->rows[0].standoff_mm == 11);
    assert_true(sheet->rows[0].tip.height_mm == 11);
    sp_fitting_sheet_destroy(sheet);
    sp_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settings_are_reported_as_they_are_set),
        cmocka_unit_test(small_parts_are_reported_as_well),
        cmocka_unit_test(decimals_follow_the_steps),
        cmocka_unit_test(types_have_steps_as_well),
        cmocka_unit_test(depth_and_heights_agree),
        cmocka_unit_test(standoff_and_heights_agree),
    };
    return cmocka_run_group_tests(tests, scratch_make, scratch_remove);
}
