/* How a triangle's area on the surface is shared among its texels. */
#include "atlas/texels/texels.h"
#include "mesh/lesser.h"

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
        pieces->items[pieces->count + i].texel = texel + i;
    for (size_t at = sp_atlas_shared_from(atlas, texel);
         at < atlas->shared_count && atlas->shared[at].pixel - texel < cover->count; at++)
        if (atlas->shared[at].triangle == triangle)
            pieces->items[pieces->count + (atlas->shared[at].pixel - texel)].texel = atlas->shared[at].texel;
    pieces->count += cover->count;
    return true;
}

static void measure_row(sp_pieces *pieces)
{
    const sp_cover *cover = &pieces->cover;
    sp_piece *row = pieces->items + (pieces->count - cover->count);
    for (uint32_t i = 0; i < cover->count; i++)
        row[i].area = sp_greater(cover->area[i], LEAST_SHARE * cover->flat);
}

bool sp_pieces_of(sp_pieces *pieces, const sp_atlas *atlas, const sp_mesh *mesh, uint32_t triangle)
{
    pieces->count = 0;
    if (!sp_atlas_cover(atlas, triangle, SP_COVER_AREAS, &pieces->cover))
        return false;
    while (sp_cover_next(&pieces->cover)) {
        if (!add_row(pieces, atlas, triangle))
            return false;
        measure_row(pieces);
    }
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

static bool visit_row(const sp_piece *items, const piece_row *row, const piece_row *below, sp_pieces_visitor *visit,
                      void *user)
{
    const sp_piece *own = items + row->first, *other = items + below->first;
    for (uint32_t i = 1; i < row->count; i++)
        if (!visit(user, own[i - 1].texel, own[i].texel, row->x + i - 1, row->y, false))
            return false;
    uint32_t from = row->x > below->x ? row->x : below->x, end = row->x + row->count;
    end = end < below->x + below->count ? end : below->x + below->count;
    for (uint32_t x = from; below->y + 1 == row->y && x < end; x++)
        if (!visit(user, other[x - below->x].texel, own[x - row->x].texel, x, below->y, true))
            return false;
    return true;
}

bool sp_pieces_sides(sp_pieces *pieces, const sp_atlas *atlas, uint32_t triangle, sp_pieces_visitor *visit, void *user)
{
    const sp_cover *cover = &pieces->cover;
    pieces->count = 0;
    if (!sp_atlas_cover(atlas, triangle, SP_COVER_PIXELS, &pieces->cover))
        return false;
    piece_row below = {0};
    while (sp_cover_next(&pieces->cover)) {
        piece_row row = {cover->x, cover->y, cover->count, pieces->count};
        if (!add_row(pieces, atlas, triangle) || !visit_row(pieces->items, &row, &below, visit, user))
            return false;
        below = row;
    }
    return true;
}

void sp_pieces_free(sp_pieces *pieces)
{
    free(pieces->items);
    sp_cover_free(&pieces->cover);
    *pieces = (sp_pieces){0};
}
