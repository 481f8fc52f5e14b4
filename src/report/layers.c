#include "layers.h"

#include <stdlib.h>
#include <string.h>

bool sp_layers_create(sp_layers *layers, const sp_evaluator *evaluator, sp_error *error)
{
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    *layers = (sp_layers){.evaluator = evaluator, .two_sided = sp_evaluator_setup(evaluator)->cavity == SP_CAVITY_NONE};
    for (int side = 0; side < 2; ++side) {
        layers->patch[side] = malloc((atlas->texel_count + 1) * sizeof *layers->patch[side]);
        if (!layers->patch[side]) {
            sp_layers_free(layers);
            return sp_fail_memory(error);
        }
        memset(layers->patch[side], 0xff, (atlas->texel_count + 1) * sizeof *layers->patch[side]);
    }
    for (size_t i = 0; i < patches->count; ++i) {
        int side = patches->side[i] == SP_SIDE_BACK;
        layers->patch[side][patches->texel[i]] = (uint32_t)i;
        layers->has_back |= side == 1;
    }
    return true;
}

bool sp_layers_create_for(sp_layers *layers, const sp_evaluator *evaluator, const sp_colour_scale *scale,
                          sp_error *error)
{
    if (!sp_layers_create(layers, evaluator, error))
        return false;
    if (scale->style.quantity != SP_QUANTITY_CHARTS)
        return true;
    layers->chart_colour = sp_chart_colours(sp_evaluator_atlas(evaluator), error);
    if (!layers->chart_colour)
        sp_layers_free(layers);
    return layers->chart_colour != NULL;
}

void sp_layers_colour(const sp_layers *layers, const sp_colour_scale *scale, const sp_deposits *deposits,
                      uint32_t patch, int stripe, uint8_t rgb[3])
{
    uint32_t texel = sp_evaluator_patches(layers->evaluator)->texel[patch];
    if (layers->chart_colour)
        memcpy(
            rgb,
            sp_chart_palette[layers->chart_colour[sp_atlas_place(sp_evaluator_atlas(layers->evaluator), texel).chart]],
            3);
    else
        sp_false_colour(scale, deposits, patch, stripe, rgb);
}

void sp_layers_free(sp_layers *layers)
{
    free(layers->chart_colour);
    free(layers->patch[0]);
    free(layers->patch[1]);
    *layers = (sp_layers){0};
}

bool sp_layers_wet(const sp_layers *layers, uint32_t triangle, int back)
{
    return sp_evaluator_wet(layers->evaluator, triangle) >> back & 1;
}

static bool is_clean_at(const sp_layers *layers, uint32_t triangle, double u, double v, int back)
{
    return sp_layers_clean(layers, triangle, back) &&
           (sp_evaluator_wet_at(layers->evaluator, triangle, u, v) >> back & 1);
}

bool sp_layers_clean(const sp_layers *layers, uint32_t triangle, int back)
{
    const sp_setup *setup = sp_evaluator_setup(layers->evaluator);
    return setup->surfaces[setup->mesh->part[triangle]].clean && sp_layers_wet(layers, triangle, back);
}

uint32_t sp_layers_patch(const sp_layers *layers, uint32_t triangle, double u, double v, int back)
{
    if (!is_clean_at(layers, triangle, u, v, back))
        return SP_NONE;
    uint32_t texel = sp_atlas_texel(sp_evaluator_atlas(layers->evaluator), triangle, u, v);
    return layers->patch[layers->two_sided ? 0 : back][texel];
}

size_t sp_layers_pixel(const sp_atlas *atlas, sp_texel_place place)
{
    return (size_t)(atlas->page_edge - 1 - place.y) * atlas->page_edge + place.x;
}

/* Gives every empty pixel the colour of a neighbour that holds surface. */
static void spread_rims(uint8_t *pixels, uint8_t *filled, size_t edge)
{
    static const int steps[8][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    for (size_t y = 0; y < edge; ++y)
        for (size_t x = 0; x < edge; ++x) {
            size_t here = y * edge + x;
            for (int k = 0; k < 8 && !filled[here]; ++k) {
                size_t i = x + (size_t)steps[k][0], j = y + (size_t)steps[k][1]; /* wraps below 0: then not < edge */
                if (i >= edge || j >= edge || filled[j * edge + i] != 1)
                    continue;
                memcpy(pixels + 3 * here, pixels + 3 * (j * edge + i), 3);
                filled[here] = 2;
            }
        }
}

uint8_t *sp_layers_picture(const sp_layers *layers, const sp_coverage *coverage, const sp_colour_scale *scale,
                           size_t page, int layer, const uint8_t background[3], bool spread, sp_error *error)
{
    const sp_atlas *atlas = sp_evaluator_atlas(layers->evaluator);
    size_t edge = atlas->page_edge;
    uint8_t *pixels = malloc(3 * edge * edge), *filled = calloc(edge, edge);
    if (!pixels || !filled) {
        free(pixels);
        free(filled);
        return sp_fail_memory(error);
    }
    for (size_t i = 0; i < edge * edge; ++i)
        memcpy(pixels + 3 * i, background, 3);
    for (uint32_t texel = 0; texel < atlas->pixel_count; ++texel) { /* the largest patch of each pixel */
        sp_texel_place place = sp_atlas_place(atlas, texel);
        if (place.page != page)
            continue;
        size_t pixel = sp_layers_pixel(atlas, place);
        uint32_t patch = layers->patch[layer][texel];
        int stripe = (place.x + place.y) % 6 < 2;
        if (patch == SP_NONE)
            memcpy(pixels + 3 * pixel, sp_colour_obstacle, 3);
        else
            sp_layers_colour(layers, scale, &coverage->deposits, patch, stripe, pixels + 3 * pixel);
        filled[pixel] = 1;
    }
    if (spread)
        spread_rims(pixels, filled, edge);
    free(filled);
    return pixels;
}
