/* The evaluator of a page against the one that its arrays come from, on a room with a table that a beam runs through,
 * so that some triangles are wet in parts. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include "live/live.h"
#include "live/numbers.h"
#include "spray/paths.h"
#include "spray/restore.h"
#include "trace/ray/visit.h"

#include <sprayplan/sprayplan.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TOLERANCE 1e-9

static const sp_nozzle_type cone = {.name = "cone",
                                    .pattern = SP_PATTERN_FULL_CONE,
                                    .angle = 1.6,
                                    .flow = 2e-4,
                                    .at = 2e5,
                                    .exponent = 0.5,
                                    .cv = 0.95,
                                    .drop = 1e-3,
                                    .angle_min = 1.6,
                                    .angle_max = 1.6,
                                    .flow_min = 2e-4,
                                    .flow_max = 2e-4};
static sp_member arms[2];
static sp_nozzle_type pair = {.name = "pair",
                              .pattern = SP_PATTERN_CLUSTER,
                              .flow = 3e-4,
                              .at = 2e5,
                              .exponent = 0.5,
                              .cv = 0.95,
                              .drop = 1e-3,
                              .flow_min = 3e-4,
                              .flow_max = 3e-4,
                              .member_count = 2,
                              .members = arms};
static sp_mesh *mesh;
static sp_surface surfaces[3];
static sp_evaluator *evaluator;
static sp_live *live;
static sp_nozzle nozzles[2];

static void add_box(sp_vec3 low, sp_vec3 high, bool inwards, sp_vec3 *vertices, uint32_t (*triangles)[3], size_t box)
{
    static const uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (uint32_t i = 0; i < 8; i++)
        vertices[8 * box + i] = sp_v(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    for (size_t q = 0; q < 6; q++)
        for (size_t half = 0; half < 2; half++)
            for (size_t k = 0; k < 3; k++) {
                size_t corner = half ? (k ? k + 1 : 0) : k;
                triangles[12 * box + 2 * q + half][inwards ? 2 - k : k] = (uint32_t)(8 * box) + quads[q][corner];
            }
}

static void hand_over(sp_live_array which, const void *values, size_t bytes)
{
    void *room = sp_live_hand_over(live, which, bytes);
    assert_non_null(room);
    if (bytes)
        memcpy(room, values, bytes);
}

static void hand_over_surface(void)
{
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    size_t triangles = mesh->triangle_count;
    sp_wet_arrays arrays;
    sp_error error = {0};
    assert_true(sp_evaluator_wet_arrays(evaluator, &arrays, &error));
    assert_true(arrays.cut_count > 0);
    hand_over(SP_LIVE_VERTICES, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    hand_over(SP_LIVE_TRIANGLES, mesh->triangles, triangles * sizeof *mesh->triangles);
    hand_over(SP_LIVE_PARTS, mesh->part, triangles * sizeof *mesh->part);
    hand_over(SP_LIVE_CLEAN, (const uint8_t[]){1, 1, 0}, 3);
    hand_over(SP_LIVE_NAMES, "room\0table\0beam", sizeof "room\0table\0beam");
    hand_over(SP_LIVE_CHARTS, atlas->chart, triangles * sizeof *atlas->chart);
    hand_over(SP_LIVE_UV, atlas->uv, triangles * sizeof *atlas->uv);
    hand_over(SP_LIVE_CHART_PAGE, atlas->chart_page, atlas->chart_count * sizeof *atlas->chart_page);
    hand_over(SP_LIVE_CHART_TEXEL, atlas->chart_texel, atlas->chart_count * sizeof *atlas->chart_texel);
    hand_over(SP_LIVE_SIDES, arrays.sides, triangles);
    hand_over(SP_LIVE_NODES, arrays.nodes, arrays.node_count);
    hand_over(SP_LIVE_CUTS, arrays.cuts, arrays.cut_count * sizeof *arrays.cuts);
    sp_wet_arrays_free(&arrays);
}

static void hand_over_settings(const sp_setup *setup)
{
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    const double settings[SP_LIVE_SETTING_COUNT] = {[SP_LIVE_DENSITY] = setup->liquid.density,
                                                    [SP_LIVE_GRAVITY] = setup->gravity,
                                                    [SP_LIVE_FLUX] = setup->criterion.flux,
                                                    [SP_LIVE_INCIDENCE] = setup->criterion.incidence,
                                                    [SP_LIVE_PARABOLA] = 1,
                                                    [SP_LIVE_TEXEL] = sp_evaluator_fidelity(evaluator)->texel,
                                                    [SP_LIVE_CAVITY] = setup->cavity,
                                                    [SP_LIVE_CAVITY_X] = setup->cavity_point.x,
                                                    [SP_LIVE_CAVITY_Y] = setup->cavity_point.y,
                                                    [SP_LIVE_CAVITY_Z] = setup->cavity_point.z,
                                                    [SP_LIVE_PAGE_EDGE] = atlas->page_edge,
                                                    [SP_LIVE_PAGE_COUNT] = (double)atlas->page_count};
    double types[3][SP_LIVE_TYPE_NUMBERS], members[2][SP_LIVE_MEMBER_NUMBERS];
    sp_live_write_type(&cone, 0, types[0]);
    sp_live_write_type(&pair, 0, types[1]);
    sp_live_write_type(&arms[0].type, 0, types[2]);
    for (size_t i = 0; i < 2; i++)
        sp_live_write_member(&arms[i], 2, members[i]);
    hand_over(SP_LIVE_SETTINGS, settings, sizeof settings);
    hand_over(SP_LIVE_TYPES, types, sizeof types);
    hand_over(SP_LIVE_MEMBERS, members, sizeof members);
}

static void hand_over_nozzles(bool second_on)
{
    double rows[2][SP_LIVE_NOZZLE_NUMBERS];
    for (size_t i = 0; i < 2; i++)
        sp_live_write_nozzle(&nozzles[i], nozzles[i].type == &pair, rows[i]);
    rows[1][SP_LIVE_NOZZLE_NUMBERS - 1] = second_on;
    hand_over(SP_LIVE_NOZZLES, rows, sizeof rows);
}

static int open_room(void **state)
{
    (void)state;
    sp_vec3 vertices[24];
    uint32_t triangles[36][3], part[36];
    for (size_t t = 0; t < 36; t++)
        part[t] = (uint32_t)(t / 12);
    add_box(sp_v(0, 0, 0), sp_v(2, 1.5, 1.2), true, vertices, triangles, 0);
    add_box(sp_v(0.5, 0.4, 0.3), sp_v(1.1, 0.9, 0.4), false, vertices, triangles, 1);
    add_box(sp_v(0.7, 0.55, 0.1), sp_v(0.8, 0.65, 0.9), false, vertices, triangles, 2);
    sp_error error = {0};
    mesh = sp_mesh_create(vertices, 24, triangles, 36, part, (const char *const[]){"room", "table", "beam"}, 3, &error);
    for (size_t i = 0; i < 3; i++)
        surfaces[i] = (sp_surface){.clean = i < 2, .rebound = 1};
    for (size_t i = 0; i < 2; i++)
        arms[i] = (sp_member){
            .type = cone, .offset = {i ? 0.05 : -0.05, 0, 0}, .axis = {0, i ? 0.6 : -0.6, 0.8}, .share = 1 + i};
    for (size_t i = 0; i < 2; i++)
        arms[i].type.trajectory = SP_TRAJECTORY_LINE;
    sp_setup setup = sp_setup_default();
    setup.mesh = mesh;
    setup.surfaces = surfaces;
    setup.cavity = SP_CAVITY_POINT;
    setup.cavity_point = sp_v(1.5, 1.2, 0.8);
    setup.criterion.flux = 2 / 6e4;
    setup.fidelity.texel = 0.03;
    evaluator = sp_evaluator_create(&setup, &error);
    live = sp_live_create();
    if (!evaluator || !live)
        return -1;
    nozzles[0] =
        (sp_nozzle){.name = "N1", .type = &cone, .position = {1.4, 1, 1.1}, .axis = {0, 0, -1}, .pressure = 2e5};
    nozzles[1] =
        (sp_nozzle){.name = "N2", .type = &pair, .position = {0.4, 0.5, 1}, .axis = {0.6, 0, -0.8}, .pressure = 3e5};
    hand_over_surface();
    hand_over_settings(&setup);
    return 0;
}

static int close_room(void **state)
{
    (void)state;
    sp_live_destroy(live);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(mesh);
    return 0;
}

static double figure(sp_live_figure which)
{
    return ((const double *)sp_live_tell(live, SP_LIVE_FIGURES))[which];
}

/* On every patch. */
static void expect_like(size_t count)
{
    sp_error error = {0};
    sp_layout layout = {.count = count, .nozzles = nozzles};
    sp_coverage *coverage = sp_evaluate(evaluator, &layout, &error);
    assert_non_null(coverage);
    assert_true(coverage->fraction > 0.02 && coverage->fraction < 0.95);
    assert_float_equal(figure(SP_LIVE_COVERAGE), coverage->fraction, TOLERANCE);
    assert_float_equal(figure(SP_LIVE_FLOW), coverage->flow, TOLERANCE * coverage->flow);
    assert_int_equal((size_t)figure(SP_LIVE_PATCHES), coverage->deposits.count);
    const double *flux = sp_live_tell(live, SP_LIVE_PATCH_FLUX), *speed = sp_live_tell(live, SP_LIVE_PATCH_SPEED);
    const double *share = sp_live_tell(live, SP_LIVE_PATCH_SHARE);
    for (size_t i = 0; i < coverage->deposits.count; i++) {
        assert_float_equal(flux[i], coverage->deposits.flux[i], TOLERANCE * coverage->flux_max);
        assert_float_equal(speed[i], coverage->deposits.speed[i], 1e-6);
        assert_float_equal(share[i], coverage->deposits.share[i], TOLERANCE);
    }
    sp_coverage_destroy(coverage);
}

