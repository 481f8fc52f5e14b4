/* A STEP vessel of 5 mm wall whose area to clean is known in closed form, through check, simulate and place; and the
 * program without the one that reads CAD files. */
#include "results.h"

#include "../cad/files.h"

#include <sprayplan/scene.h>

/* m, as in tests/cad/occt/make.cc */
#define RADIUS 0.5
#define HEIGHT 1.0
#define SHAFT 0.02
#define LENGTH 0.9 /* of the shaft in the vessel */
#define SUNK 0.001 /* the lid in the shell */
static const double blade[3] = {0.3, 0.01, 0.087};

#define LEVEL "cavity: [0.2 m, 0.2 m, 0.7 m]\ncatalogue: catalogue.yaml\n"
#define NOZZLES                                                                                                        \
    "nozzles:\n  - {name: N1, type: ball, position: [0.25 m, 0 m, 0.8 m], axis: [0, 0, -1], pressure: 2 bar}\n"
#define PLACE                                                                                                          \
    "place:\n  coverage: 20 %\n  pressure: 2 bar\n  types: [ball]\n  refine: none\n  mounts:\n    - port: {name: P1, " \
    "position: [0.25 m, 0 m, 0.9 m], "                                                                                 \
    "axis: [0, 0, -1]}\n"

/* Area to clean of each part. A blade passes through the shaft, or lies beside its axis with half its thickness in it.
 */
typedef struct {
    double shell, lid, shaft, blade;
} areas;

static areas closed_form(bool altered)
{
    double half = blade[1] / 2, sunk = altered ? SUNK : 0;
    double plane = altered ? SHAFT - half : half; /* its nearer face from the axis */
    double chord = 2 * sqrt(SHAFT * SHAFT - plane * plane), angle = acos(plane / SHAFT);
    double segment = SHAFT * SHAFT * angle - plane * chord / 2;
    double faces = altered ? 1 : 2;                                         /* of a blade in the shaft */
    double within = altered ? segment : M_PI * SHAFT * SHAFT - 2 * segment; /* of a blade's ends */
    double arc = altered ? 2 * angle * SHAFT : 2 * M_PI * SHAFT - 4 * angle * SHAFT;
    double surface = 2 * (blade[0] * blade[1] + blade[1] * blade[2] + blade[2] * blade[0]);
    return (areas){2 * M_PI * RADIUS * RADIUS + 2 * M_PI * RADIUS * (HEIGHT - sunk),
                   M_PI * (RADIUS * RADIUS - SHAFT * SHAFT),
                   2 * M_PI * SHAFT * (LENGTH - sunk) + M_PI * SHAFT * SHAFT - 2 * arc * blade[2],
                   surface - faces * chord * blade[2] - 2 * within};
}

/* Within 0.2 %; of nothing, nothing. */
static void expect_wet(json_t *parts, size_t index, const char *name, double area)
{
    json_t *part = json_array_get(parts, index);
    assert_string_equal(json_string_value(json_object_get(part, "name")), name);
    double wet = number(part, "wet_area_m2");
    if (fabs(wet - area) > 2e-3 * area)
        fail_msg("%s: %.5f m2 to clean, expected %.5f", name, wet, area);
}

static void expect_areas(json_t *object, const areas *expected)
{
    json_t *parts = json_object_get(object, "parts");
    double total = expected->shell + expected->lid + expected->shaft + 2 * expected->blade;
    assert_int_equal(json_array_size(parts), 8);
    expect_wet(parts, 0, "vessel/shell", expected->shell);
    expect_wet(parts, 1, "vessel/lid", expected->lid);
    expect_wet(parts, 2, "vessel/agitator/shaft", expected->shaft);
    expect_wet(parts, 3, "vessel/agitator/blade", expected->blade);
    expect_wet(parts, 4, "vessel/agitator/blade#2", expected->blade);
    expect_wet(parts, 5, "vessel/foot", 0);
    expect_wet(parts, 7, "vessel/foot#3", 0);
    assert_true(fabs(number(object, "clean_area_m2") / total - 1) < 2e-3);
    assert_int_equal(json_array_size(json_object_get(object, "warnings")), 0);
}

