/* What the report's pictures show. */
#include "report/labels.h"
#include "report/overlay.h"

#include "tank.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

/* A tank washed from outside: nozzles around it are in every picture, one that is lost far away is in none and takes
 * nothing from the rest. */
static void nozzles_around_a_machine_are_in_the_picture(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_mesh *mesh = tank_mesh(24, &error);
    sp_setup setup = tank_setup(mesh, 0.05);
    setup.cavity = SP_CAVITY_OUTSIDE;
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    assert_non_null(evaluator);
    sp_nozzle nozzles[4] = {tank_manual[0], tank_manual[0], tank_manual[0], tank_manual[0]};
    nozzles[0].position = sp_v(1.4, 0.3, 1);
    nozzles[1].position = sp_v(-1.2, -0.8, 0.1);
    nozzles[2].position = sp_v(0, 0, 2.2);
    nozzles[3].position = sp_v(300, 0, 0);
    sp_layout *layout = sp_layout_create(nozzles, 4, &error);
    sp_design design = {.name = "manual", .evaluator = evaluator, .layout = layout};
    sp_result result = {.design_count = 1, .designs = &design};
    for (int viewpoint = 0; viewpoint < SP_VIEWPOINTS; viewpoint++) {
        double xy[2];
        sp_camera camera = sp_camera_create(evaluator, &result, &sp_viewpoints[viewpoint], 900);
        for (size_t i = 0; i < 4; i++)
            assert_int_equal(sp_camera_shows(&camera, nozzles[i].position, xy), i < 3);
        assert_true(sp_camera_shows(&camera, sp_v(0, 0, TANK_HEIGHT + TANK_DISH), xy));
        sp_camera without = sp_camera_create(evaluator, &(sp_result){0}, &sp_viewpoints[viewpoint], 900);
        assert_true(camera.size == without.size);
        assert_true(sp_distance(camera.eye, camera.centre) < 3 * sp_distance(without.eye, without.centre));
    }
    sp_layout_destroy(layout);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(mesh);
}

static size_t count(const char *text, const char *part)
{
    size_t found = 0;
    for (const char *at = text; (at = strstr(at, part)); at++)
        found++;
    return found;
}

/* One dot and one name, with an outline for each pattern. */
static void a_cluster_is_one_nozzle_that_sprays_several_ways(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_mesh *mesh = tank_mesh(24, &error);
    sp_setup setup = tank_setup(mesh, 0.05);
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    assert_non_null(evaluator);
    sp_member members[3];
    for (int i = 0; i < 3; i++)
        members[i] =
            (sp_member){.type = tank_types[i % 2], .axis = sp_v(sin(i), 0, cos(i)), .offset = {0, 0, 0.01}, .share = 1};
    sp_nozzle_type type = tank_types[0];
    type.pattern = SP_PATTERN_CLUSTER;
    type.member_count = 3;
    type.members = members;
    sp_nozzle nozzle = tank_manual[0];
    nozzle.type = &type;
    sp_layout layout = {1, &nozzle};
    sp_camera camera = sp_camera_create(evaluator, &(sp_result){0}, &sp_viewpoints[0], 900);
    sp_text text = {0};
    sp_overlay_sprays(&text, &camera, evaluator, &layout);
    sp_labels_nozzles(&(sp_labels){0}, &text, &camera, &layout);
    sp_fitting_sheet *sheet = sp_fitting_sheet_create(&layout, &setup, NULL, 0, &error);
    char *markup = sp_text_finish(&text, &error), *csv = sp_nozzles_csv(sheet, &error);
    assert_int_equal(count(markup, "class=\"nozzle\""), 1);
    assert_int_equal(count(markup, "class=\"name\""), 1);
    assert_int_equal(count(markup, "class=\"spray\""), 3);
    assert_int_equal(count(csv, "\n"), 2);
    free(markup);
    free(csv);
    sp_fitting_sheet_destroy(sheet);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(mesh);
}

static bool overlap(const double a[4], const double b[4])
{
    return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
}

/* Nozzles so close together that names cannot all stand beside their dots. */
static void names_stand_clear_of_each_other(void **state)
{
    (void)state;
    enum { NOZZLES = 14 };
    sp_error error = {0};
    sp_mesh *mesh = tank_mesh(24, &error);
    sp_setup setup = tank_setup(mesh, 0.05);
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    sp_nozzle nozzles[NOZZLES];
    for (int i = 0; i < NOZZLES; i++) {
        nozzles[i] = tank_manual[0];
        snprintf(nozzles[i].name, sizeof nozzles[i].name, "Nozzle %d", i);
        nozzles[i].position = sp_v(0.01 * (i % 4), 0, 1 + 0.01 * (i / 4));
    }
    sp_layout layout = {NOZZLES, nozzles};
    for (int viewpoint = 0; viewpoint < SP_VIEWPOINTS; viewpoint++) {
        sp_camera camera = sp_camera_create(evaluator, &(sp_result){0}, &sp_viewpoints[viewpoint], 900);
        sp_text text = {0};
        sp_labels labels = {.width = camera.width, .height = camera.height};
        sp_labels_nozzles(&labels, &text, &camera, &layout);
        assert_int_equal(labels.count, 2 * NOZZLES);
        for (size_t i = NOZZLES; i < labels.count; i++) { /* names come after the dots */
            const double *box = labels.box[i];
            assert_true(box[0] >= 0 && box[1] >= 0 && box[2] <= camera.width && box[3] <= camera.height);
            for (size_t k = 0; k < labels.count; k++)
                assert_true(i == k || !overlap(labels.box[i], labels.box[k]));
        }
        assert_true(count(text.text, "class=\"lead\"") > 0);
        free(text.text);
    }
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(mesh);
}

