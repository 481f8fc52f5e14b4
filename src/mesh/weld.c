/* Exact welding: points with equal coordinates become one vertex. */
#include "mesh/weld.h"

#include <stdlib.h>
#include <string.h>

static uint64_t hash_point(sp_vec3 p)
{
    uint64_t bits[3], hash = 0;
    memcpy(bits, &p, sizeof bits);
    for (int i = 0; i < 3; i++) { /* the mixing step of splitmix64 */
        hash = (hash ^ bits[i]) + 0x9e3779b97f4a7c15u;
        hash = (hash ^ hash >> 30) * 0xbf58476d1ce4e5b9u;
        hash = (hash ^ hash >> 27) * 0x94d049bb133111ebu;
        hash ^= hash >> 31;
    }
    return hash;
}

static bool same_point(sp_vec3 a, sp_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/* vertex[i]: the welded vertex of point i. Vertices are numbered by their first point. */
static bool weld_points(const mesh_build *build, sp_mesh *mesh, uint32_t *vertex)
{
    size_t slots = 16;
    while (slots < 2 * build->point_count)
        slots *= 2;
    uint32_t *table = malloc(slots * sizeof *table);
    mesh->vertices = malloc((build->point_count + 1) * sizeof *mesh->vertices);
    if (!table || !mesh->vertices) {
        free(table);
        return false;
    }
    memset(table, 0xff, slots * sizeof *table);
    for (size_t i = 0; i < build->point_count; i++) {
        sp_vec3 p = build->points[i];
        p = sp_v(p.x + 0.0, p.y + 0.0, p.z + 0.0); /* -0 becomes 0 */
        size_t slot = hash_point(p) & (slots - 1);
        while (table[slot] != SP_NONE && !same_point(mesh->vertices[table[slot]], p))
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == SP_NONE) {
            table[slot] = (uint32_t)mesh->vertex_count;
            mesh->vertices[mesh->vertex_count++] = p;
        }
        vertex[i] = table[slot];
    }
    free(table);
    return true;
}

static bool degenerate(const sp_mesh *mesh, const uint32_t corners[3])
{
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        return true;
    sp_vec3 a = sp_sub(mesh->vertices[corners[1]], mesh->vertices[corners[0]]);
    sp_vec3 b = sp_sub(mesh->vertices[corners[2]], mesh->vertices[corners[0]]);
    sp_vec3 c = sp_sub(b, a);
    double longest = fmax(sp_length(a), fmax(sp_length(b), sp_length(c)));
    /* A height below round-off of the longest edge has no direction to call a normal. */
    return !(sp_length(sp_cross(sp_scale(a, 1 / longest), sp_scale(b, 1 / longest))) > 1e-14);
}

static bool allocate_triangles(sp_mesh *mesh, size_t count)
{
    mesh->triangles = malloc((count + 1) * sizeof *mesh->triangles);
    mesh->part = malloc((count + 1) * sizeof *mesh->part);
    mesh->source = malloc((count + 1) * sizeof *mesh->source);
    mesh->source_triangles = malloc((count + 1) * sizeof *mesh->source_triangles);
    mesh->source_part = malloc((count + 1) * sizeof *mesh->source_part);
    return mesh->triangles && mesh->part && mesh->source && mesh->source_triangles && mesh->source_part;
}

static void sort_triangles(const mesh_build *build, sp_mesh *mesh, const uint32_t *vertex)
{
    mesh->source_triangle_count = build->triangle_count;
    for (size_t t = 0; t < build->triangle_count; t++) {
        uint32_t *corners = mesh->source_triangles[t];
        for (int i = 0; i < 3; i++)
            corners[i] = vertex[build->triangles[t][i]];
        mesh->source_part[t] = build->part[t];
        if (degenerate(mesh, corners))
            continue;
        memcpy(mesh->triangles[mesh->triangle_count], corners, sizeof *mesh->triangles);
        mesh->part[mesh->triangle_count] = build->part[t];
        mesh->source[mesh->triangle_count++] = (uint32_t)t;
    }
}

static bool take_parts(mesh_build *build, sp_mesh *mesh)
{
    mesh->parts = calloc(build->name_count + 1, sizeof *mesh->parts);
    if (!mesh->parts)
        return false;
    for (size_t i = 0; i < build->name_count; i++)
        mesh->parts[i].name = build->names[i];
    mesh->part_count = build->name_count;
    build->name_count = 0;
    return true;
}

sp_mesh *mesh_weld(mesh_build *build, sp_error *error)
{
    sp_mesh *mesh = calloc(1, sizeof *mesh);
    uint32_t *vertex = malloc((build->point_count + 1) * sizeof *vertex);
    bool good = mesh && vertex && weld_points(build, mesh, vertex) && allocate_triangles(mesh, build->triangle_count) &&
                take_parts(build, mesh);
    if (good)
        sort_triangles(build, mesh, vertex);
    else
        sp_fail_memory(error);
    free(vertex);
    if (good && mesh->triangle_count == 0)
        good = sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "found no triangle of some area, expected at least one");
    if (!good) {
        sp_mesh_destroy(mesh);
        return NULL;
    }
    return mesh;
}
