#include "valid_range.h"
#include "mesh/allocate.h"
#include "mesh/grow.h"
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

static void shrink_vertices(sp_mesh *mesh)
{
    sp_reallocate(&mesh->vertices, mesh->vertex_count ? mesh->vertex_count : 1, sizeof *mesh->vertices);
}

/* Leaves of mesh->vertices[vertex_count] the different points, in the order of their first coming, and renumbers the
 * corners. */
static bool weld(sp_mesh *mesh, sp_error *error)
{
    size_t count = mesh->vertex_count, different = 0;
    sp_weld_table table = {0};
    uint32_t *welded = allocate(count, sizeof *welded, error);
    bool good = welded && (sp_weld_reserve(&table, count, NULL, 0) || sp_fail_memory(error));
    for (size_t i = 0; good && i < count; i++) {
        sp_vec3 point = sp_weld_canonical(mesh->vertices[i]);
        uint32_t *slot = sp_weld_slot(&table, mesh->vertices, point);
        if (*slot == SP_NONE) {
            *slot = (uint32_t)different;
            mesh->vertices[different++] = point;
        }
        welded[i] = *slot;
    }
    free(table.slots);
    for (size_t i = 0; good && i < mesh->source_triangle_count; i++)
        for (int k = 0; k < 3; k++)
            mesh->source_triangles[i][k] = welded[mesh->source_triangles[i][k]];
    free(welded);
    mesh->vertex_count = different;
    shrink_vertices(mesh);
    return good;
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

static bool keep_proper_triangles(sp_mesh *mesh, sp_error *error)
{
    mesh->source = allocate(mesh->source_triangle_count, sizeof *mesh->source, error);
    for (size_t i = 0; mesh->source && i < mesh->source_triangle_count; i++)
        if (!is_degenerate(mesh, mesh->source_triangles[i]))
            mesh->source[mesh->triangle_count++] = (uint32_t)i;
    size_t count = mesh->triangle_count;
    if (!mesh->source || !sp_reallocate(&mesh->source, count ? count : 1, sizeof *mesh->source) ||
        !(mesh->triangles = allocate(count, sizeof *mesh->triangles, error)) ||
        !(mesh->part = allocate(count, sizeof *mesh->part, error)))
        return sp_fail_memory(error);
    for (size_t t = 0; t < count; t++) {
        memcpy(mesh->triangles[t], mesh->source_triangles[mesh->source[t]], sizeof *mesh->triangles);
        mesh->part[t] = mesh->source_part[mesh->source[t]];
    }
    return true;
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

/* What a mesh is made from: all but its proper triangles. */
static sp_mesh *allocate_sources(size_t vertex_count, size_t triangle_count, size_t part_count, sp_error *error)
{
    sp_mesh *mesh = allocate(1, sizeof *mesh, error);
    if (!mesh)
        return NULL;
    mesh->source_triangle_count = triangle_count;
    mesh->part_count = part_count;
    mesh->vertices = allocate(vertex_count, sizeof *mesh->vertices, error);
    mesh->source_triangles = allocate(triangle_count, sizeof *mesh->source_triangles, error);
    mesh->source_part = allocate(triangle_count, sizeof *mesh->source_part, error);
    mesh->parts = allocate(part_count, sizeof *mesh->parts, error);
    if (mesh->vertices && mesh->source_triangles && mesh->source_part && mesh->parts)
        return mesh;
    sp_mesh_destroy(mesh);
    return NULL;
}

sp_mesh *sp_mesh_allocate(size_t vertex_count, size_t triangle_count, size_t part_count, sp_error *error)
{
    sp_mesh *mesh = allocate_sources(vertex_count, triangle_count, part_count, error);
    if (!mesh)
        return NULL;
    mesh->triangles = allocate(triangle_count, sizeof *mesh->triangles, error);
    mesh->part = allocate(triangle_count, sizeof *mesh->part, error);
    mesh->source = allocate(triangle_count, sizeof *mesh->source, error);
    if (mesh->triangles && mesh->part && mesh->source)
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
    if (!sp_is_listed((sp_owner){"mesh", ""}, "vertices", vertices, vertex_count, error) ||
        !sp_is_listed((sp_owner){"mesh", ""}, "triangles", triangles, triangle_count, error))
        return false;
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
    sp_mesh *mesh = allocate_sources(vertex_count, triangle_count, part_count, error);
    if (mesh) {
        mesh->vertex_count = vertex_count;
        if (vertex_count)
            memcpy(mesh->vertices, vertices, vertex_count * sizeof *vertices);
        if (triangle_count)
            memcpy(mesh->source_triangles, triangles, triangle_count * sizeof *triangles);
        if (part && triangle_count)
            memcpy(mesh->source_part, part, triangle_count * sizeof *part);
    }
    if (mesh && name_parts(mesh, part_names, error) && weld(mesh, error) && keep_proper_triangles(mesh, error))
        return mesh;
    sp_mesh_destroy(mesh);
    return NULL;
}

/* Each array goes over as it is, cut to what it holds. */
static void take(sp_mesh *mesh, sp_soup *soup)
{
    for (size_t i = 0; i < soup->part_count; i++)
        mesh->parts[i].name = soup->part_names[i];
    soup->part_count = 0;
    mesh->vertices = soup->vertices;
    mesh->vertex_count = soup->vertex_count;
    mesh->source_triangles = soup->triangles;
    mesh->source_part = soup->part;
    mesh->source_triangle_count = soup->triangle_count;
    mesh->tangled = soup->tangled;
    soup->vertices = NULL;
    soup->triangles = NULL;
    soup->part = NULL;
    sp_soup_clear(soup);
    shrink_vertices(mesh);
    sp_reallocate(&mesh->source_triangles, mesh->source_triangle_count, sizeof *mesh->source_triangles);
    sp_reallocate(&mesh->source_part, mesh->source_triangle_count, sizeof *mesh->source_part);
}

sp_mesh *sp_soup_mesh(sp_soup *soup, sp_error *error)
{
    if (!check_input(soup->vertices, soup->vertex_count, (const uint32_t(*)[3])soup->triangles, soup->triangle_count,
                     soup->part, soup->part_count, error))
        return NULL;
    bool distinct = soup->welded.size > 0;
    sp_mesh *mesh = allocate(1, sizeof *mesh, error);
    if (!mesh)
        return NULL;
    mesh->part_count = soup->part_count;
    mesh->parts = allocate(soup->part_count, sizeof *mesh->parts, error);
    if (mesh->parts) {
        take(mesh, soup);
        if ((distinct || weld(mesh, error)) && keep_proper_triangles(mesh, error))
            return mesh;
    }
    sp_mesh_destroy(mesh);
    return NULL;
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
