/* Unfolding: what is developable stays whole and keeps its lengths; nothing overlaps; cuts are where they must be. */
#include "shapes.h"

static void expect_isometric(const sp_mesh *mesh, const sp_charts *charts)
{
    for (size_t t = 0; t < mesh->triangle_count; t++) {
        const double(*p)[2] = (const double(*)[2])charts->flat[t];
        double twice = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        assert_true(twice > 0);
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3;
            double length = sp_distance(mesh->vertices[mesh->triangles[t][i]], mesh->vertices[mesh->triangles[t][j]]);
            assert_true(fabs(hypot(p[j][0] - p[i][0], p[j][1] - p[i][1]) - length) <= 1e-10 * length);
        }
    }
}

/* Charts of a developable mesh, which is destroyed. */
static size_t count_charts(sp_mesh *mesh)
{
    sp_charts *charts = charts_of(mesh, INFINITY);
    expect_isometric(mesh, charts);
    size_t count = charts->chart_count;
    sp_charts_destroy(charts);
    sp_mesh_destroy(mesh);
    return count;
}

static void developable_surfaces_are_one_chart(void **state)
{
    (void)state;
    assert_int_equal(count_charts(one_triangle(1)), 1);
    size_t sides = count_charts(box(1, 2, 3)); /* cut at edges where its net would waste the page */
    assert_true(sides >= 1 && sides <= 3);
    assert_int_equal(count_charts(net(64, 16, on_cylinder, 1)), 1);
    assert_int_equal(count_charts(net(999, 3, on_cylinder, 1)), 1);
    assert_int_equal(count_charts(net(48, 12, on_cone, 1)), 1);
    for (double size = 1e-6; size < 1e7; size *= 1000) {
        assert_int_equal(count_charts(net(64, 16, on_cylinder, size)), 1);
        assert_int_equal(count_charts(net(48, 12, on_cone, size)), 1);
    }
}

static void a_cylinder_keeps_its_size(void **state)
{
    (void)state;
    sp_mesh *mesh = net(64, 16, on_cylinder, 1);
    sp_charts *charts = charts_of(mesh, INFINITY);
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 2; k++) {
                low[k] = fmin(low[k], charts->flat[t][i][k]);
                high[k] = fmax(high[k], charts->flat[t][i][k]);
            }
    /* Unrolled it is at least as long as its polygon is round and exactly as high, the seam running askew or straight.
     */
    double around = 64 * sin(M_PI / 64);
    assert_true((high[0] - low[0]) * (high[1] - low[1]) >= around * (1 - 1e-9));
    assert_true(fabs(high[1] - low[1] - 1) < 1e-9);
    sp_charts_destroy(charts);
    sp_mesh_destroy(mesh);
}

static void curved_surfaces_do_not_overlap(void **state)
{
    (void)state;
    sp_mesh *meshes[] = {net(40, 20, on_sphere, 1), net(24, 24, on_saddle, 1)};
    for (int i = 0; i < 2; i++) {
        sp_charts *charts = charts_of(meshes[i], INFINITY);
        assert_true(charts->chart_count > 1 && charts->chart_count <= 14);
        sp_charts_destroy(charts);
        sp_atlas *atlas = atlas_of(meshes[i], 0.05, 0);
        sp_atlas_figures figures = figures_of(atlas, meshes[i]);
        assert_int_equal(figures.overlaps, 0);
        assert_int_equal(figures.shared_texels, 0);
        assert_true(figures.strain95 <= 0.05);
        sp_atlas_destroy(atlas);
        sp_mesh_destroy(meshes[i]);
    }
}

