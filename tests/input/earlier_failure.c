/* What an earlier failure left NULL: every public function that can fail returns NULL or false for it, and keeps the
 * error. */
#include "../optimizer/room.h"

#include <sprayplan/sprayplan.h>

#include <glob.h>
#include <stdio.h>
#include <unistd.h>

#define FILE_PATH BINARY_DIR "/earlier-failure-test"

static sp_error error;
static const char *asked[200];
static size_t asked_count;

static void fail_early(void)
{
    error = (sp_error){0};
    sp_fail(&error, SP_ERROR_INPUT, "first.obj", 3, 5, "the cause");
}

static void was_kept(const char *name, const char *call, bool failed)
{
    char text[1400];
    sp_error_text(&error, text, sizeof text);
    if (!failed || error.kind != SP_ERROR_INPUT || strcmp(text, "first.obj:3:5: the cause") != 0)
        fail_msg("%s: %s, %s", call, failed ? "failed" : "has not failed", text);
    for (size_t i = 0; i < asked_count; i++)
        if (strcmp(asked[i], name) == 0)
            return;
    asked[asked_count++] = name;
}

#define KEEPS(function, ...) (fail_early(), was_kept(#function, #function #__VA_ARGS__, !function(__VA_ARGS__)))

static void *const nothing = NULL;

static void meshes_keep_it(void **state)
{
    const room *r = *state;
    sp_mesh_diagnosis diagnosis;
    sp_repair_account account;
    double volumes[8];
    const sp_mesh *missing[] = {r->mesh, NULL};
    const sp_transform as_they_are[] = {sp_transform_default(), sp_transform_default()};
    const sp_cad_options finely = sp_cad_options_default();
    KEEPS(sp_mesh_load, nothing, 1, &error);
    KEEPS(sp_mesh_load_stream, nothing, "a.obj", 1, &error);
    KEEPS(sp_mesh_load_stream, stdin, nothing, 1, &error);
    KEEPS(sp_cad_load, nothing, 1, &finely, nothing, &error);
    KEEPS(sp_cad_load, FILE_PATH ".step", 1, nothing, nothing, &error);
    KEEPS(sp_mesh_create, nothing, 3, nothing, 1, nothing, nothing, 0, &error);
    KEEPS(sp_mesh_join, nothing, as_they_are, 2, &error);
    KEEPS(sp_mesh_join, missing, as_they_are, 2, &error);
    KEEPS(sp_mesh_join, missing, nothing, 1, &error);
    KEEPS(sp_mesh_diagnose, nothing, &diagnosis, &error);
    KEEPS(sp_mesh_repair, nothing, nothing, &account, &error);
    KEEPS(sp_mesh_write_obj, nothing, FILE_PATH, &error);
    KEEPS(sp_mesh_write_obj, r->mesh, nothing, &error);
    KEEPS(sp_mesh_volumes, nothing, volumes, &error);
    KEEPS(sp_tracer_create, nothing, SP_ACCELERATOR_BVH, 1, &error);
}

