/* Several meshes in one, each moved to its place. */
#include <sprayplan/mesh.h>

#include <stdlib.h>
#include <string.h>

sp_transform sp_transform_default(void)
{
    return (sp_transform){.scale = 1, .rotate = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

void sp_transform_rotation(sp_transform *transform, sp_vec3 axis, double angle)
{
    sp_vec3 k = sp_unit(axis);
    double s = sin(angle), c = cos(angle), d = 1 - c;
    double r[3][3] = {{c + k.x * k.x * d, k.x * k.y * d - k.z * s, k.x * k.z * d + k.y * s},
                      {k.y * k.x * d + k.z * s, c + k.y * k.y * d, k.y * k.z * d - k.x * s},
                      {k.z * k.x * d - k.y * s, k.z * k.y * d + k.x * s, c + k.z * k.z * d}};
    memcpy(transform->rotate, r, sizeof r);
}

sp_vec3 sp_transform_point(const sp_transform *transform, sp_vec3 point)
{
    const double(*r)[3] = transform->rotate;
    sp_vec3 p = sp_scale(point, transform->scale);
    return sp_v(r[0][0] * p.x + r[0][1] * p.y + r[0][2] * p.z + transform->translate.x,
                r[1][0] * p.x + r[1][1] * p.y + r[1][2] * p.z + transform->translate.y,
                r[2][0] * p.x + r[2][1] * p.y + r[2][2] * p.z + transform->translate.z);
}

static bool allocate(sp_mesh *joined, const sp_mesh *const *meshes, size_t count)
{
    size_t vertices = 1, triangles = 1, sources = 1, parts = 1;
    for (size_t i = 0; i < count; i++) {
        vertices += meshes[i]->vertex_count;
        triangles += meshes[i]->triangle_count;
        sources += meshes[i]->source_triangle_count;
        parts += meshes[i]->part_count;
    }
    if (vertices >= SP_NONE || sources >= SP_NONE / 4)
        return false;
    joined->vertices = malloc(vertices * sizeof *joined->vertices);
    joined->triangles = malloc(triangles * sizeof *joined->triangles);
    joined->part = malloc(triangles * sizeof *joined->part);
    joined->source = malloc(triangles * sizeof *joined->source);
    joined->source_triangles = malloc(sources * sizeof *joined->source_triangles);
    joined->source_part = malloc(sources * sizeof *joined->source_part);
    joined->parts = calloc(parts, sizeof *joined->parts);
    return joined->vertices && joined->triangles && joined->part && joined->source && joined->source_triangles &&
           joined->source_part && joined->parts;
}

static bool append_parts(sp_mesh *joined, const sp_mesh *mesh, uint32_t geometry)
{
    for (size_t i = 0; i < mesh->part_count; i++) {
        char *name = strdup(mesh->parts[i].name);
        if (!name)
            return false;
        joined->parts[joined->part_count++] = (sp_part){name, geometry};
    }
    return true;
}

static void append_triangles(sp_mesh *joined, const sp_mesh *mesh, uint32_t first_vertex, uint32_t first_part)
{
    uint32_t first_source = (uint32_t)joined->source_triangle_count;
    for (size_t t = 0; t < mesh->triangle_count; t++, joined->triangle_count++) {
        for (int i = 0; i < 3; i++)
            joined->triangles[joined->triangle_count][i] = mesh->triangles[t][i] + first_vertex;
        joined->part[joined->triangle_count] = mesh->part[t] + first_part;
        joined->source[joined->triangle_count] = mesh->source[t] + first_source;
    }
    for (size_t t = 0; t < mesh->source_triangle_count; t++, joined->source_triangle_count++) {
        for (int i = 0; i < 3; i++)
            joined->source_triangles[joined->source_triangle_count][i] = mesh->source_triangles[t][i] + first_vertex;
        joined->source_part[joined->source_triangle_count] = mesh->source_part[t] + first_part;
    }
}

static bool append(sp_mesh *joined, const sp_mesh *mesh, const sp_transform *transform, uint32_t geometry,
                   sp_error *error)
{
    uint32_t first_vertex = (uint32_t)joined->vertex_count, first_part = (uint32_t)joined->part_count;
    if (!append_parts(joined, mesh, geometry))
        return sp_fail_memory(error);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        sp_vec3 p = sp_transform_point(transform, mesh->vertices[i]);
        if (!(isfinite(p.x) && isfinite(p.y) && isfinite(p.z)))
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                           "geometry %lu: found a vertex that its transform moves out of all range",
                           (unsigned long)geometry);
        joined->vertices[joined->vertex_count++] = p;
    }
    append_triangles(joined, mesh, first_vertex, first_part);
    return true;
}

sp_mesh *sp_mesh_join(const sp_mesh *const *meshes, const sp_transform *transforms, size_t count, sp_error *error)
{
    sp_mesh *joined = calloc(1, sizeof *joined);
    bool good = joined && allocate(joined, meshes, count);
    if (!good)
        sp_fail_memory(error);
    for (size_t i = 0; i < count && good; i++)
        good = append(joined, meshes[i], &transforms[i], (uint32_t)i, error);
    if (!good) {
        sp_mesh_destroy(joined);
        return NULL;
    }
    return joined;
}