/* Two triangles on a square and, in turn, what forbids to unfold one across the other's edge. */
static void cuts_at_edges_that_are_no_surface(void **state)
{
    (void)state;
    const sp_vec3 vertices[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
    assert_int_equal(count_charts(mesh_of(vertices, 4, (const uint32_t[][3]){{0, 1, 2}, {0, 2, 3}}, 2)), 1);
    assert_int_equal(count_charts(mesh_of(vertices, 4, (const uint32_t[][3]){{0, 1, 2}, {0, 3, 2}}, 2)), 2);
    /* a sheet on a wall, which goes on behind it; two walls that cross; and three sheets of which none goes on */
    assert_int_equal(count_charts(mesh_of(vertices, 5, (const uint32_t[][3]){{0, 1, 2}, {0, 2, 3}, {0, 2, 4}}, 3)), 2);
    const sp_vec3 cross[] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    const uint32_t walls[][3] = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}};
    assert_int_equal(count_charts(mesh_of(cross, 6, walls, 4)), 2);
    assert_int_equal(count_charts(mesh_of(cross, 6, (const uint32_t[][3]){{0, 1, 2}, {1, 0, 4}, {0, 1, 3}}, 3)), 3);
    assert_int_equal(count_charts(mesh_of(vertices, 4, (const uint32_t[][3]){{0, 1, 2}, {0, 1, 2}}, 2)), 2);
    const sp_vec3 apart[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {3, 0, 0}, {2, 1, 0}};
    assert_int_equal(count_charts(mesh_of(apart, 6, (const uint32_t[][3]){{0, 1, 2}, {3, 4, 5}}, 2)), 2);
}

static void no_chart_exceeds_the_extent(void **state)
{
    (void)state;
    sp_mesh *mesh = net(64, 32, on_cylinder, 1);
    for (double extent = 2; extent > 0.02; extent /= 2) {
        sp_charts *charts = charts_of(mesh, extent);
        double(*span)[4] = malloc(charts->chart_count * sizeof *span);
        size_t *size = calloc(charts->chart_count, sizeof *size);
        for (size_t c = 0; c < charts->chart_count; c++)
            memcpy(span[c], (double[]){INFINITY, INFINITY, -INFINITY, -INFINITY}, sizeof *span);
        for (size_t t = 0; t < mesh->triangle_count; t++) {
            double *s = span[charts->chart[t]];
            size[charts->chart[t]]++;
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 2; k++) {
                    s[k] = fmin(s[k], charts->flat[t][i][k]);
                    s[k + 2] = fmax(s[k + 2], charts->flat[t][i][k]);
                }
        }
        for (size_t c = 0; c < charts->chart_count; c++)
            assert_true(size[c] == 1 || fmax(span[c][2] - span[c][0], span[c][3] - span[c][1]) <= extent * (1 + 1e-12));
        free(span);
        free(size);
        sp_charts_destroy(charts);
    }
    sp_mesh_destroy(mesh);
}

static void a_fan_of_needles_stays_whole(void **state)
{
    (void)state;
    enum { COUNT = 2000 };
    sp_vec3 *vertices = malloc((COUNT + 1) * sizeof *vertices);
    uint32_t(*triangles)[3] = malloc(COUNT * sizeof *triangles);
    vertices[COUNT] = sp_v(0, 0, 0);
    for (uint32_t i = 0; i < COUNT; i++) {
        vertices[i] = on_circle(1, (double)i / COUNT, 0);
        memcpy(triangles[i], (uint32_t[]){COUNT, i, (i + 1) % COUNT}, sizeof *triangles);
    }
    assert_int_equal(count_charts(mesh_of(vertices, COUNT + 1, (const uint32_t(*)[3])triangles, COUNT)), 1);
    free(vertices);
    free(triangles);
}

static void refuses_what_makes_no_sense(void **state)
{
    (void)state;
    sp_mesh *mesh = one_triangle(1);
    const double extents[] = {0, -1, NAN};
    for (int i = 0; i < 3; i++) {
        sp_error error = {0};
        assert_null(sp_charts_create(mesh, extents[i], &error));
        assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    }
    assert_null(sp_charts_create(NULL, 1, NULL));
    sp_charts_destroy(NULL);
    sp_mesh_destroy(mesh);
}

