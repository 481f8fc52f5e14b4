/* Pixels that several patches cross. Only where a cut or a crease passes can a pixel hold more than one: elsewhere the
 * chart goes on in all directions. There the pixel's triangles are joined wherever they touch along an edge of the mesh
 * inside the pixel, which says what is one patch of the surface however the chart was cut; but not across a crease,
 * where liquid that wets one face may miss the other, and a patch of both were judged by either of them. */
#include "mesh/adjacent.h"
#include "mesh/bits.h"
#include "mesh/key_sort.h"
#include "atlas/texels/texels.h"
#include "mesh/min_max.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NEAR 1e-6 /* pixels: a cut that runs along a border is on both sides of it */

typedef struct {
    uint64_t *items; /* pixel in the upper half, triangle in the lower */
    size_t count, capacity;
} pairs;

static bool add_pair(pairs *p, uint32_t pixel, uint32_t triangle)
{
    if (p->count == p->capacity) {
        size_t capacity = p->capacity ? p->capacity + p->capacity / 2 : 4096;
        uint64_t *items = realloc(p->items, capacity * sizeof *items);
        if (!items)
            return false;
        p->items = items;
        p->capacity = capacity;
    }
    p->items[p->count++] = (uint64_t)pixel << 32 | triangle;
    return true;
}

/* Marks the pixels that one side of a cut passes. */
static bool mark_side(const sp_atlas *atlas, uint32_t half_edge, uint64_t *bits, size_t row_words,
                      sp_crossings *crossings)
{
    uint64_t *page = bits + (size_t)atlas->chart_page[atlas->chart[half_edge / 3]] * atlas->page_edge * row_words;
    double p[2], q[2], edge = atlas->page_edge;
    sp_edge_point(atlas, half_edge, 0, p);
    sp_edge_point(atlas, half_edge, 1, q);
    if (!sp_crossings_of(crossings, p, q))
        return false;
    for (size_t i = 1; i < crossings->count; i++) {
        double part = 0.5 * (crossings->items[i - 1] + crossings->items[i]);
        double x = p[0] + part * (q[0] - p[0]), y = p[1] + part * (q[1] - p[1]);
        for (int k = 0; k < 4; k++) {
            double at_x = floor(x + (k & 1 ? NEAR : -NEAR)), at_y = floor(y + (k & 2 ? NEAR : -NEAR));
            if (at_x >= 0 && at_y >= 0 && at_x < edge && at_y < edge)
                sp_bits_fill(page + (size_t)at_y * row_words, (size_t)at_x, 1);
        }
    }
    return true;
}

/* Marks the pixels that cuts pass, open edges among them, and creases. */
static bool mark_cuts(const sp_atlas *atlas, const sp_half_edges *edges, const sp_mesh *mesh, uint64_t *bits,
                      size_t row_words)
{
    sp_crossings crossings = {0};
    bool done = true;
    for (uint32_t h = 0; done && h < 3 * atlas->triangle_count; h++) {
        uint32_t other = edges->opposite[h];
        if (other == SP_NONE || sp_edge_is_cut(atlas, mesh, h, other) || sp_edge_is_crease(mesh, h, other))
            done = mark_side(atlas, h, bits, row_words, &crossings);
    }
    free(crossings.items);
    return done;
}

/* The triangles in the marked pixels. */
static bool list_triangles(const sp_atlas *atlas, const uint64_t *bits, size_t row_words, pairs *p)
{
    sp_raster raster = {0};
    for (uint32_t t = 0; t < atlas->triangle_count; t++) {
        const uint64_t *page = bits + (size_t)atlas->chart_page[atlas->chart[t]] * atlas->page_edge * row_words;
        if (!sp_atlas_rasterize(atlas, t, SP_RASTER_PIXELS, &raster))
            return false;
        while (sp_raster_next(&raster)) {
            const uint64_t *row = page + raster.y * row_words;
            size_t end = (size_t)raster.x + raster.count, x = sp_bits_find(row, raster.x, end, true);
            uint32_t texel = x < end ? sp_atlas_row_texel(atlas, t, &raster) : 0;
            for (; x < end; x = sp_bits_find(row, x + 1, end, true))
                if (!add_pair(p, texel + (uint32_t)(x - raster.x), t))
                    return false;
        }
    }
    return p->count == 0 || sp_sort_keys(p->items, p->count);
}

