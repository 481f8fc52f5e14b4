/* A scene written back loads again, from wherever it lies, and says the same to the last bit. */
#include "scratch.h"

#include <sprayplan/scene.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static sp_scene *load(const char *path)
{
    sp_error error = {0};
    char message[2000];
    sp_scene *scene = sp_scene_load(path, &error);
    sp_error_text(&error, message, sizeof message);
    if (!scene)
        fail_msg("%s", message);
    return scene;
}

static char *text_of(const sp_scene *scene, const sp_layout *layout, const sp_fidelity *fidelity, const char *directory)
{
    sp_error error = {0};
    char *text = sp_scene_text(scene, layout, fidelity, directory, &error);
    if (!text)
        fail_msg("%s", error.message);
    return text;
}

#define same(a, b) assert_memory_equal(&(a), &(b), sizeof(a))

static void same_setup(const sp_setup *a, const sp_setup *b)
{
    assert_int_equal(a->mesh->vertex_count, b->mesh->vertex_count);
    assert_memory_equal(a->mesh->vertices, b->mesh->vertices, a->mesh->vertex_count * sizeof *a->mesh->vertices);
    assert_int_equal(a->mesh->part_count, b->mesh->part_count);
    for (size_t i = 0; i < a->mesh->part_count; i++) {
        assert_int_equal(a->surfaces[i].clean, b->surfaces[i].clean);
        same(a->surfaces[i].restitution, b->surfaces[i].restitution);
        same(a->surfaces[i].rebound, b->surfaces[i].rebound);
    }
    assert_int_equal(a->cavity, b->cavity);
    same(a->cavity_point, b->cavity_point);
    same(a->liquid, b->liquid);
    same(a->air, b->air);
    same(a->up, b->up);
    same(a->datum, b->datum);
    same(a->gravity, b->gravity);
    same(a->criterion.flux, b->criterion.flux);
    same(a->criterion.impact_speed, b->criterion.impact_speed);
    same(a->criterion.incidence, b->criterion.incidence);
    assert_int_equal(a->criterion.combine, b->criterion.combine);
}

static void same_fidelity(const sp_fidelity *a, const sp_fidelity *b)
{
    assert_int_equal(a->trajectory, b->trajectory);
    assert_int_equal(a->method, b->method);
    assert_int_equal(a->reflections, b->reflections);
    assert_true(a->jets == b->jets && a->seed == b->seed);
    same(a->texel, b->texel);
    assert_int_equal(a->splat, b->splat);
    same(a->accuracy, b->accuracy);
}

static void same_type(const sp_nozzle_type *a, const sp_nozzle_type *b)
{
    assert_string_equal(a->name, b->name);
    assert_int_equal(a->pattern, b->pattern);
    assert_memory_equal(&a->angle, &b->angle, offsetof(sp_nozzle_type, members) - offsetof(sp_nozzle_type, angle));
    for (size_t i = 0; i < a->member_count; i++)
        assert_memory_equal(&a->members[i].offset, &b->members[i].offset,
                            sizeof *a->members - offsetof(sp_member, offset));
}

static void same_layout(const sp_layout *a, const sp_layout *b)
{
    assert_int_equal(a->count, b->count);
    for (size_t i = 0; i < a->count; i++) {
        const sp_nozzle *p = &a->nozzles[i], *q = &b->nozzles[i];
        assert_string_equal(p->name, q->name);
        same_type(p->type, q->type);
        same(p->position, q->position);
        same(p->axis, q->axis);
        same(p->roll, q->roll);
        same(p->pressure, q->pressure);
        same(p->angle, q->angle);
        same(p->flow, q->flow);
        same(p->speed, q->speed);
        assert_true(p->jets == q->jets && p->keep == q->keep);
    }
}

