/* What a scene says becomes plain structs, in SI; what it does not say gets the documented defaults. */
#include "scratch.h"
#include "written.h"

#include <sprayplan/scene.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static sp_scene *load(const char *text)
{
    sp_error error = {0};
    char message[2000];
    scratch_write("scene.yaml", text);
    sp_scene *scene = sp_scene_load("scene.yaml", &error);
    sp_error_text(&error, message, sizeof message);
    if (!scene)
        fail_msg("%s", message);
    return scene;
}

static void near(double value, double expected)
{
    assert_true(fabs(value - expected) <= 1e-14 * (fabs(expected) + 1e-3));
}

static void near_vector(sp_vec3 value, double x, double y, double z)
{
    near(value.x, x);
    near(value.y, y);
    near(value.z, z);
}

static const char least[] = "geometry: [{file: tank.obj}]\n";

static void defaults(void **state)
{
    (void)state;
    sp_scene *scene = load(least);
    const sp_setup *setup = sp_scene_setup(scene);
    assert_int_equal(setup->cavity, SP_CAVITY_NONE);
    near_vector(setup->up, 0, 0, 1);
    near(setup->gravity, 9.81);
    near(setup->liquid.density, 1000);
    near(setup->liquid.viscosity, 1e-3);
    near(setup->liquid.surface_tension, 72e-3);
    near(setup->air.density, 1.2);
    near(setup->air.viscosity, 18e-6);
    near(setup->criterion.flux, 0);
    near(setup->criterion.impact_speed, 0);
    near(setup->criterion.incidence, M_PI / 2);
    assert_int_equal(setup->criterion.combine, SP_COMBINE_SUM);
    assert_int_equal(setup->fidelity.trajectory, SP_TRAJECTORY_AUTO);
    assert_int_equal(setup->fidelity.method, SP_METHOD_AUTO);
    assert_int_equal(setup->fidelity.reflections, -1);
    assert_int_equal(setup->fidelity.jets, 0);
    near(setup->fidelity.texel, 0);
    assert_int_equal(setup->fidelity.splat, SP_SPLAT_NEAREST);
    near(setup->fidelity.accuracy, 0.01);
    assert_int_equal(setup->fidelity.seed, 1);
    assert_int_equal(setup->mesh->part_count, 4);
    for (size_t i = 0; i < 4; i++) {
        assert_true(setup->surfaces[i].clean);
        near(setup->surfaces[i].restitution, 0);
        near(setup->surfaces[i].rebound, 1);
    }
    assert_int_equal(sp_scene_layout(scene)->count, 0);
    assert_string_equal(sp_scene_path(scene), "scene.yaml");
    assert_false(sp_scene_has_place(scene));
    sp_scene_destroy(scene);
}

/* What is written to be loaded beside the first file is in that file's own coordinates, also far away. */
static void the_first_file_has_its_own_coordinates(void **state)
{
    (void)state;
    sp_scene *scene = load(least);
    near(sp_scene_setup(scene)->file.scale, 1);
    near_vector(sp_transform_point(&sp_scene_setup(scene)->file, sp_v(1, 2, 3)), 1, 2, 3);
    sp_scene_destroy(scene);
    scene = load("geometry:\n"
                 "  - {file: tank.obj, unit: mm, scale: 2, rotate: {axis: [0, 0, 1], angle: 90 deg},\n"
                 "     translate: [1000 m, 2000 m, 3000 m]}\n"
                 "  - {file: tank.obj, translate: [1000 m, 2000 m, 3000 m]}\n");
    const sp_setup *setup = sp_scene_setup(scene);
    assert_true(sp_length(setup->origin) > 0);
    near(setup->file.scale, 2e-3);
    near_vector(sp_transform_point(&setup->file, sp_v(500, 0, 1000)), 1000, 2001, 3002);
    sp_scene_destroy(scene);
}

