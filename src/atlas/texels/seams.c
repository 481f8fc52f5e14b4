/* What touches across cuts: both sides of an edge are followed at once, from one border of pixels to the next. */
#include "atlas/order.h"
#include "atlas/texels/texels.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
    sp_seam *items;
    size_t count, capacity;
} seams;

static bool add_seam(seams *s, uint32_t texel, uint32_t other, double length)
{
    if (texel == other || !(length > 0))
        return true;
    if (s->count && s->items[s->count - 1].texel == texel && s->items[s->count - 1].other == other) {
        s->items[s->count - 1].length += length;
        return true;
    }
    if (s->count == s->capacity) {
        size_t capacity = s->capacity ? s->capacity + s->capacity / 2 : 1024;
        sp_seam *items = realloc(s->items, capacity * sizeof *items);
        if (!items)
            return false;
        s->items = items;
        s->capacity = capacity;
    }
    s->items[s->count++] = (sp_seam){texel, other, length};
    return true;
}

static uint32_t texel_at(const sp_atlas *atlas, uint32_t half_edge, double part)
{
    double u, v;
    sp_edge_weights(half_edge, part, &u, &v);
    return sp_atlas_texel(atlas, half_edge / 3, u, v);
}

bool sp_edge_walk_begin(sp_edge_walk *walk, const sp_atlas *atlas, const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    double p[2], q[2];
    walk->a = a;
    walk->b = b;
    walk->opposite = sp_edge_is_opposite(mesh, a, b);
    walk->at_a = walk->at_b = 1;
    walk->to = 0;
    for (int side = 0; side < 2; side++) {
        sp_edge_point(atlas, side ? b : a, side && walk->opposite ? 1 : 0, p);
        sp_edge_point(atlas, side ? b : a, side && walk->opposite ? 0 : 1, q);
        if (!sp_crossings_of(&walk->crossings[side], p, q))
            return false;
    }
    return true;
}

bool sp_edge_walk_next(sp_edge_walk *walk, const sp_atlas *atlas)
{
    if (walk->to >= 1)
        return false;
    walk->from = walk->to;
    double next_a = walk->crossings[0].items[walk->at_a], next_b = walk->crossings[1].items[walk->at_b];
    walk->to = fmin(next_a, next_b);
    walk->at_a += next_a <= next_b;
    walk->at_b += next_b <= next_a;
    double middle = 0.5 * (walk->from + walk->to);
    walk->texel_a = texel_at(atlas, walk->a, middle);
    walk->texel_b = texel_at(atlas, walk->b, walk->opposite ? 1 - middle : middle);
    return true;
}

void sp_edge_walk_free(sp_edge_walk *walk)
{
    free(walk->crossings[0].items);
    free(walk->crossings[1].items);
}

static bool walk_cut(seams *s, sp_edge_walk *walk, const sp_atlas *atlas, const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    double length = sp_distance(mesh->vertices[sp_half_edge_from(mesh, a)], mesh->vertices[sp_half_edge_to(mesh, a)]);
    if (!sp_edge_walk_begin(walk, atlas, mesh, a, b))
        return false;
    while (sp_edge_walk_next(walk, atlas))
        if (!add_seam(s, walk->texel_a, walk->texel_b, (walk->to - walk->from) * length))
            return false;
    return true;
}

/* Sorts the seams, joins those of the same texels, and adds each the other way round. */
static bool collect(sp_atlas *atlas, const seams *s)
{
    uint64_t *keys = malloc((2 * s->count + 1) * sizeof *keys);
    uint32_t *order = malloc((2 * s->count + 1) * sizeof *order);
    atlas->seams = malloc((2 * s->count + 1) * sizeof *atlas->seams);
    bool done = keys && order && atlas->seams && s->count < SP_NONE / 2;
    for (size_t i = 0; done && i < s->count; i++) {
        keys[2 * i] = (uint64_t)s->items[i].texel << 32 | s->items[i].other;
        keys[2 * i + 1] = (uint64_t)s->items[i].other << 32 | s->items[i].texel;
    }
    done = done && (s->count == 0 || sp_order_by_key(keys, 2 * s->count, order));
    size_t count = 0;
    for (size_t i = 0; done && i < 2 * s->count; i++) {
        uint64_t key = keys[order[i]];
        double length = s->items[order[i] / 2].length;
        if (i && key == keys[order[i - 1]])
            atlas->seams[count - 1].length += length;
        else
            atlas->seams[count++] = (sp_seam){(uint32_t)(key >> 32), (uint32_t)key, length};
    }
    atlas->seam_count = count;
    free(keys);
    free(order);
    sp_seam *fitting = done ? realloc(atlas->seams, (count + 1) * sizeof *fitting) : NULL;
    if (fitting)
        atlas->seams = fitting;
    return done;
}

bool sp_atlas_find_seams(sp_atlas *atlas, const sp_mesh *mesh, const sp_half_edges *edges, sp_error *error)
{
    seams s = {0};
    sp_edge_walk walk = {0};
    bool done = true;
    for (size_t i = 0, of_edge; done && i < 3 * mesh->triangle_count; i += of_edge) {
        of_edge = sp_half_edges_of_edge(mesh, edges, i);
        for (size_t k = 1; done && k < of_edge; k++) {
            uint32_t a = edges->order[i + k - 1], b = edges->order[i + k];
            done = !sp_edge_is_cut(atlas, mesh, a, b) || walk_cut(&s, &walk, atlas, mesh, a, b);
        }
    }
    sp_edge_walk_free(&walk);
    done = done && collect(atlas, &s);
    free(s.items);
    return done || sp_fail_memory(error);
}
