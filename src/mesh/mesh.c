#include "mesh/allocate.h"
#include "mesh/soup.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *allocate(size_t count, size_t size, sp_error *error)
{
    void *items = calloc(count ? count : 1, size);
    return items ? items : sp_fail_memory(error);
}

void sp_mesh_destroy(sp_mesh *mesh)
{
    if (!mesh)
        return;
    for (size_t i = 0; mesh->parts && i < mesh->part_count; i++)
        free(mesh->parts[i].name);
    free(mesh->parts);
    free(mesh->vertices);
    free(mesh->triangles);
    free(mesh->part);
    free(mesh->source);
    free(mesh->source_triangles);
    free(mesh->source_part);
    free(mesh);
}

static uint64_t mix(uint64_t hash, double number)
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15u; /* 2^64 over the golden ratio: Knuth's multiplicative hashing */
    return hash ^ (hash >> 29);
}

static bool equal(sp_vec3 a, sp_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Fills mesh->vertices with the different points, in the order of their first coming, and `welded` with where each
 * went. */
static bool weld(sp_mesh *mesh, const sp_vec3 *vertices, size_t count, uint32_t *welded, sp_error *error)
{
    size_t size = 16;
    while (size < 2 * count)
        size *= 2;
    uint32_t *table = allocate(size, sizeof *table, error);
    if (!table)
        return false;
    memset(table, 0xFF, size * sizeof *table);
    for (size_t i = 0; i < count; i++) {
        sp_vec3 p = sp_add(vertices[i], sp_v(0, 0, 0)); /* -0 becomes 0 */
        size_t slot = mix(mix(mix(0, p.x), p.y), p.z) & (size - 1);
        while (table[slot] != SP_NONE && !equal(mesh->vertices[table[slot]], p))
            slot = (slot + 1) & (size - 1);
        if (table[slot] == SP_NONE) {
            table[slot] = (uint32_t)mesh->vertex_count;
            mesh->vertices[mesh->vertex_count++] = p;
        }
        welded[i] = table[slot];
    }
    free(table);
    return true;
}

/* Two equal corners, or an area that cannot be told from round-off: a component of the cross product of edges not
 * longer than L has a rounding error of at most 3 epsilon L². */
static bool is_degenerate(const sp_mesh *mesh, const uint32_t corners[3])
{
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        return true;
    sp_vec3 a = mesh->vertices[corners[0]], b = mesh->vertices[corners[1]], c = mesh->vertices[corners[2]];
    sp_vec3 ab = sp_sub(b, a), ac = sp_sub(c, a), bc = sp_sub(c, b);
    double longest = fmax(sp_dot(ab, ab), fmax(sp_dot(ac, ac), sp_dot(bc, bc)));
    return !(sp_length(sp_cross(ab, ac)) > 8 * DBL_EPSILON * longest);
}

static void keep_proper_triangles(sp_mesh *mesh)
{
    for (size_t i = 0; i < mesh->source_triangle_count; i++) {
        if (is_degenerate(mesh, mesh->source_triangles[i]))
            continue;
        size_t t = mesh->triangle_count++;
        memcpy(mesh->triangles[t], mesh->source_triangles[i], sizeof *mesh->triangles);
        mesh->part[t] = mesh->source_part[i];
        mesh->source[t] = (uint32_t)i;
    }
}

static bool name_parts(sp_mesh *mesh, const char *const *names, sp_error *error)
{
    for (size_t i = 0; i < mesh->part_count; i++) {
        char number[32];
        snprintf(number, sizeof number, "part-%zu", i);
        const char *name = names ? names[i] : mesh->part_count == 1 ? "default" : number;
        mesh->parts[i].name = strdup(name);
        if (!mesh->parts[i].name) {
            sp_fail_memory(error);
            return false;
        }
    }
    return true;
}

sp_mesh *sp_mesh_allocate(size_t vertex_count, size_t triangle_count, size_t part_count, sp_error *error)
{
    sp_mesh *mesh = allocate(1, sizeof *mesh, error);
    if (!mesh)
        return NULL;
    mesh->source_triangle_count = triangle_count;
    mesh->part_count = part_count;
    mesh->vertices = allocate(vertex_count, sizeof *mesh->vertices, error);
    mesh->triangles = allocate(triangle_count, sizeof *mesh->triangles, error);
    mesh->part = allocate(triangle_count, sizeof *mesh->part, error);
    mesh->source = allocate(triangle_count, sizeof *mesh->source, error);
    mesh->source_triangles = allocate(triangle_count, sizeof *mesh->source_triangles, error);
    mesh->source_part = allocate(triangle_count, sizeof *mesh->source_part, error);
    mesh->parts = allocate(part_count, sizeof *mesh->parts, error);
    if (mesh->vertices && mesh->triangles && mesh->part && mesh->source && mesh->source_triangles &&
        mesh->source_part && mesh->parts)
        return mesh;
    sp_mesh_destroy(mesh);
    return NULL;
}

static bool check_input(const sp_vec3 *vertices, size_t vertex_count, const uint32_t (*triangles)[3],
                        size_t triangle_count, const uint32_t *part, size_t part_count, sp_error *error)
{
    /* So that vertices, and half edges 3 t + k, have numbers below SP_NONE. */
    if (vertex_count >= SP_NONE || triangle_count >= SP_NONE / 3 || part_count >= SP_NONE)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "found %zu vertices, %zu triangles, %zu parts, expected fewer than %u, %u, %u", vertex_count,
                       triangle_count, part_count, SP_NONE, SP_NONE / 3, SP_NONE);
    for (size_t i = 0; i < vertex_count; i++)
        if (!sp_coordinates_allowed(vertices[i]))
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                           "found in vertex %zu a coordinate that is not finite or beyond 1e30 m", i);
    for (size_t i = 0; i < triangle_count; i++) {
        for (int k = 0; k < 3; k++)
            if (triangles[i][k] >= vertex_count)
                return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                               "found in triangle %zu vertex %u, expected less than %zu", i, triangles[i][k],
                               vertex_count);
        if (part && part[i] >= part_count)
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "found triangle %zu in part %u, expected less than %zu",
                           i, part[i], part_count);
    }
    return true;
}

