/* Thin parts: texels no longer than an eighth of their girth, and what that makes of them. */
#include "shapes.h"

#include "spray/state/state.h"

#define RADIUS 0.0015
#define LENGTH 0.4

static const sp_nozzle_type lamp = {.name = "lamp",
                                    .pattern = SP_PATTERN_FULL_CONE,
                                    .angle = 0.2,
                                    .flow = 1e-3,
                                    .at = 2e5,
                                    .exponent = 0.5,
                                    .cv = 0.95};

/* A closed rod about the z axis in `at`, of `around` faces, each side of it in `along` pieces. */
static void add_rod(shape *s, sp_vec3 at, double radius, double length, int around, int along)
{
    for (int i = 0; i < around; i++) {
        double a = 2 * M_PI * i / around, b = i + 1 < around ? 2 * M_PI * (i + 1) / around : 0;
        sp_vec3 p = sp_add(at, sp_v(radius * cos(a), radius * sin(a), 0));
        sp_vec3 q = sp_add(at, sp_v(radius * cos(b), radius * sin(b), 0));
        for (int k = 0; k < along; k++) {
            double low = -0.5 * length + length * k / along, high = -0.5 * length + length * (k + 1) / along;
            sp_vec3 c[4] = {p, q, q, p};
            for (int j = 0; j < 4; j++)
                c[j].z += j < 2 ? low : high;
            shape_triangle(s, c[0], c[1], c[2]);
            shape_triangle(s, c[0], c[2], c[3]);
        }
        sp_vec3 foot = sp_v(0, 0, 0.5 * length);
        shape_triangle(s, sp_sub(at, foot), sp_sub(q, foot), sp_sub(p, foot));
        shape_triangle(s, sp_add(at, foot), sp_add(p, foot), sp_add(q, foot));
    }
}

static sp_setup setup_of(const sp_mesh *mesh, const sp_surface *surfaces, double texel)
{
    sp_setup setup = sp_setup_default();
    setup.mesh = mesh;
    setup.surfaces = surfaces;
    setup.run.threads = 1;
    setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    setup.fidelity.method = SP_METHOD_INVERSE;
    setup.fidelity.texel = texel;
    return setup;
}

static sp_evaluator *evaluator_of(const sp_mesh *mesh, const sp_surface *surfaces, double texel)
{
    sp_setup setup = setup_of(mesh, surfaces, texel);
    sp_error error = {0};
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    if (!evaluator)
        fail_msg("%s", error.message);
    return evaluator;
}

/* The covered share under one lamp far away in that direction. */
static double lit_from(const sp_evaluator *evaluator, sp_vec3 direction)
{
    sp_error error = {0};
    sp_nozzle nozzle = {
        .type = &lamp, .position = sp_scale(direction, 10), .axis = sp_scale(direction, -1), .pressure = 2e5};
    sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
    sp_coverage *coverage = sp_evaluate(evaluator, layout, &error);
    if (!coverage)
        fail_msg("%s", error.message);
    double share = coverage->fraction;
    sp_coverage_destroy(coverage);
    sp_layout_destroy(layout);
    return share;
}

static void a_rod_is_lit_by_half(void **state)
{
    (void)state;
    const sp_surface surface = {.clean = true, .rebound = 1};
    for (int around = 6; around <= 48; around *= 2) {
        shape s = shape_create();
        shape_part(&s, "rod");
        add_rod(&s, sp_v(0, 0, 0), RADIUS, LENGTH, around, around / 6);
        sp_mesh *mesh = shape_mesh(&s);
        sp_evaluator *evaluator = evaluator_of(mesh, &surface, 0.01);
        for (int i = 0; i < 24; i++) {
            double turn = 0.1 + 2 * M_PI * i / 24, lean = 0.5 * sin(7.0 * i);
            double share = lit_from(evaluator, sp_unit(sp_v(cos(turn), sin(turn), lean)));
            if (!(fabs(share - 0.5) < 0.02))
                fail_msg("%d faces, from %g: %g", around, turn, share);
        }
        print_message("%d faces: %zu texels of %g mm\n", around, evaluator->atlas->texel_count,
                      1e3 * sp_evaluator_patches(evaluator)->length[0]);
        sp_evaluator_destroy(evaluator);
        sp_mesh_destroy(mesh);
    }
}