static void a_layout_covers_what_it_does(void **state)
{
    (void)state;
    hand_over_nozzles(true);
    assert_false(sp_live_evaluate(live, 1));
    if (!sp_live_open(live))
        fail_msg("%s", sp_live_error(live));
    assert_true(sp_live_evaluate(live, 1));
    assert_true(figure(SP_LIVE_TRACED) == 2);
    expect_like(2);
}

static void only_what_moved_is_traced(void **state)
{
    (void)state;
    assert_true(sp_live_evaluate(live, 1));
    assert_true(figure(SP_LIVE_TRACED) == 0);
    nozzles[0].position.x -= 0.3;
    hand_over_nozzles(true);
    assert_true(sp_live_evaluate(live, 1));
    assert_true(figure(SP_LIVE_TRACED) == 1);
    expect_like(2);
    assert_true(sp_live_prepare(live, 0));
    nozzles[0].axis = sp_unit(sp_v(0.3, -0.2, -1));
    nozzles[0].flow = 1.7e-4;
    hand_over_nozzles(true);
    assert_true(sp_live_evaluate(live, 1));
    assert_true(figure(SP_LIVE_TRACED) == 0);
    expect_like(2);
    nozzles[0].pressure = 1e5; /* as slow it flies elsewhere */
    nozzles[1].axis = sp_unit(sp_v(0.3, 0.1, -1));
    hand_over_nozzles(true);
    assert_true(sp_live_evaluate(live, 1));
    assert_true(figure(SP_LIVE_TRACED) == 2);
    expect_like(2);
}

