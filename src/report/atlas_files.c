/* What lies on the atlas as files: coverage.png, deposits.exr, pictures of the charts. */
#include "channels.h"
#include "layers.h"
#include "scaled_files.h"

#include "result/design.h"

#include <sprayplan/image.h>
#include <sprayplan/report.h>

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const uint8_t white[3] = {255, 255, 255};

/* Pages side by side in as square a block as they make; fronts first, then backs. */
static bool tile(const sp_layers *layers, const sp_coverage *coverage, const sp_colour_scale *scale, const char *path,
                 sp_error *error)
{
    const sp_atlas *atlas = sp_evaluator_atlas(layers->evaluator);
    size_t edge = atlas->page_edge, count = atlas->page_count * (layers->has_back ? 2 : 1), columns = 1;
    while (columns * columns < count)
        columns++;
    size_t rows = (count + columns - 1) / columns;
    if (columns * edge > INT_MAX || rows * edge > INT_MAX || columns * rows > SIZE_MAX / 3 / edge / edge)
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "%zu pages of %zu x %zu texels are too large for one picture",
                       count, edge, edge);
    uint8_t *picture = malloc(3 * columns * rows * edge * edge);
    if (!picture)
        return sp_fail_memory(error);
    memset(picture, 255, 3 * columns * rows * edge * edge);
    bool done = true;
    for (size_t i = 0; done && i < count; ++i) {
        uint8_t *page = sp_layers_picture(layers, coverage, scale, i % atlas->page_count, i >= atlas->page_count, white,
                                          false, error);
        done = page != NULL;
        for (size_t y = 0; done && y < edge; ++y)
            memcpy(picture + 3 * (((i / columns) * edge + y) * columns + i % columns) * edge, page + 3 * y * edge,
                   3 * edge);
        free(page);
    }
    done = done && sp_image_write_png(path, picture, (int)(columns * edge), (int)(rows * edge), 3, error);
    free(picture);
    return done;
}

bool sp_coverage_png(const sp_design *design, const sp_colour_scale *scale, const char *path, sp_error *error)
{
    sp_layers layers;
    if (!sp_layers_create_for(&layers, design->evaluator, scale, error))
        return false;
    bool done = tile(&layers, design->coverage, scale, path, error);
    sp_layers_free(&layers);
    return done;
}

bool sp_report_coverage_png(const sp_design *design, const char *path, sp_error *error)
{
    if (!sp_design_is_evaluated(design) || !path)
        return false;
    sp_colour_scale scale = sp_colour_scale_of(design, 1, (sp_picture_style){0});
    return sp_coverage_png(design, &scale, path, error);
}

static void fill_part(const sp_layers *layers, const sp_design *design, size_t page, int layer, float *pixels)
{
    const sp_atlas *atlas = sp_evaluator_atlas(layers->evaluator);
    for (size_t i = 0; i < (size_t)atlas->page_edge * atlas->page_edge; ++i)
        pixels[SP_CHANNELS * i + SP_CHANNEL_CHART] = -1;            /* no chart */
    for (uint32_t texel = 0; texel < atlas->pixel_count; ++texel) { /* the largest patch of each pixel */
        sp_texel_place place = sp_atlas_place(atlas, texel);
        if (place.page != page)
            continue;
        float *pixel = pixels + SP_CHANNELS * sp_layers_pixel(atlas, place);
        uint32_t patch = layers->patch[layer][texel];
        pixel[SP_CHANNEL_CHART] = (float)place.chart;
        for (int k = 0; patch != SP_NONE && k < SP_CHANNEL_CHART; ++k)
            pixel[k] = (float)sp_channel_of(design, patch, k);
    }
}

static bool write_parts(const sp_layers *layers, const sp_design *design, const char *path, sp_error *error)
{
    const sp_atlas *atlas = sp_evaluator_atlas(layers->evaluator);
    size_t sides = layers->has_back ? 2 : 1, count = atlas->page_count * sides;
    size_t page_size = (size_t)atlas->page_edge * atlas->page_edge * SP_CHANNELS;
    float *pixels = count <= SIZE_MAX / sizeof(float) / page_size ? calloc(count, page_size * sizeof *pixels) : NULL;
    sp_exr_part *parts = calloc(count, sizeof *parts);
    char(*names)[40] = calloc(count, sizeof *names);
    bool done = pixels && parts && names;
    if (!done)
        sp_fail_memory(error);
    for (size_t i = 0; done && i < count; ++i) {
        size_t page = i / sides;
        int layer = (int)(i % sides);
        snprintf(names[i], sizeof names[i], "page%zu%s", page, layer ? "-back" : "");
        fill_part(layers, design, page, layer, pixels + i * page_size);
        parts[i] = (sp_exr_part){names[i], (int)atlas->page_edge, (int)atlas->page_edge, pixels + i * page_size};
    }
    done = done && sp_image_write_exr(path, parts, count, sp_channel_names, SP_CHANNELS, error);
    free(names);
    free(parts);
    free(pixels);
    return done;
}

bool sp_report_deposits_exr(const sp_design *design, const char *path, sp_error *error)
{
    if (!sp_design_is_evaluated(design) || !path)
        return false;
    sp_layers layers;
    if (!sp_layers_create(&layers, design->evaluator, error))
        return false;
    bool done = write_parts(&layers, design, path, error);
    sp_layers_free(&layers);
    return done;
}

/* Hues a golden angle apart, so that neighbouring numbers look different; never too dark or too pale. */
static void chart_colour(uint32_t chart, uint8_t rgb[3])
{
    double hue = fmod(chart * 0.6180339887498949, 1), light = 0.55 + 0.3 * fmod(chart * 0.7548776662466927, 1);
    for (int k = 0; k < 3; ++k) {
        double level = 0.5 + 0.5 * cos(2 * M_PI * (hue - k / 3.0));
        rgb[k] = (uint8_t)(255 * (light * (0.35 + 0.65 * level)) + 30);
    }
}

uint8_t *sp_report_charts(const sp_atlas *atlas, size_t page, sp_error *error)
{
    if (!atlas)
        return NULL;
    size_t edge = atlas->page_edge;
    uint8_t *pixels = malloc(3 * edge * edge + 1);
    if (!pixels)
        return sp_fail_memory(error);
    memset(pixels, 255, 3 * edge * edge);
    for (uint32_t texel = 0; texel < atlas->pixel_count; ++texel) {
        sp_texel_place place = sp_atlas_place(atlas, texel);
        if (place.page == page)
            chart_colour(place.chart, pixels + 3 * sp_layers_pixel(atlas, place));
    }
    return pixels;
}