static void place_defaults(void **state)
{
    (void)state;
    sp_scene *scene = load("geometry: [{file: tank.obj}]\ncatalogue: catalogue.yaml\n"
                           "place: {pressure: 2 bar, mounts: [{port: {name: P, position: [0, 0, 1]}},\n"
                           "  {surface: {geometry: 0, spacing: 10 mm}}, {box: {min: [0, 0, 0], max: [0, 0, 0]}}]}\n");
    sp_place_options place = sp_scene_place_options(scene);
    assert_true(sp_scene_has_place(scene));
    assert_int_equal(place.objective, SP_OBJECTIVE_AREA_PER_WATER);
    near(place.coverage, 0.99);
    assert_int_equal(place.max_nozzles, 0);
    assert_true(isinf(place.max_water));
    near(place.clearance, 0);
    assert_int_equal(place.type_count, 6);
    assert_string_equal(place.types[4]->name, "set");
    assert_int_equal(place.pressure_count, 1);
    near(place.refine.position, -1);
    near(place.refine.axis, M_PI / 12);
    assert_true(place.refine.roll);
    assert_true(isinf(place.refine.angle) && isinf(place.refine.flow));
    assert_ptr_equal(place.kept, sp_scene_layout(scene));
    assert_int_equal(place.mount_count, 3);
    near_vector(place.mounts[0].axis, 0, 0, -1);
    near(place.mounts[0].tilt, 0);
    near(place.mounts[0].depth_to, 0);
    assert_int_equal(place.mounts[0].type_count, 0);
    assert_int_equal(place.mounts[1].part, SP_NONE);
    near(place.mounts[1].standoff, 0);
    sp_scene_destroy(scene);
}

static void surfaces_and_physics(void **state)
{
    (void)state;
    sp_scene *scene = load(full_scene);
    const sp_setup *setup = sp_scene_setup(scene);
    near_vector(setup->up, 0, 1, 0);
    assert_int_equal(setup->cavity, SP_CAVITY_POINT);
    near_vector(setup->cavity_point, 0.1, 0.2, 0.3);
    near(setup->liquid.density, 1100);
    near(setup->liquid.viscosity, 2e-3);
    near(setup->liquid.surface_tension, 40e-3);
    near(setup->air.viscosity, 20e-6);
    near(setup->criterion.flux, 1e-3 / 60);
    near(setup->criterion.impact_speed, 1);
    near(setup->criterion.incidence, M_PI / 3);
    assert_int_equal(setup->criterion.combine, SP_COMBINE_SINGLE);
    assert_int_equal(setup->mesh->part_count, 8);
    for (size_t i = 0; i < 8; i++)
        assert_int_equal(setup->surfaces[i].clean, i < 3);
    near(setup->surfaces[0].restitution, 0.5);
    near(setup->surfaces[0].rebound, 0.8);
    near(setup->surfaces[4].restitution, 0);
    /* Corner (1, 0, 0) mm, doubled, turned a quarter about z, moved. */
    near_vector(setup->mesh->vertices[1], 0, 0.102, 0.5);
    near_vector(setup->mesh->vertices[5], 1, 0, 0);
    sp_scene_destroy(scene);
}

static void nozzles_and_simulation(void **state)
{
    (void)state;
    sp_scene *scene = load(full_scene);
    const sp_layout *layout = sp_scene_layout(scene);
    assert_int_equal(layout->count, 2);
    const sp_nozzle *first = &layout->nozzles[0], *second = &layout->nozzles[1];
    assert_string_equal(first->name, "N1");
    assert_string_equal(first->type->name, "cone");
    near_vector(first->position, 0, 0.01, 0.2);
    near_vector(first->axis, 0, 0, -1);
    near(first->pressure, 2e5);
    assert_true(first->angle == 0 && first->flow == 0 && first->speed == 0 && first->jets == 0 && !first->keep);
    near_vector(second->axis, 1.0 / 3, 2.0 / 3, 2.0 / 3);
    near(second->roll, -M_PI / 6);
    near(second->angle, 100 * M_PI / 180);
    near(second->flow, 22e-3 / 60);
    near(second->speed, 12);
    assert_int_equal(second->jets, 5000);
    assert_true(second->keep);
    const sp_fidelity *fidelity = &sp_scene_setup(scene)->fidelity;
    assert_int_equal(fidelity->trajectory, SP_TRAJECTORY_LINE);
    assert_int_equal(fidelity->method, SP_METHOD_FORWARD);
    assert_int_equal(fidelity->reflections, 3);
    assert_int_equal(fidelity->jets, 20000);
    near(fidelity->texel, 0.005);
    assert_int_equal(fidelity->splat, SP_SPLAT_LINEAR);
    near(fidelity->accuracy, 0.02);
    assert_true(fidelity->seed == UINT64_MAX);
    sp_scene_destroy(scene);
}

