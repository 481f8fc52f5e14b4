/* Which pixels hold surface. */
#include "mesh/bits.h"
#include "atlas/texels/texels.h"

#include <assert.h>
#include <stdlib.h>

static bool paint(const sp_atlas *atlas, uint64_t *bits, size_t row_words, sp_raster *raster)
{
    for (uint32_t t = 0; t < atlas->triangle_count; t++) {
        uint64_t *page = bits + (size_t)atlas->chart_page[atlas->chart[t]] * atlas->page_edge * row_words;
        if (!sp_atlas_rasterize(atlas, t, SP_RASTER_PIXELS, raster))
            return false;
        while (sp_raster_next(raster))
            sp_bits_fill(page + raster->y * row_words, raster->x, raster->count);
    }
    return true;
}

/* The runs of every row, without their charts; with runs NULL only counts them and their pixels. */
static void list_runs(sp_atlas *atlas, const uint64_t *bits, size_t row_words, size_t *pixels)
{
    size_t rows = atlas->page_count * atlas->page_edge, edge = atlas->page_edge;
    atlas->run_count = *pixels = 0;
    for (size_t row = 0; row < rows; row++) {
        const uint64_t *at = bits + row * row_words;
        atlas->row_start[row] = (uint32_t)atlas->run_count;
        for (size_t x = 0, end; (x = sp_bits_find(at, x, edge, true)) < edge; x = end) {
            end = sp_bits_find(at, x, edge, false);
            assert(end - x <= UINT16_MAX);
            if (atlas->runs)
                atlas->runs[atlas->run_count] = (sp_texel_run){.texel = (uint32_t)*pixels,
                                                               .row = (uint32_t)row,
                                                               .chart = SP_NONE,
                                                               .x = (uint16_t)x,
                                                               .count = (uint16_t)(end - x)};
            atlas->run_count++;
            *pixels += end - x;
        }
    }
    atlas->row_start[rows] = (uint32_t)atlas->run_count;
}

static bool name_charts(sp_atlas *atlas, sp_raster *raster)
{
    for (uint32_t t = 0; t < atlas->triangle_count; t++) {
        size_t row = (size_t)atlas->chart_page[atlas->chart[t]] * atlas->page_edge;
        if (!sp_atlas_rasterize(atlas, t, SP_RASTER_PIXELS, raster))
            return false;
        while (sp_raster_next(raster))
            ((sp_texel_run *)sp_atlas_run(atlas, row + raster->y, raster->x))->chart = atlas->chart[t];
    }
    return true;
}

bool sp_atlas_find_pixels(sp_atlas *atlas, sp_error *error)
{
    size_t rows = atlas->page_count * atlas->page_edge, row_words = sp_bits_words(atlas->page_edge), pixels = 0;
    if (rows >= SP_NONE)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "a texel of %g m takes %zu pages of %u texels, too many",
                       atlas->texel, atlas->page_count, atlas->page_edge);
    uint64_t *bits = calloc(rows * row_words + 1, sizeof *bits);
    sp_raster raster = {0};
    atlas->row_start = malloc((rows + 1) * sizeof *atlas->row_start);
    bool done = bits && atlas->row_start && paint(atlas, bits, row_words, &raster);
    if (done)
        list_runs(atlas, bits, row_words, &pixels);
    bool fits = pixels < SP_NONE && atlas->run_count < SP_NONE;
    if (done && fits) {
        atlas->runs = malloc((atlas->run_count + 1) * sizeof *atlas->runs);
        done = atlas->runs;
        if (done)
            list_runs(atlas, bits, row_words, &pixels);
    }
    free(bits);
    atlas->pixel_count = atlas->texel_count = pixels;
    done = done && (!fits || name_charts(atlas, &raster));
    sp_raster_free(&raster);
    if (!done)
        return sp_fail_memory(error);
    return fits || sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "a texel of %g m cuts the surface into more than 2^32",
                           atlas->texel);
}