static void write_scene(const char *file, const char *fineness, const char *more)
{
    char scene[2048];
    snprintf(scene, sizeof scene,
             "geometry:\n  - file: %s\n%s    clean_parts: [vessel/shell, vessel/lid, vessel/agitator/*]\n" LEVEL NOZZLES
             "%ssimulate: {texel: 100 mm}\n",
             file, fineness, more);
    write_file("vessel.yaml", scene);
}

static void make(const char *what, const char *name, const char *unit)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", workplace, name);
    make_cad(what, path, unit);
}

/* Volumes of the bodies beside those of their triangles. */
static void expect_volumes(json_t *object)
{
    size_t i;
    json_t *part, *parts = json_object_get(object, "parts");
    json_array_foreach(parts, i, part)
    {
        double body = number(part, "body_volume_m3");
        assert_true(body > 0 && fabs(number(part, "volume_m3") / body - 1) < 4e-3);
    }
    part = json_array_get(parts, 3);
    assert_true(fabs(number(part, "body_volume_m3") / (blade[0] * blade[1] * blade[2]) - 1) < 1e-9);
}

static void expect_cleaned(const char *what, const char *unit)
{
    make(what, "vessel.step", unit);
    write_scene("vessel.step", "", "");
    json_t *object = expect_json("check vessel.yaml --json", 0);
    areas expected = closed_form(strcmp(what, "vessel") != 0);
    expect_areas(object, &expected);
    expect_volumes(object);
    assert_int_equal(json_array_size(json_object_get(object, "cad")), 1);
    json_decref(object);
}

/* In inch; the same in mm, and altered, takes long. */
static void only_its_inside_lid_and_agitator_are_cleaned(void **state)
{
    (void)state;
    need_cad();
    expect_cleaned("vessel", "INCH");
    if (getenv("SPRAYPLAN_LONG")) {
        expect_cleaned("vessel", "MM");
        expect_cleaned("altered", "MM");
        expect_cleaned("altered", "INCH");
    }
    areas expected = closed_form(false);
    assert_true(fabs(expected.shell + expected.lid + expected.shaft + 2 * expected.blade - 5.712) < 5e-4);
}

/* Its triangles as OBJ, a group for each part. */
static void write_obj(const char *from, const char *to)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", workplace, from);
    const sp_cad_options options = {.chord = 2e-3, .angle = 0.17};
    sp_mesh *mesh = load_cad(path, 1, &options, NULL);
    snprintf(path, sizeof path, "%s/%s", workplace, to);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        fprintf(file, "v %.17g %.17g %.17g\n", mesh->vertices[i].x, mesh->vertices[i].y, mesh->vertices[i].z);
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        if (t == 0 || mesh->part[t] != mesh->part[t - 1])
            fprintf(file, "g %s\n", mesh->parts[mesh->part[t]].name);
        fprintf(file, "f %u %u %u\n", mesh->triangles[t][0] + 1, mesh->triangles[t][1] + 1, mesh->triangles[t][2] + 1);
    }
    assert_int_equal(fclose(file), 0);
    sp_mesh_destroy(mesh);
}

/* In mm, its lid 1 mm in the shell, its blades half in the shaft; as it is, takes long. */
static void the_same_as_obj(void **state)
{
    (void)state;
    need_cad();
    for (int altered = 1; altered >= (getenv("SPRAYPLAN_LONG") ? 0 : 1); altered--) {
        make(altered ? "altered" : "vessel", "vessel.step", "MM");
        write_obj("vessel.step", "vessel.obj");
        write_scene("vessel.obj", "", "");
        json_t *object = expect_json("check vessel.yaml --json", 0);
        areas expected = closed_form(altered);
        expect_areas(object, &expected);
        assert_int_equal(json_array_size(json_object_get(object, "cad")), 0);
        json_decref(object);
    }
}

