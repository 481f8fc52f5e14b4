/* What is left to auto, what is refused, and the patches. */
#include "shapes.h"

typedef struct {
    sp_mesh *mesh;
    sp_surface surfaces[2];
    sp_setup setup;
} fixture;

/* A floor of 1 m² and, as another part, a step on it of 0.25 m². */
static fixture floor_and_step(void)
{
    shape s = shape_create();
    shape_part(&s, "floor");
    shape_sheet(&s, sp_v(0, 0, 0), sp_v(1, 0, 0), sp_v(0, 1, 0), 4);
    shape_part(&s, "step");
    shape_sheet(&s, sp_v(0.25, 0.25, 0.1), sp_v(0.5, 0, 0), sp_v(0, 0.5, 0), 2);
    fixture f = {
        .mesh = shape_mesh(&s), .surfaces = {{true, 0, 1, false}, {true, 0, 1, false}}, .setup = sp_setup_default()};
    f.setup.mesh = f.mesh;
    return f;
}

static sp_fidelity resolved(fixture *f)
{
    f->setup.surfaces = f->surfaces;
    sp_error error = {0};
    sp_evaluator *evaluator = sp_evaluator_create(&f->setup, &error);
    assert_string_equal(error.message, "");
    assert_non_null(evaluator);
    sp_fidelity fidelity = *sp_evaluator_fidelity(evaluator);
    sp_evaluator_destroy(evaluator);
    return fidelity;
}

static void refused(fixture *f, sp_error_kind kind, const char *text)
{
    f->setup.surfaces = f->surfaces;
    sp_error error = {0};
    assert_null(sp_evaluator_create(&f->setup, &error));
    assert_int_equal(error.kind, kind);
    if (!strstr(error.message, text))
        fail_msg("\"%s\" does not say \"%s\"", error.message, text);
}

static void auto_chooses(void **state)
{
    (void)state;
    fixture f = floor_and_step();
    sp_fidelity fidelity = resolved(&f);
    assert_int_equal(fidelity.trajectory, SP_TRAJECTORY_PARABOLA);
    assert_int_equal(fidelity.method, SP_METHOD_INVERSE);
    assert_int_equal(fidelity.reflections, 0);
    assert_true(fabs(fidelity.texel - sqrt(1.25 / 100000)) < 1e-12);
    assert_true(fidelity.jets > 0);

    f.setup.fidelity.texel = 0.05;
    f.surfaces[1].restitution = 0.3;
    fidelity = resolved(&f);
    assert_int_equal(fidelity.method, SP_METHOD_FORWARD);
    assert_int_equal(fidelity.reflections, 3);
    f.setup.fidelity.reflections = 0;
    assert_int_equal(resolved(&f).method, SP_METHOD_INVERSE);
    f.setup.fidelity.reflections = -1;
    f.setup.fidelity.method = SP_METHOD_INVERSE;
    assert_int_equal(resolved(&f).reflections, 0);
    f.surfaces[1].restitution = 0;
    f.setup.fidelity.method = SP_METHOD_FORWARD;
    assert_int_equal(resolved(&f).reflections, 0);

    uint64_t to_touch = resolved(&f).jets;
    f.setup.criterion.flux = 1e-5;
    assert_true(resolved(&f).jets > to_touch);
    assert_true(resolved(&f).jets >= 100 * (uint64_t)(1.25 / (0.05 * 0.05)));
    sp_mesh_destroy(f.mesh);
}

static void settings_are_kept(void **state)
{
    (void)state;
    fixture f = floor_and_step();
    f.setup.fidelity = (sp_fidelity){.trajectory = SP_TRAJECTORY_LINE,
                                     .method = SP_METHOD_FORWARD,
                                     .reflections = 2,
                                     .jets = 77,
                                     .texel = 0.1,
                                     .splat = SP_SPLAT_LINEAR,
                                     .accuracy = 0.02,
                                     .seed = 5};
    sp_fidelity fidelity = resolved(&f);
    const sp_fidelity *asked = &f.setup.fidelity;
    assert_true(fidelity.trajectory == asked->trajectory && fidelity.method == asked->method);
    assert_true(fidelity.reflections == asked->reflections && fidelity.jets == asked->jets);
    assert_true(fidelity.texel == asked->texel && fidelity.splat == asked->splat);
    assert_true(fidelity.accuracy == asked->accuracy && fidelity.seed == asked->seed);
    sp_mesh_destroy(f.mesh);
}

