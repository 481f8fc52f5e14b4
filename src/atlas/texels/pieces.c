/* How a triangle's area on the surface is shared among its texels. */
#include "atlas/texels/texels.h"
#include "mesh/min_max.h"

#include <math.h>
#include <stdlib.h>

#define LEAST_SHARE 1e-15 /* of the triangle: no texel is without area, whatever rounding says */

static bool add_row(sp_pieces *pieces, const sp_atlas *atlas, uint32_t triangle)
{
    const sp_raster *raster = &pieces->raster;
    if (pieces->capacity - pieces->count < raster->count) {
        size_t capacity = 2 * pieces->capacity + raster->count + 64;
        sp_texel_piece *items = realloc(pieces->items, capacity * sizeof *items);
        if (!items)
            return false;
        pieces->items = items;
        pieces->capacity = capacity;
    }
    uint32_t texel = sp_atlas_row_texel(atlas, triangle, raster);
    for (uint32_t i = 0; i < raster->count; i++)
        pieces->items[pieces->count + i].texel = texel + i;
    for (size_t at = sp_atlas_shared_from(atlas, texel);
         at < atlas->shared_count && atlas->shared[at].pixel - texel < raster->count; at++)
        if (atlas->shared[at].triangle == triangle)
            pieces->items[pieces->count + (atlas->shared[at].pixel - texel)].texel = atlas->shared[at].texel;
    pieces->count += raster->count;
    return true;
}

static void measure_row(sp_pieces *pieces)
{
    const sp_raster *raster = &pieces->raster;
    sp_texel_piece *row = pieces->items + (pieces->count - raster->count);
    for (uint32_t i = 0; i < raster->count; i++)
        row[i].area = sp_greater(raster->area[i], LEAST_SHARE * raster->flat);
}

bool sp_pieces_of(sp_pieces *pieces, const sp_atlas *atlas, const sp_mesh *mesh, uint32_t triangle)
{
    pieces->count = 0;
    if (!sp_atlas_rasterize(atlas, triangle, SP_RASTER_AREAS, &pieces->raster))
        return false;
    while (sp_raster_next(&pieces->raster)) {
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

static bool visit_row(const sp_texel_piece *items, const piece_row *row, const piece_row *below,
                      sp_pieces_visitor *visit, void *user)
{
    const sp_texel_piece *own = items + row->first, *other = items + below->first;
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
    const sp_raster *raster = &pieces->raster;
    pieces->count = 0;
    if (!sp_atlas_rasterize(atlas, triangle, SP_RASTER_PIXELS, &pieces->raster))
        return false;
    piece_row below = {0};
    while (sp_raster_next(&pieces->raster)) {
        piece_row row = {raster->x, raster->y, raster->count, pieces->count};
        if (!add_row(pieces, atlas, triangle) || !visit_row(pieces->items, &row, &below, visit, user))
            return false;
        below = row;
    }
    return true;
}

void sp_pieces_free(sp_pieces *pieces)
{
    free(pieces->items);
    sp_raster_free(&pieces->raster);
    *pieces = (sp_pieces){0};
}