/* The part of a half-edge inside the square at (x, y), but for round-off, as parts of the edge; empty where from >= to.
 */
static void clip_edge(const sp_atlas *atlas, uint32_t half_edge, double x, double y, double *from, double *to)
{
    double p[2], q[2];
    const double low[2] = {x - SP_SLIVER, y - SP_SLIVER}, high[2] = {x + 1 + SP_SLIVER, y + 1 + SP_SLIVER};
    sp_edge_point(atlas, half_edge, 0, p);
    sp_edge_point(atlas, half_edge, 1, q);
    *from = 0;
    *to = 1;
    for (int k = 0; k < 2; k++) {
        double step = q[k] - p[k];
        if (step == 0) {
            if (p[k] < low[k] || p[k] > high[k])
                *to = -1;
            continue;
        }
        double a = (low[k] - p[k]) / step, b = (high[k] - p[k]) / step;
        *from = sp_greater(*from, sp_lesser(a, b));
        *to = sp_lesser(*to, sp_greater(a, b));
    }
}

/* Whether the two sides of an edge are in one pixel at one place of the edge. */
static bool meet_in(const sp_atlas *atlas, uint32_t a, uint32_t b, sp_texel_place at)
{
    double from_a, to_a, from_b, to_b;
    clip_edge(atlas, a, at.x, at.y, &from_a, &to_a);
    clip_edge(atlas, b, at.x, at.y, &from_b, &to_b);
    return from_a < to_a && from_b < to_b && sp_greater(from_a, 1 - to_b) < sp_lesser(to_a, 1 - from_b);
}

/* The triangles of one pixel, as their pairs, and the patches that they make. */
typedef struct {
    const uint64_t *pairs; /* [count] */
    size_t count, capacity;
    uint32_t *root;  /* [count], index of the patch's lowest triangle, its own where it is that */
    double *area;    /* [count], at a root: of the patch */
    uint32_t *texel; /* [count], at a root: of the patch */
} group;

static void free_group(group *g)
{
    free(g->root);
    free(g->area);
    free(g->texel);
}

static bool room(group *g, size_t count)
{
    if (count <= g->capacity)
        return true;
    free_group(g);
    g->root = malloc(2 * count * sizeof *g->root);
    g->area = malloc(2 * count * sizeof *g->area);
    g->texel = malloc(2 * count * sizeof *g->texel);
    g->capacity = g->root && g->area && g->texel ? 2 * count : 0;
    return g->capacity;
}

static size_t index_of(const group *g, uint32_t triangle)
{
    size_t low = 0, high = g->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if ((uint32_t)g->pairs[middle] < triangle)
            low = middle + 1;
        else
            high = middle;
    }
    return low < g->count && (uint32_t)g->pairs[low] == triangle ? low : SIZE_MAX;
}

static uint32_t root_of(const group *g, uint32_t i)
{
    while (g->root[i] != i)
        i = g->root[i] = g->root[g->root[i]];
    return i;
}

/* Returns how many patches the group makes. */
static size_t join(group *g, const sp_atlas *atlas, const sp_mesh *mesh, const sp_half_edges *edges)
{
    sp_texel_place at = sp_atlas_place(atlas, (uint32_t)(g->pairs[0] >> 32));
    size_t patches = g->count;
    for (uint32_t i = 0; i < g->count; i++)
        g->root[i] = i;
    for (uint32_t i = 0; i < g->count && patches > 1; i++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t h = 3 * (uint32_t)g->pairs[i] + k, other = edges->opposite[h];
            size_t j = other == SP_NONE || other < h ? SIZE_MAX : index_of(g, other / 3);
            if (j == SIZE_MAX || sp_edge_is_crease(mesh, h, other) || !meet_in(atlas, h, other, at))
                continue;
            uint32_t a = root_of(g, i), b = root_of(g, (uint32_t)j);
            patches -= a != b;
            g->root[a > b ? a : b] = a > b ? b : a;
        }
    return patches;
}

static void measure(group *g, const sp_atlas *atlas, const sp_mesh *mesh)
{
    sp_texel_place at = sp_atlas_place(atlas, (uint32_t)(g->pairs[0] >> 32));
    for (size_t i = 0; i < g->count; i++)
        g->area[i] = 0;
    for (uint32_t i = 0; i < g->count; i++)
        g->area[root_of(g, i)] += sp_piece_area(atlas, mesh, (uint32_t)g->pairs[i], at.x, at.y);
}