static void same_mount(const sp_mount *a, const sp_mount *b)
{
    assert_int_equal(a->kind, b->kind);
    assert_string_equal(a->name, b->name);
    same(a->position, b->position);
    same(a->axis, b->axis);
    same(a->tilt, b->tilt);
    assert_memory_equal(&a->depth_from, &b->depth_from, 3 * sizeof(double));
    assert_int_equal(a->type_count, b->type_count);
    for (size_t i = 0; i < a->type_count; i++)
        same_type(a->types[i], b->types[i]);
    same(a->bore, b->bore);
    same(a->depth_step, b->depth_step);
    same(a->tilt_step, b->tilt_step);
    assert_int_equal(a->geometry, b->geometry);
    assert_int_equal(a->part, b->part);
    same(a->standoff, b->standoff);
    same(a->spacing, b->spacing);
    same(a->from, b->from);
    same(a->to, b->to);
}

static void same_place(const sp_place_options *a, const sp_place_options *b)
{
    assert_int_equal(a->objective, b->objective);
    same(a->coverage, b->coverage);
    assert_int_equal(a->max_nozzles, b->max_nozzles);
    same(a->max_water, b->max_water);
    assert_int_equal(a->type_count, b->type_count);
    for (size_t i = 0; i < a->type_count; i++)
        same_type(a->types[i], b->types[i]);
    assert_int_equal(a->pressure_count, b->pressure_count);
    for (size_t i = 0; i < a->pressure_count; i++)
        same(a->pressures[i], b->pressures[i]);
    same(a->clearance, b->clearance);
    assert_int_equal(a->mount_count, b->mount_count);
    for (size_t i = 0; i < a->mount_count; i++)
        same_mount(&a->mounts[i], &b->mounts[i]);
    same(a->refine.position, b->refine.position);
    same(a->refine.axis, b->refine.axis);
    assert_int_equal(a->refine.roll, b->refine.roll);
    same(a->refine.angle, b->refine.angle);
    same(a->refine.flow, b->refine.flow);
}

static const sp_fidelity decided = {SP_TRAJECTORY_PARABOLA, SP_METHOD_FORWARD, 2,         12345678901, 1.0 / 300,
                                    SP_SPLAT_LINEAR,        1.0 / 77,          UINT64_MAX};

/* Reads what was written for `directory` from there and compares everything. */
static void check_in(const sp_scene *scene, const sp_layout *layout, const char *directory, const char *file)
{
    char *text = text_of(scene, layout, &decided, directory);
    scratch_write(file, text);
    sp_scene *again = load(file);
    same_setup(sp_scene_setup(scene), sp_scene_setup(again));
    same_fidelity(&decided, &sp_scene_setup(again)->fidelity);
    same_layout(layout, sp_scene_layout(again));
    sp_place_options a = sp_scene_place_options(scene), b = sp_scene_place_options(again);
    same_place(&a, &b);
    /* What it writes of itself is the same bytes. */
    char *repeated = text_of(again, sp_scene_layout(again), &decided, directory);
    assert_string_equal(text, repeated);
    free(repeated);
    free(text);
    sp_scene_destroy(again);
}

/* Numbers that only 17 digits hold; axes that are unit vectors to the last digit but one. */
static sp_layout *awkward_layout(const sp_scene *scene)
{
    sp_place_options place = sp_scene_place_options(scene);
    const sp_nozzle_type *adjustable = sp_scene_layout(scene)->nozzles[1].type;
    sp_layout *layout = sp_layout_create(NULL, 500, NULL);
    assert_non_null(layout);
    for (size_t i = 0; i < layout->count; i++) {
        sp_nozzle *nozzle = &layout->nozzles[i];
        double t = (double)i + 1;
        bool odd = i % 2;
        snprintf(nozzle->name, sizeof nozzle->name, "%s %zu", odd ? "a: \"#b\" {\\" : "N\xc3\xbc\xc2\x85", i);
        nozzle->type = odd ? adjustable : place.types[0];
        nozzle->position = sp_v(sin(t) / 3, -1e-17 * t, exp(t / 20));
        nozzle->axis = sp_unit(sp_v(sin(t), cos(3 * t), 1 / t));
        nozzle->roll = t / 7 - 30;
        nozzle->pressure = 1e5 * (1 + t / 11);
        nozzle->angle = odd ? adjustable->angle_min + (adjustable->angle_max - adjustable->angle_min) * (t / 501) : 0;
        double rated = adjustable->flow_min + (adjustable->flow_max - adjustable->flow_min) * (t / 501);
        nozzle->flow = odd ? sp_type_flow(adjustable, rated, nozzle->pressure, &sp_scene_setup(scene)->liquid) : 0;
        nozzle->speed = i % 3 ? 0 : t / 13;
        nozzle->jets = i % 5 ? 0 : i + 1;
        nozzle->keep = i % 7 == 0;
    }
    return layout;
}