static void atlases_keep_it(void **state)
{
    const room *r = *state;
    const sp_atlas *atlas = sp_evaluator_atlas(r->evaluator);
    const sp_atlas_options options = {.texel = 0.1};
    const sp_unfolding *missing[] = {NULL};
    sp_fragments fragments;
    sp_texel_links links;
    sp_atlas_figures figures;
    sp_error none = {0};
    sp_charts *charts = sp_charts_create(r->mesh, INFINITY, &none);
    assert_non_null(charts);
    KEEPS(sp_charts_create, nothing, 1, &error);
    KEEPS(sp_charts_girth, nothing, r->mesh, &error);
    KEEPS(sp_charts_girth, charts, nothing, &error);
    KEEPS(sp_charts_of_atlas, nothing, &error);
    KEEPS(sp_atlas_create, nothing, charts, &options, &error);
    KEEPS(sp_atlas_create, r->mesh, nothing, &options, &error);
    KEEPS(sp_atlas_create, r->mesh, charts, nothing, &error);
    KEEPS(sp_atlas_reuse, nothing, FILE_PATH, 0, &error);
    KEEPS(sp_atlas_reuse, r->mesh, nothing, 0, &error);
    KEEPS(sp_unfolding_read, nothing, 1, &error);
    KEEPS(sp_atlas_of_files, nothing, missing, 0, 0, &error);
    KEEPS(sp_atlas_of_files, r->mesh, nothing, 1, 0, &error);
    KEEPS(sp_atlas_of_files, r->mesh, missing, 1, 0, &error);
    KEEPS(sp_fragments_create, &fragments, nothing, r->mesh, &error);
    KEEPS(sp_fragments_create, &fragments, atlas, nothing, &error);
    KEEPS(sp_texel_links_create, &links, nothing, r->mesh, &error);
    KEEPS(sp_texel_links_create, &links, atlas, nothing, &error);
    KEEPS(sp_atlas_measure, nothing, r->mesh, &figures, &error);
    KEEPS(sp_atlas_measure, atlas, nothing, &figures, &error);
    KEEPS(sp_atlas_obj, nothing, r->mesh, &error);
    KEEPS(sp_atlas_obj, atlas, nothing, &error);
    sp_charts_destroy(charts);
}

static void evaluators_keep_it(void **state)
{
    const room *r = *state;
    sp_evaluator *again;
    const sp_nozzle untyped = {.name = "1"};
    const sp_launch launch = {.speed = 10};
    const sp_vec3 place = {1, 1, 1}, down = {0, 0, -1};
    sp_track_gaps gaps;
    double beyond;
    KEEPS(sp_evaluator_create, nothing, &error);
    KEEPS(sp_evaluator_create_for, nothing, nothing, &error);
    KEEPS(sp_evaluator_resample, nothing, 0.1, &error);
    KEEPS(sp_evaluator_again, nothing, true, &again, &error);
    assert_null(again);
    KEEPS(sp_runoff_create, nothing, &error);
    KEEPS(sp_evaluator_beyond_caps, nothing, &beyond, &error);
    KEEPS(sp_evaluator_admits, nothing, &untyped, &error);
    KEEPS(sp_evaluator_admits, r->evaluator, nothing, &error);
    KEEPS(sp_evaluator_admits, r->evaluator, &untyped, &error);
    KEEPS(sp_evaluator_reach, nothing, place, launch, down, 1, &error);
    KEEPS(sp_evaluator_reach_passing, nothing, place, launch, down, 1, nothing, &error);
    KEEPS(sp_evaluator_reach_part, nothing, place, launch, down, 1, 0, 1, nothing, &error);
    KEEPS(sp_points_create, nothing, &error);
    KEEPS(sp_find_track_gaps, nothing, &untyped, &gaps, &error);
    KEEPS(sp_find_track_gaps, r->evaluator, nothing, &gaps, &error);
    KEEPS(sp_find_track_gaps, r->evaluator, &untyped, &gaps, &error);
    KEEPS(sp_wavefronts_create, nothing, 10, down, 1, &error);
}