/* Numbers the patches: the largest has the pixel's own number. */
static void number(group *g, sp_atlas *atlas)
{
    uint32_t pixel = (uint32_t)(g->pairs[0] >> 32), largest = 0;
    for (uint32_t i = 0; i < g->count; i++)
        if (g->root[i] == i && g->area[i] > g->area[largest])
            largest = i;
    g->texel[largest] = pixel;
    assert(!atlas->shared_count || atlas->shared[atlas->shared_count - 1].pixel < pixel);
    for (uint32_t i = 0; i < g->count; i++)
        if (g->root[i] == i && i != largest) {
            g->texel[i] = (uint32_t)atlas->texel_count;
            atlas->behind[atlas->texel_count++ - atlas->pixel_count] = pixel;
        }
    for (uint32_t i = 0; i < g->count; i++)
        atlas->shared[atlas->shared_count++] = (sp_shared_pixel){pixel, (uint32_t)g->pairs[i], g->texel[root_of(g, i)]};
}

/* Room for as many further texels and shared entries. */
static bool grow(sp_atlas *atlas, size_t patches, size_t entries)
{
    size_t behind = atlas->texel_count - atlas->pixel_count + patches, shared = atlas->shared_count + entries;
    uint32_t *grown = realloc(atlas->behind, (behind + 1) * sizeof *grown);
    if (grown)
        atlas->behind = grown;
    sp_shared_pixel *more = realloc(atlas->shared, (shared + 1) * sizeof *more);
    if (more)
        atlas->shared = more;
    return grown && more;
}

/* Pixels are seen in ascending order, so that their entries are ordered too. */
static bool split_pixels(sp_atlas *atlas, const sp_mesh *mesh, const sp_half_edges *edges, const pairs *p)
{
    group g = {0};
    bool done = true;
    for (size_t i = 0, end; done && i < p->count; i = end) {
        for (end = i + 1; end < p->count && p->items[end] >> 32 == p->items[i] >> 32;)
            end++;
        g.pairs = p->items + i;
        g.count = end - i;
        if (g.count == 1)
            continue;
        done = room(&g, g.count);
        size_t patches = done ? join(&g, atlas, mesh, edges) : 1;
        if (patches == 1)
            continue;
        done = grow(atlas, patches - 1, g.count);
        if (done) {
            measure(&g, atlas, mesh);
            number(&g, atlas);
        }
    }
    free_group(&g);
    return done;
}

bool sp_atlas_share_pixels(sp_atlas *atlas, const sp_mesh *mesh, const sp_half_edges *edges, sp_error *error)
{
    size_t rows = atlas->page_count * atlas->page_edge, row_words = sp_bits_words(atlas->page_edge);
    uint64_t *bits = calloc(rows * row_words + 1, sizeof *bits);
    pairs p = {0};
    bool done = bits && mark_cuts(atlas, edges, mesh, bits, row_words) && list_triangles(atlas, bits, row_words, &p);
    free(bits);
    done = done && split_pixels(atlas, mesh, edges, &p);
    free(p.items);
    return done || sp_fail_memory(error);
}

bool sp_atlas_count_shared(const sp_atlas *atlas, const sp_mesh *mesh, size_t *shared, sp_error *error)
{
    sp_fragments fragments = {0};
    sp_half_edges edges = {0};
    group g = {0};
    pairs p = {0};
    *shared = 0;
    bool done = sp_fragments_create(&fragments, atlas, mesh, error) && sp_adjacent_create(mesh, &edges, error);
    for (uint32_t texel = 0; done && texel < atlas->texel_count; texel++) {
        p.count = 0;
        for (uint32_t f = fragments.start[texel]; done && f < fragments.start[texel + 1]; f++)
            done = add_pair(&p, texel, fragments.items[f].triangle);
        g.pairs = p.items;
        g.count = p.count;
        done = done && room(&g, g.count + 1);
        *shared += done && join(&g, atlas, mesh, &edges) != 1;
    }
    free_group(&g);
    free(p.items);
    sp_half_edges_destroy(&edges);
    sp_fragments_destroy(&fragments);
    return done || sp_fail_memory(error);
}