/* Types that the scene does not name are read all the same. */
static void where_to_buy(void **state)
{
    (void)state;
    scratch_write("sold.yaml", "geometry:\n  - {file: tank.obj, unit: m}\ncatalogue: catalogue.yaml\nnozzles:\n"
                               "  - {name: N1, type: ring, position: [0, 0, 0], axis: [0, 0, 1], pressure: 2 bar}\n"
                               "  - {name: N2, type: cone, position: [0, 0, 0], axis: [0, 0, 1], pressure: 2 bar}\n");
    sp_error error = {0};
    sp_scene *scene = sp_scene_load("sold.yaml", &error);
    assert_non_null(scene);
    const sp_nozzle *nozzles = sp_scene_layout(scene)->nozzles;
    assert_string_equal(nozzles[0].type->order_code, "R-80");
    assert_string_equal(nozzles[0].type->url, "https://example.com/r?a=x&b=y");
    assert_true(!nozzles[1].type->order_code[0] && !nozzles[1].type->url[0]);
    sp_scene_destroy(scene);
}

static void only_addresses_are_linked(void **state)
{
    (void)state;
    static const char *const good[] = {"http://a", "https://example.com/r?a=1&b=%20#x"};
    static const char *const bad[] = {"",           "a",          "https://",   "javascript:alert(1)",
                                      "HTTPS ://a", "http://a b", "http://\"a", "http://<a>",
                                      "ftp://a",    "http://a\n"};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        assert_true(sp_is_url(good[i]));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(sp_is_url(bad[i]));
    char long_one[SP_URL + 1];
    memset(long_one, 'a', sizeof long_one);
    memcpy(long_one, "https://", 8);
    long_one[SP_URL] = 0;
    assert_false(sp_is_url(long_one));
    long_one[SP_URL - 1] = 0;
    assert_true(sp_is_url(long_one));
}

static void mounts(void **state)
{
    (void)state;
    sp_scene *scene = load(full_scene);
    sp_place_options place = sp_scene_place_options(scene);
    assert_int_equal(place.objective, SP_OBJECTIVE_MAX_COVERAGE);
    near(place.coverage, 0.95);
    assert_int_equal(place.max_nozzles, 12);
    near(place.max_water, 0.2 / 60);
    assert_int_equal(place.type_count, 2);
    assert_string_equal(place.types[0]->name, "fan");
    assert_int_equal(place.pressure_count, 2);
    near(place.pressures[1], 2e5);
    near(place.clearance, 0.05);
    assert_int_equal(place.mount_count, 4);
    const sp_mount *m = place.mounts;
    assert_int_equal(m[0].kind, SP_MOUNT_PORT);
    assert_string_equal(m[0].name, "P1");
    near_vector(m[0].axis, 0, 0, -1);
    assert_true(m[0].tilt == M_PI);
    near(m[0].depth_from, 0.05);
    near(m[0].depth_to, 0.4);
    near(m[0].depth_spacing, 0.05);
    assert_int_equal(m[0].type_count, 1);
    assert_string_equal(m[0].types[0]->name, "jet");
    assert_int_equal(m[1].kind, SP_MOUNT_SURFACE);
    assert_int_equal(m[1].geometry, 1);
    assert_int_equal(m[1].part, 7);
    near(m[1].standoff, 0.05);
    assert_int_equal(m[2].kind, SP_MOUNT_LINE);
    near_vector(m[2].axis, 0, -1, 0);
    near_vector(m[2].to, 1, 0, 0);
    assert_int_equal(m[3].kind, SP_MOUNT_BOX);
    near_vector(m[3].to, 1, 1, 0);
    near(m[3].spacing, 0.15);
    near(place.refine.position, 0.02);
    assert_false(place.refine.roll);
    near(place.refine.angle, M_PI / 9);
    near(place.refine.flow, 0.25);
    sp_scene_destroy(scene);
}

static void types(void **state)
{
    (void)state;
    sp_scene *scene = load("geometry: [{file: tank.obj}]\ncatalogue: catalogue.yaml\n");
    sp_place_options place = sp_scene_place_options(scene);
    assert_int_equal(place.type_count, 6);
    const sp_nozzle_type *cone = place.types[0], *ring = place.types[1], *fan = place.types[2], *jet = place.types[3];
    assert_int_equal(cone->pattern, SP_PATTERN_FULL_CONE);
    near(cone->angle, M_PI / 2);
    near(cone->flow, 0.2e-3);
    near(cone->at, 2e5);
    assert_true(cone->exponent == 0.5 && cone->cv == 0.95 && cone->drop == 1e-3);
    assert_true(cone->angle_min == cone->angle && cone->angle_max == cone->angle && cone->flow_max == cone->flow);
    near(ring->hollow, 0.7);
    near(ring->exponent, 0.46);
    near(fan->thickness, 8 * M_PI / 180);
    near(fan->flow, 2 * 231 * 0.0254 * 0.0254 * 0.0254 / 60);
    assert_true(fabs(fan->at - 40 * 6894.757293168) < 1e-3);
    near(fan->drop, 2e-3);
    near(jet->angle, M_PI / 180);
    near(place.types[4]->angle_min, M_PI / 3);
    near(place.types[4]->flow_max, 0.5e-3);
    assert_int_equal(cone->trajectory, SP_TRAJECTORY_AUTO);
    assert_int_equal(place.types[4]->trajectory, SP_TRAJECTORY_LINE);
    sp_scene_destroy(scene);
}

