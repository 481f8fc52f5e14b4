/* Meshes at their limits and nozzles in awkward places. */
#include "stage.h"

/* A box of 2 m × 1.6 m × 1.5 m from triangles of the caller's making: each wall is a fan of `slices` strips along its
 * longer way, so that strips are as thin as asked. */
static sp_mesh *sliced_box(int slices)
{
    rectangle faces[6];
    box_rectangles(sp_v(-1, -0.8, 0), sp_v(2, 1.6, 1.5), faces);
    enum { MOST = 64 };
    sp_vec3 points[6 * 2 * (MOST + 1)];
    uint32_t triangles[6 * 2 * MOST][3];
    size_t n = 0, count = 0;
    for (int f = 0; f < 6; f++) {
        uint32_t first = (uint32_t)n;
        for (int i = 0; i <= slices; i++) {
            /* half of the wall is one strip, half of the rest the next, ...: the last is 2^-slices wide */
            double share = i == slices ? 1 : 1 - ldexp(1, -i);
            sp_vec3 p = sp_along(faces[f].corner, share, faces[f].u);
            points[n++] = p;
            points[n++] = sp_add(p, faces[f].v);
        }
        for (uint32_t i = 0; i < (uint32_t)slices; i++) {
            uint32_t a = first + 2 * i;
            const uint32_t two[2][3] = {{a, a + 2, a + 3}, {a, a + 3, a + 1}};
            for (int k = 0; k < 2; k++, count++)
                for (int c = 0; c < 3; c++)
                    triangles[count][c] = two[k][c];
        }
    }
    return sp_mesh_create(points, n, (const uint32_t(*)[3])triangles, count, NULL, NULL, 0, NULL);
}

/* A plain box and one that ends in needles of 1 : 1e8 are the same to the liquid. */
static void needles_and_triangles_of_every_size(void **state)
{
    (void)state;
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 110);
    for (int t = SP_TRAJECTORY_LINE; t <= SP_TRAJECTORY_PARABOLA; t++) {
        double fraction[2][2];
        for (int fine = 0; fine < 2; fine++) {
            scene s;
            scene_open(&s, sliced_box(fine ? 27 : 1), (sp_trajectory)t, STAGE_TEXEL);
            assert_int_equal(s.mesh->triangle_count, fine ? 6 * 2 * 27 : 12);
            s.setup.fidelity.texel = STAGE_TEXEL;
            s.setup.fidelity.jets = STAGE_JETS;
            s.setup.cavity = SP_CAVITY_POINT;
            s.setup.cavity_point = sp_v(0.1, 0.2, 0.8);
            sp_evaluator *evaluator = scene_evaluator(&s);
            sp_nozzle nozzle = nozzle_at(&type, sp_v(0.31, 0.13, 0.71), sp_v(0.9, 0.3, -0.2), 9);
            for (int k = 0; k < 2; k++) {
                sp_coverage *coverage = sound_cover(evaluator, &nozzle, 1, k == 0);
                /* what is thinner than 1e-6 of the diagonal touches */
                assert_float_equal(coverage->area / 17.2, 1, 3e-6);
                assert_float_equal(share_landed(coverage), 1, k ? 1e-5 : 0.01); /* nor does it count */
                fraction[fine][k] = coverage->fraction;
                sp_coverage_destroy(coverage);
            }
            sp_evaluator_destroy(evaluator);
            scene_close(&s);
        }
        print_message("needles: coverage %.5f and %.5f by the inverse, %.5f and %.5f by the forward evaluator\n",
                      fraction[0][0], fraction[1][0], fraction[0][1], fraction[1][1]);
        assert_float_equal(fraction[1][0], fraction[0][0], 0.005);
        assert_float_equal(fraction[1][1], fraction[0][1], 0.01); /* a sliver that is touched counts whole */
    }
}

/* Where a nozzle may stand in the furnished room: hard by the ceiling, in it, on an edge and at a corner of its
 * triangles. */
