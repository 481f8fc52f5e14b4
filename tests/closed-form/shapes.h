/* Meshes for the closed forms: rectangles and spheres. */
#ifndef CLOSED_FORM_SHAPES_H
#define CLOSED_FORM_SHAPES_H

#include <sprayplan/mesh.h>

#include <stdlib.h>

typedef struct {
    sp_vec3 corner, u, v; /* the rectangle corner + s u + t v, 0 <= s, t <= 1; its front is where u × v points */
} rectangle;

#define CELLS 12 /* a rectangle's quads along each edge */

static inline size_t add_rectangle(const rectangle *r, uint32_t part, size_t vertices, sp_vec3 *vertex,
                                   uint32_t (*triangle)[3], uint32_t *parts)
{
    size_t triangles = 0;
    for (int j = 0; j <= CELLS; j++) {
        for (int i = 0; i <= CELLS; i++)
            vertex[vertices + (size_t)(j * (CELLS + 1) + i)] =
                sp_along(sp_along(r->corner, (double)i / CELLS, r->u), (double)j / CELLS, r->v);
    }
    for (int j = 0; j < CELLS; j++) {
        for (int i = 0; i < CELLS; i++) {
            uint32_t a = (uint32_t)vertices + (uint32_t)(j * (CELLS + 1) + i), d = a + CELLS + 1;
            const uint32_t quad[2][3] = {{a, a + 1, d + 1}, {a, d + 1, d}};
            for (int k = 0; k < 2; k++) {
                for (int c = 0; c < 3; c++)
                    triangle[triangles][c] = quad[k][c];
                parts[triangles++] = part;
            }
        }
    }
    return triangles;
}

/* Rectangle i is part i. */
static inline sp_mesh *mesh_of_rectangles(const rectangle *rectangles, size_t count)
{
    static const char *const names[] = {"r0", "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11"};
    enum { corners = (CELLS + 1) * (CELLS + 1), pieces = 2 * CELLS * CELLS };
    sp_vec3 *vertex = malloc(count * corners * sizeof *vertex);
    uint32_t(*triangle)[3] = malloc(count * pieces * sizeof *triangle);
    uint32_t *part = malloc(count * pieces * sizeof *part);
    for (size_t i = 0; i < count; i++)
        add_rectangle(&rectangles[i], (uint32_t)i, i * corners, vertex, triangle + i * pieces, part + i * pieces);
    sp_mesh *mesh = sp_mesh_create(vertex, count * corners, (const uint32_t(*)[3])triangle, count * pieces, part, names,
                                   count, NULL);
    free(vertex);
    free(triangle);
    free(part);
    return mesh;
}

/* A level rectangle about (0, 0, z), front up. */
static inline rectangle level_rectangle(double width, double depth, double z)
{
    return (rectangle){sp_v(-0.5 * width, -0.5 * depth, z), sp_v(width, 0, 0), sp_v(0, depth, 0)};
}

/* The six faces of a box, fronts outwards. */
static inline void box_rectangles(sp_vec3 low, sp_vec3 size, rectangle faces[6])
{
    sp_vec3 x = sp_v(size.x, 0, 0), y = sp_v(0, size.y, 0), z = sp_v(0, 0, size.z), high = sp_add(low, size);
    faces[0] = (rectangle){low, y, x};
    faces[1] = (rectangle){low, x, z};
    faces[2] = (rectangle){low, z, y};
    faces[3] = (rectangle){high, sp_scale(x, -1), sp_scale(y, -1)};
    faces[4] = (rectangle){high, sp_scale(z, -1), sp_scale(x, -1)};
    faces[5] = (rectangle){high, sp_scale(y, -1), sp_scale(z, -1)};
}

/* A room of 2 m x 2 m x 1.6 m about the origin, whose walls face inwards. */
static inline sp_mesh *mesh_of_room(void)
{
    const double x = 1, y = 1, z = 0.8;
    const rectangle walls[] = {
        {{-x, -y, -z}, {2 * x, 0, 0}, {0, 2 * y, 0}}, {{-x, -y, z}, {0, 2 * y, 0}, {2 * x, 0, 0}},
        {{-x, -y, -z}, {0, 2 * y, 0}, {0, 0, 2 * z}}, {{x, -y, -z}, {0, 0, 2 * z}, {0, 2 * y, 0}},
        {{-x, -y, -z}, {0, 0, 2 * z}, {2 * x, 0, 0}}, {{-x, y, -z}, {2 * x, 0, 0}, {0, 0, 2 * z}},
    };
    return mesh_of_rectangles(walls, 6);
}

/* An icosahedron's faces cut in four `levels` times, on a sphere about the origin, front outwards. */
static inline sp_mesh *mesh_of_sphere(double radius, int levels)
{
    const double t = 0.5 * (1 + sqrt(5));
    const sp_vec3 base[12] = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                              {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
    const uint32_t face[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                  {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                  {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    size_t count = 20, all = (size_t)20 << (2 * levels);
    sp_vec3 *corner = malloc(3 * all * sizeof *corner); /* of triangles apart; the mesh welds equal ones */
    uint32_t(*triangle)[3] = malloc(all * sizeof *triangle);
    for (size_t i = 0; i < 60; i++)
        corner[i] = sp_scale(sp_unit(base[face[i / 3][i % 3]]), radius);
    for (; count < all; count *= 4) {
        for (size_t i = count; i-- > 0;) {
            sp_vec3 c[3] = {corner[3 * i], corner[3 * i + 1], corner[3 * i + 2]}, m[3];
            for (int k = 0; k < 3; k++)
                m[k] = sp_scale(sp_unit(sp_add(c[(k + 1) % 3], c[(k + 2) % 3])), radius);
            const sp_vec3 quarters[12] = {c[0], m[2], m[1], c[1], m[0], m[2], c[2], m[1], m[0], m[0], m[1], m[2]};
            for (size_t k = 0; k < 12; k++)
                corner[12 * i + k] = quarters[k];
        }
    }
    for (size_t i = 0; i < 3 * all; i++)
        triangle[i / 3][i % 3] = (uint32_t)i;
    sp_mesh *mesh = sp_mesh_create(corner, 3 * all, (const uint32_t(*)[3])triangle, all, NULL, NULL, 0, NULL);
    free(corner);
    free(triangle);
    return mesh;
}

#endif