static void evaluations_keep_it(void **state)
{
    const room *r = *state;
    sp_error none = {0};
    sp_layout *layout = sp_layout_create(NULL, 0, &none);
    sp_coverage *coverage = sp_evaluate(r->evaluator, layout, &none);
    double bound;
    sp_borderline borderline;
    sp_measured_error measured;
    sp_shadow *shadows;
    size_t count;
    uint32_t *numbers = calloc(sp_evaluator_patches(r->evaluator)->count, sizeof *numbers);
    assert_true(coverage && numbers);
    KEEPS(sp_evaluate, nothing, layout, &error);
    KEEPS(sp_evaluate, r->evaluator, nothing, &error);
    KEEPS(sp_evaluate_inverse, nothing, layout, &error);
    KEEPS(sp_evaluate_inverse, r->evaluator, nothing, &error);
    KEEPS(sp_evaluate_forward, nothing, layout, 0, 10, &error);
    KEEPS(sp_evaluate_forward, r->evaluator, nothing, 0, 10, &error);
    KEEPS(sp_evaluate_balance, nothing, layout, coverage, &error);
    KEEPS(sp_evaluate_balance, r->evaluator, nothing, coverage, &error);
    KEEPS(sp_evaluate_balance, r->evaluator, layout, nothing, &error);
    KEEPS(sp_contributions_create, nothing, layout, coverage, &error);
    KEEPS(sp_contributions_create, r->evaluator, nothing, coverage, &error);
    KEEPS(sp_contributions_create, r->evaluator, layout, nothing, &error);
    KEEPS(sp_find_borderline, nothing, layout, coverage, nothing, &borderline, &error);
    KEEPS(sp_find_borderline, r->evaluator, nothing, coverage, nothing, &borderline, &error);
    KEEPS(sp_find_borderline, r->evaluator, layout, nothing, nothing, &borderline, &error);
    KEEPS(sp_bound_lines, nothing, layout, &bound, nothing, &error);
    KEEPS(sp_bound_lines, r->evaluator, nothing, &bound, nothing, &error);
    KEEPS(sp_measure_error, nothing, layout, coverage, SP_TRAJECTORY_AUTO, 1, &measured, &error);
    KEEPS(sp_measure_error, r->evaluator, nothing, coverage, SP_TRAJECTORY_AUTO, 1, &measured, &error);
    KEEPS(sp_measure_error, r->evaluator, layout, nothing, SP_TRAJECTORY_AUTO, 1, &measured, &error);
    KEEPS(sp_shadows, nothing, coverage, nothing, &shadows, &count, &error);
    KEEPS(sp_shadows, r->evaluator, nothing, nothing, &shadows, &count, &error);
    KEEPS(sp_shadow_numbers, nothing, coverage, nothing, 0, numbers, &error);
    KEEPS(sp_shadow_numbers, r->evaluator, nothing, nothing, 0, numbers, &error);
    KEEPS(sp_shadow_numbers, r->evaluator, coverage, nothing, 1, numbers, &error);
    free(numbers);
    sp_coverage_destroy(coverage);
    sp_layout_destroy(layout);
}

static void points_and_launches_keep_it(void **state)
{
    const room *r = *state;
    sp_error none = {0};
    const sp_nozzle nozzle = {.name = "1"};
    const sp_point point = {.triangle = 0};
    bool covered[1];
    sp_launch launch;
    sp_layout *layout = sp_layout_create(NULL, 0, &none);
    sp_reference *reference = sp_reference_create(r->evaluator, layout, SP_TRAJECTORY_AUTO, &none);
    sp_launch_table *table = sp_launch_table_create(r->evaluator, 1, &none);
    assert_true(reference && table);
    KEEPS(sp_reference_create, nothing, layout, SP_TRAJECTORY_AUTO, &error);
    KEEPS(sp_reference_create, r->evaluator, nothing, SP_TRAJECTORY_AUTO, &error);
    KEEPS(sp_reference_judge, nothing, &point, 1, covered, &error);
    KEEPS(sp_reference_judge, reference, nothing, 1, covered, &error);
    KEEPS(sp_points_judge, nothing, layout, SP_TRAJECTORY_AUTO, &point, 1, covered, &error);
    KEEPS(sp_points_judge, r->evaluator, nothing, SP_TRAJECTORY_AUTO, &point, 1, covered, &error);
    KEEPS(sp_points_judge, r->evaluator, layout, SP_TRAJECTORY_AUTO, nothing, 1, covered, &error);
    KEEPS(sp_launch_table_create, nothing, 1, &error);
    KEEPS(sp_launch_table_add, nothing, &nozzle, &error);
    KEEPS(sp_launch_table_add, table, nothing, &error);
    KEEPS(sp_launch_table_add, table, &nozzle, &error);
    KEEPS(sp_launch_table_find, nothing, &nozzle, &launch, &error);
    KEEPS(sp_launch_table_find, table, nothing, &launch, &error);
    sp_launch_table_destroy(table);
    sp_reference_destroy(reference);
    sp_layout_destroy(layout);
}

