/* How a triangle's area on the surface is shared among its texels. */
#include "atlas/texels/texels.h"
#include "atlas/least.h"

#include <math.h>
#include <stdlib.h>

#define LEAST_SHARE 1e-15 /* of the triangle: no texel is without area, whatever rounding says */

static bool add_row(sp_pieces *pieces, const sp_atlas *atlas, uint32_t triangle)
{
    const sp_cover *cover = &pieces->cover;
    if (pieces->capacity - pieces->count < cover->count) {
        size_t capacity = 2 * pieces->capacity + cover->count + 64;
        sp_piece *items = realloc(pieces->items, capacity * sizeof *items);
        if (!items)
            return false;
        pieces->items = items;
        pieces->capacity = capacity;
    }
    uint32_t texel = sp_atlas_row_texel(atlas, triangle, cover);
    for (uint32_t i = 0; i < cover->count; i++)
        pieces->items[pieces->count + i] = (sp_piece){texel + i, sp_most(cover->area[i], LEAST_SHARE * cover->flat)};
    for (size_t at = sp_atlas_shared_from(atlas, texel);
         at < atlas->shared_count && atlas->shared[at].pixel - texel < cover->count; at++)
        if (atlas->shared[at].triangle == triangle)
            pieces->items[pieces->count + (atlas->shared[at].pixel - texel)].texel = atlas->shared[at].texel;
    pieces->count += cover->count;
    return true;
}

bool sp_pieces_of(sp_pieces *pieces, const sp_atlas *atlas, const sp_mesh *mesh, uint32_t triangle)
{
    pieces->count = 0;
    if (!sp_atlas_cover(atlas, triangle, SP_COVER_AREAS, &pieces->cover))
        return false;
    while (sp_cover_next(&pieces->cover))
        if (!add_row(pieces, atlas, triangle))
            return false;
    double total = 0, surface = sp_triangle_area(mesh, triangle);
    for (size_t i = 0; i < pieces->count; i++)
        total += pieces->items[i].area;
    for (size_t i = 0; i < pieces->count; i++)
        pieces->items[i].area = total > 0 ? pieces->items[i].area * (surface / total) : surface / pieces->count;
    return true;
}

void sp_pieces_free(sp_pieces *pieces)
{
    free(pieces->items);
    sp_cover_free(&pieces->cover);
    *pieces = (sp_pieces){0};
}
