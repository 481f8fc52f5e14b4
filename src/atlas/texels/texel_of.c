/* Which texel holds what, and where it lies. */
#include "atlas/texels/texels.h"
#include "mesh/min_max.h"

#include <assert.h>
#include <math.h>
#include <stddef.h>

/* A point nearer than this to the border of its pixel may lie in a sliver that was dropped, pixels. */
#define DOUBTFUL 1e-7

const sp_texel_run *sp_atlas_run(const sp_atlas *atlas, size_t row, uint32_t x)
{
    uint32_t low = atlas->row_start[row], high = atlas->row_start[row + 1];
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        const sp_texel_run *run = &atlas->runs[middle];
        if (x < run->x)
            high = middle;
        else if (x >= (uint32_t)run->x + run->count)
            low = middle + 1;
        else
            return run;
    }
    return NULL;
}

uint32_t sp_atlas_pixel(const sp_atlas *atlas, uint32_t page, uint32_t x, uint32_t y)
{
    if (page >= atlas->page_count || x >= atlas->page_edge || y >= atlas->page_edge)
        return SP_NONE;
    const sp_texel_run *run = sp_atlas_run(atlas, (size_t)page * atlas->page_edge + y, x);
    return run ? run->texel + (x - run->x) : SP_NONE;
}

/* The first of the shared entries at or after a pixel and triangle. */
static size_t find_shared(const sp_atlas *atlas, uint32_t pixel, uint32_t triangle)
{
    size_t low = 0, high = atlas->shared_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        const sp_shared_pixel *at = &atlas->shared[middle];
        if (at->pixel < pixel || (at->pixel == pixel && at->triangle < triangle))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

size_t sp_atlas_shared_from(const sp_atlas *atlas, uint32_t pixel)
{
    return atlas->shared_count ? find_shared(atlas, pixel, 0) : 0;
}

uint32_t sp_atlas_resolve(const sp_atlas *atlas, uint32_t pixel, uint32_t triangle)
{
    size_t at = find_shared(atlas, pixel, triangle);
    if (at == atlas->shared_count || atlas->shared[at].pixel != pixel || atlas->shared[at].triangle != triangle)
        return pixel;
    return atlas->shared[at].texel;
}

bool sp_atlas_rasterize(const sp_atlas *atlas, uint32_t triangle, sp_raster_kind kind, sp_raster *raster)
{
    return sp_raster_begin(raster, (const double(*)[2])atlas->uv[triangle], kind);
}

uint32_t sp_atlas_row_texel(const sp_atlas *atlas, uint32_t triangle, const sp_raster *raster)
{
    size_t row = (size_t)atlas->chart_page[atlas->chart[triangle]] * atlas->page_edge + raster->y;
    const sp_texel_run *run = sp_atlas_run(atlas, row, raster->x);
    assert(run); /* what a triangle covers was painted */
    return run->texel + (raster->x - run->x);
}

/* The triangle's own pixel that is nearest to a point. */
static uint32_t nearest_own(const sp_atlas *atlas, uint32_t triangle, double x, double y)
{
    sp_raster raster = {0};
    double least = INFINITY;
    uint32_t nearest = SP_NONE;
    sp_atlas_rasterize(atlas, triangle, SP_RASTER_PIXELS, &raster); /* needs no memory */
    while (sp_raster_next(&raster)) {
        double column = sp_lesser(sp_greater(floor(x), raster.x), raster.x + raster.count - 1.0);
        double dx = sp_greater(0, sp_greater(column - x, x - column - 1)),
               dy = sp_greater(0, sp_greater(raster.y - y, y - raster.y - 1));
        if (dx * dx + dy * dy >= least)
            continue;
        least = dx * dx + dy * dy;
        nearest = sp_atlas_row_texel(atlas, triangle, &raster) + ((uint32_t)column - raster.x);
    }
    return nearest;
}

static bool is_doubtful(double x)
{
    double part = x - floor(x);
    return !(part > DOUBTFUL && part < 1 - DOUBTFUL);
}

uint32_t sp_atlas_texel(const sp_atlas *atlas, uint32_t triangle, double u, double v)
{
    const double(*uv)[2] = (const double(*)[2])atlas->uv[triangle];
    double x = uv[0][0] + u * (uv[1][0] - uv[0][0]) + v * (uv[2][0] - uv[0][0]);
    double y = uv[0][1] + u * (uv[1][1] - uv[0][1]) + v * (uv[2][1] - uv[0][1]);
    double flat = (uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) - (uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]);
    uint32_t pixel = SP_NONE;
    if (flat > DOUBTFUL && u >= 0 && v >= 0 && u + v <= 1 && !is_doubtful(x) && !is_doubtful(y))
        pixel = sp_atlas_pixel(atlas, atlas->chart_page[atlas->chart[triangle]], (uint32_t)x, (uint32_t)y);
    if (pixel == SP_NONE)
        pixel = nearest_own(atlas, triangle, x, y);
    assert(pixel < atlas->pixel_count);
    return atlas->shared_count ? sp_atlas_resolve(atlas, pixel, triangle) : pixel;
}

sp_texel_place sp_atlas_place(const sp_atlas *atlas, uint32_t texel)
{
    assert(texel < atlas->texel_count);
    uint32_t pixel = texel < atlas->pixel_count ? texel : atlas->behind[texel - atlas->pixel_count];
    size_t low = 0, high = atlas->run_count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (atlas->runs[middle].texel <= pixel)
            low = middle;
        else
            high = middle;
    }
    const sp_texel_run *run = &atlas->runs[low];
    return (sp_texel_place){run->row / atlas->page_edge, run->x + (pixel - run->texel), run->row % atlas->page_edge,
                            run->chart};
}

const sp_seam *sp_atlas_seams(const sp_atlas *atlas, uint32_t texel, size_t *count)
{
    size_t low = 0, high = atlas->seam_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (atlas->seams[middle].texel < texel)
            low = middle + 1;
        else
            high = middle;
    }
    *count = 0;
    while (low + *count < atlas->seam_count && atlas->seams[low + *count].texel == texel)
        ++*count;
    return atlas->seams + low;
}