static void one_that_is_off_brings_nothing(void **state)
{
    (void)state;
    hand_over_nozzles(false);
    assert_true(sp_live_evaluate(live, 1));
    expect_like(1);
    assert_null(sp_live_alone(live, 1));
    hand_over_nozzles(true);
    assert_true(sp_live_evaluate(live, 1));
    assert_true(figure(SP_LIVE_TRACED) == 0);
    expect_like(2);
    assert_non_null(sp_live_alone(live, 1));
}

static void a_sample_comes_near(void **state)
{
    (void)state;
    double exact = figure(SP_LIVE_COVERAGE);
    nozzles[0].position.z -= 1e-6;
    hand_over_nozzles(true);
    assert_true(sp_live_evaluate(live, 2));
    assert_true(figure(SP_LIVE_TRACED) == 1);
    assert_float_equal(figure(SP_LIVE_COVERAGE), exact, 0.05);
    assert_true(figure(SP_LIVE_COVERAGE) != exact);
    assert_true(sp_live_evaluate(live, 1));
    assert_true(figure(SP_LIVE_TRACED) == 1);
    expect_like(2);
}

static void shadows_are_those_of_the_layout(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_layout layout = {.count = 2, .nozzles = nozzles};
    sp_coverage *coverage = sp_evaluate(evaluator, &layout, &error);
    sp_shadow *shadows;
    size_t count;
    assert_true(sp_shadows(evaluator, coverage, NULL, &shadows, &count, &error));
    assert_true(sp_live_find_shadows(live));
    const double(*list)[SP_LIVE_SHADOW_NUMBERS] = sp_live_tell(live, SP_LIVE_SHADOW_LIST);
    size_t listed = count < SP_LIVE_SHADOWS ? count : SP_LIVE_SHADOWS, of_flux = 0;
    assert_int_equal((size_t)figure(SP_LIVE_SHADOW_COUNT), listed);
    assert_float_equal(list[0][0], shadows[0].area, TOLERANCE);
    for (size_t i = 0; i < listed; i++) {
        assert_int_equal((size_t)list[i][4], shadows[i].part);
        assert_int_equal((size_t)list[i][5], shadows[i].lack);
        of_flux += shadows[i].lack == SP_LACK_FLUX;
    }
    assert_true(of_flux > 0);
    free(shadows);
    sp_coverage_destroy(coverage);
}

