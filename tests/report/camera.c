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
    for (int view = 0; view < SP_VIEWS; view++) {
        double xy[2];
        sp_camera camera = sp_camera_create(evaluator, &result, &sp_views[view], 900);
        for (size_t i = 0; i < 4; i++)
            assert_int_equal(sp_camera_shows(&camera, nozzles[i].position, xy), i < 3);
        assert_true(sp_camera_shows(&camera, sp_v(0, 0, TANK_HEIGHT + TANK_DISH), xy));
        sp_camera without = sp_camera_create(evaluator, &(sp_result){0}, &sp_views[view], 900);
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
    sp_camera camera = sp_camera_create(evaluator, &(sp_result){0}, &sp_views[0], 900);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nozzles_around_a_machine_are_in_the_picture),
        cmocka_unit_test(a_cluster_is_one_nozzle_that_sprays_several_ways),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