/* Area-weighted share of triangles with more than 5 % strain; every triangle must lie anticlockwise in some chart. */
static double strained_share(const sp_mesh *mesh, const sp_charts *charts)
{
    double over = 0, all = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        const double(*p)[2] = (const double(*)[2])charts->flat[t];
        sp_vec3 b = sp_sub(mesh->vertices[mesh->triangles[t][1]], mesh->vertices[mesh->triangles[t][0]]);
        sp_vec3 c = sp_sub(mesh->vertices[mesh->triangles[t][2]], mesh->vertices[mesh->triangles[t][0]]);
        double bb = sp_dot(b, b), bc = sp_dot(b, c), cc = sp_dot(c, c), determinant = bb * cc - bc * bc;
        double e[2] = {p[1][0] - p[0][0], p[1][1] - p[0][1]}, f[2] = {p[2][0] - p[0][0], p[2][1] - p[0][1]};
        assert_true(charts->chart[t] < charts->chart_count);
        assert_true(e[0] * f[1] - e[1] * f[0] > 0);
        /* σ² are the eigenvalues of the flat metric against the surface's. */
        double ee = e[0] * e[0] + e[1] * e[1], ef = e[0] * f[0] + e[1] * f[1], ff = f[0] * f[0] + f[1] * f[1];
        double half_trace = 0.5 * (ee * cc - 2 * ef * bc + ff * bb) / determinant;
        double product = (ee * ff - ef * ef) / determinant;
        double root = sqrt(fmax(half_trace * half_trace - product, 0));
        double strain = fmax(sqrt(half_trace + root) - 1, 1 - sqrt(fmax(half_trace - root, 0)));
        double area = sp_triangle_area(mesh, t);
        over += strain > 0.05 ? area : 0;
        all += area;
    }
    return over / all;
}

