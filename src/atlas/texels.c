/* Cuts the laid triangles by the squares of the pages. */
#include "atlas/texels.h"

#include "atlas/order.h"

#include <math.h>
#include <stdlib.h>

/* Pieces smaller than this part of the triangle and of a texel are round-off at a texel's border and make no fragment.
 */
#define SLIVER 1e-9

typedef struct {
    uint64_t *key; /* page, then y, then x */
    sp_fragment *fragment;
    size_t count, capacity;
} pieces;

sp_local_triangle sp_local(const double uv[3][2])
{
    sp_local_triangle local;
    double low[2], high[2];
    for (int k = 0; k < 2; k++) {
        low[k] = floor(fmin(uv[0][k], fmin(uv[1][k], uv[2][k])));
        for (int i = 0; i < 3; i++)
            local.corner[i][k] = uv[i][k] - low[k];
        high[k] = fmax(local.corner[0][k], fmax(local.corner[1][k], local.corner[2][k]));
    }
    local.x = (uint32_t)low[0];
    local.y = (uint32_t)low[1];
    local.columns = (uint32_t)fmax(ceil(high[0]), 1);
    local.rows = (uint32_t)fmax(ceil(high[1]), 1);
    return local;
}

static bool add_piece(pieces *p, uint64_t key, uint32_t triangle, double weight)
{
    if (p->count == p->capacity) {
        size_t capacity = p->capacity ? 2 * p->capacity : 4096;
        uint64_t *key_grown = realloc(p->key, capacity * sizeof *key_grown);
        if (key_grown)
            p->key = key_grown;
        sp_fragment *fragment_grown = realloc(p->fragment, capacity * sizeof *fragment_grown);
        if (fragment_grown)
            p->fragment = fragment_grown;
        if (!key_grown || !fragment_grown)
            return false;
        p->capacity = capacity;
    }
    p->key[p->count] = key;
    p->fragment[p->count++] = (sp_fragment){triangle, weight};
    return true;
}

static uint64_t texel_key(const sp_atlas *atlas, uint32_t triangle, uint64_t x, uint64_t y)
{
    uint64_t edge = atlas->page_edge;
    return (atlas->chart_page[atlas->chart[triangle]] * edge + y) * edge + x;
}

typedef struct {
    double low, high;
} range;

static range range_of(const double (*points)[2], int count, int axis)
{
    range r = {INFINITY, -INFINITY};
    for (int i = 0; i < count; i++) {
        r.low = fmin(r.low, points[i][axis]);
        r.high = fmax(r.high, points[i][axis]);
    }
    return r;
}

static bool narrower(const sp_polygon *polygon, int axis, double least)
{
    range r = range_of((const double(*)[2])polygon->point, polygon->count, axis);
    return !(r.high - r.low >= least);
}

/* The triangle's pieces with their flat areas, without slivers; returns false when memory runs out. */
static bool cut_flat(pieces *p, const sp_atlas *atlas, uint32_t triangle, const sp_local_triangle *local)
{
    const double(*corner)[2] = (const double(*)[2])local->corner;
    range x = range_of(corner, 3, 0), y = range_of(corner, 3, 1);
    double least_x = SLIVER * fmin(1, x.high - x.low), least_y = SLIVER * fmin(1, y.high - y.low);
    for (uint32_t row = 0; row < local->rows; row++) {
        sp_polygon strip, cell;
        sp_clip_row(corner, row, &strip);
        if (narrower(&strip, 1, least_y))
            continue;
        range reach = range_of((const double(*)[2])strip.point, strip.count, 0);
        for (uint32_t column = (uint32_t)reach.low; column < reach.high && column < local->columns; column++) {
            sp_clip_column(&strip, column, &cell);
            double area = sp_polygon_area(&cell);
            if (area > 0 && !narrower(&cell, 0, least_x) && !narrower(&cell, 1, least_y) &&
                !add_piece(p, texel_key(atlas, triangle, local->x + column, local->y + row), triangle, area))
                return false;
        }
    }
    return true;
}

/* Shares the triangle's area on the surface among its pieces by their flat areas. A triangle too small or too thin to
 * have any area on the page belongs to the texel of its centroid. */
static bool cut_triangle(pieces *p, const sp_atlas *atlas, const sp_mesh *mesh, uint32_t triangle)
{
    sp_local_triangle local = sp_local((const double(*)[2])atlas->uv[triangle]);
    size_t begin = p->count;
    if (!cut_flat(p, atlas, triangle, &local))
        return false;
    double total = 0, surface = sp_triangle_area(mesh, triangle);
    for (size_t i = begin; i < p->count; i++)
        total += p->fragment[i].area;
    for (size_t i = begin; i < p->count; i++)
        p->fragment[i].area *= surface / total;
    if (begin < p->count)
        return true;
    double x = (local.corner[0][0] + local.corner[1][0] + local.corner[2][0]) / 3;
    double y = (local.corner[0][1] + local.corner[1][1] + local.corner[2][1]) / 3;
    uint32_t column = x < local.columns ? (uint32_t)x : local.columns - 1;
    uint32_t row = y < local.rows ? (uint32_t)y : local.rows - 1;
    return add_piece(p, texel_key(atlas, triangle, local.x + column, local.y + row), triangle, surface);
}