static void types_and_images_keep_it(void **state)
{
    (void)state;
    static const uint8_t pixels[3];
    static const float values[1] = {1};
    static const char *const names[] = {"liquid", "speed"};
    const sp_exr_part part = {"page0", 1, 1, values};
    sp_speed_layer layers[SP_SPEEDS];
    size_t size;
    KEEPS(sp_type_is_valid, nothing, &error);
    KEEPS(sp_patternation_create, nothing, 1, 1, 1, &error);
    KEEPS(sp_patternation_layers, nothing, values, 1, 1, 1, layers, &error);
    KEEPS(sp_patternation_layers, values, nothing, 1, 1, 1, layers, &error);
    KEEPS(sp_image_write_png, nothing, pixels, 1, 1, 3, &error);
    KEEPS(sp_image_write_png, FILE_PATH, nothing, 1, 1, 3, &error);
    KEEPS(sp_image_encode_png, nothing, 1, 1, 3, &size, &error);
    KEEPS(sp_image_encode_webp, nothing, 1, 1, &size, &error);
    KEEPS(sp_image_write_exr, nothing, &part, 1, names, 1, &error);
    KEEPS(sp_image_write_exr, FILE_PATH, nothing, 1, names, 1, &error);
    KEEPS(sp_image_write_exr, FILE_PATH, &part, 1, nothing, 1, &error);
    fail_early();
    was_kept("sp_image_read", "sp_image_read", !sp_image_read(NULL, 1, 1, names, &error).values);
}

static void scenes_and_placements_keep_it(void **state)
{
    const room *r = *state;
    const sp_place_options options = sp_place_options_default();
    const sp_study_options at_leisure = {0};
    const sp_fidelity fidelity = *sp_evaluator_fidelity(r->evaluator);
    const sp_nozzle nozzle = {.name = "1"};
    sp_layout none = {0};
    size_t all[1], usable[1];
    double value;
    KEEPS(sp_scene_load, nothing, &error);
    KEEPS(sp_scene_load_with, nothing, nothing, 0, nothing, &error);
    KEEPS(sp_scene_load_stream, stdin, nothing, nothing, 0, nothing, &error);
    KEEPS(sp_scene_file_path, nothing, 0, &error);
    KEEPS(sp_scene_text, nothing, &none, &fidelity, ".", &error);
    fail_early();
    sp_scene_locate(NULL, &error);
    was_kept("sp_scene_locate", "sp_scene_locate", true);
    KEEPS(sp_quantity_parse, nothing, "m", &value, &error);
    KEEPS(sp_mounts_admit, nothing, nothing, 0, &nozzle, &error);
    KEEPS(sp_mounts_admit, &r->setup, nothing, 0, nothing, &error);
    KEEPS(sp_place_count_points, nothing, &options, all, usable, &error);
    KEEPS(sp_place_count_points, r->evaluator, nothing, all, usable, &error);
    KEEPS(sp_place, nothing, &options, &error);
    KEEPS(sp_place, r->evaluator, nothing, &error);
    KEEPS(sp_study_create, nothing, &none, &options, &at_leisure, &error);
    KEEPS(sp_study_create, &r->setup, nothing, &options, &at_leisure, &error);
    KEEPS(sp_study_create, &r->setup, &none, &options, nothing, &error);
    KEEPS(sp_study_json, nothing, "scene.yaml", &error);
    KEEPS(sp_study_csv, nothing, &error);
    KEEPS(sp_study_place_csv, nothing, &error);
    KEEPS(sp_study_text, nothing, &error);
    KEEPS(sp_study_html, nothing, "scene.yaml", &error);
}