sp_mesh *sp_mesh_create(const sp_vec3 *vertices, size_t vertex_count, const uint32_t (*triangles)[3],
                        size_t triangle_count, const uint32_t *part, const char *const *part_names, size_t part_count,
                        sp_error *error)
{
    if (!part && part_count == 0)
        part_count = 1;
    if (!check_input(vertices, vertex_count, triangles, triangle_count, part, part_count, error))
        return NULL;
    sp_mesh *mesh = sp_mesh_allocate(vertex_count, triangle_count, part_count, error);
    uint32_t *welded = mesh ? allocate(vertex_count, sizeof *welded, error) : NULL;
    if (!welded || !name_parts(mesh, part_names, error) || !weld(mesh, vertices, vertex_count, welded, error)) {
        free(welded);
        sp_mesh_destroy(mesh);
        return NULL;
    }
    for (size_t i = 0; i < triangle_count; i++) {
        for (int k = 0; k < 3; k++)
            mesh->source_triangles[i][k] = welded[triangles[i][k]];
        mesh->source_part[i] = part ? part[i] : 0;
    }
    free(welded);
    keep_proper_triangles(mesh);
    return mesh;
}

static sp_vec3 twice_area(const sp_mesh *mesh, uint32_t triangle)
{
    const uint32_t *corners = mesh->triangles[triangle];
    sp_vec3 a = mesh->vertices[corners[0]];
    return sp_cross(sp_sub(mesh->vertices[corners[1]], a), sp_sub(mesh->vertices[corners[2]], a));
}

double sp_triangle_area(const sp_mesh *mesh, uint32_t triangle)
{
    return 0.5 * sp_length(twice_area(mesh, triangle));
}

sp_vec3 sp_triangle_normal(const sp_mesh *mesh, uint32_t triangle)
{
    return sp_unit(twice_area(mesh, triangle));
}

sp_vec3 sp_triangle_point(const sp_mesh *mesh, uint32_t triangle, double u, double v)
{
    const uint32_t *corners = mesh->triangles[triangle];
    sp_vec3 point = sp_scale(mesh->vertices[corners[0]], 1 - u - v);
    return sp_along(sp_along(point, u, mesh->vertices[corners[1]]), v, mesh->vertices[corners[2]]);
}

double sp_mesh_area(const sp_mesh *mesh)
{
    double area = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++)
        area += sp_triangle_area(mesh, (uint32_t)i);
    return area;
}

double sp_mesh_box(const sp_mesh *mesh, sp_vec3 *low, sp_vec3 *high)
{
    *low = *high = mesh->triangle_count ? mesh->vertices[mesh->triangles[0][0]] : sp_v(0, 0, 0);
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            sp_vec3 p = mesh->vertices[mesh->triangles[t][k]];
            *low = sp_v(fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z));
            *high = sp_v(fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z));
        }
    return sp_distance(*low, *high);
}

bool sp_triangle_weights(const sp_mesh *mesh, uint32_t triangle, sp_vec3 point, double *u, double *v)
{
    const uint32_t *corner = mesh->triangles[triangle];
    sp_vec3 a = mesh->vertices[corner[0]], offset = sp_sub(point, a);
    sp_vec3 ab = sp_sub(mesh->vertices[corner[1]], a), ac = sp_sub(mesh->vertices[corner[2]], a),
            area = sp_cross(ab, ac);
    *u = sp_dot(sp_cross(offset, ac), area) / sp_dot(area, area);
    *v = sp_dot(sp_cross(ab, offset), area) / sp_dot(area, area);
    return *u >= 0 && *v >= 0 && *u + *v <= 1;
}
