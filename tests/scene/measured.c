/* Measured types in a catalogue: the image beside it, who shares it, what is written back, and images that are none. */
#include "scratch.h"

#include <sprayplan/image.h>
#include <sprayplan/scene.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

/* What another folder's catalogue holds; its images are beside it. */
static const char types[] =
    "nozzles:\n"
    "  - {name: plain, pattern: full_cone, angle: 60 deg, flow: 9 L/min, at: 2 bar}\n"
    "  - {name: rim, pattern: measured, image: own/rim.exr, angle: 80 deg, flow: 9 L/min, at: 2 bar}\n"
    "  - {name: strong, pattern: measured, image: own/rim.exr, angle: 80 deg, flow: 18 L/min, at: 2 bar}\n"
    "  - name: pair\n"
    "    pattern: cluster\n"
    "    flow: 20 L/min\n"
    "    at: 2 bar\n"
    "    members:\n"
    "      - {pattern: measured, image: own/rim.exr, angle: 80 deg, ring: {count: 3, polar: 90 deg}}\n"
    "      - {pattern: measured, image: own/rim.exr, angle: 40 deg}\n";
static const char scene_text[] =
    "geometry: [{file: tank.obj}]\n"
    "catalogue: maker/types.yaml\n"
    "nozzles:\n"
    "  - {name: ours, type: rim, position: [0.1, 0.1, 0.1], axis: [1, 1, 1], roll: 20 deg, pressure: 2 bar}\n"
    "  - {name: both, type: pair, position: [0.1, 0.1, 0.1], axis: [1, 1, 1], pressure: 2 bar}\n"
    "place: {pressure: 2 bar, mounts: [{port: {name: P, position: [0.2, 0.2, 0.2], axis: [1, 1, 1]}}]}\n";

static void write_image(const char *path, const float *pixels, int width, int height, int channels)
{
    static const char *const names[][3] = {{"Y"}, {"liquid", "speed"}, {"R", "G", "B"}};
    const sp_exr_part part = {"pattern", width, height, pixels};
    sp_error error = {0};
    if (!sp_image_write_exr(path, &part, 1, names[channels - 1], channels, &error))
        fail_msg("%s", error.message);
}

static const float rim[6] = {1, 2, 3, 4, 5, 6};

static int make(void **state)
{
    if (scratch_make(state) || mkdir("maker", 0777) || mkdir("maker/own", 0777) || mkdir("out", 0777))
        return -1;
    scratch_write("maker/types.yaml", types);
    scratch_write("scene.yaml", scene_text);
    return 0;
}

static sp_scene *load(const char *path)
{
    sp_error error = {0};
    write_image("maker/own/rim.exr", rim, 3, 2, 1);
    sp_scene *scene = sp_scene_load(path, &error);
    if (!scene)
        fail_msg("%s:%d: %s", error.file, error.line, error.message);
    return scene;
}

static void types_share_their_image(void **state)
{
    (void)state;
    sp_scene *scene = load("scene.yaml");
    const sp_nozzle *nozzles = sp_scene_layout(scene)->nozzles;
    const sp_nozzle_type *own = nozzles[0].type, *pair = nozzles[1].type;
    assert_int_equal(own->pattern, SP_PATTERN_MEASURED);
    assert_string_equal(own->image, "own/rim.exr");
    assert_true(fabs(own->angle - 80 * M_PI / 180) < 1e-15 && own->angle_max == own->angle);
    assert_int_equal(pair->member_count, 4);
    assert_ptr_equal(pair->members[0].type.patternation, own->patternation);
    assert_ptr_equal(pair->members[2].type.patternation, own->patternation);
    assert_ptr_not_equal(pair->members[3].type.patternation, own->patternation);
    sp_spray spray = sp_spray_create(own, own->angle);
    sp_vec3 second = sp_v(-sin(30 * M_PI / 180), 0, cos(30 * M_PI / 180)),
            first = sp_v(-second.x / 2, sqrt(0.1875), second.z);
    /* the last row's middle is at 30 deg, its columns' at azimuths of 60, 180 and 300 deg */
    assert_true(fabs(sp_spray_intensity(&spray, second) / sp_spray_intensity(&spray, first) - 5 / 4.) < 1e-6);
    assert_int_equal(sp_scene_place_options(scene).type_count, 4);
    sp_scene_destroy(scene);
}

/* The plain types' catalogue, where no cluster has the image. */
static void with_speeds_a_type_is_a_cluster(void **state)
{
    (void)state;
    static const float pixels[12] = {1, 1, 2, 1, 3, 1, 4, 0.5f, 5, 0.5f, 6, 0.5f};
    sp_error error = {0};
    char text[2000];
    scratch_write("maker/types.yaml", types);
    write_image("maker/own/rim.exr", pixels, 3, 2, 2);
    assert_null(sp_scene_load("scene.yaml", &error));
    sp_error_text(&error, text, sizeof text);
    assert_string_equal(text,
                        "maker/types.yaml:10:36: image: found 'own/rim.exr', expected an image without speeds in a "
                        "cluster");
    snprintf(text, sizeof text, "%.*s", (int)(strstr(types, "  - name: pair") - types), types);
    scratch_write("maker/types.yaml", text);
    scratch_write("speeds.yaml",
                  "geometry: [{file: tank.obj}]\ncatalogue: maker/types.yaml\nnozzles:\n"
                  "  - {name: ours, type: rim, position: [0.1, 0.1, 0.1], axis: [1, 1, 1], pressure: 2 bar}\n");
    error = (sp_error){0};
    sp_scene *scene = sp_scene_load("speeds.yaml", &error);
    assert_string_equal(error.message, "");
    const sp_nozzle *nozzle = &sp_scene_layout(scene)->nozzles[0];
    sp_fluid water = sp_scene_setup(scene)->liquid;
    sp_nozzle patterns[2];
    assert_int_equal(sp_nozzle_pattern_count(nozzle), 2);
    sp_nozzle_patterns(nozzle, &water, sp_v(0, 0, 1), patterns);
    assert_true(fabs(sp_nozzle_angle(nozzle) - 80 * M_PI / 180) < 1e-9);
    assert_true(fabs(sp_nozzle_speed(&patterns[0], &water) / sp_nozzle_speed(nozzle, &water) - 0.5) < 1e-7);
    assert_true(fabs(sp_nozzle_speed(&patterns[1], &water) / sp_nozzle_speed(nozzle, &water) - 1) < 1e-7);
    assert_true(fabs(patterns[0].flow + patterns[1].flow - sp_nozzle_flow(nozzle, &water)) < 1e-12);
    assert_true(patterns[0].flow > patterns[1].flow);
    sp_scene_destroy(scene);
    scratch_write("maker/types.yaml", types);
}

