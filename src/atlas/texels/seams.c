/* What touches across cuts: both sides of an edge are followed at once, from one border of pixels to the next. */
#include "mesh/key_sort.h"
#include "atlas/texels/texels.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    sp_seam *items;
    size_t count, capacity;
} seams;

/* Adds the piece of an edge that the walk is at. */
static bool add_seam(seams *s, const sp_edge_walk *walk, double length)
{
    uint32_t texel = walk->texel_a, other = walk->texel_b;
    if (texel == other || !(length > 0))
        return true;
    sp_seam *last = s->count ? &s->items[s->count - 1] : NULL;
    if (last && last->texel == texel && last->other == other && last->edge == walk->a && last->across == walk->b) {
        last->length += (float)length;
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
    s->items[s->count++] = (sp_seam){texel, other, walk->a, walk->b, (float)length};
    return true;
}

static uint32_t texel_at(const sp_atlas *atlas, uint32_t half_edge, double part)
{
    double u, v;
    sp_edge_weights(half_edge, part, &u, &v);
    return sp_atlas_texel(atlas, half_edge / 3, u, v);
}

bool sp_edge_walk_begin_on(sp_edge_walk *walk, const sp_atlas *atlas, uint32_t a, const double on_a[2], uint32_t b,
                           const double on_b[2])
{
    double p[2], q[2];
    walk->a = a;
    walk->b = b;
    walk->at_a = walk->at_b = 1;
    walk->to = 0;
    for (int side = 0; side < 2; side++) {
        double *way = walk->way[side];
        memcpy(way, side ? on_b : on_a, 2 * sizeof *way);
        sp_edge_point(atlas, side ? b : a, way[0], p);
        sp_edge_point(atlas, side ? b : a, way[1], q);
        if (!sp_crossings_of(&walk->crossings[side], p, q))
            return false;
    }
    return true;
}

bool sp_edge_walk_begin(sp_edge_walk *walk, const sp_atlas *atlas, const sp_mesh *mesh, uint32_t a, uint32_t b)
{
    static const double ahead[2] = {0, 1}, back[2] = {1, 0};
    return sp_edge_walk_begin_on(walk, atlas, a, ahead, b, sp_edge_is_opposite(mesh, a, b) ? back : ahead);
}

/* A part of a half-edge, at that part of the way along it. */
static double part_at(const double way[2], double part)
{
    return way[0] + part * (way[1] - way[0]);
}

bool sp_edge_walk_next(sp_edge_walk *walk, const sp_atlas *atlas)
{
    if (walk->to >= 1)
        return false;
    walk->from = walk->to;
    double next_a = walk->crossings[0].items[walk->at_a], next_b = walk->crossings[1].items[walk->at_b];
    walk->to = fmin(next_a, next_b);
    assert(walk->from <= walk->to);
    walk->at_a += next_a <= next_b;
    walk->at_b += next_b <= next_a;
    double middle = 0.5 * (walk->from + walk->to);
    walk->texel_a = texel_at(atlas, walk->a, part_at(walk->way[0], middle));
    walk->texel_b = texel_at(atlas, walk->b, part_at(walk->way[1], middle));
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
        if (!add_seam(s, walk, (walk->to - walk->from) * length))
            return false;
    return true;
}

/* Every second one is the one before it seen from the other side. */
static sp_seam seam_at(const seams *s, size_t i)
{
    sp_seam seam = s->items[i / 2];
    return i % 2 ? (sp_seam){seam.other, seam.texel, seam.across, seam.edge, seam.length} : seam;
}

/* The order of all seams, either way round, by texel and other; NULL when memory runs out. */
static uint32_t *order_of(const seams *s)
{
    size_t count = 2 * s->count;
    uint64_t *keys = malloc((count + 1) * sizeof *keys);
    uint32_t *order = malloc((count + 1) * sizeof *order);
    bool done = keys && order;
    for (size_t i = 0; done && i < count; i++) {
        sp_seam seam = seam_at(s, i);
        keys[i] = (uint64_t)seam.texel << 32 | seam.other;
    }
    done = done && (count == 0 || sp_order_by_key(keys, count, order));
    free(keys);
    if (done)
        return order;
    free(order);
    return NULL;
}

/* Joins the seams of the same texels, keeping the edge of the longest, and adds each the other way round. */
static bool collect(sp_atlas *atlas, const seams *s)
{
    uint32_t *order = s->count < SP_NONE / 2 ? order_of(s) : NULL;
    atlas->seams = order ? malloc((2 * s->count + 1) * sizeof *atlas->seams) : NULL;
    bool done = atlas->seams;
    size_t count = 0;
    float longest = 0;
    for (size_t i = 0; done && i < 2 * s->count; i++) {
        sp_seam piece = seam_at(s, order[i]), *last = count ? &atlas->seams[count - 1] : NULL;
        assert(!last || last->texel < piece.texel || (last->texel == piece.texel && last->other <= piece.other));
        if (!last || last->texel != piece.texel || last->other != piece.other) {
            atlas->seams[count++] = piece;
            longest = piece.length;
            continue;
        }
        last->length += piece.length;
        if (piece.length <= longest)
            continue;
        longest = piece.length;
        last->edge = piece.edge;
        last->across = piece.across;
    }
    atlas->seam_count = count;
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
    sp_seam *fitting = done ? realloc(s.items, (s.count + 1) * sizeof *fitting) : NULL;
    if (fitting)
        s.items = fitting;
    done = done && collect(atlas, &s);
    free(s.items);
    return done || sp_fail_memory(error);
}

void sp_atlas_across(const sp_atlas *atlas, const sp_mesh *mesh, const sp_seam *seam, const double place[2],
                     double there[2])
{
    bool opposite = sp_edge_is_opposite(mesh, seam->edge, seam->across);
    double a[2], b[2], to[2], from[2];
    sp_edge_point(atlas, seam->edge, 0, a);
    sp_edge_point(atlas, seam->edge, 1, b);
    sp_edge_point(atlas, seam->across, opposite ? 1 : 0, from);
    sp_edge_point(atlas, seam->across, opposite ? 0 : 1, to);
    double x = b[0] - a[0], y = b[1] - a[1], u = to[0] - from[0], v = to[1] - from[1];
    double length = hypot(x, y), other = hypot(u, v), inverse = length > 0 ? 1 / length : 0;
    double along = inverse * inverse * ((place[0] - a[0]) * x + (place[1] - a[1]) * y);
    double beyond = inverse * ((place[0] - a[0]) * y - (place[1] - a[1]) * x); /* right of the edge, < 0 inside */
    double away = other > 0 ? (opposite ? -beyond : beyond) / other : 0;       /* left of it, seen from there */
    there[0] = from[0] + along * u - away * v;
    there[1] = from[1] + along * v + away * u;
}