/* Of so many that names do not find room some are left out, to be seen where the pointer rests. */
static void names_without_room_are_left_out(void **state)
{
    (void)state;
    enum { NOZZLES = 600 };
    static sp_nozzle nozzles[NOZZLES];
    static sp_labels labels;
    sp_error error = {0};
    sp_mesh *mesh = tank_mesh(24, &error);
    sp_setup setup = tank_setup(mesh, 0.05);
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    for (int i = 0; i < NOZZLES; i++) {
        nozzles[i] = tank_manual[0];
        snprintf(nozzles[i].name, sizeof nozzles[i].name, "MW %d", i);
        nozzles[i].position = sp_v(0.01 * (i % 30), 0, 1 + 0.01 * (i / 30));
    }
    sp_layout layout = {NOZZLES, nozzles};
    sp_camera camera = sp_camera_create(evaluator, &(sp_result){0}, &sp_viewpoints[0], 900);
    sp_text text = {0};
    labels = (sp_labels){.width = camera.width, .height = camera.height};
    sp_labels_nozzles(&labels, &text, &camera, &layout);
    size_t named = count(text.text, "class=\"name\""), hidden = count(text.text, "<title>MW ");
    assert_true(named > 0 && hidden > 0);
    assert_int_equal(named + hidden, NOZZLES);
    assert_int_equal(count(text.text, "class=\"nozzle\""), NOZZLES);
    for (size_t i = NOZZLES; i < labels.count; i++)
        for (size_t k = 0; k < i; k++)
            assert_false(overlap(labels.box[i], labels.box[k]));
    free(text.text);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(mesh);
}

/* On every side what is to be cleaned comes near the picture's rim; what only blocks is not made room for. */
static void pictures_are_cropped_to_what_is_cleaned(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_mesh *mesh = tank_mesh(24, &error);
    sp_setup setup = tank_setup(mesh, 0.05);
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    sp_result result = {0};
    for (int viewpoint = 0; viewpoint < SP_VIEWPOINTS; viewpoint++) {
        sp_camera camera = sp_camera_create(evaluator, &result, &sp_viewpoints[viewpoint], 900);
        double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, xy[2];
        for (uint32_t t = 0; t < mesh->triangle_count; t++)
            for (int k = 0; k < 3 && setup.surfaces[mesh->part[t]].clean; k++) {
                assert_true(sp_camera_shows(&camera, mesh->vertices[mesh->triangles[t][k]], xy));
                for (int i = 0; i < 2; i++) {
                    low[i] = fmin(low[i], xy[i]);
                    high[i] = fmax(high[i], xy[i]);
                }
            }
        const double size[2] = {camera.width, camera.height};
        assert_true(fmax(size[0], size[1]) <= 900);
        for (int i = 0; i < 2; i++) {
            assert_true(low[i] < 0.05 * size[i] && high[i] > 0.95 * size[i]);
            assert_true(fabs(low[i] - (size[i] - high[i])) < 0.02 * size[i]);
        }
    }
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(mesh);
}

/* The bar is as long as what it says, at the depth of the middle. */
static void the_bar_is_to_scale(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_mesh *mesh = tank_mesh(24, &error);
    sp_setup setup = tank_setup(mesh, 0.05);
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    for (int viewpoint = 0; viewpoint < SP_VIEWPOINTS; viewpoint++) {
        sp_camera camera = sp_camera_create(evaluator, &(sp_result){0}, &sp_viewpoints[viewpoint], 900);
        sp_text text = {0};
        sp_overlay_scale(&text, &camera);
        double left, right, length, from[2], to[2];
        assert_int_equal(sscanf(strstr(text.text, "v12M"), "v12M%lf %*fH%lf", &left, &right), 2);
        const char *told = strstr(text.text, "\"middle\">") + 9;
        assert_int_equal(sscanf(told, "%lf mm<", &length), 1);
        assert_non_null(strstr(told, " mm</text>"));
        sp_camera_project(&camera, camera.centre, from);
        sp_camera_project(&camera, sp_along(camera.centre, length / 1000, camera.right), to);
        assert_true(fabs((to[0] - from[0]) - (right - left)) < 0.2);
        assert_int_equal(count(text.text, ">x</text>") + count(text.text, ">y</text>") + count(text.text, ">z</text>"),
                         viewpoint == 0   ? 2
                         : viewpoint == 1 ? 3
                                          : 3);
        free(text.text);
    }
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nozzles_around_a_machine_are_in_the_picture),
        cmocka_unit_test(a_cluster_is_one_nozzle_that_sprays_several_ways),
        cmocka_unit_test(names_stand_clear_of_each_other),
        cmocka_unit_test(names_without_room_are_left_out),
        cmocka_unit_test(pictures_are_cropped_to_what_is_cleaned),
        cmocka_unit_test(the_bar_is_to_scale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