static void results_keep_it(void **state)
{
    const room *r = *state;
    const sp_design unmade = {.name = "manual"}, uncovered = {.name = "manual", .evaluator = r->evaluator};
    sp_result results[] = {{.command = "simulate", .scene = "scene.yaml", .design_count = 1, .designs = &unmade},
                           {.command = "simulate", .scene = "scene.yaml", .design_count = 1, .designs = &uncovered}};
    const sp_fitting_sheet *missing[] = {NULL};
    static const char *const names[] = {"manual"};
    const sp_layout none = {0};
    sp_swab swabs[SP_SWABS];
    double seconds;
    size_t count;
    char digest[SP_SHA256];
    for (int i = 0; i < 3; i++) {
        const sp_result *result = i < 2 ? &results[i] : nothing;
        KEEPS(sp_result_figures, result, &error);
        KEEPS(sp_result_json, result, &error);
        KEEPS(sp_report_html, result, &error);
        KEEPS(sp_report_picture_time, result, &seconds, &error);
        const sp_design *design = result ? result->designs : nothing;
        KEEPS(sp_find_swabs, design, swabs, &count, &error);
        KEEPS(sp_swabs_csv, design, &error);
        KEEPS(sp_report_coverage_png, design, FILE_PATH, &error);
        KEEPS(sp_report_deposits_exr, design, FILE_PATH, &error);
        KEEPS(sp_report_model_glb, design, FILE_PATH, &error);
        KEEPS(sp_report_surface_vtp, design, FILE_PATH, &error);
        KEEPS(sp_report_texels_vtp, design, FILE_PATH, &error);
        KEEPS(sp_report_nozzles_stl, design, FILE_PATH, &error);
    }
    KEEPS(sp_figures_read, nothing, &count, &error);
    KEEPS(sp_file_sha256, nothing, digest, &error);
    KEEPS(sp_fitting_sheet_create, nothing, &r->setup, nothing, 0, &error);
    KEEPS(sp_fitting_sheet_create, &none, nothing, nothing, 0, &error);
    KEEPS(sp_nozzles_csv, nothing, &error);
    KEEPS(sp_all_nozzles_csv, nothing, names, 1, &error);
    KEEPS(sp_all_nozzles_csv, missing, names, 1, &error);
    KEEPS(sp_all_nozzles_csv, missing, nothing, 0, &error);
    KEEPS(sp_report_wet_png, nothing, FILE_PATH, &error);
    KEEPS(sp_report_wet_png, r->evaluator, nothing, &error);
    KEEPS(sp_report_charts, nothing, 0, &error);
    assert_int_equal(access(FILE_PATH, F_OK), -1);
}

static void outputs_keep_it(void **state)
{
    (void)state;
    const sp_design unmade = {.name = "manual"};
    const sp_result result = {.command = "simulate", .scene = "scene.yaml", .design_count = 1, .designs = &unmade};
    sp_error none = {0};
    sp_output *output = sp_output_open(FILE_PATH "-folder", &none);
    assert_non_null(output);
    KEEPS(sp_output_open, nothing, &error);
    KEEPS(sp_output_path, nothing, "a.txt", &error);
    KEEPS(sp_output_path, output, nothing, &error);
    KEEPS(sp_output_protect, nothing, "/", &error);
    KEEPS(sp_output_protect, output, nothing, &error);
    KEEPS(sp_output_supersede, nothing, &error);
    KEEPS(sp_output_text, nothing, "a.txt", "text", &error);
    KEEPS(sp_output_text, output, "a.txt", nothing, &error);
    KEEPS(sp_output_bytes, nothing, "a.txt", "text", 4, &error);
    KEEPS(sp_output_bytes, output, "a.txt", nothing, 4, &error);
    KEEPS(sp_output_scene, nothing, "a.yaml", "text", false, &error);
    KEEPS(sp_output_scene, output, "a.yaml", nothing, false, &error);
    KEEPS(sp_output_may_replace, nothing, "a.yaml", false, &error);
    KEEPS(sp_output_may_replace, output, nothing, false, &error);
    KEEPS(sp_output_commit, nothing, &error);
    KEEPS(sp_report_write, nothing, output, &error);
    KEEPS(sp_report_write, &result, nothing, &error);
    KEEPS(sp_report_write, &result, output, &error);
    fail_early();
    sp_output_tell(NULL, &error);
    was_kept("sp_output_tell", "sp_output_tell", true);
    sp_output_discard(output);
}