/* A closed tank of 1 m, a baffle of 4 mm in it, and a roof far above and far larger. */
static shape tank_under_roof(double roof)
{
    shape s = shape_create();
    shape_part(&s, "tank");
    for (int i = 0; i < 64; i++) {
        double a = 2 * M_PI * i / 64, b = i < 63 ? 2 * M_PI * (i + 1) / 64 : 0;
        sp_vec3 p = sp_v(0.5 * cos(a), 0.5 * sin(a), 0), q = sp_v(0.5 * cos(b), 0.5 * sin(b), 0), up = sp_v(0, 0, 1);
        shape_triangle(&s, q, p, sp_add(p, up));
        shape_triangle(&s, q, sp_add(p, up), sp_add(q, up));
        shape_triangle(&s, sp_v(0, 0, 0), p, q);
        shape_triangle(&s, up, sp_add(q, up), sp_add(p, up));
    }
    shape_part(&s, "baffle");
    shape_box(&s, sp_v(-0.002, -0.3, 0.2), sp_v(0.002, 0.3, 0.8), false);
    shape_part(&s, "roof");
    if (roof > 0)
        shape_sheet(&s, sp_v(-0.5 * roof, -0.5 * roof, 8), sp_v(roof, 0, 0), sp_v(0, roof, 0), 1);
    return s;
}

/* What needs no cleaning, however large, does not make the texels of the rest longer, nor takes many itself. */
static void a_roof_leaves_the_texels_short(void **state)
{
    (void)state;
    const sp_surface surfaces[] = {{true, 0, 1, false}, {true, 0, 1, false}, {false, 0, 1, false}};
    double texel[2];
    uint64_t jets[2];
    for (int with = 0; with < 2; with++) {
        shape s = tank_under_roof(with ? 100 : 0);
        sp_mesh *mesh = shape_mesh(&s);
        sp_setup setup = setup_of(mesh, surfaces, 0);
        setup.cavity = SP_CAVITY_POINT;
        setup.cavity_point = sp_v(0.1, 0, 0.5);
        setup.criterion.flux = 1e-5;
        sp_error error = {0};
        sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
        if (!evaluator)
            fail_msg("%s", error.message);
        const sp_patches *patches = sp_evaluator_patches(evaluator);
        texel[with] = sp_evaluator_fidelity(evaluator)->texel;
        jets[with] = sp_evaluator_fidelity(evaluator)->jets;
        print_message("texel %g mm, %zu patches, %zu texels\n", 1e3 * texel[with], patches->count,
                      sp_evaluator_atlas(evaluator)->texel_count);
        assert_true(fabs(texel[with] - sqrt(patches->total_area / 100000)) < 1e-3 * texel[with]);
        assert_true(sp_evaluator_atlas(evaluator)->texel_count < 400000);
        sp_evaluator_destroy(evaluator);
        sp_mesh_destroy(mesh);
    }
    assert_true(fabs(texel[1] - texel[0]) < 1e-12 && jets[1] == jets[0]);
}

/* Walls of a tank and faces of a baffle have the texels that were asked for; its edges take few more. */
static void a_tank_keeps_its_texels(void **state)
{
    (void)state;
    const sp_surface surfaces[] = {{true, 0, 1, false}, {true, 0, 1, false}};
    shape s = tank_under_roof(0);
    s.part_count = 2;
    sp_mesh *mesh = shape_mesh(&s);
    for (double texel = 0.005; texel < 0.05; texel *= 2) {
        sp_evaluator *evaluator = evaluator_of(mesh, surfaces, texel);
        const sp_patches *patches = sp_evaluator_patches(evaluator);
        double usual = 0;
        for (uint32_t p = 0; p < patches->count; p++)
            usual += sp_evaluator_patches(evaluator)->length[p] == texel ? patches->area[p] : 0;
        print_message("%g mm: %zu patches, %g of %g m2 as asked\n", 1e3 * texel, patches->count, usual,
                      patches->total_area);
        assert_true(usual > 0.99 * patches->total_area);
        sp_evaluator_destroy(evaluator);
    }
    sp_mesh_destroy(mesh);
}

/* Many rods may double the number of texels, and are then content with longer ones. */
static void many_rods_are_not_without_end(void **state)
{
    (void)state;
    const sp_surface surface = {.clean = true, .rebound = 1};
    shape s = shape_create();
    shape_part(&s, "rods");
    for (int i = 0; i < 60; i++)
        add_rod(&s, sp_v(0.01 * i, 0, 0), RADIUS, 4, 12, 1);
    sp_mesh *mesh = shape_mesh(&s);
    sp_evaluator *evaluator = evaluator_of(mesh, &surface, 0.0105);
    double length = sp_evaluator_patches(evaluator)->length[0];
    print_message("%zu texels of %g mm\n", evaluator->atlas->texel_count, 1e3 * length);
    assert_true(length > 0.0012 && length < 0.0105);
    assert_true(fabs(sp_mesh_area(mesh) / (length * length) - 50000) < 1000);
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rod_is_lit_by_half),
        cmocka_unit_test(a_roof_leaves_the_texels_short),
        cmocka_unit_test(a_tank_keeps_its_texels),
        cmocka_unit_test(many_rods_are_not_without_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