static void a_nozzle_in_steel_cannot_stand(void **state)
{
    (void)state;
    assert_true(sp_live_admits(live, 0));
    sp_vec3 before = nozzles[0].position;
    nozzles[0].position = sp_v(0.6, 0.5, 0.35);
    hand_over_nozzles(true);
    assert_false(sp_live_admits(live, 0));
    nozzles[0].position = before;
    hand_over_nozzles(true);
}

static void a_foot_lies_on_its_part(void **state)
{
    (void)state;
    const double *foot = sp_live_foot(live, 1, 0.9, 0.8, 1.0);
    assert_non_null(foot);
    const double expected[6] = {0.9, 0.8, 0.4, 0, 0, 1};
    for (size_t k = 0; k < 6; k++)
        assert_float_equal(foot[k], expected[k], 1e-12);
}

/* What is told wrongly is no evaluator, and no crash. */
static void boxes_are_those_of_the_tree(void **state)
{
    (void)state;
    const sp_tracer *tracer = sp_evaluator_tracer(evaluator);
    size_t count = sp_tracer_leaves(tracer, NULL);
    double(*boxes)[6] = malloc(count * sizeof *boxes);
    assert_true(count > 1 && boxes);
    sp_tracer_leaves(tracer, boxes);
    for (int twice = 0; twice < 2; twice++) {
        assert_int_equal(sp_live_boxes(live), count);
        assert_memory_equal(sp_live_tell(live, SP_LIVE_BOXES), boxes, count * sizeof *boxes);
    }
    free(boxes);
}

/* Of a cone, and of both members of a cluster, each from its own place; of one that is off, or none, nothing. */
static void jets_fly_as_the_report_s_do(void **state)
{
    (void)state;
    hand_over_nozzles(true);
    for (size_t n = 0; n < 2; n++) {
        sp_error error = {0};
        sp_paths paths;
        sp_nozzle patterns[2];
        assert_true(sp_paths_fly(evaluator, &nozzles[n], &paths, &error));
        sp_nozzle_patterns(&nozzles[n], &sp_evaluator_setup(evaluator)->liquid, sp_evaluator_setup(evaluator)->up,
                           patterns);
        assert_true(paths.jet_count >= 30);
        assert_int_equal(sp_live_fly(live, n), paths.leg_count);
        const double(*legs)[SP_LIVE_LEG_NUMBERS] = sp_live_tell(live, SP_LIVE_LEGS);
        for (size_t i = 0; i < paths.leg_count; i++) {
            const sp_path_leg *leg = &paths.legs[i];
            const sp_vec3 from = patterns[paths.pattern[leg->jet]].position;
            const double expected[SP_LIVE_LEG_NUMBERS] = {from.x,     from.y,     from.z,    leg->end.x,
                                                          leg->end.y, leg->end.z, leg->rise, leg->bounce};
            for (size_t k = 0; k < SP_LIVE_LEG_NUMBERS; k++)
                assert_float_equal(legs[i][k], expected[k], TOLERANCE);
        }
        sp_paths_free(&paths);
    }
    assert_int_equal(sp_live_fly(live, 2), 0);
    hand_over_nozzles(false);
    assert_int_equal(sp_live_fly(live, 1), 0);
    hand_over_nozzles(true);
}

static void what_does_not_belong_together_is_refused(void **state)
{
    (void)state;
    sp_live *own = live;
    live = sp_live_create();
    hand_over_surface();
    hand_over_settings(sp_evaluator_setup(evaluator));
    uint32_t *corners = sp_live_hand_over(live, SP_LIVE_TRIANGLES, mesh->triangle_count * sizeof *mesh->triangles);
    memcpy(corners, mesh->triangles, mesh->triangle_count * sizeof *mesh->triangles);
    corners[5] = (uint32_t)mesh->vertex_count;
    assert_false(sp_live_open(live));
    hand_over(SP_LIVE_TRIANGLES, mesh->triangles, mesh->triangle_count * sizeof *mesh->triangles);
    hand_over(SP_LIVE_NODES, (const uint8_t[]){SP_WET_CUT, 0}, 2);
    assert_false(sp_live_open(live));
    sp_live_destroy(live);
    live = own;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_layout_covers_what_it_does),    cmocka_unit_test(only_what_moved_is_traced),
        cmocka_unit_test(one_that_is_off_brings_nothing),  cmocka_unit_test(a_sample_comes_near),
        cmocka_unit_test(shadows_are_those_of_the_layout), cmocka_unit_test(a_nozzle_in_steel_cannot_stand),
        cmocka_unit_test(a_foot_lies_on_its_part),         cmocka_unit_test(what_does_not_belong_together_is_refused),
        cmocka_unit_test(boxes_are_those_of_the_tree),     cmocka_unit_test(jets_fly_as_the_report_s_do),
    };
    return cmocka_run_group_tests_name("live evaluate", tests, open_room, close_room);
}