/* What was kept, as JSON and as text. */
static void check_reports_what_was_kept(void **state)
{
    (void)state;
    need_cad();
    make("round", "round.step", "INCH");
    write_file("round.yaml", "geometry:\n  - {file: round.step, chord: 2 mm, angle: 20 deg}\n");
    json_t *object = expect_json("check round.yaml --json", 0), *cad;
    assert_int_equal(json_array_size(cad = json_object_get(object, "cad")), 1);
    cad = json_array_get(cad, 0);
    assert_true(fabs(number(cad, "chord_m") - 2e-3) < 1e-12 && fabs(number(cad, "angle_rad") - M_PI / 9) < 1e-12);
    assert_true(number(cad, "triangles") > 500 && number(cad, "faults") == 0 && number(cad, "sewn_faces") == 0);
    json_decref(object);
    outcome told = run_program("check round.yaml");
    assert_int_equal(told.status, 0);
    assert_non_null(strstr(told.out, "file 0: chord 2 mm, angle 20 deg, "));
    assert_non_null(strstr(told.out, "volume m3   triangles m3    off %\n"));
    assert_non_null(strstr(told.out, "cylinder                     0.78539816 "));
    forget(&told);
}

/* What is told of bodies, whatever their size. */
static void volumes_have_digits(void **state)
{
    (void)state;
    need_cad();
    static const struct {
        const char *scale, *told;
    } sizes[] = {{"1e-5", " cylinder                       7.85e-16 "},
                 {"20", " cylinder                     6283.18531 "}};
    make("round", "round.step", "INCH");
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char scene[200];
        snprintf(scene, sizeof scene, "geometry:\n  - {file: round.step, angle: 20 deg, scale: %s}\n", sizes[i].scale);
        write_file("sized.yaml", scene);
        outcome told = run_program("check sized.yaml");
        if (!strstr(told.out, sizes[i].told))
            fail_msg("nowhere: %s\n%s", sizes[i].told, told.out);
        forget(&told);
    }
}

/* What was written as a scene is cut as it was, and covered as it was. */
static void expect_same_again(const char *command, const char *again)
{
    json_t *first = expect_json(command, 0), *second = expect_json(again, 0);
    json_t *layouts = json_object_get(first, "layouts"), *last = json_array_get(layouts, json_array_size(layouts) - 1);
    json_t *only = json_array_get(json_object_get(second, "layouts"), 0);
    assert_true(number(last, "covered_area_m2") > 1);
    assert_true(number(last, "covered_area_m2") == number(only, "covered_area_m2"));
    assert_true(number(json_object_get(first, "geometry"), "triangles") ==
                number(json_object_get(second, "geometry"), "triangles"));
    json_t *account = json_object_get(json_object_get(first, "geometry"), "account");
    assert_true(number(account, "cad_chord_m") > 1e-4 && number(account, "cad_faults") == 0);
    assert_true(json_equal(account, json_object_get(json_object_get(second, "geometry"), "account")));
    json_decref(first);
    json_decref(second);
}

static void the_vessel_is_simulated_and_placed_in(void **state)
{
    (void)state;
    need_cad();
    make("vessel", "vessel.step", "MM");
    write_scene("vessel.step", "    angle: 40 deg\n", PLACE);
    json_t *object = expect_json("simulate vessel.yaml --json", 0);
    json_t *manual = json_array_get(json_object_get(object, "layouts"), 0);
    assert_true(number(manual, "covered_area_m2") > 1);
    json_decref(object);
    if (getenv("SPRAYPLAN_LONG")) {
        expect_same_again("simulate vessel.yaml -o out --json", "simulate out/layout.yaml --json");
        expect_same_again("place vessel.yaml -o placed --json", "simulate placed/layout.yaml --json");
    }
}

