/* Which texel holds a point of the surface. */
#include "atlas/texels.h"

#include <math.h>

/* The triangle's own texel at (x, y), or SP_NONE: its texels are ordered by y, then x, all on one page. */
static uint32_t find_own(const sp_atlas *atlas, uint32_t triangle, double x, double y)
{
    const uint32_t *own = atlas->triangle_texels;
    uint32_t low = atlas->triangle_start[triangle], end = atlas->triangle_start[triangle + 1], high = end;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2, texel = own[middle];
        if (atlas->texel_y[texel] < y || (atlas->texel_y[texel] == y && atlas->texel_x[texel] < x))
            low = middle + 1;
        else
            high = middle;
    }
    return low < end && atlas->texel_y[own[low]] == y && atlas->texel_x[own[low]] == x ? own[low] : SP_NONE;
}

/* The square of the distance from a point to a texel's square. */
static double distance_to(const sp_atlas *atlas, uint32_t texel, double x, double y)
{
    double left = atlas->texel_x[texel], low = atlas->texel_y[texel];
    double dx = fmax(0, fmax(left - x, x - left - 1)), dy = fmax(0, fmax(low - y, y - low - 1));
    return dx * dx + dy * dy;
}

uint32_t sp_atlas_texel(const sp_atlas *atlas, uint32_t triangle, double u, double v)
{
    const double(*uv)[2] = (const double(*)[2])atlas->uv[triangle];
    double x = uv[0][0] + u * (uv[1][0] - uv[0][0]) + v * (uv[2][0] - uv[0][0]);
    double y = uv[0][1] + u * (uv[1][1] - uv[0][1]) + v * (uv[2][1] - uv[0][1]);
    uint32_t texel = find_own(atlas, triangle, floor(x), floor(y));
    if (texel != SP_NONE)
        return texel;
    /* Round-off has put the point just outside of the triangle, or into a sliver that was dropped. */
    double least = INFINITY;
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            uint32_t near = find_own(atlas, triangle, floor(x) + dx, floor(y) + dy);
            if (near != SP_NONE && distance_to(atlas, near, x, y) < least) {
                least = distance_to(atlas, near, x, y);
                texel = near;
            }
        }
    if (texel != SP_NONE)
        return texel;
    texel = atlas->triangle_texels[atlas->triangle_start[triangle]];
    for (uint32_t i = atlas->triangle_start[triangle]; i < atlas->triangle_start[triangle + 1]; i++)
        if (distance_to(atlas, atlas->triangle_texels[i], x, y) < least) {
            least = distance_to(atlas, atlas->triangle_texels[i], x, y);
            texel = atlas->triangle_texels[i];
        }
    return texel;
}
