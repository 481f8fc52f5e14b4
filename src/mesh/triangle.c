/* One triangle of a mesh. */
#include <sprayplan/mesh.h>

static sp_vec3 twice_area(const sp_mesh *mesh, uint32_t triangle)
{
    const uint32_t *corners = mesh->triangles[triangle];
    sp_vec3 a = mesh->vertices[corners[0]];
    return sp_cross(sp_sub(mesh->vertices[corners[1]], a), sp_sub(mesh->vertices[corners[2]], a));
}

double sp_triangle_area(const sp_mesh *mesh, uint32_t triangle) { return 0.5 * sp_length(twice_area(mesh, triangle)); }

sp_vec3 sp_triangle_normal(const sp_mesh *mesh, uint32_t triangle) { return sp_unit(twice_area(mesh, triangle)); }

sp_vec3 sp_triangle_point(const sp_mesh *mesh, uint32_t triangle, double u, double v)
{
    const uint32_t *corners = mesh->triangles[triangle];
    sp_vec3 a = mesh->vertices[corners[0]];
    return sp_along(sp_along(a, u, sp_sub(mesh->vertices[corners[1]], a)), v, sp_sub(mesh->vertices[corners[2]], a));
}

double sp_mesh_area(const sp_mesh *mesh)
{
    double sum = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        sum += sp_triangle_area(mesh, (uint32_t)t);
    return sum;
}
