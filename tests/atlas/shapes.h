/* Small surfaces to lay out. All return a welded mesh; a failure ends the test. */
#ifndef TESTS_ATLAS_SHAPES_H
#define TESTS_ATLAS_SHAPES_H

#include <sprayplan/sprayplan.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static inline sp_mesh *mesh_of(const sp_vec3 *vertices, size_t vertex_count, const uint32_t (*triangles)[3],
                               size_t count)
{
    sp_error error = {0};
    sp_mesh *mesh = sp_mesh_create(vertices, vertex_count, triangles, count, NULL, NULL, 0, &error);
    if (!mesh)
        fail_msg("%s", error.message);
    return mesh;
}

/* A net of (columns + 1) x (rows + 1) points, `at` giving each for its place in [0, 1]²; equal points become one. */
static inline sp_mesh *net(int columns, int rows, sp_vec3 (*at)(double s, double t, double size), double size)
{
    size_t points = (size_t)(columns + 1) * (size_t)(rows + 1), count = 0;
    sp_vec3 *vertices = malloc(points * sizeof *vertices);
    uint32_t(*triangles)[3] = malloc(2 * points * sizeof *triangles);
    for (int r = 0; r <= rows; r++)
        for (int c = 0; c <= columns; c++)
            vertices[r * (columns + 1) + c] = at((double)c / columns, (double)r / rows, size);
    for (int r = 0; r < rows; r++)
        for (int c = 0; c < columns; c++) {
            uint32_t a = (uint32_t)(r * (columns + 1) + c), b = a + 1, d = a + (uint32_t)columns + 1, e = d + 1;
            memcpy(triangles[count++], (uint32_t[]){a, b, e}, sizeof *triangles);
            memcpy(triangles[count++], (uint32_t[]){a, e, d}, sizeof *triangles);
        }
    sp_mesh *mesh = mesh_of(vertices, points, (const uint32_t(*)[3])triangles, count);
    free(vertices);
    free(triangles);
    return mesh;
}

static inline sp_vec3 on_circle(double radius, double turn, double z)
{
    double angle = turn == 1 ? 0 : 2 * M_PI * turn; /* so that the ends meet exactly */
    return sp_v(radius * cos(angle), radius * sin(angle), z);
}
static inline sp_vec3 on_cylinder(double s, double t, double size)
{
    return on_circle(0.5 * size, s, t * size);
}
static inline sp_vec3 on_cone(double s, double t, double size)
{
    return on_circle(0.5 * size * t, s, -t * size);
}
static inline sp_vec3 on_sphere(double s, double t, double size)
{
    double polar = M_PI * (1 - t);
    return t == 0 || t == 1 ? sp_v(0, 0, t ? size : -size) : on_circle(size * sin(polar), s, size * cos(polar));
}
/* A horse saddle: more than a full turn around every vertex. */
static inline sp_vec3 on_saddle(double s, double t, double size)
{
    double x = 2 * s - 1, y = 2 * t - 1;
    return sp_v(size * x, size * y, size * (x * x - y * y));
}

/* A strip that comes back turned over. */
static inline sp_vec3 on_strip(double s, double t, double size)
{
    double turn = s == 1 ? 0 : s, across = (s == 1 ? 0.5 - t : t - 0.5) * 0.6;
    double angle = 2 * M_PI * turn, bent = M_PI * turn;
    double radius = size * (1 + across * cos(bent));
    return sp_v(radius * cos(angle), radius * sin(angle), size * across * sin(bent));
}

/* Two bulging tubes that touch along a line, where four triangles meet at each edge. */
static inline sp_vec3 on_two_tubes(double s, double t, double size)
{
    bool second = s > 0.5;
    double turn = second ? 2 * s - 1 : 2 * s;
    double angle = turn == 1 ? 0 : 2 * M_PI * turn, x = 1 - cos(angle);
    double bulge = size * (1 + 0.3 * sin(M_PI * t));
    return sp_v(second ? -bulge * x : bulge * x, bulge * sin(angle), size * t);
}

static inline sp_vec3 on_washer(double s, double t, double size)
{
    return on_circle(size * (1 + t), s, 0);
}

static inline sp_vec3 on_torus(double s, double t, double size)
{
    sp_vec3 ring = on_circle(size * (1 + 0.4 * (t == 1 ? 1 : cos(2 * M_PI * t))), s, 0);
    ring.z = size * 0.4 * (t == 1 ? 0 : sin(2 * M_PI * t));
    return ring;
}

static inline sp_mesh *one_triangle(double size)
{
    const sp_vec3 vertices[] = {{0, 0, 0}, {3 * size, 0, 0}, {0, 0, 4 * size}};
    return mesh_of(vertices, 3, (const uint32_t[][3]){{0, 1, 2}}, 1);
}

static inline sp_mesh *box(double x, double y, double z)
{
    sp_vec3 vertices[8];
    for (int i = 0; i < 8; i++)
        vertices[i] = sp_v(i & 1 ? x : 0, i & 2 ? y : 0, i & 4 ? z : 0);
    const uint32_t triangles[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh_of(vertices, 8, triangles, 12);
}

/* A rotation by an arbitrary angle, a scale and a move, as the same mesh. */
static inline sp_mesh *posed(const sp_mesh *mesh, double scale, double angle, sp_vec3 move)
{
    sp_error error = {0};
    sp_transform pose = sp_transform_default();
    sp_transform_rotation(&pose, sp_v(1, 2, -3), angle);
    pose.scale = scale;
    pose.translate = move;
    sp_mesh *moved = sp_mesh_join(&mesh, &pose, 1, &error);
    if (!moved)
        fail_msg("%s", error.message);
    assert_int_equal(moved->triangle_count, mesh->triangle_count);
    return moved;
}

/* NULL, with a message, where it is not there. */
static inline sp_mesh *data_mesh(const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, DATA_DIR "/%s", name);
    sp_error error = {0};
    sp_mesh *mesh = sp_mesh_load(path, 1, &error);
    if (!mesh)
        print_message("skipped: %s\n", error.message);
    return mesh;
}

static inline sp_charts *charts_of(const sp_mesh *mesh, double extent)
{
    sp_error error = {0};
    sp_charts *charts = sp_charts_create(mesh, extent, &error);
    if (!charts)
        fail_msg("%s", error.message);
    return charts;
}

static inline sp_atlas *atlas_of(const sp_mesh *mesh, double texel, uint32_t page_edge)
{
    sp_error error = {0};
    sp_charts *charts = charts_of(mesh, texel * (page_edge ? page_edge : 4096));
    sp_atlas *atlas =
        sp_atlas_create(mesh, charts, &(sp_atlas_options){.texel = texel, .page_edge = page_edge}, &error);
    if (!atlas)
        fail_msg("%s", error.message);
    sp_charts_destroy(charts);
    return atlas;
}

static inline sp_atlas_figures figures_of(const sp_atlas *atlas, const sp_mesh *mesh)
{
    sp_error error = {0};
    sp_atlas_figures figures;
    if (!sp_atlas_measure(atlas, mesh, &figures, &error))
        fail_msg("%s", error.message);
    return figures;
}

/* xorshift64*: reproducible numbers in [0, 1). */
static inline double random_number(uint64_t *state)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (double)((*state * 0x2545F4914F6CDD1Dull) >> 11) * 0x1p-53;
}

#endif