/* True where a declaration's function can fail and is not among those asked above. */
static bool is_missing(const char *declaration, size_t length, char name[100])
{
    /* of nothing that another function makes, or of a NULL that is no failure */
    static const char *const others[] = {"sp_fail", "sp_fail_memory", "sp_ranks_join", "sp_topic_schema",
                                         "sp_layout_create"};
    static const char last[] = "sp_error *error)";
    const char *open = memchr(declaration, '(', length), *start = open;
    if (!open || length < sizeof last || strncmp(declaration + length - strlen(last), last, strlen(last)) != 0)
        return false;
    while (start[-1] == '_' || (start[-1] >= 'a' && start[-1] <= 'z') || (start[-1] >= '0' && start[-1] <= '9'))
        start--;
    snprintf(name, 100, "%.*s", (int)(open - start), start);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strcmp(name, others[i]) == 0)
            return false;
    for (size_t i = 0; i < asked_count; i++)
        if (strcmp(name, asked[i]) == 0)
            return false;
    return true;
}

static void all_were_asked(void **state)
{
    (void)state;
    glob_t headers;
    size_t declarations = 0;
    static char text[100000];
    assert_int_equal(glob(SOURCE_DIR "/include/sprayplan/*.h", 0, NULL, &headers), 0);
    for (size_t i = 0; i < headers.gl_pathc; i++) {
        FILE *file = fopen(headers.gl_pathv[i], "r");
        assert_non_null(file);
        text[fread(text, 1, sizeof text - 1, file)] = 0;
        assert_true(feof(file));
        fclose(file);
        for (const char *at = text, *end; (at = strstr(at, "SP_API ")); at = end) {
            char name[100];
            end = at + strcspn(at, ";{");
            declarations++;
            if (is_missing(at, (size_t)(end - at), name))
                fail_msg("%s: %s can fail, and is not asked", headers.gl_pathv[i], name);
        }
    }
    globfree(&headers);
    assert_true(declarations > asked_count && asked_count > 90);
}

static int open_room(void **state)
{
    static room r;
    room_builder builder = {0};
    room_box(&builder, sp_v(0, 0, 0), sp_v(1, 1, 1), "walls", "lid");
    r.setup = sp_setup_default();
    room_open(&r, &builder, 0.2);
    *state = &r;
    return 0;
}

static int close_room(void **state)
{
    room_close(*state);
    return rmdir(FILE_PATH "-folder") == 0; /* discarded, so that it is gone */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_keep_it),
        cmocka_unit_test(atlases_keep_it),
        cmocka_unit_test(evaluators_keep_it),
        cmocka_unit_test(evaluations_keep_it),
        cmocka_unit_test(points_and_launches_keep_it),
        cmocka_unit_test(types_and_images_keep_it),
        cmocka_unit_test(scenes_and_placements_keep_it),
        cmocka_unit_test(results_keep_it),
        cmocka_unit_test(outputs_keep_it),
        cmocka_unit_test(all_were_asked),
    };
    return cmocka_run_group_tests(tests, open_room, close_room);
}