/* Written with a texel, which would make it finer, where the scene left that open. */
static void what_is_written_is_cut_as_finely(void **state)
{
    (void)state;
    need_cad();
    char path[1024];
    sp_error error = {0};
    make("round", "round.step", "MM");
    write_file("round.yaml", "geometry:\n  - file: round.step\n");
    snprintf(path, sizeof path, "%s/round.yaml", workplace);
    sp_scene *scene = sp_scene_load(path, &error);
    assert_non_null(scene);
    const char *texel = "simulate.texel=5 mm";
    sp_scene *finer = sp_scene_load_with(path, &texel, 1, NULL, &error);
    assert_non_null(finer);
    assert_true(fabs(sp_scene_cad(finer, 0)->chord - 5e-4) < 1e-12 && sp_scene_cad(scene, 0)->chord > 2e-3);
    sp_scene_destroy(finer);
    sp_fidelity fidelity = sp_scene_setup(scene)->fidelity;
    fidelity.trajectory = SP_TRAJECTORY_PARABOLA;
    fidelity.method = SP_METHOD_INVERSE;
    fidelity.reflections = 0;
    fidelity.texel = 5e-3;
    char *text = sp_scene_text(scene, sp_scene_layout(scene), &fidelity, workplace, &error);
    assert_non_null(text);
    write_file("again.yaml", text);
    snprintf(path, sizeof path, "%s/again.yaml", workplace);
    sp_scene *again = sp_scene_load(path, &error);
    assert_non_null(again);
    assert_true(sp_scene_setup(again)->fidelity.texel == fidelity.texel);
    assert_true(sp_scene_cad(again, 0)->chord == sp_scene_cad(scene, 0)->chord);
    assert_true(sp_scene_cad(again, 0)->angle == sp_scene_cad(scene, 0)->angle);
    assert_int_equal(sp_scene_setup(again)->mesh->triangle_count, sp_scene_setup(scene)->mesh->triangle_count);
    free(text);
    sp_scene_destroy(again);
    sp_scene_destroy(scene);
}

static void run(const char *command)
{
    char line[2048];
    snprintf(line, sizeof line, "cd '%s' && %s", workplace, command);
    assert_int_equal(system(line), 0);
}

/* Without the program, and with one in its place that dies or lies. */
static void what_reads_cad_may_be_missing_or_die(void **state)
{
    (void)state;
    static const struct {
        const char *script, *said;
        int status;
    } cases[] = {
        {NULL,
         "vessel.step: cannot be read: the program sprayplan-cad, which reads STEP, IGES and BREP, is not installed; "
         "it is sprayplan's component `cad`",
         1},
        {"#!/bin/sh\nkill -SEGV $$\n", "vessel.step: cannot be read: OpenCASCADE crashed on it (Segmentation fault)",
         3},
        {"#!/bin/sh\necho 'here are your triangles'\n", "vessel.step: found a record of no kind", 3},
        {"#!/bin/sh\nexit 9\n", "vessel.step: cannot be read: sprayplan-cad ended early, with status 9", 3},
        {"no program\n", "cannot be started", 1},
    };
    if (access(INSTALLED_PROGRAMS "/sprayplan-cad", F_OK) == 0) {
        print_message("there is a sprayplan-cad in %s, which would be found\n", INSTALLED_PROGRAMS);
        skip();
    }
    run("cp '" BINARY_DIR "/sprayplan' alone && mkdir -p libexec/sprayplan");
    write_file("vessel.step", "ISO-10303-21;\n");
    write_file("vessel.yaml", "geometry:\n  - file: vessel.step\n" LEVEL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char line[256];
        if (cases[i].script)
            write_file("libexec/sprayplan/sprayplan-cad", cases[i].script);
        if (cases[i].script)
            run("chmod +x libexec/sprayplan/sprayplan-cad");
        snprintf(line, sizeof line, "./alone check vessel.yaml >.out 2>.err </dev/null; test $? -eq %d",
                 cases[i].status);
        run(line);
        char *said = read_file(".err", NULL);
        if (!strstr(said, cases[i].said))
            fail_msg("%s", said);
        free(said);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(only_its_inside_lid_and_agitator_are_cleaned, open_workplace, close_workplace),
        cmocka_unit_test_setup_teardown(the_same_as_obj, open_workplace, close_workplace),
        cmocka_unit_test_setup_teardown(check_reports_what_was_kept, open_workplace, close_workplace),
        cmocka_unit_test_setup_teardown(volumes_have_digits, open_workplace, close_workplace),
        cmocka_unit_test_setup_teardown(the_vessel_is_simulated_and_placed_in, open_workplace, close_workplace),
        cmocka_unit_test_setup_teardown(what_is_written_is_cut_as_finely, open_workplace, close_workplace),
        cmocka_unit_test_setup_teardown(what_reads_cad_may_be_missing_or_die, open_workplace, close_workplace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
