/* Which texels touch: inside a triangle, and across the edges of the mesh whether or not the atlas is cut there. Two
 * lips of a cut that merely lie side by side on the page do not touch. */
#include "mesh/key_sort.h"
#include "atlas/texels/texels.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
    uint64_t *items; /* first texel in the upper half, second in the lower; both ways round */
    size_t count, capacity;
} pairs;

static bool add_pair(pairs *p, uint32_t a, uint32_t b)
{
    if (a == b)
        return true;
    if (p->capacity - p->count < 2) {
        size_t capacity = p->capacity ? 2 * p->capacity : 4096;
        uint64_t *items = realloc(p->items, capacity * sizeof *items);
        if (!items)
            return false;
        p->items = items;
        p->capacity = capacity;
    }
    p->items[p->count++] = (uint64_t)a << 32 | b;
    p->items[p->count++] = (uint64_t)b << 32 | a;
    return true;
}

static bool pair_sides(void *user, uint32_t a, uint32_t b, uint32_t x, uint32_t y, bool above)
{
    (void)x;
    (void)y;
    (void)above;
    return add_pair(user, a, b);
}

/* Where two sides of an edge that is not cut meet a corner of the pixels, round-off may name two texels across it. */
static bool only_diagonal(const sp_atlas *atlas, uint32_t a, uint32_t b)
{
    sp_texel_place p = sp_atlas_place(atlas, a), q = sp_atlas_place(atlas, b);
    return p.x != q.x && p.y != q.y;
}

/* Pairs across every edge that two or more triangles share, whichever way they face. */
static bool pair_edges(pairs *p, const sp_atlas *atlas, const sp_mesh *mesh, sp_error *error)
{
    sp_half_edges edges = {0};
    sp_edge_walk walk = {0};
    bool done = sp_half_edges_create(mesh, &edges, error);
    for (size_t i = 0, of_edge; done && i < 3 * mesh->triangle_count; i += of_edge) {
        of_edge = sp_half_edges_of_edge(mesh, &edges, i);
        for (size_t k = 1; done && k < of_edge; k++) {
            uint32_t a = edges.order[i + k - 1], b = edges.order[i + k];
            bool cut = sp_edge_is_cut(atlas, mesh, a, b);
            done = sp_edge_walk_begin(&walk, atlas, mesh, a, b);
            while (done && sp_edge_walk_next(&walk, atlas))
                if (cut || (walk.texel_a != walk.texel_b && !only_diagonal(atlas, walk.texel_a, walk.texel_b)))
                    done = add_pair(p, walk.texel_a, walk.texel_b);
        }
    }
    sp_edge_walk_free(&walk);
    sp_half_edges_destroy(&edges);
    return done;
}

static bool collect(sp_texel_links *links, const sp_atlas *atlas, pairs *p, sp_error *error)
{
    if (p->count && !sp_sort_keys(p->items, p->count))
        return sp_fail_memory(error);
    size_t unique = 0;
    for (size_t i = 0; i < p->count; i++)
        if (i == 0 || p->items[i] != p->items[i - 1])
            p->items[unique++] = p->items[i];
    links->start = calloc(atlas->texel_count + 1, sizeof *links->start);
    links->items = malloc((unique + !unique) * sizeof *links->items);
    if (!links->start || !links->items)
        return sp_fail_memory(error);
    if (unique >= SP_NONE)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "a texel of %g m has more than 2^32 neighbours on the surface", atlas->texel);
    for (size_t i = 0; i < unique; i++) {
        links->start[(p->items[i] >> 32) + 1]++;
        links->items[i] = (uint32_t)p->items[i];
    }
    for (size_t i = 0; i < atlas->texel_count; i++)
        links->start[i + 1] += links->start[i];
    return true;
}

bool sp_texel_links_create(sp_texel_links *links, const sp_atlas *atlas, const sp_mesh *mesh, sp_error *error)
{
    *links = (sp_texel_links){0};
    if (!atlas || !mesh)
        return false;
    pairs p = {0};
    sp_pieces pieces = {0};
    bool done = true;
    for (uint32_t t = 0; t < mesh->triangle_count && done; t++)
        done = sp_pieces_sides(&pieces, atlas, t, pair_sides, &p);
    done = done && pair_edges(&p, atlas, mesh, error) && collect(links, atlas, &p, error);
    free(p.items);
    sp_pieces_free(&pieces);
    if (done)
        return true;
    sp_texel_links_destroy(links);
    return sp_fail_memory(error);
}

void sp_texel_links_destroy(sp_texel_links *links)
{
    free(links->start);
    free(links->items);
    *links = (sp_texel_links){0};
}
