/* patch_code.js does the same the other way round: whatever is changed here is changed there. */
#include "patch_code.h"

#include <stdlib.h>

#define SIZES SP_PATCH_SIZES

typedef struct {
    sp_bit_model right[SP_HINTS][SIZES][SIZES];
    sp_byte_model off[SP_HINTS][SIZES];
} models;

bool sp_neighbours_find(sp_neighbours *neighbours, const sp_layers *layers)
{
    const sp_atlas *atlas = sp_evaluator_atlas(layers->evaluator);
    const sp_patches *patches = sp_evaluator_patches(layers->evaluator);
    *neighbours = (sp_neighbours){patches->count, malloc((patches->count + 1) * sizeof *neighbours->of)};
    for (uint32_t i = 0; neighbours->of && i < patches->count; ++i) {
        uint32_t texel = patches->texel[i], *of = neighbours->of[i];
        const uint32_t *layer = layers->patch[patches->side[i] == SP_SIDE_BACK];
        bool on_page = texel < atlas->pixel_count;
        sp_texel_place at = on_page ? sp_atlas_place(atlas, texel) : (sp_texel_place){0};
        for (int k = 0; k < 3; ++k) {
            uint32_t left = k > 0, above = k != 1;
            of[k] = SP_NONE;
            if (!on_page || at.x < left || at.y < above)
                continue;
            uint32_t pixel = sp_atlas_pixel(atlas, at.page, at.x - left, at.y - above);
            of[k] = pixel == SP_NONE || layer[pixel] >= i ? SP_NONE : layer[pixel];
        }
    }
    return neighbours->of != NULL;
}

void sp_neighbours_free(sp_neighbours *neighbours)
{
    free(neighbours->of);
    *neighbours = (sp_neighbours){0};
}

/* The median of above, left and what a plane through all three has (LOCO-I). */
uint8_t sp_patch_expected(const sp_neighbours *neighbours, const uint8_t *values, const uint8_t *where, size_t patch)
{
    const uint32_t *of = neighbours->of[patch];
    bool has[3];
    int value[3];
    for (int k = 0; k < 3; ++k) {
        has[k] = of[k] != SP_NONE && (!where || where[of[k]]);
        value[k] = has[k] ? values[of[k]] : 0;
    }
    if (!has[0] && !has[1])
        return has[2] ? (uint8_t)value[2] : 0;
    if (!has[0] || !has[1] || !has[2])
        return (uint8_t)value[has[0] ? 0 : 1];
    int least = value[0] < value[1] ? value[0] : value[1], most = value[0] + value[1] - least;
    return (uint8_t)(value[2] >= most ? least : value[2] <= least ? most : value[0] + value[1] - value[2]);
}

int sp_patch_size(uint8_t off)
{
    int size = off < 128 ? off : 256 - off;
    return size == 0 ? 0 : size == 1 ? 1 : size < 6 ? 2 : 3;
}

bool sp_patches_encode(const sp_neighbours *neighbours, const uint8_t *values, const sp_patch_guess *guess,
                       uint8_t *off, sp_coder *coder)
{
    models *m = calloc(1, sizeof *m);
    for (size_t i = 0; m && i < neighbours->count; ++i) {
        const uint32_t *of = neighbours->of[i];
        int before = i ? sp_patch_size(off[i - 1]) : 0, hint = guess->hint[i];
        int beside = of[0] != SP_NONE ? sp_patch_size(off[of[0]]) : of[1] != SP_NONE ? sp_patch_size(off[of[1]]) : 0;
        off[i] = (uint8_t)(values[i] - guess->expected[i]);
        sp_code_bit(coder, &m->right[hint][before][beside], off[i] == 0);
        if (off[i])
            sp_code_byte(coder, &m->off[hint][beside > before ? beside : before], off[i]);
    }
    free(m);
    return m != NULL;
}