static void *array(size_t count, size_t size)
{
    return malloc((count + !count) * size);
}

static bool allocate(sp_atlas *atlas, size_t texels, size_t fragments)
{
    atlas->texel_count = texels;
    atlas->texel_page = array(texels, sizeof *atlas->texel_page);
    atlas->texel_x = array(texels, sizeof *atlas->texel_x);
    atlas->texel_y = array(texels, sizeof *atlas->texel_y);
    atlas->texel_chart = array(texels, sizeof *atlas->texel_chart);
    atlas->texel_area = array(texels, sizeof *atlas->texel_area);
    atlas->fragment_start = array(texels + 1, sizeof *atlas->fragment_start);
    atlas->fragments = array(fragments, sizeof *atlas->fragments);
    atlas->triangle_start = calloc(atlas->triangle_count + 1, sizeof *atlas->triangle_start);
    atlas->triangle_texels = array(fragments, sizeof *atlas->triangle_texels);
    return atlas->texel_page && atlas->texel_x && atlas->texel_y && atlas->texel_chart && atlas->texel_area &&
           atlas->fragment_start && atlas->fragments && atlas->triangle_start && atlas->triangle_texels;
}

/* Numbers the texels in the order of their keys. */
static void number_texels(sp_atlas *atlas, const pieces *p, const uint32_t *order)
{
    size_t texel = SIZE_MAX;
    uint64_t edge = atlas->page_edge;
    for (size_t i = 0; i < p->count; i++) {
        uint64_t key = p->key[order[i]];
        const sp_fragment *fragment = &p->fragment[order[i]];
        if (i == 0 || key != p->key[order[i - 1]]) {
            texel++;
            atlas->texel_x[texel] = (uint32_t)(key % edge);
            atlas->texel_y[texel] = (uint32_t)(key / edge % edge);
            atlas->texel_page[texel] = (uint32_t)(key / edge / edge);
            atlas->texel_chart[texel] = atlas->chart[fragment->triangle];
            atlas->texel_area[texel] = 0;
            atlas->fragment_start[texel] = (uint32_t)i;
        }
        atlas->fragments[i] = *fragment;
        atlas->texel_area[texel] += fragment->area;
    }
    atlas->fragment_start[atlas->texel_count] = (uint32_t)p->count;
}

/* Lists each triangle's own texels, ascending. */
static void list_own_texels(sp_atlas *atlas)
{
    uint32_t *start = atlas->triangle_start;
    for (size_t i = 0; i < atlas->fragment_start[atlas->texel_count]; i++)
        start[atlas->fragments[i].triangle + 1]++;
    for (size_t t = 0; t < atlas->triangle_count; t++)
        start[t + 1] += start[t];
    for (size_t texel = 0; texel < atlas->texel_count; texel++)
        for (uint32_t i = atlas->fragment_start[texel]; i < atlas->fragment_start[texel + 1]; i++)
            atlas->triangle_texels[start[atlas->fragments[i].triangle]++] = (uint32_t)texel;
    for (size_t t = atlas->triangle_count; t > 0; t--) /* filling moved each start to the next one's */
        start[t] = start[t - 1];
    start[0] = 0;
}

static bool collect(sp_atlas *atlas, const pieces *p, sp_error *error)
{
    if (p->count >= SP_NONE)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "a texel of %g m cuts the surface into more than 2^32 pieces",
                       atlas->texel);
    uint32_t *order = array(p->count, sizeof *order);
    bool done = order && sp_order_by_key(p->key, p->count, order);
    size_t texels = 0;
    for (size_t i = 0; done && i < p->count; i++)
        texels += i == 0 || p->key[order[i]] != p->key[order[i - 1]];
    done = done && allocate(atlas, texels, p->count);
    if (done) {
        number_texels(atlas, p, order);
        list_own_texels(atlas);
    } else {
        sp_fail_memory(error);
    }
    free(order);
    return done;
}

bool sp_atlas_cut(sp_atlas *atlas, const sp_mesh *mesh, sp_error *error)
{
    pieces p = {0};
    bool done = true;
    for (uint32_t t = 0; t < mesh->triangle_count && done; t++)
        done = cut_triangle(&p, atlas, mesh, t);
    if (done)
        done = collect(atlas, &p, error);
    else
        sp_fail_memory(error);
    free(p.key);
    free(p.fragment);
    return done;
}