static void nozzles_in_the_wall(void **state)
{
    (void)state;
    const sp_vec3 places[] = {
        {0.21, 0.13, 1.5 - 1e-6}, {0.21, 0.13, 1.5}, {2.0 / 12, 0.05, 1.5}, {2.0 / 12, 1.6 / 12, 1.5}};
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 45);
    const double radius = 1.5 * tan(deg(22.5));
    for (int turned = 0; turned < 3; turned++) {
        sp_transform pose = sp_transform_default();
        if (turned)
            sp_transform_rotation(&pose, sp_v(0.3, 0.5 * turned, -0.8), 1.3);
        rectangle faces[6];
        box_rectangles(sp_v(-1, -0.8, 0), sp_v(2, 1.6, 1.5), faces);
        sp_mesh *plain = mesh_of_rectangles(faces, 6);
        scene s;
        scene_open(&s, sp_mesh_join((const sp_mesh *const *)&plain, &pose, 1, NULL), SP_TRAJECTORY_LINE, STAGE_TEXEL);
        sp_mesh_destroy(plain);
        s.setup.fidelity.texel = 0.5 * STAGE_TEXEL;
        s.setup.fidelity.jets = STAGE_JETS;
        s.setup.cavity = SP_CAVITY_POINT;
        s.setup.cavity_point = sp_transform_point(&pose, sp_v(0.1, 0.2, 0.8));
        s.setup.criterion.flux = 0.3e-4 / (M_PI * radius * radius); /* few jets must not count as spray */
        sp_evaluator *evaluator = scene_evaluator(&s);
        for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
            sp_nozzle nozzle = nozzle_at(&type, places[i], sp_v(0, 0, -1), 9);
            nozzle.flow = 1e-4;
            pose_nozzle(&pose, sp_v(0, 0, 1), &nozzle);
            for (int k = 0; k < 2; k++) {
                sp_coverage *coverage = sound_cover(evaluator, &nozzle, 1, k == 0);
                double area = M_PI * radius * radius;
                print_message("turn %d, place %zu, %s: landed %.5f, disc %+.2f %%\n", turned, i,
                              k ? "forward" : "inverse", share_landed(coverage),
                              100 * (coverage->covered_area / area - 1));
                bool near = fabs(coverage->covered_area / area - 1) < 0.03 &&
                            fabs(share_landed(coverage) - 1) < (k ? 1e-9 : 0.01);
                if (!near)
                    fail_msg("covered %g of a disc of %g m2, landed %g", coverage->covered_area, area,
                             share_landed(coverage));
                sp_coverage_destroy(coverage);
            }
        }
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
}

/* One triangle, by texels from a thousandth of it to a thousand times as large: its area stays, and a cone that holds
 * it covers it. */
static void one_triangle_by_any_texel(void **state)
{
    (void)state;
    static const sp_vec3 points[] = {{-0.2, -0.1, 0}, {0.3, -0.15, 0}, {0.05, 0.25, 0.02}};
    static const uint32_t triangle[][3] = {{0, 1, 2}};
    static const double texels[] = {0.0005, 0.01, 0.2, 1, 500};
    sp_nozzle_type type = spray_type(SP_PATTERN_FULL_CONE, 90);
    for (size_t i = 0; i < sizeof texels / sizeof *texels; i++) {
        scene s;
        scene_open(&s, sp_mesh_create(points, 3, triangle, 1, NULL, NULL, 0, NULL), SP_TRAJECTORY_PARABOLA, 1);
        s.setup.fidelity.texel = texels[i];
        s.setup.fidelity.jets = 10000;
        sp_evaluator *evaluator = scene_evaluator(&s);
        double area = sp_triangle_area(s.mesh, 0), liquid[2];
        sp_nozzle nozzle = nozzle_at(&type, sp_v(0.05, 0, 1), sp_v(0, 0, -1), 9);
        for (int k = 0; k < 2; k++) {
            sp_coverage *coverage = sound_cover(evaluator, &nozzle, 1, k == 0);
            assert_float_equal(coverage->area / area, 1, 1e-9);
            assert_true(k == 0 ? coverage->fraction > 1 - 1e-9 : coverage->fraction > 0);
            liquid[k] = share_landed(coverage);
            sp_coverage_destroy(coverage);
        }
        print_message("one triangle, texel %g m: %.5f of the liquid by the inverse, %.5f by the forward evaluator\n",
                      texels[i], liquid[0], liquid[1]);
        assert_true(liquid[0] > 0.02 && fabs(liquid[0] / liquid[1] - 1) < 0.05);
        sp_evaluator_destroy(evaluator);
        scene_close(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(needles_and_triangles_of_every_size),
        cmocka_unit_test(nozzles_in_the_wall),
        cmocka_unit_test(one_triangle_by_any_texel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