static void elsewhere(void **state)
{
    (void)state;
    scratch_write("scene.yaml", full_scene);
    mkdir("a", 0700);
    mkdir("a/b: c #d", 0700);
    sp_scene *scene = load("scene.yaml");
    sp_layout *layout = awkward_layout(scene);
    check_in(scene, sp_scene_layout(scene), ".", "here.yaml");
    check_in(scene, layout, ".", "here.yaml");
    check_in(scene, layout, "a", "a/there.yaml");
    check_in(scene, layout, "a/b: c #d/", "a/b: c #d/there.yaml");
    /* And back from there, after the folder was moved along with nothing. */
    sp_scene *moved = load("a/b: c #d/there.yaml");
    check_in(moved, sp_scene_layout(moved), ".", "back.yaml");
    sp_scene_destroy(moved);
    sp_layout_destroy(layout);
    sp_scene_destroy(scene);
}

/* A folder that is yet to be made, absolute paths, links, and names that YAML or a shell would trip over. */
static void paths(void **state)
{
    (void)state;
    static const char odd[] = "x/- it's \"100 %\" [\xc3\xa9] #1, {a: b}\\.obj";
    char text[1200], absolute[1100];
    mkdir("x", 0700);
    scratch_write(odd, tetrahedron);
    snprintf(absolute, sizeof absolute, "%s/tank.obj", scratch);
    snprintf(text, sizeof text, "geometry:\n  - file: %s\n  - file: \"%s\"\n", absolute,
             "x/- it's \\\"100 %\\\" [\xc3\xa9] #1, {a: b}\\\\.obj");
    scratch_write("scene.yaml", text);
    sp_scene *scene = load("scene.yaml");
    char *future = text_of(scene, sp_scene_layout(scene), &decided, "new/folder");
    mkdir("new", 0700);
    mkdir("new/folder", 0700);
    scratch_write("new/folder/layout.yaml", future);
    assert_non_null(strstr(future, "file: ../../tank.obj"));
    free(future);
    sp_scene *again = load("new/folder/layout.yaml");
    same_setup(sp_scene_setup(scene), sp_scene_setup(again));
    sp_scene_destroy(again);
    assert_int_equal(symlink("new/folder", "link"), 0);
    check_in(scene, sp_scene_layout(scene), "link", "link/again.yaml");
    sp_scene_destroy(scene);
}

/* Overrides are part of the scene that is written; other settings stay as they stood. */
static void overridden(void **state)
{
    (void)state;
    const char *const settings[] = {"place.max_water=7 L/min", "place.refine={angle: 1 deg}"};
    sp_error error = {0};
    scratch_write("scene.yaml", full_scene);
    sp_scene *scene = sp_scene_load_with("scene.yaml", settings, 2, NULL, &error);
    assert_non_null(scene);
    check_in(scene, sp_scene_layout(scene), ".", "set.yaml");
    sp_scene_destroy(scene);
    scratch_write("scene.yaml", "geometry: [{file: tank.obj}]\ncavity: outside\nnozzles:\nplace:\n  mounts:\n");
    scene = load("scene.yaml");
    check_in(scene, sp_scene_layout(scene), ".", "set.yaml");
    sp_scene_destroy(scene);
}

static void clusters(void **state)
{
    (void)state;
    char *text = with(full_scene, "type: cone", "type: ball");
    scratch_write("scene.yaml", text);
    free(text);
    sp_scene *scene = load("scene.yaml");
    assert_int_equal(sp_scene_layout(scene)->nozzles[0].type->member_count, 14);
    check_in(scene, sp_scene_layout(scene), ".", "ball.yaml");
    sp_scene_destroy(scene);
}

