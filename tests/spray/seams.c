/* Liquid beside a cut is shared with what lies across it, as if there were no cut. */
#include "shapes.h"

#include "spray/splat.h"
#include "spray/state/state.h"

#define TEXEL 0.02

static const sp_nozzle_type needle = {.name = "needle",
                                      .pattern = SP_PATTERN_FULL_CONE,
                                      .angle = 1e-9,
                                      .flow = 1e-4,
                                      .at = 2e5,
                                      .exponent = 0.5,
                                      .cv = 0.95};

/* A floor of four quarters that meet in the origin, each with the front up or down as its bit in `down` says: where two
 * differ the surface is cut. The rest of the floor's size keeps texels from falling on each other across the cuts. */
static sp_mesh *floor_of_quarters(unsigned down, double lean)
{
    shape s = shape_create();
    shape_part(&s, "floor");
    for (unsigned q = 0; q < 4; q++) {
        sp_vec3 x = sp_v(q & 1 ? 0.313 : -0.297, 0, 0), y = sp_v(q & 2 ? lean : -lean, q & 2 ? 0.331 : -0.289, 0);
        bool mirrored = (q & 1) != q >> 1, front_down = (down >> q & 1) != 0;
        shape_sheet(&s, sp_v(0, 0, 0), mirrored != front_down ? y : x, mirrored != front_down ? x : y, 2);
    }
    return shape_mesh(&s);
}

/* One jet straight down on (x, y). */
static sp_coverage *drip(const sp_evaluator *evaluator, double x, double y)
{
    sp_error error = {0};
    sp_nozzle nozzle = {.type = &needle, .position = sp_v(x, y, 1), .axis = sp_v(0, 0, -1), .pressure = 2e5, .jets = 1};
    sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
    sp_coverage *coverage = sp_evaluate(evaluator, layout, &error);
    if (!coverage)
        fail_msg("%s", error.message);
    sp_layout_destroy(layout);
    return coverage;
}

/* Where the plane's point (x, y) lies on the page of a triangle's chart if that went on. */
static void on_page(const sp_evaluator *evaluator, uint32_t triangle, double x, double y, double place[2])
{
    const sp_mesh *mesh = evaluator->setup.mesh;
    const double(*uv)[2] = (const double(*)[2])evaluator->atlas->uv[triangle];
    sp_vec3 a = mesh->vertices[mesh->triangles[triangle][0]], b = mesh->vertices[mesh->triangles[triangle][1]],
            c = mesh->vertices[mesh->triangles[triangle][2]];
    double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    double u = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
    double v = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
    for (int k = 0; k < 2; k++)
        place[k] = uv[0][k] + u * (uv[1][k] - uv[0][k]) + v * (uv[2][k] - uv[0][k]);
}

/* What a texel gets by the distance of its centre alone, whichever chart it is of. */
static double weight_of(const sp_evaluator *evaluator, uint32_t patch, double x, double y)
{
    uint32_t texel = evaluator->patches.texel[patch];
    sp_texel_place place = sp_atlas_place(evaluator->atlas, texel);
    double at[2];
    on_page(evaluator, evaluator->fragments.items[evaluator->fragments.start[texel]].triangle, x, y, at);
    double away[2] = {fabs(at[0] - place.x - 0.5), fabs(at[1] - place.y - 0.5)};
    return fmax(0, 1 - away[0]) * fmax(0, 1 - away[1]) * evaluator->patches.area[patch];
}

typedef struct {
    size_t crossing; /* hits whose liquid more than one chart got */
    double error;    /* the largest of any share */
} verdict;

static void expect_share_by_distance(const sp_evaluator *evaluator, double x, double y, verdict *v)
{
    sp_coverage *coverage = drip(evaluator, x, y);
    size_t patches = evaluator->patches.count, charts[2] = {SIZE_MAX, SIZE_MAX};
    double sum = 0, jets = 0, liquid = 0;
    for (uint32_t p = 0; p < patches; p++)
        sum += weight_of(evaluator, p, x, y);
    for (uint32_t p = 0; p < patches; p++) {
        double got = coverage->deposits.jets[p];
        v->error = fmax(v->error, fabs(got - weight_of(evaluator, p, x, y) / sum));
        jets += got;
        liquid += coverage->deposits.flux[p] * evaluator->patches.area[p];
        if (got > 0)
            charts[charts[0] != SIZE_MAX] = sp_atlas_place(evaluator->atlas, evaluator->patches.texel[p]).chart;
        v->crossing += got > 0 && charts[1] != SIZE_MAX && charts[0] != charts[1];
    }
    assert_true(fabs(jets - 1) <= 1e-14);
    assert_true(fabs(liquid - coverage->flow) <= 1e-14 * coverage->flow);
    sp_coverage_destroy(coverage);
}

static sp_evaluator *evaluator_of(const sp_mesh *mesh, const sp_surface *surface)
{
    sp_setup setup = sp_setup_default();
    setup.mesh = mesh;
    setup.surfaces = surface;
    setup.run.threads = 1;
    setup.fidelity = (sp_fidelity){.trajectory = SP_TRAJECTORY_LINE,
                                   .method = SP_METHOD_FORWARD,
                                   .splat = SP_SPLAT_LINEAR,
                                   .texel = TEXEL,
                                   .jets = 1};
    sp_error error = {0};
    sp_evaluator *evaluator = sp_evaluator_create(&setup, &error);
    if (!evaluator)
        fail_msg("%s", error.message);
    return evaluator;
}

