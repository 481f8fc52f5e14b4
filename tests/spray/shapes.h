/* Meshes put together by hand for the tests of this room. */
#ifndef TESTS_SPRAY_SHAPES_H
#define TESTS_SPRAY_SHAPES_H

#include <sprayplan/sprayplan.h>

#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#define SHAPE_POINTS 100000
#define SHAPE_PARTS 8

typedef struct {
    size_t point_count, triangle_count, part_count;
    sp_vec3 *points;
    uint32_t (*triangles)[3];
    uint32_t *part;
    const char *names[SHAPE_PARTS];
} shape;

static inline shape shape_create(void)
{
    shape s = {.points = malloc(SHAPE_POINTS * sizeof(sp_vec3)),
               .triangles = malloc(2 * SHAPE_POINTS * sizeof(uint32_t[3])),
               .part = malloc(2 * SHAPE_POINTS * sizeof(uint32_t))};
    assert_true(s.points && s.triangles && s.part);
    return s;
}

/* What follows belongs to a new part. */
static inline void shape_part(shape *s, const char *name)
{
    assert_true(s->part_count < SHAPE_PARTS);
    s->names[s->part_count++] = name;
}

static inline void shape_triangle(shape *s, sp_vec3 a, sp_vec3 b, sp_vec3 c)
{
    assert_true(s->point_count + 3 <= SHAPE_POINTS);
    uint32_t first = (uint32_t)s->point_count;
    s->points[s->point_count++] = a;
    s->points[s->point_count++] = b;
    s->points[s->point_count++] = c;
    s->triangles[s->triangle_count][0] = first;
    s->triangles[s->triangle_count][1] = first + 1;
    s->triangles[s->triangle_count][2] = first + 2;
    s->part[s->triangle_count++] = (uint32_t)s->part_count - 1;
}

/* A parallelogram of n × n cells; the front is towards x × y. */
static inline void shape_sheet(shape *s, sp_vec3 corner, sp_vec3 x, sp_vec3 y, int n)
{
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            sp_vec3 p[4];
            for (int k = 0; k < 4; k++) {
                double u = (double)(i + (k == 1 || k == 2)) / n, v = (double)(j + (k >= 2)) / n;
                p[k] = sp_along(sp_along(corner, u, x), v, y);
            }
            shape_triangle(s, p[0], p[1], p[2]);
            shape_triangle(s, p[0], p[2], p[3]);
        }
    }
}

/* A closed box, its front outside or, where `inwards`, inside. */
static inline void shape_box(shape *s, sp_vec3 low, sp_vec3 high, bool inwards)
{
    sp_vec3 x = sp_v(high.x - low.x, 0, 0), y = sp_v(0, high.y - low.y, 0), z = sp_v(0, 0, high.z - low.z);
    sp_vec3 faces[6][3] = {{low, y, x},
                           {low, z, y},
                           {low, x, z},
                           {high, sp_scale(x, -1), sp_scale(y, -1)},
                           {high, sp_scale(y, -1), sp_scale(z, -1)},
                           {high, sp_scale(z, -1), sp_scale(x, -1)}};
    for (int f = 0; f < 6; f++)
        shape_sheet(s, faces[f][0], faces[f][inwards ? 2 : 1], faces[f][inwards ? 1 : 2], 1);
}

/* The (r, z) profile turned about the z axis, its front on the left of the profile's way (seen with r to the right, z
 * up). */
static inline void shape_turned(shape *s, const double (*profile)[2], int count, int segments)
{
    for (int i = 0; i + 1 < count; i++) {
        for (int k = 0; k < segments; k++) {
            double a = 2 * M_PI * k / segments, b = 2 * M_PI * ((k + 1) % segments) / segments;
            double r0 = profile[i][0], z0 = profile[i][1], r1 = profile[i + 1][0], z1 = profile[i + 1][1];
            sp_vec3 p0 = sp_v(r0 * cos(a), r0 * sin(a), z0), p1 = sp_v(r1 * cos(a), r1 * sin(a), z1);
            sp_vec3 q0 = sp_v(r0 * cos(b), r0 * sin(b), z0), q1 = sp_v(r1 * cos(b), r1 * sin(b), z1);
            if (r0 > 0)
                shape_triangle(s, p0, q1, q0);
            if (r1 > 0)
                shape_triangle(s, p0, p1, q1);
        }
    }
}

static inline void shape_sphere(shape *s, double radius, bool inwards, int segments)
{
    double profile[64][2];
    int rings = segments / 2;
    for (int i = 0; i <= rings; i++) {
        double polar = M_PI * (inwards ? rings - i : i) / rings;
        profile[i][0] = i == 0 || i == rings ? 0 : radius * sin(polar);
        profile[i][1] = radius * cos(polar);
    }
    shape_turned(s, (const double(*)[2])profile, rings + 1, segments);
}

/* The mesh; the shape is used up. */
static inline sp_mesh *shape_mesh(shape *s)
{
    sp_error error = {0};
    sp_mesh *mesh = sp_mesh_create(s->points, s->point_count, (const uint32_t(*)[3])s->triangles, s->triangle_count,
                                   s->part, s->names, s->part_count, &error);
    assert_string_equal(error.message, "");
    assert_non_null(mesh);
    free(s->points);
    free(s->triangles);
    free(s->part);
    return mesh;
}

#endif