/* No command writes over an image that it read. */
static void images_are_input_files(void **state)
{
    (void)state;
    sp_scene *scene = load("scene.yaml");
    sp_error error = {0};
    bool found = false;
    for (size_t i = 0; i < sp_scene_file_count(scene); i++) {
        char *path = sp_scene_file_path(scene, i, &error);
        assert_non_null(path);
        found = found || strcmp(path, "maker/own/rim.exr") == 0;
        free(path);
    }
    assert_true(found);
    sp_scene_destroy(scene);
}

/* From another folder the catalogue is found, and from it the image. */
static void what_is_written_reads_back(void **state)
{
    (void)state;
    static const sp_fidelity fidelity = {SP_TRAJECTORY_LINE, SP_METHOD_INVERSE, 0, 0, 0.1, SP_SPLAT_NEAREST, 0.01, 1};
    sp_scene *scene = load("scene.yaml");
    sp_error error = {0};
    char *text = sp_scene_text(scene, sp_scene_layout(scene), &fidelity, "out", &error);
    assert_non_null(text);
    assert_non_null(strstr(text, "../maker/types.yaml"));
    scratch_write("out/layout.yaml", text);
    free(text);
    sp_scene *again = load("out/layout.yaml");
    const sp_nozzle *one = &sp_scene_layout(scene)->nozzles[0], *other = &sp_scene_layout(again)->nozzles[0];
    sp_spray before = sp_spray_create(one->type, 0), after = sp_spray_create(other->type, 0);
    assert_true(before.solid_angle == after.solid_angle && one->roll == other->roll);
    sp_scene_destroy(again);
    sp_scene_destroy(scene);
}

static void refuse(const char *expected)
{
    sp_error error = {0};
    char text[2000], whole[2000];
    snprintf(whole, sizeof whole,
             "maker/types.yaml:3:43: image: found 'own/rim.exr': %s; expected an image of liquid per solid angle, and "
             "perhaps of its speed as a second channel",
             expected);
    sp_scene *scene = sp_scene_load("scene.yaml", &error);
    sp_error_text(&error, text, sizeof text);
    assert_null(scene);
    assert_string_equal(text, whole);
}

static void wrong_images_are_named(void **state)
{
    (void)state;
    const char *path = "maker/own/rim.exr";
    float pixels[6] = {1, 2, 3, 4, 5, 6}, *wide = calloc(4097, sizeof *wide);
    write_image(path, pixels, 2, 1, 3);
    refuse("has 3 channels, expected 1 or 2");
    pixels[4] = -0.5f;
    write_image(path, pixels, 3, 2, 1);
    refuse("-0.5 found in column 2 of row 2, expected finite values of 0 or more");
    pixels[4] = NAN;
    write_image(path, pixels, 3, 2, 1);
    refuse("nan found in column 2 of row 2, expected finite values of 0 or more");
    pixels[4] = INFINITY;
    write_image(path, pixels, 2, 3, 1);
    refuse("inf found in column 1 of row 3, expected finite values of 0 or more");
    assert_non_null(wide);
    write_image(path, wide, 6, 1, 1);
    refuse("no value above 0 found, expected some liquid");
    write_image(path, wide, 4097, 1, 1);
    refuse("has 4097 x 1 pixels, expected 1 x 1 to 4096 x 1024");
    free(wide);
}

/* Cut anywhere, an image is an error or, where only its end is missing, may still be one. */
static void cut_images_are_no_crash(void **state)
{
    (void)state;
    char bytes[4000];
    write_image("maker/own/rim.exr", rim, 3, 2, 1);
    FILE *file = fopen("maker/own/rim.exr", "rb");
    assert_non_null(file);
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    for (size_t end = 0; end < size; end += 41) {
        scratch_write_bytes("maker/own/rim.exr", bytes, end);
        sp_error error = {0};
        sp_scene *scene = sp_scene_load("scene.yaml", &error);
        assert_true(scene || (error.line == 3 && error.column == 43));
        assert_true(end > size / 2 || !scene);
        sp_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(types_share_their_image),    cmocka_unit_test(images_are_input_files),
        cmocka_unit_test(what_is_written_reads_back), cmocka_unit_test(wrong_images_are_named),
        cmocka_unit_test(cut_images_are_no_crash),    cmocka_unit_test(with_speeds_a_type_is_a_cluster),
    };
    return cmocka_run_group_tests(tests, make, scratch_remove);
}
