/* A scene far from (0, 0, 0): computed about a local origin, read and written where it lies. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "../scene/scratch.h"

#include <sprayplan/report.h>

static const char room_obj[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                               "g floor\nf 1 2 3 4\ng ceiling\nf 5 8 7 6\n"
                               "g walls\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";

/* The room at `at`, given as it would be by hand: by decimal numbers where its points then lie. */
static void write_scene(const char *name, sp_vec3 at)
{
    char text[2000];
    snprintf(text, sizeof text,
             "geometry: [{file: room.obj, translate: [%.17g, %.17g, %.17g]}]\n"
             "cavity: [%.17g, %.17g, %.17g]\n"
             "caps: [{point: [%.17g, %.17g, %.17g], normal: [0, 0, 1], radius: 50 mm}]\n"
             "criterion: {flux: 2 L/min/m2}\n"
             "catalogue: catalogue.yaml\n"
             "nozzles: [{name: N1, type: set, position: [%.17g, %.17g, %.17g], axis: [0, 0, -1], pressure: 2 bar}]\n"
             "simulate: {texel: 80 mm}\n"
             "place:\n"
             "  objective: max_coverage\n"
             "  max_nozzles: 2\n"
             "  types: [set]\n"
             "  pressure: 2 bar\n"
             "  mounts:\n"
             "    - line: {from: [%.17g, %.17g, %.17g], to: [%.17g, %.17g, %.17g], spacing: 300 mm, tilt: 20 deg}\n"
             "    - port: {name: M, position: [%.17g, %.17g, %.17g], depth: {to: 0.25, spacing: 0.125}, tilt: 9 deg}\n",
             at.x, at.y, at.z, at.x + 0.5, at.y + 0.5, at.z + 0.5, at.x + 0.5, at.y + 0.5, at.z + 1, at.x + 0.3,
             at.y + 0.4, at.z + 0.7, at.x + 0.25, at.y + 0.125, at.z + 0.75, at.x + 0.75, at.y + 0.125, at.z + 0.75,
             at.x + 0.625, at.y + 0.75, at.z + 0.875);
    scratch_write("room.obj", room_obj);
    scratch_write(name, text);
}

typedef struct {
    sp_scene *scene;
    sp_evaluator *evaluator;
    sp_vec3 at;
} opened;

static opened open_scene(const char *name, sp_vec3 at)
{
    sp_error error = {0};
    opened o = {.scene = sp_scene_load(name, &error), .at = at};
    o.evaluator = sp_evaluator_create(sp_scene_setup(o.scene), &error);
    assert_string_equal(error.message, "");
    return o;
}

static void close_scene(opened *o)
{
    sp_evaluator_destroy(o->evaluator);
    sp_scene_destroy(o->scene);
}

static sp_proposal *place(const opened *o)
{
    sp_error error = {0};
    sp_place_options options = sp_scene_place_options(o->scene);
    sp_proposal *proposal = sp_place(o->evaluator, &options, &error);
    assert_string_equal(error.message, "");
    return proposal;
}

/* What is written of the layout lies where the scene does, and covers the same when it is read again. */
static void check_written(const opened *o, const sp_layout *layout, double fraction)
{
    sp_error error = {0};
    const sp_setup *setup = sp_scene_setup(o->scene);
    char *text = sp_scene_text(o->scene, layout, sp_evaluator_fidelity(o->evaluator), ".", &error);
    assert_non_null(text);
    scratch_write("written.yaml", text);
    free(text);
    opened again = open_scene("written.yaml", o->at);
    sp_coverage *coverage = sp_evaluate(again.evaluator, sp_scene_layout(again.scene), &error);
    assert_true(coverage->fraction == fraction);
    sp_design design = {.name = "manual", .layout = layout, .coverage = coverage, .evaluator = o->evaluator};
    sp_result result = {.command = "simulate", .design_count = 1, .designs = &design};
    sp_figures *figures = sp_result_figures(&result, &error);
    sp_fitting_sheet *sheet = sp_fitting_sheet_create(layout, setup, NULL, 0, &error);
    char *csv = sp_nozzles_csv(sheet, &error), *row = strchr(csv, '\n') + 1;
    for (size_t i = 0; i < layout->count; i++, row = strchr(row, '\n') + 1) {
        sp_vec3 own = sp_setup_outside(setup, layout->nozzles[i].position), given = figures->nozzles[i].position;
        assert_true(sp_distance(own, given) == 0);
        assert_true(sp_distance(layout->nozzles[i].position, sp_scene_layout(again.scene)->nozzles[i].position) == 0);
        assert_true(sp_distance(own, o->at) < 2);
        double x, y, z;
        assert_int_equal(sscanf(row, "%*[^,],%*[^,],%lf,%lf,%lf", &x, &y, &z), 3);
        assert_true(sp_distance(own, sp_v(x, y, z)) == 0);
    }
    for (size_t i = 0; i < figures->shadow_count; i++)
        assert_true(sp_distance(figures->shadows[i].centroid, o->at) < 2);
    free(csv);
    sp_fitting_sheet_destroy(sheet);
    sp_figures_destroy(figures, 1);
    sp_coverage_destroy(coverage);
    close_scene(&again);
}

