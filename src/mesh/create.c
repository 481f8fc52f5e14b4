/* Meshes from arrays in memory, and from other meshes. */
#include "mesh/weld.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool finite_point(sp_vec3 p) { return isfinite(p.x) && isfinite(p.y) && isfinite(p.z); }

static bool add_points(mesh_build *build, const sp_vec3 *vertices, size_t count, sp_error *error)
{
    for (size_t i = 0; i < count; i++) {
        if (!finite_point(vertices[i]))
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "vertex %zu: found a coordinate that is not finite", i);
        if (!mesh_build_point(build, vertices[i], error))
            return false;
    }
    return true;
}

static bool add_triangles(mesh_build *build, const uint32_t (*triangles)[3], const uint32_t *part, size_t count,
                          sp_error *error)
{
    for (size_t t = 0; t < count; t++) {
        for (int i = 0; i < 3; i++)
            if (triangles[t][i] >= build->point_count)
                return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "triangle %zu: found vertex %lu, expected below %zu",
                               t, (unsigned long)triangles[t][i], build->point_count);
        if (part && part[t] >= build->name_count)
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "triangle %zu: found part %lu, expected below %zu", t,
                           (unsigned long)part[t], build->name_count);
        if (!mesh_build_triangle(build, triangles[t][0], triangles[t][1], triangles[t][2], part ? part[t] : 0, error))
            return false;
    }
    return true;
}

static bool add_names(mesh_build *build, const char *const *names, size_t count, sp_error *error)
{
    for (size_t i = 0; i < count || i == 0; i++) {
        char numbered[32];
        uint32_t part;
        snprintf(numbered, sizeof numbered, "part %zu", i);
        const char *name = names && count ? names[i] : count > 1 ? numbered : "default";
        if (!mesh_build_part(build, name, strlen(name), &part, error))
            return false;
        if (part != i)
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "part %zu: found the name \"%s\" again", i, name);
    }
    return true;
}

sp_mesh *sp_mesh_create(const sp_vec3 *vertices, size_t vertex_count, const uint32_t (*triangles)[3],
                        size_t triangle_count, const uint32_t *part, const char *const *part_names, size_t part_count,
                        sp_error *error)
{
    mesh_build build = {0};
    sp_mesh *mesh = NULL;
    if (add_names(&build, part_names, part_count, error) && add_points(&build, vertices, vertex_count, error) &&
        add_triangles(&build, triangles, part, triangle_count, error))
        mesh = mesh_weld(&build, error);
    mesh_build_free(&build);
    return mesh;
}

void sp_mesh_destroy(sp_mesh *mesh)
{
    if (!mesh)
        return;
    for (size_t i = 0; i < mesh->part_count; i++)
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