static void wrong_setups_are_refused(void **state)
{
    (void)state;
    fixture f = floor_and_step();
    f.setup.fidelity.method = SP_METHOD_INVERSE;
    f.setup.fidelity.reflections = 2;
    refused(&f, SP_ERROR_INPUT, "primary impact only");
    f.setup.fidelity.reflections = 0;
    f.setup.fidelity.splat = SP_SPLAT_LINEAR;
    refused(&f, SP_ERROR_INPUT, "splat");
    f.setup.fidelity.splat = SP_SPLAT_NEAREST;
    f.setup.fidelity.texel = 1e-7;
    refused(&f, SP_ERROR_INPUT, "texel");
    f.setup.fidelity.texel = -1;
    refused(&f, SP_ERROR_ARGUMENT, "texel");
    f.setup.fidelity.texel = 0.05;
    f.setup.criterion.flux = NAN;
    refused(&f, SP_ERROR_ARGUMENT, "criterion");
    f.setup.criterion.flux = 0;
    f.surfaces[0].restitution = 1.5;
    refused(&f, SP_ERROR_ARGUMENT, "restitution");
    f.surfaces[0].restitution = 0;
    f.surfaces[0].clean = f.surfaces[1].clean = false;
    refused(&f, SP_ERROR_INPUT, "nothing is to be cleaned");
    sp_mesh_destroy(f.mesh);

    sp_error error = {.kind = SP_ERROR_FILE, .message = "earlier"};
    assert_null(sp_evaluator_create(NULL, &error));
    assert_null(sp_evaluator_resample(NULL, 0.1, &error));
    assert_null(sp_evaluate(NULL, NULL, &error));
    assert_string_equal(error.message, "earlier");
}

static bool stop(void *user, const char *stage, double done)
{
    (void)stage;
    (void)done;
    return --*(int *)user > 0;
}

/* Faster than v⁴ can be reckoned: it used to run for ever. */
static void absurd_speeds_are_refused(void **state)
{
    (void)state;
    const sp_method methods[] = {SP_METHOD_INVERSE, SP_METHOD_FORWARD};
    sp_nozzle_type cone = {
        .pattern = SP_PATTERN_FULL_CONE, .angle = 1, .flow = 1e-4, .at = 2e5, .exponent = 0.5, .cv = 0.95};
    sp_nozzle nozzle = {
        .name = "N1", .type = &cone, .position = sp_v(0.5, 0.5, 1), .axis = sp_v(0, 0, -1), .pressure = 1e300};
    for (int i = 0; i < 2; i++) {
        fixture f = floor_and_step();
        f.setup.surfaces = f.surfaces;
        f.setup.fidelity.texel = 0.05;
        f.setup.fidelity.method = methods[i];
        sp_error error = {0};
        sp_evaluator *evaluator = sp_evaluator_create(&f.setup, &error);
        sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
        assert_string_equal(error.message, "");
        assert_null(sp_evaluate(evaluator, layout, &error));
        assert_int_equal(error.kind, SP_ERROR_INPUT);
        assert_non_null(strstr(error.message, "nozzle N1: exit speed"));
        sp_layout_destroy(layout);
        sp_evaluator_destroy(evaluator);
        sp_mesh_destroy(f.mesh);
    }
}

static void building_can_be_interrupted(void **state)
{
    (void)state;
    fixture f = floor_and_step();
    f.setup.fidelity.texel = 0.05;
    f.setup.cavity = SP_CAVITY_OUTSIDE;
    f.setup.run.progress = stop;
    for (int calls = 1; calls <= 4; calls++) {
        int left = calls;
        f.setup.run.user = &left;
        refused(&f, SP_ERROR_INTERRUPTED, "interrupted");
    }
    sp_mesh_destroy(f.mesh);
}

/* The patch's point lies on its triangle, and neighbours are mutual, ascending and of the same side. */
static void check_patches(const sp_evaluator *evaluator, const sp_mesh *mesh)
{
    const sp_patches *p = sp_evaluator_patches(evaluator);
    double total = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        total += p->area[i];
        assert_true(p->area[i] > 0);
        assert_true(i == 0 || p->texel[i] > p->texel[i - 1] ||
                    (p->texel[i] == p->texel[i - 1] && p->side[i] > p->side[i - 1]));
        sp_vec3 a = sp_triangle_point(mesh, p->triangle[i], 0, 0);
        assert_true(fabs(sp_dot(sp_sub(p->point[i], a), p->normal[i])) < 1e-9);
        double sign = p->side[i] == SP_SIDE_BACK ? -1 : 1;
        assert_true(sp_dot(p->normal[i], sp_triangle_normal(mesh, p->triangle[i])) * sign > 1 - 1e-12);
        for (uint32_t k = p->neighbour_start[i]; k < p->neighbour_start[i + 1]; k++) {
            uint32_t other = p->neighbours[k];
            assert_true(other < p->count && other != i && p->side[other] == p->side[i]);
            assert_true(k == p->neighbour_start[i] || p->neighbours[k - 1] < other);
            bool mutual = false;
            for (uint32_t m = p->neighbour_start[other]; m < p->neighbour_start[other + 1]; m++)
                mutual = mutual || p->neighbours[m] == i;
            assert_true(mutual);
        }
    }
    assert_true(fabs(total / p->total_area - 1) < 1e-12);
}