static double turn_of(const double o[2], const double a[2], const double b[2])
{
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

static bool beyond(const double a[3][2], const double b[3][2])
{
    for (int i = 0; i < 3; i++) {
        const double *p = a[i], *q = a[(i + 1) % 3];
        double slack = 1e-9 * hypot(q[0] - p[0], q[1] - p[1]);
        double reach = hypot(q[0] - p[0], q[1] - p[1]);
        if (turn_of(p, q, b[0]) <= slack * reach && turn_of(p, q, b[1]) <= slack * reach &&
            turn_of(p, q, b[2]) <= slack * reach)
            return true;
    }
    return false;
}

static int by_left(const void *a, const void *b)
{
    const double *p = a, *q = b;
    return (p[0] > q[0]) - (p[0] < q[0]);
}

/* Every pair of triangles of a chart whose boxes meet, by separating lines: nothing of how charts are made. */
static void expect_no_overlap(const sp_mesh *mesh, const sp_charts *charts)
{
    double(*sweep)[4] = malloc(mesh->triangle_count * sizeof *sweep); /* left, right, triangle, unused */
    for (uint32_t chart = 0; chart < charts->chart_count; chart++) {
        size_t count = 0;
        for (uint32_t t = 0; t < mesh->triangle_count; t++) {
            const double(*p)[2] = (const double(*)[2])charts->flat[t];
            if (charts->chart[t] == chart)
                memcpy(sweep[count++],
                       (double[]){fmin(p[0][0], fmin(p[1][0], p[2][0])), fmax(p[0][0], fmax(p[1][0], p[2][0])), t, 0},
                       sizeof *sweep);
        }
        qsort(sweep, count, sizeof *sweep, by_left);
        for (size_t i = 0; i < count; i++)
            for (size_t j = i + 1; j < count && sweep[j][0] < sweep[i][1]; j++) {
                const double(*p)[2] = (const double(*)[2])charts->flat[(uint32_t)sweep[i][2]];
                const double(*q)[2] = (const double(*)[2])charts->flat[(uint32_t)sweep[j][2]];
                assert_true(beyond(p, q) || beyond(q, p));
            }
    }
    free(sweep);
}

static void strain_is_bounded_and_nothing_overlaps(void **state)
{
    (void)state;
    sp_mesh *meshes[] = {net(60, 30, on_sphere, 1), net(80, 40, on_torus, 1), net(40, 40, on_saddle, 1),
                         data_mesh("elephant.obj"), data_mesh("horse.obj"),   data_mesh("beetle.obj")};
    static const size_t most[] = {14, 30, 8, 54, 100, 100};
    for (int i = 0; i < 6; i++) {
        if (!meshes[i])
            continue;
#ifdef SPRAYPLAN_SANITIZE
        if (meshes[i]->triangle_count > 25000) {
            sp_mesh_destroy(meshes[i]);
            continue;
        }
#endif
        sp_charts *charts = charts_of(meshes[i], INFINITY);
        print_message("%zu triangles: %zu charts\n", meshes[i]->triangle_count, charts->chart_count);
        assert_true(charts->chart_count <= most[i]);
        assert_true(strained_share(meshes[i], charts) <= 0.05);
        expect_no_overlap(meshes[i], charts);
        sp_charts_destroy(charts);
        sp_mesh_destroy(meshes[i]);
    }
}

static void expect_same_charts(const sp_mesh *mesh, double scale, double angle, sp_vec3 move)
{
    sp_mesh *other = posed(mesh, scale, angle, move);
    assert_int_equal(other->triangle_count, mesh->triangle_count);
    sp_charts *charts = charts_of(mesh, INFINITY), *again = charts_of(other, INFINITY);
    assert_int_equal(again->chart_count, charts->chart_count);
    assert_memory_equal(again->chart, charts->chart, mesh->triangle_count * sizeof *charts->chart);
    sp_charts_destroy(charts);
    sp_charts_destroy(again);
    sp_mesh_destroy(other);
}

static void neither_size_nor_pose_matters(void **state)
{
    (void)state;
    sp_mesh *meshes[] = {net(40, 20, on_sphere, 1), net(50, 25, on_torus, 1), net(64, 16, on_cylinder, 1), box(1, 2, 3),
                         data_mesh("elephant.obj")};
    for (int i = 0; i < 5; i++) {
        if (!meshes[i])
            continue;
        expect_same_charts(meshes[i], 1, 0, sp_v(0, 0, 0));
        expect_same_charts(meshes[i], 1e-3, 0, sp_v(0, 0, 0));
        expect_same_charts(meshes[i], 1e3, 0, sp_v(0, 0, 0));
        expect_same_charts(meshes[i], 1, 1.234, sp_v(3, -5, 7));
        expect_same_charts(meshes[i], 0.37, -2.5, sp_v(0, 0, 0));
        sp_mesh_destroy(meshes[i]);
    }
}

static void the_same_twice(void **state)
{
    (void)state;
    sp_mesh *mesh = net(50, 25, on_torus, 1);
    sp_charts *a = charts_of(mesh, INFINITY), *b = charts_of(mesh, INFINITY);
    assert_int_equal(a->chart_count, b->chart_count);
    assert_memory_equal(a->chart, b->chart, mesh->triangle_count * sizeof *a->chart);
    assert_memory_equal(a->flat, b->flat, mesh->triangle_count * sizeof *a->flat);
    sp_charts_destroy(a);
    sp_charts_destroy(b);
    sp_mesh_destroy(mesh);
}

/* A washer closes up again; a cube of many squares comes in few pieces; so do triangles thin beyond all measure. */
static void flat_things_with_holes_and_splinters(void **state)
{
    (void)state;
    sp_mesh *washer = net(48, 4, on_washer, 1);
    sp_charts *charts = charts_of(washer, INFINITY);
    expect_isometric(washer, charts);
    assert_int_equal(charts->chart_count, 1);
    expect_no_overlap(washer, charts);
    sp_charts_destroy(charts);
    sp_mesh_destroy(washer);
    const sp_vec3 splinters[] = {{0, 0, 0},   {1, 0, 0},           {0.5, 1e-13, 0},
                                 {0.5, 1, 0}, {0.5, -1e-150, 0.1}, {2, 1e-300, 0}};
    const uint32_t triangles[][3] = {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {1, 0, 4}, {1, 5, 2}};
    sp_mesh *mesh = mesh_of(splinters, 6, triangles, 5);
    charts = charts_of(mesh, INFINITY);
    assert_true(charts->chart_count >= 1 && charts->chart_count <= mesh->triangle_count);
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 6; i++)
            assert_true(isfinite(charts->flat[t][i / 2][i % 2]));
    sp_charts_destroy(charts);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(developable_surfaces_are_one_chart),
        cmocka_unit_test(a_cylinder_keeps_its_size),
        cmocka_unit_test(curved_surfaces_do_not_overlap),
        cmocka_unit_test(cuts_at_edges_that_are_no_surface),
        cmocka_unit_test(no_chart_exceeds_the_extent),
        cmocka_unit_test(a_fan_of_needles_stays_whole),
        cmocka_unit_test(strain_is_bounded_and_nothing_overlaps),
        cmocka_unit_test(neither_size_nor_pose_matters),
        cmocka_unit_test(the_same_twice),
        cmocka_unit_test(flat_things_with_holes_and_splinters),
        cmocka_unit_test(refuses_what_makes_no_sense),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