/* A cluster's patterns fly as the cluster says. */
static void trajectories(void **state)
{
    (void)state;
    scratch_write("ways.yaml", "nozzles:\n"
                               "  - {name: ball, pattern: cluster, flow: 40 L/min, at: 1.5 bar, trajectory: drag,\n"
                               "     members: [{pattern: solid_stream}, {pattern: full_cone, angle: 20 deg}]}\n");
    sp_scene *scene = load("geometry: [{file: tank.obj}]\ncatalogue: ways.yaml\n");
    const sp_nozzle_type *ball = sp_scene_place_options(scene).types[0];
    assert_int_equal(ball->trajectory, SP_TRAJECTORY_DRAG);
    for (size_t i = 0; i < ball->member_count; i++)
        assert_int_equal(ball->members[i].type.trajectory, SP_TRAJECTORY_DRAG);
    sp_scene_destroy(scene);
}

/* 2 + 1 + 12 shares; place takes it as any other type. */
static void clusters(void **state)
{
    (void)state;
    sp_scene *scene =
        load("geometry: [{file: tank.obj}]\ncatalogue: catalogue.yaml\n"
             "nozzles: [{name: N1, type: ball, position: [0, 0, 0], axis: [0, 0, 1], pressure: 6 bar}]\n");
    assert_int_equal(sp_scene_place_options(scene).type_count, 6);
    const sp_nozzle *nozzle = &sp_scene_layout(scene)->nozzles[0];
    const sp_nozzle_type *ball = nozzle->type;
    assert_int_equal(ball->pattern, SP_PATTERN_CLUSTER);
    assert_int_equal(ball->member_count, 14);
    assert_true(ball->angle == 0 && ball->angle_max == 0);
    assert_true(fabs(sp_nozzle_flow(nozzle, &sp_scene_setup(scene)->liquid) - 2 * 40e-3 / 60) < 1e-16);
    const sp_member *members = ball->members, *last = &members[13];
    assert_int_equal(members[0].type.pattern, SP_PATTERN_SOLID_STREAM);
    assert_string_equal(members[0].type.name, "ball");
    near(members[0].type.angle, M_PI / 180);
    near_vector(members[0].axis, 0, 0, 1);
    near_vector(members[0].offset, 0, 0, 0.014);
    near(members[0].share, 2);
    near(members[1].type.thickness, 8 * M_PI / 180);
    near_vector(members[1].axis, 0.6, 0, 0.8);
    near(members[1].roll, M_PI / 2);
    near(members[1].share, 1);
    double longitude = (10 + 330) * M_PI / 180, level = sqrt(0.75);
    sp_vec3 outwards = sp_v(level * cos(longitude), level * sin(longitude), 0.5);
    assert_true(sp_distance(last->axis, outwards) < 1e-14);
    assert_true(sp_distance(last->offset, sp_scale(outwards, 0.014)) < 1e-16);
    near(last->type.angle, M_PI / 60);
    assert_true(fabs(sp_nozzle_angle(nozzle) - 2 * (acos(0.8) + acos(cos(M_PI / 6) * cos(M_PI / 45)))) < 1e-13);
    sp_scene_destroy(scene);
}

static void what_reports_show(void **state)
{
    (void)state;
    sp_error error = {0};
    scratch_write("scene.yaml", full_scene);
    sp_scene *scene = sp_scene_load("scene.yaml", &error);
    sp_picture_style style = sp_scene_picture_style(scene);
    assert_true(style.quantity == SP_QUANTITY_FLUX && style.shades == SP_SHADES_AUTO &&
                style.colours == SP_COLOURS_VIRIDIS && !style.wireframe);
    sp_scene_destroy(scene);
    const char *const settings[] = {"report.quantity=incidence_min", "report.scale=stepped", "report.colours=cividis",
                                    "report.wireframe=true"};
    scene = sp_scene_load_with("scene.yaml", settings, 4, NULL, &error);
    assert_non_null(scene);
    style = sp_scene_picture_style(scene);
    assert_true(style.quantity == SP_QUANTITY_INCIDENCE_MIN && style.shades == SP_SHADES_STEPPED &&
                style.colours == SP_COLOURS_CIVIDIS && style.wireframe);
    sp_scene_destroy(scene);
    const char *const unasked[] = {"report.quantity=jets", "report.scale=stepped"};
    assert_null(sp_scene_load_with("scene.yaml", unasked, 2, NULL, &error));
    assert_string_equal(error.message, "scale: found 'stepped', expected auto, linear or log, as the criterion asks "
                                       "nothing of jets");
}

