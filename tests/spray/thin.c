/* Thin parts: texels no longer than an eighth of their girth, and what that makes of them. */
#include "shapes.h"

#include "spray/state.h"

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
                      1e3 * sp_evaluator_texel_length(evaluator, 0));
        sp_evaluator_destroy(evaluator);
        sp_mesh_destroy(mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rod_is_lit_by_half),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
