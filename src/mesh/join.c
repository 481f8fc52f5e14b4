#include "mesh/allocate.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

sp_transform sp_transform_default(void)
{
    return (sp_transform){1, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
}

void sp_transform_rotation(sp_transform *transform, sp_vec3 axis, double angle)
{
    sp_vec3 k = sp_unit(axis);
    double c = cos(angle), s = sin(angle), d = 1 - c;
    double rotate[3][3] = {{c + d * k.x * k.x, d * k.x * k.y - s * k.z, d * k.x * k.z + s * k.y},
                           {d * k.x * k.y + s * k.z, c + d * k.y * k.y, d * k.y * k.z - s * k.x},
                           {d * k.x * k.z - s * k.y, d * k.y * k.z + s * k.x, c + d * k.z * k.z}};
    memcpy(transform->rotate, rotate, sizeof rotate);
}

sp_vec3 sp_transform_point(const sp_transform *transform, sp_vec3 point)
{
    sp_vec3 p = sp_scale(point, transform->scale);
    const double(*r)[3] = transform->rotate;
    return sp_v(r[0][0] * p.x + r[0][1] * p.y + r[0][2] * p.z + transform->translate.x,
                r[1][0] * p.x + r[1][1] * p.y + r[1][2] * p.z + transform->translate.y,
                r[2][0] * p.x + r[2][1] * p.y + r[2][2] * p.z + transform->translate.z);
}

static bool turns_without_mirroring(const sp_transform *transform)
{
    const double(*r)[3] = transform->rotate;
    sp_vec3 x = sp_v(r[0][0], r[0][1], r[0][2]), y = sp_v(r[1][0], r[1][1], r[1][2]),
            z = sp_v(r[2][0], r[2][1], r[2][2]);
    return transform->scale > 0 && sp_dot(sp_cross(x, y), z) > 0;
}

/* A moved copy, welded anew: rounding may have made points equal. */
static sp_mesh *move(const sp_mesh *mesh, const sp_transform *transform, size_t number, sp_error *error)
{
    if (!turns_without_mirroring(transform)) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                "found a transform of geometry %zu that mirrors or flattens, expected scale and rotation", number);
        return NULL;
    }
    sp_vec3 *vertices = calloc(mesh->vertex_count + 1, sizeof *vertices);
    const char **names = calloc(mesh->part_count + 1, sizeof *names);
    sp_mesh *moved = NULL;
    if (vertices && names) {
        for (size_t i = 0; i < mesh->vertex_count; i++)
            vertices[i] = sp_transform_point(transform, mesh->vertices[i]);
        for (size_t i = 0; i < mesh->part_count; i++)
            names[i] = mesh->parts[i].name;
        moved = sp_mesh_create(vertices, mesh->vertex_count, (const uint32_t(*)[3])mesh->source_triangles,
                               mesh->source_triangle_count, mesh->source_part, names, mesh->part_count, error);
    } else {
        sp_fail_memory(error);
    }
    if (moved)
        moved->tangled = mesh->tangled;
    for (size_t i = 0; moved && i < mesh->part_count; i++)
        moved->parts[i].volume = mesh->parts[i].volume * transform->scale * transform->scale * transform->scale;
    free(vertices);
    free(names);
    return moved;
}

static void append_triangles(uint32_t (*to)[3], uint32_t *to_part, const uint32_t (*from)[3], const uint32_t *part,
                             size_t count, uint32_t first_vertex, uint32_t first_part)
{
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++)
            to[i][k] = from[i][k] + first_vertex;
        to_part[i] = part[i] + first_part;
    }
}

/* Puts `mesh` behind what `joined` holds already; takes the names of its parts. `sources` and `parts` are how many
 * source triangles and parts `joined` holds. */
static void append(sp_mesh *joined, sp_mesh *mesh, size_t sources, size_t parts, uint32_t geometry)
{
    uint32_t first_vertex = (uint32_t)joined->vertex_count;
    size_t triangles = joined->triangle_count;
    memcpy(joined->vertices + first_vertex, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    append_triangles(joined->triangles + triangles, joined->part + triangles, (const uint32_t(*)[3])mesh->triangles,
                     mesh->part, mesh->triangle_count, first_vertex, (uint32_t)parts);
    append_triangles(joined->source_triangles + sources, joined->source_part + sources,
                     (const uint32_t(*)[3])mesh->source_triangles, mesh->source_part, mesh->source_triangle_count,
                     first_vertex, (uint32_t)parts);
    for (size_t i = 0; i < mesh->triangle_count; i++)
        joined->source[triangles + i] = mesh->source[i] + (uint32_t)sources;
    for (size_t i = 0; i < mesh->part_count; i++) {
        joined->parts[parts + i] = (sp_part){mesh->parts[i].name, geometry, mesh->parts[i].volume};
        mesh->parts[i].name = NULL;
    }
    joined->vertex_count += mesh->vertex_count;
    joined->tangled += mesh->tangled;
    joined->triangle_count += mesh->triangle_count;
}

static sp_mesh *concatenate(sp_mesh *const *meshes, size_t count, sp_error *error)
{
    size_t vertices = 0, sources = 0, parts = 0;
    for (size_t i = 0; i < count; i++) {
        vertices += meshes[i]->vertex_count;
        sources += meshes[i]->source_triangle_count;
        parts += meshes[i]->part_count;
    }
    if (vertices >= SP_NONE || sources >= SP_NONE / 3 || parts >= SP_NONE) {
        sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                "found %zu vertices, %zu triangles, %zu parts together, expected fewer than %u, %u, %u", vertices,
                sources, parts, SP_NONE, SP_NONE / 3, SP_NONE);
        return NULL;
    }
    sp_mesh *joined = sp_mesh_allocate(vertices, sources, parts, error);
    sources = parts = 0;
    for (size_t i = 0; joined && i < count; i++) {
        append(joined, meshes[i], sources, parts, (uint32_t)i);
        sources += meshes[i]->source_triangle_count;
        parts += meshes[i]->part_count;
    }
    assert(!joined || joined->vertex_count == vertices);
    return joined;
}

sp_mesh *sp_mesh_join(const sp_mesh *const *meshes, const sp_transform *transforms, size_t count, sp_error *error)
{
    if (!meshes || !transforms)
        return NULL;
    sp_mesh **moved = calloc(count + 1, sizeof *moved);
    if (!moved)
        return sp_fail_memory(error);
    bool good = true;
    for (size_t i = 0; good && i < count; i++) {
        moved[i] = meshes[i] ? move(meshes[i], &transforms[i], i, error) : NULL; /* its loading failed and said so */
        good = moved[i] != NULL;
    }
    sp_mesh *joined = good ? concatenate(moved, count, error) : NULL;
    for (size_t i = 0; i < count; i++)
        sp_mesh_destroy(moved[i]);
    free(moved);
    return joined;
}