static void overrides(void **state)
{
    (void)state;
    const char *const settings[] = {"simulate.jets=777", "place.refine=none", "place.max_water=60 L/min",
                                    "place.pressure=[1.5 bar]", "simulate.reflections=auto"};
    sp_error error = {0};
    scratch_write("scene.yaml", full_scene);
    sp_scene *scene = sp_scene_load_with("scene.yaml", settings, 5, NULL, &error);
    assert_non_null(scene);
    sp_place_options place = sp_scene_place_options(scene);
    assert_int_equal(sp_scene_setup(scene)->fidelity.jets, 777);
    assert_int_equal(sp_scene_setup(scene)->fidelity.reflections, -1);
    near(place.max_water, 1e-3);
    near(place.pressures[0], 1.5e5);
    assert_true(place.refine.position == 0 && place.refine.axis == 0 && !place.refine.roll && place.refine.angle == 0 &&
                place.refine.flow == 0);
    sp_scene_destroy(scene);
    /* Blocks that the file does not have. */
    const char *const deep[] = {"place.refine.axis=3 deg", "simulate.seed=7"};
    scratch_write("scene.yaml", least);
    scene = sp_scene_load_with("scene.yaml", deep, 2, NULL, &error);
    assert_non_null(scene);
    near(sp_scene_place_options(scene).refine.axis, M_PI / 60);
    assert_int_equal(sp_scene_setup(scene)->fidelity.seed, 7);
    sp_scene_destroy(scene);
}

static void nothing(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_scene_destroy(NULL);
    assert_null(sp_scene_setup(NULL));
    assert_null(sp_scene_layout(NULL));
    assert_null(sp_scene_path(NULL));
    assert_false(sp_scene_has_place(NULL));
    assert_int_equal(sp_scene_place_options(NULL).mount_count, 0);
    assert_null(sp_scene_text(NULL, NULL, NULL, ".", &error));
    assert_int_equal(error.kind, SP_OK);
    assert_null(sp_scene_load(NULL, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    assert_null(sp_scene_load("no-such.yaml", NULL));
}

/* All that moves does so together; a dose is a mean flux over the pass, and is written back as it stood. */
static void goods_that_move(void **state)
{
    (void)state;
    sp_error error = {0};
    sp_scene *scene = load("geometry:\n"
                           "  - {file: tank.obj, sweep: {from: [-1, 0, 0], to: [2, 4, 0], speed: 6 m/min}}\n"
                           "  - {file: stirrer.obj, role: obstacle}\n"
                           "criterion: {dose: 5 L/m2}\n"
                           "catalogue: catalogue.yaml\n");
    const sp_setup *setup = sp_scene_setup(scene);
    near_vector(setup->sweep.from, -1, 0, 0);
    near_vector(setup->sweep.to, 2, 4, 0);
    near(setup->sweep.speed, 0.1);
    near(sp_sweep_duration(&setup->sweep), 50);
    near(setup->criterion.flux, 1e-4);
    for (size_t i = 0; i < setup->mesh->part_count; i++)
        assert_int_equal(setup->surfaces[i].moves, setup->mesh->parts[i].geometry == 0);
    char *text = written_text(scene, ".", &error);
    assert_non_null(text);
    assert_non_null(strstr(text, "sweep: {from: [-1, 0, 0], to: [2, 4, 0], speed: 6 m/min}"));
    assert_non_null(strstr(text, "dose: 5 L/m2"));
    free(text);
    sp_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults),
        cmocka_unit_test(the_first_file_has_its_own_coordinates),
        cmocka_unit_test(place_defaults),
        cmocka_unit_test(surfaces_and_physics),
        cmocka_unit_test(nozzles_and_simulation),
        cmocka_unit_test(where_to_buy),
        cmocka_unit_test(only_addresses_are_linked),
        cmocka_unit_test(mounts),
        cmocka_unit_test(types),
        cmocka_unit_test(trajectories),
        cmocka_unit_test(clusters),
        cmocka_unit_test(what_reports_show),
        cmocka_unit_test(overrides),
        cmocka_unit_test(goods_that_move),
        cmocka_unit_test(nothing),
    };
    return cmocka_run_group_tests(tests, scratch_make, scratch_remove);
}