/* Moved by what the coordinates hold exactly, not a bit of the search on the candidates changes. Refined places are
 * rounded to what can be written there. */
static void a_far_scene_is_the_same_scene(void **state)
{
    (void)state;
    const sp_vec3 there = {1e6, -5e5, 250000};
    write_scene("near.yaml", sp_v(0, 0, 0));
    write_scene("far.yaml", there);
    opened near = open_scene("near.yaml", sp_v(0, 0, 0)), far = open_scene("far.yaml", there);
    assert_true(sp_length(sp_scene_setup(near.scene)->origin) == 0);
    assert_true(sp_distance(sp_scene_setup(far.scene)->origin, there) < 2);
    assert_true(sp_distance(sp_setup_outside(sp_scene_setup(far.scene), sp_scene_setup(far.scene)->cavity_point),
                            sp_add(there, sp_v(0.5, 0.5, 0.5))) == 0);
    sp_vec3 given = {there.x + 0.3, there.y + 0.4, there.z + 0.7};
    const sp_nozzle *own = sp_scene_layout(far.scene)->nozzles;
    assert_true(sp_distance(sp_setup_outside(sp_scene_setup(far.scene), own->position), given) == 0);
    sp_proposal *home = place(&near), *away = place(&far);
    assert_true(home->coverage->covered_area > home->greedy_coverage->covered_area);
    assert_true(away->greedy_coverage->fraction == home->greedy_coverage->fraction);
    assert_true(away->greedy_coverage->flow == home->greedy_coverage->flow);
    assert_true(fabs(away->coverage->fraction - home->coverage->fraction) < 1e-9);
    assert_true(fabs(away->coverage->flow / home->coverage->flow - 1) < 1e-9);
    for (size_t i = 0; i < home->layout->count; i++) {
        sp_vec3 own = sp_setup_outside(sp_scene_setup(far.scene), away->layout->nozzles[i].position);
        assert_true(sp_distance(sp_sub(own, there), home->layout->nozzles[i].position) < 1e-9);
    }
    check_written(&near, home->layout, home->coverage->fraction);
    check_written(&far, away->layout, away->coverage->fraction);
    sp_proposal_destroy(home);
    sp_proposal_destroy(away);
    close_scene(&near);
    close_scene(&far);
}

#ifndef SPRAYPLAN_SANITIZE /* the same again, which takes minutes there */
/* Moved by anything: what is rounded there is 1e-10 of the room. */
static void a_scene_moved_by_anything(void **state)
{
    (void)state;
    static const double far[] = {3.3, 98765.4321, 1e6 / 3};
    write_scene("near.yaml", sp_v(0, 0, 0));
    opened near = open_scene("near.yaml", sp_v(0, 0, 0));
    sp_proposal *home = place(&near);
    for (size_t i = 0; i < sizeof far / sizeof *far; i++) {
        sp_vec3 there = {far[i], 0.7 * far[i], -0.31 * far[i]};
        write_scene("moved.yaml", there);
        opened moved = open_scene("moved.yaml", there);
        sp_proposal *away = place(&moved);
        print_message("moved by %g m: coverage %+.2g, water %+.2g\n", sp_length(there),
                      away->coverage->fraction - home->coverage->fraction,
                      away->coverage->flow / home->coverage->flow - 1);
        assert_true(fabs(away->coverage->fraction - home->coverage->fraction) < 1e-9);
        assert_true(fabs(away->coverage->flow / home->coverage->flow - 1) < 1e-9);
        check_written(&moved, away->layout, away->coverage->fraction);
        sp_proposal_destroy(away);
        close_scene(&moved);
    }
    sp_proposal_destroy(home);
    close_scene(&near);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_far_scene_is_the_same_scene),
#ifndef SPRAYPLAN_SANITIZE
        cmocka_unit_test(a_scene_moved_by_anything),
#endif
    };
    return cmocka_run_group_tests(tests, scratch_make, scratch_remove);
}