static void patches_hold_what_is_counted(void **state)
{
    (void)state;
    fixture f = floor_and_step();
    f.setup.surfaces = f.surfaces;
    f.setup.fidelity.texel = 0.03;
    sp_error error = {0};
    sp_evaluator *evaluator = sp_evaluator_create(&f.setup, &error);
    assert_non_null(evaluator);
    check_patches(evaluator, f.mesh);
    assert_true(fabs(sp_evaluator_patches(evaluator)->total_area - 1.25) < 1e-9);
    sp_evaluator *coarse = sp_evaluator_resample(evaluator, 0.11, &error);
    assert_non_null(coarse);
    check_patches(coarse, f.mesh);
    assert_true(fabs(sp_evaluator_patches(coarse)->total_area - 1.25) < 1e-9);
    assert_true(sp_evaluator_patches(coarse)->count < sp_evaluator_patches(evaluator)->count / 8);
    assert_int_equal(sp_evaluator_fidelity(coarse)->method, SP_METHOD_INVERSE);
    assert_ptr_equal(sp_evaluator_tracer(coarse), sp_evaluator_tracer(evaluator));
    sp_evaluator_destroy(coarse);
    sp_evaluator *finer = sp_evaluator_resample(evaluator, 0.002, &error);
    assert_non_null(finer);
    assert_true(fabs(sp_evaluator_patches(finer)->total_area - 1.25) < 1e-9);
    sp_evaluator_destroy(finer);
    sp_evaluator_destroy(evaluator);

    f.surfaces[1].clean = false;
    f.setup.cavity = SP_CAVITY_OUTSIDE;
    evaluator = sp_evaluator_create(&f.setup, &error);
    assert_non_null(evaluator);
    check_patches(evaluator, f.mesh);
    assert_true(fabs(sp_evaluator_patches(evaluator)->total_area - 2) < 1e-9);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(f.mesh);
}

/* Of all patches: what each part has, and how many patches are of several. */
typedef struct {
    double area[3], of_patch;
    uint32_t last;
    size_t straddling;
} part_account;

static void add_part(void *user, uint32_t part, double area)
{
    part_account *account = user;
    assert_true(part < 3 && area > 0);
    account->straddling += account->last != SP_NONE && account->last != part;
    account->last = part;
    account->area[part] += area;
    account->of_patch += area;
}

static part_account account_parts(const sp_evaluator *evaluator)
{
    part_account account = {.last = SP_NONE};
    for (uint32_t i = 0; i < sp_evaluator_patches(evaluator)->count; i++) {
        account.of_patch = 0;
        account.last = SP_NONE;
        sp_evaluator_part_areas(evaluator, i, add_part, &account);
        assert_true(fabs(account.of_patch - sp_evaluator_counted(evaluator, i)) < 1e-12);
    }
    return account;
}

/* A floor of three strips, of which each is a part, under texels that lie across several of them. */
static void parts_have_their_own_area(void **state)
{
    (void)state;
    static const double from[4] = {0, 0.07, 0.16, 1};
    static const char *const names[3] = {"left", "middle", "right"};
    sp_surface surfaces[3] = {{true, 0, 1, false}, {true, 0, 1, false}, {true, 0, 1, false}};
    shape s = shape_create();
    for (int k = 0; k < 3; k++) {
        shape_part(&s, names[k]);
        shape_sheet(&s, sp_v(from[k], 0, 0), sp_v(from[k + 1] - from[k], 0, 0), sp_v(0, 1, 0), 1);
    }
    sp_setup setup = sp_setup_default();
    sp_mesh *mesh = shape_mesh(&s);
    setup.mesh = mesh;
    setup.surfaces = surfaces;
    sp_error error = {0};
    setup.fidelity.texel = 0.21;
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    assert_non_null(evaluator);
    part_account account = account_parts(evaluator);
    assert_true(account.straddling > 5);
    for (int k = 0; k < 3; k++)
        assert_true(fabs(account.area[k] - (from[k + 1] - from[k])) < 1e-9);
    sp_evaluator_destroy(evaluator);
    surfaces[1].clean = false;
    evaluator = sp_evaluator_create(&setup, &error);
    assert_non_null(evaluator);
    account = account_parts(evaluator);
    assert_true(account.area[1] == 0 && fabs(account.area[0] - from[1]) < 1e-9);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(auto_chooses),
        cmocka_unit_test(settings_are_kept),
        cmocka_unit_test(wrong_setups_are_refused),
        cmocka_unit_test(absurd_speeds_are_refused),
        cmocka_unit_test(building_can_be_interrupted),
        cmocka_unit_test(patches_hold_what_is_counted),
        cmocka_unit_test(parts_have_their_own_area),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
