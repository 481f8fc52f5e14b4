#include <sprayplan/atlas.h>

#include "atlas/packing/pack.h"
#include "atlas/texels/texels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEFAULT_PAGE_EDGE 4096u
#define LARGEST_PAGE_EDGE 65535u

sp_atlas *sp_atlas_create(const sp_mesh *mesh, const sp_charts *charts, const sp_atlas_options *options,
                          sp_error *error)
{
    if (!mesh || !charts || !options)
        return NULL;
    uint32_t limit = options->page_edge ? options->page_edge : DEFAULT_PAGE_EDGE;
    if (!(options->texel > 0) || !isfinite(options->texel) || limit > LARGEST_PAGE_EDGE) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                "an atlas of texels of %g m and pages of %u texels; expected a size "
                "above 0 and pages of at most %u",
                options->texel, limit, LARGEST_PAGE_EDGE);
        return NULL;
    }
    if (charts->triangle_count != mesh->triangle_count) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "charts of %zu triangles for a mesh of %zu",
                charts->triangle_count, mesh->triangle_count);
        return NULL;
    }
    sp_atlas *atlas = calloc(1, sizeof *atlas);
    if (!atlas)
        return sp_fail_memory(error);
    atlas->texel = options->texel;
    atlas->triangle_count = charts->triangle_count;
    atlas->chart_count = charts->chart_count;
    atlas->chart = malloc((charts->triangle_count + 1) * sizeof *atlas->chart);
    atlas->uv = malloc((charts->triangle_count + 1) * sizeof *atlas->uv);
    atlas->chart_page = malloc((charts->chart_count + 1) * sizeof *atlas->chart_page);
    atlas->chart_texel = malloc((charts->chart_count + 1) * sizeof *atlas->chart_texel);
    bool done = atlas->chart && atlas->uv && atlas->chart_page && atlas->chart_texel;
    if (!done)
        sp_fail_memory(error);
    else
        memcpy(atlas->chart, charts->chart, charts->triangle_count * sizeof *atlas->chart);
    for (size_t c = 0; done && c < charts->chart_count; c++)
        atlas->chart_texel[c] = options->chart_texel ? options->chart_texel[c] : options->texel;
    done = done && sp_atlas_pack(atlas, charts, options->packing, limit, error) && sp_atlas_cut(atlas, mesh, error);
    if (done)
        return atlas;
    sp_atlas_destroy(atlas);
    return NULL;
}

void sp_atlas_destroy(sp_atlas *atlas)
{
    if (!atlas)
        return;
    free(atlas->chart);
    free(atlas->chart_page);
    free(atlas->chart_texel);
    free(atlas->uv);
    free(atlas->texel_area);
    free(atlas->behind);
    free(atlas->runs);
    free(atlas->row_start);
    free(atlas->shared);
    free(atlas->seams);
    free(atlas);
}
