/* A scene with rotating types, from its catalogue to result.json and back. */
#include "../scene/scratch.h"

#include <sprayplan/result.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static const char turning_catalogue[] =
    "nozzles:\n"
    "  - {name: plain, pattern: full_cone, angle: 90 deg, flow: 12 L/min, at: 2 bar}\n"
    "  - {name: fan, pattern: rotating, flow: 40 L/min, at: 3 bar,\n"
    "     rotation: {jet: {pattern: flat_fan, angle: 60 deg, thickness: 4 deg, tilt: 30 deg, roll: 20 deg}}}\n"
    "  - {name: head, pattern: rotating, flow: 60 L/min, at: 4 bar,\n"
    "     rotation: {jets: 4, gears: [43, 47], speed: 3 rpm, turns: 20, jet: {pattern: solid_stream}}}\n"
    "  - {name: slow, pattern: rotating, flow: 60 L/min, at: 4 bar,\n"
    "     rotation: {jets: 1, gears: [1, 1000], jet: {pattern: hollow_cone, angle: 5 deg, hollow: 0.5}}}\n";

static const char turning_scene[] =
    "geometry: [{file: tank.obj}]\n"
    "cavity: [0.1, 0.1, 0.1]\n"
    "catalogue: turning.yaml\n"
    "criterion: {flux: 1 L/min/m2}\n"
    "simulate: {texel: 40 mm}\n"
    "nozzles:\n"
    "  - {name: A, type: head, position: [0.2, 0.2, 0.2], axis: [0, 0, 1], pressure: 4 bar}\n"
    "  - {name: B, type: fan, position: [0.2, 0.2, 0.3], axis: [0, 0, -1], pressure: 3 bar}\n"
    "  - {name: C, type: slow, position: [0.1, 0.2, 0.3], axis: [0, 1, 0], pressure: 4 bar}\n"
    "place:\n"
    "  pressure: 3 bar\n"
    "  types: [plain, fan]\n"
    "  mounts: [{port: {name: P, position: [0.2, 0.2, 0.3], axis: [0, 0, -1]}}]\n";

static int make(void **state)
{
    if (scratch_make(state))
        return -1;
    scratch_write("turning.yaml", turning_catalogue);
    scratch_write("scene.yaml", turning_scene);
    return 0;
}

static sp_scene *load(void)
{
    sp_error error = {0};
    char text[2000];
    sp_scene *scene = sp_scene_load("scene.yaml", &error);
    sp_error_text(&error, text, sizeof text);
    if (!scene)
        fail_msg("%s", text);
    return scene;
}

static void types_are_as_written(void **state)
{
    (void)state;
    sp_scene *scene = load();
    const sp_layout *layout = sp_scene_layout(scene);
    const sp_nozzle_type *head = layout->nozzles[0].type, *fan = layout->nozzles[1].type;
    assert_int_equal(fan->pattern, SP_PATTERN_ROTATING);
    assert_int_equal(fan->rotation.jet, SP_PATTERN_FLAT_FAN);
    assert_int_equal(fan->rotation.jets, 0);
    assert_float_equal(fan->angle, M_PI / 3, 1e-12);
    assert_float_equal(fan->angle_max, M_PI / 3, 1e-12);
    assert_float_equal(fan->thickness, M_PI / 45, 1e-12);
    assert_float_equal(fan->rotation.tilt, M_PI / 6, 1e-12);
    assert_float_equal(fan->rotation.roll, M_PI / 9, 1e-12);
    assert_int_equal(head->rotation.jet, SP_PATTERN_SOLID_STREAM);
    assert_int_equal(head->rotation.jets, 4);
    assert_true(head->rotation.gears[0] == 43 && head->rotation.gears[1] == 47 && head->rotation.turns == 20);
    assert_float_equal(head->rotation.speed, 3 * 2 * M_PI / 60, 1e-12);
    assert_float_equal(head->angle, M_PI / 180, 1e-12);
    sp_scene_destroy(scene);
}

static void gaps_are_reported(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_scene *scene = load();
    const sp_layout *layout = sp_scene_layout(scene);
    sp_evaluator *evaluator = sp_evaluator_create_for(sp_scene_setup(scene), layout, &error);
    sp_coverage *coverage = sp_evaluate(evaluator, layout, &error);
    assert_non_null(coverage);
    assert_true(coverage->fraction > 0.5);
    sp_design design = {.name = "manual", .evaluator = evaluator, .layout = layout, .coverage = coverage};
    sp_result result = {.command = "simulate", .scene = "scene.yaml", .design_count = 1, .designs = &design};
    char *json = sp_result_json(&result, &error);
    assert_non_null(json);
    scratch_write("result.json", json);
    size_t count;
    sp_figures *figures = sp_figures_read("result.json", &count, &error);
    assert_non_null(figures);
    const sp_nozzle_figures *nozzles = figures[0].nozzles;
    const sp_track_gaps *gaps = &nozzles[0].tracks;
    assert_true(gaps->known && !nozzles[1].tracks.known && nozzles[2].tracks.known);
    assert_true(gaps->turns == 20 && nozzles[2].tracks.turns == 1000 && isnan(nozzles[2].tracks.duration));
    assert_float_equal(gaps->duration, 400, 1e-9);
    assert_true(gaps->mean > 0 && gaps->mean < gaps->p95 && gaps->p95 < gaps->greatest && gaps->greatest < 0.3);
    assert_true(gaps->area > 0.9 * coverage->area);
    sp_figures_destroy(figures, count);
    char *damaged = with(json, "\"mean_gap_m\": ", "\"mean_gap_m\": -");
    scratch_write("result.json", damaged);
    free(damaged);
    assert_null(sp_figures_read("result.json", &count, &error));
    assert_non_null(strstr(error.message, "layouts[0].nozzles[0].tracks.mean_gap_m"));
    free(json);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    sp_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(types_are_as_written),
        cmocka_unit_test(gaps_are_reported),
    };
    return cmocka_run_group_tests(tests, make, scratch_remove);
}
