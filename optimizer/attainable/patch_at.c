#include "attainable/patch_at.h"

uint32_t sp_patch_of(const sp_evaluator *evaluator, uint32_t triangle, double u, double v, bool back)
{
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    uint32_t texel = sp_atlas_texel(sp_evaluator_atlas(evaluator), triangle, u, v);
    size_t low = 0, high = patches->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (patches->texel[middle] < texel)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < patches->count && patches->texel[low] == texel; low++)
        if (patches->side[low] == SP_SIDE_BOTH || (patches->side[low] == SP_SIDE_BACK) == back)
            return (uint32_t)low;
    return SP_NONE;
}

uint32_t sp_coarse_patch(const sp_evaluator *fine, const sp_evaluator *coarse, size_t patch)
{
    const sp_patches *patches = sp_evaluator_patches(fine);
    const sp_mesh *mesh = sp_evaluator_setup(fine)->mesh;
    uint32_t triangle = patches->triangle[patch];
    const uint32_t *corner = mesh->triangles[triangle];
    sp_vec3 a = mesh->vertices[corner[0]], ab = sp_sub(mesh->vertices[corner[1]], a),
            ac = sp_sub(mesh->vertices[corner[2]], a), ap = sp_sub(patches->point[patch], a), area = sp_cross(ab, ac);
    double area2 = sp_dot(area, area);
    if (!(area2 > 0))
        return SP_NONE;
    double u = sp_dot(sp_cross(ap, ac), area) / area2, v = sp_dot(sp_cross(ab, ap), area) / area2;
    return sp_patch_of(coarse, triangle, u, v, patches->side[patch] == SP_SIDE_BACK);
}