static void refused(const sp_scene *scene, const sp_layout *layout, const sp_fidelity *fidelity, const char *message)
{
    sp_error error = {0};
    assert_null(sp_scene_text(scene, layout, fidelity, ".", &error));
    assert_string_equal(error.message, message);
}

/* What would not load again is not written. */
static void refusals(void **state)
{
    (void)state;
    scratch_write("scene.yaml", full_scene);
    sp_scene *scene = load("scene.yaml");
    sp_fidelity undecided = decided;
    undecided.texel = 0;
    refused(scene, sp_scene_layout(scene), &undecided, "a scene is written with settings that leave nothing to auto");
    sp_layout *layout = sp_layout_create(sp_scene_layout(scene)->nozzles, 2, NULL);
    snprintf(layout->nozzles[1].name, SP_NAME, "N1");
    refused(scene, layout, &decided, "name: found 'N1', expected a name that no other nozzle has");
    snprintf(layout->nozzles[1].name, SP_NAME, "N2");
    layout->nozzles[1].position.y = NAN;
    refused(scene, layout, &decided, "position: found 'nan m', expected a length such as 250 mm");
    layout->nozzles[1].position.y = 0;
    layout->nozzles[1].angle = 170 * (M_PI / 180);
    refused(scene, layout, &decided,
            "angle: found '170 deg', expected an angle within the range of 'set', 60 deg to 120 deg");
    layout->nozzles[1].angle = 0;
    layout->nozzles[0].angle = 10 * (M_PI / 180);
    refused(scene, layout, &decided,
            "angle: found '10 deg', expected this key only with an adjustable type, and 'cone' has no angle_range");
    /* What the type says anyway may be said by the nozzle too. */
    layout->nozzles[0].angle = layout->nozzles[0].type->angle;
    char *text = text_of(scene, layout, &decided, ".");
    free(text);
    sp_layout_destroy(layout);
    sp_scene_destroy(scene);
}

/* Units as people write them, and no digits that nobody wrote. */
static void as_people_write(void **state)
{
    (void)state;
    scratch_write("scene.yaml", full_scene);
    sp_scene *scene = load("scene.yaml");
    char *text = text_of(scene, sp_scene_layout(scene), &decided, ".");
    static const char *const lines[] = {"position: [0 m, 0.01 m, 0.2 m]",
                                        "roll: 0 deg",
                                        "pressure: 2 bar",
                                        "roll: -30 deg",
                                        "pressure: 3 bar",
                                        "angle: 100 deg",
                                        "flow: 22 L/min",
                                        "speed: 12 m/s"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        if (!strstr(text, lines[i]))
            fail_msg("no '%s' in %s", lines[i], text);
    free(text);
    sp_scene_destroy(scene);
}

/* A path that is no text cannot stand in a text. */
static void no_text(void **state)
{
    (void)state;
    sp_error error = {0};
    mkdir("latin\xe9", 0700);
    scratch_write("latin\xe9/tank.obj", tetrahedron);
    scratch_write("latin\xe9/scene.yaml", "geometry: [{file: tank.obj}]\n");
    sp_scene *scene = load("latin\xe9/scene.yaml");
    assert_null(sp_scene_text(scene, sp_scene_layout(scene), &decided, ".", &error));
    assert_string_equal(error.message, "found 'latin\xe9/tank.obj', expected text in UTF-8");
    check_in(scene, sp_scene_layout(scene), "latin\xe9", "latin\xe9/again.yaml");
    sp_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elsewhere),       cmocka_unit_test(paths),   cmocka_unit_test(overridden),
        cmocka_unit_test(refusals),        cmocka_unit_test(no_text), cmocka_unit_test(clusters),
        cmocka_unit_test(as_people_write),
    };
    return cmocka_run_group_tests(tests, scratch_make, scratch_remove);
}
