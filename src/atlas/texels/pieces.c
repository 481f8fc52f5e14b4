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

/* A row of the triangle's pixels: where it begins among its pieces. */
typedef struct {
    uint32_t x, y, count;
    size_t first;
} piece_row;

bool sp_pieces_sides(sp_pieces *pieces, const sp_atlas *atlas, const sp_mesh *mesh, uint32_t triangle,
                     sp_pieces_visitor *visit, void *user)
{
    if (!sp_pieces_of(pieces, atlas, mesh, triangle) ||
        !sp_atlas_cover(atlas, triangle, SP_COVER_PIXELS, &pieces->cover))
        return false;
    const sp_cover *cover = &pieces->cover;
    const sp_piece *items = pieces->items;
    piece_row below = {0};
    for (size_t first = 0; sp_cover_next(&pieces->cover); first += cover->count) {
        for (uint32_t i = 1; i < cover->count; i++)
            if (!visit(user, items[first + i - 1].texel, items[first + i].texel, cover->x + i - 1, cover->y, false))
                return false;
        uint32_t from = cover->x > below.x ? cover->x : below.x, end = cover->x + cover->count;
        end = end < below.x + below.count ? end : below.x + below.count;
        for (uint32_t x = from; below.y + 1 == cover->y && x < end; x++)
            if (!visit(user, items[below.first + (x - below.x)].texel, items[first + (x - cover->x)].texel, x, below.y,
                       true))
                return false;
        below = (piece_row){cover->x, cover->y, cover->count, first};
    }
    return true;
}

void sp_pieces_free(sp_pieces *pieces)
{
    free(pieces->items);
    sp_cover_free(&pieces->cover);
    *pieces = (sp_pieces){0};
}
