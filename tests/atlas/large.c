/* Meshes of more than 30,000 triangles, whose charts are made on a coarse one: what holds for small ones holds for
 * them. */
#include "shapes.h"

static sp_vec3 on_plate(double s, double t, double size)
{
    return sp_v(size * s, 0.7 * size * t, 0);
}

/* A quarter of a ring. */
static sp_vec3 on_bend(double s, double t, double size)
{
    return on_circle(size * (1 + 0.4 * t), 0.25 * s, 0);
}

/* A sheet that has been corrugated: bent about parallel lines only. */
static sp_vec3 on_corrugated(double s, double t, double size)
{
    return sp_v(size * (s + 0.01 * sin(40 * s)), size * t, 0.03 * size * cos(40 * s));
}

/* A shell with a torispherical end: the usual vessel. */
static sp_vec3 on_vessel(double s, double t, double size)
{
    double polar = 0.5 * M_PI * (2 * t - 1);
    if (t > 0.5)
        return on_circle(size, s, 4 * size * (t - 0.5));
    return t == 0 ? sp_v(0, 0, -0.5 * size) : on_circle(size * cos(polar), s, 0.5 * size * sin(polar));
}

/* Coordinates as a binary STL file holds them. */
static sp_mesh *in_single(const sp_mesh *mesh)
{
    sp_vec3 *vertices = malloc(mesh->vertex_count * sizeof *vertices);
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        sp_vec3 p = mesh->vertices[v];
        vertices[v] = sp_v((float)p.x, (float)p.y, (float)p.z);
    }
    sp_mesh *rounded =
        mesh_of(vertices, mesh->vertex_count, (const uint32_t(*)[3])mesh->triangles, mesh->triangle_count);
    free(vertices);
    assert_int_equal(rounded->triangle_count, mesh->triangle_count);
    return rounded;
}

/* The most that a length between two corners of a triangle is off, in parts of `unit` or, where that is 0, of it. */
static double worst_length(const sp_mesh *mesh, const sp_charts *charts, double unit)
{
    double worst = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3;
            const double *p = charts->flat[t][i], *q = charts->flat[t][j];
            double length = sp_distance(mesh->vertices[mesh->triangles[t][i]], mesh->vertices[mesh->triangles[t][j]]);
            worst = fmax(worst, fabs(hypot(q[0] - p[0], q[1] - p[1]) - length) / (unit > 0 ? unit : length));
        }
    return worst;
}

static const struct {
    const char *name;
    sp_vec3 (*at)(double s, double t, double size);
    int columns, rows;
} developable[] = {
    {"cylinder", on_cylinder, 400, 40},
    {"slender cylinder", on_cylinder, 60, 270},
    {"cone", on_cone, 300, 55},
    {"plate", on_plate, 150, 105},
    {"bend", on_bend, 200, 80},
    {"washer", on_washer, 320, 50},
    {"corrugated", on_corrugated, 320, 50},
};

static void expect_one_chart(const char *name, const sp_mesh *mesh, double unit, double most)
{
    assert_true(mesh->triangle_count > 30000);
    sp_charts *charts = charts_of(mesh, INFINITY);
    double worst = worst_length(mesh, charts, unit);
    print_message("%s: %zu charts, lengths off by %.2g\n", name, charts->chart_count, worst);
    assert_int_equal(charts->chart_count, 1);
    assert_true(worst <= most);
    sp_charts_destroy(charts);
}

/* What can be laid without strain is, in one piece: exactly, and from single precision up to its rounding. */
static void developable_surfaces_are_one_chart(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof developable / sizeof *developable; i++) {
        sp_mesh *mesh = net(developable[i].columns, developable[i].rows, developable[i].at, 1);
        sp_mesh *askew = posed(mesh, 1, 1.234, sp_v(0.3, -0.2, 0.1)), *poor = in_single(askew);
        expect_one_chart(developable[i].name, mesh, 0, 1e-11);
        expect_one_chart(" askew", askew, 0, 1e-11);
        expect_one_chart(" in single precision", poor, 1, 1e-7);
        sp_mesh_destroy(mesh);
        sp_mesh_destroy(askew);
        sp_mesh_destroy(poor);
    }
#ifndef SPRAYPLAN_SANITIZE
    sp_mesh *wide = net(400, 300, on_plate, 1); /* round-off must not grow from row to row */
    expect_one_chart("wide plate", wide, 0, 1e-10);
    sp_mesh_destroy(wide);
#endif
}

/* The same charts, and in them the same lengths. */
static void expect_same_charts(const sp_mesh *mesh, const sp_charts *charts, double scale, double angle, sp_vec3 move)
{
    sp_mesh *other = posed(mesh, scale, angle, move);
    sp_charts *again = charts_of(other, INFINITY);
    assert_int_equal(again->chart_count, charts->chart_count);
    assert_memory_equal(again->chart, charts->chart, mesh->triangle_count * sizeof *charts->chart);
    double worst = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3;
            const double(*p)[2] = (const double(*)[2])charts->flat[t], (*q)[2] = (const double(*)[2])again->flat[t];
            double length = hypot(p[j][0] - p[i][0], p[j][1] - p[i][1]);
            worst = fmax(worst, fabs(hypot(q[j][0] - q[i][0], q[j][1] - q[i][1]) / scale - length) / length);
        }
    print_message("scale %g, turned by %g: the same to %.2g\n", scale, angle, worst);
    assert_true(worst < 1e-4);
    sp_charts_destroy(again);
    sp_mesh_destroy(other);
}

static void neither_size_nor_pose_matters(void **state)
{
    (void)state;
    sp_mesh *meshes[] = {net(200, 81, on_sphere, 1), net(200, 80, on_torus, 1), net(220, 80, on_vessel, 1),
                         net(130, 130, on_saddle, 1), data_mesh("horse.obj")};
    for (int i = 0; i < 5; i++) {
        if (!meshes[i])
            continue;
        assert_true(meshes[i]->triangle_count > 30000);
        sp_charts *charts = charts_of(meshes[i], INFINITY);
        print_message("%zu triangles, %zu charts\n", meshes[i]->triangle_count, charts->chart_count);
        expect_same_charts(meshes[i], charts, 1e-3, 0, sp_v(0, 0, 0));
        expect_same_charts(meshes[i], charts, 3.7, 1.234, sp_v(3, -5, 7));
        sp_charts_destroy(charts);
        sp_mesh_destroy(meshes[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(developable_surfaces_are_one_chart),
        cmocka_unit_test(neither_size_nor_pose_matters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