/* The floor whole, in halves and in quarters; hits all around the cuts. */
static void a_cut_changes_nothing(void **state)
{
    (void)state;
    const sp_surface surface = {.clean = true, .rebound = 1};
    static const struct {
        unsigned down;
        size_t charts;
    } floors[] = {{0, 1}, {3, 2}, {5, 2}, {6, 4}, {1, 2}};
    uint64_t seed = 3;
    for (size_t i = 0; i < sizeof floors / sizeof *floors; i++) {
        sp_mesh *mesh = floor_of_quarters(floors[i].down, 0);
        sp_evaluator *evaluator = evaluator_of(mesh, &surface);
        assert_int_equal(evaluator->atlas->chart_count, floors[i].charts);
        verdict v = {0};
        for (int k = 0; k < 300; k++) {
            double at[2];
            for (int axis = 0; axis < 2; axis++) {
                seed = seed * 6364136223846793005u + 1442695040888963407u;
                at[axis] = (k % 3 == axis ? 10 : 2) * TEXEL * ((double)(seed >> 11) * 0x1p-52 - 1);
            }
            expect_share_by_distance(evaluator, at[0], at[1], &v);
        }
        print_message("floor %u: %zu shares across, off by at most %.2g\n", floors[i].down, v.crossing, v.error);
        assert_true(v.error <= 1e-6); /* the jet itself leaves its axis by 1e-8 */
        assert_true(floors[i].charts == 1 ? v.crossing == 0 : v.crossing > 30);
        sp_evaluator_destroy(evaluator);
        sp_mesh_destroy(mesh);
    }
}

/* Gives every second chart texels of another length. */
static void make_uneven(sp_evaluator *evaluator, double times)
{
    sp_error error = {0};
    double length[16];
    assert_true(evaluator->charts->chart_count <= 16);
    for (size_t c = 0; c < evaluator->charts->chart_count; c++)
        length[c] = c % 2 ? TEXEL / times : TEXEL;
    sp_atlas_options options = {.texel = TEXEL, .chart_texel = length};
    sp_patches_free(&evaluator->patches);
    sp_fragments_destroy(&evaluator->fragments);
    sp_atlas_destroy(evaluator->atlas);
    free(evaluator->texel_patch);
    evaluator->atlas = sp_atlas_create(evaluator->setup.mesh, evaluator->charts, &options, &error);
    assert_non_null(evaluator->atlas);
    assert_true(sp_fragments_create(&evaluator->fragments, evaluator->atlas, evaluator->setup.mesh, &error));
    assert_true(sp_patches_create(evaluator, &error));
}

/* What each patch gets of even rain, over its area. [patches.count] */
static double *rain_on(const sp_evaluator *evaluator, int drops)
{
    double *got = calloc(evaluator->patches.count, sizeof *got);
    for (uint32_t t = 0; t < evaluator->setup.mesh->triangle_count; t++)
        for (int i = 0; i < drops; i++)
            for (int k = 0; i + k < drops; k++) /* the middles of equal small triangles, half of them upside down */
                for (int over = 0; over < 2 && i + k + over < drops; over++) {
                    sp_hit hit = {
                        .triangle = t, .u = (i + (1 + over) / 3.0) / drops, .v = (k + (1 + over) / 3.0) / drops};
                    sp_shares shares;
                    uint32_t patch = sp_patch_at(evaluator, t, hit.u, hit.v, false);
                    sp_share_linearly(evaluator, &hit, false, patch, &shares);
                    for (int n = 0; n < shares.count; n++)
                        got[shares.patch[n]] +=
                            shares.share[n] * sp_triangle_area(evaluator->setup.mesh, t) / drops / drops;
                }
    for (size_t p = 0; p < evaluator->patches.count; p++)
        got[p] /= evaluator->patches.area[p];
    return got;
}

/* Where charts of unequal texels meet, neither side takes liquid from the other: every patch that is no sliver gets as
 * much of even rain as all others, but for what the two grids do not share. */
static void rain_stays_even_between_densities(void **state)
{
    (void)state;
    const sp_surface surface = {.clean = true, .rebound = 1};
    sp_mesh *mesh = floor_of_quarters(6, 0);
    sp_evaluator *evaluator = evaluator_of(mesh, &surface);
    assert_int_equal(evaluator->atlas->chart_count, 4);
    for (int times = 1; times <= 4; times *= 2) {
        make_uneven(evaluator, times);
        double *got = rain_on(evaluator, 150), off[2] = {0, 0}, sum[2] = {0, 0}, area[2] = {0, 0};
        for (uint32_t p = 0; p < evaluator->patches.count; p++) {
            double length = sp_evaluator_patches(evaluator)->length[p];
            int fine = length < TEXEL;
            if (evaluator->patches.area[p] > 0.5 * length * length)
                off[fine] = fmax(off[fine], fabs(got[p] - 1));
            sum[fine] += got[p] * evaluator->patches.area[p];
            area[fine] += evaluator->patches.area[p];
        }
        print_message("%d times finer: patches off by at most %.3f and %.3f, sides by %.5f\n", times, off[0], off[1],
                      sum[0] / area[0] - 1);
        assert_true(off[0] <= 0.25 && off[1] <= 0.25 && fabs(sum[0] / area[0] - 1) <= 1e-3);
        free(got);
    }
    sp_evaluator_destroy(evaluator);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cut_changes_nothing),
        cmocka_unit_test(rain_stays_even_between_densities),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
