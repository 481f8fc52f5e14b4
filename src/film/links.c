#include "film/links.h"

#include "atlas/texels/borders.h"
#include "mesh/diagnosis/flaw.h"
#include "mesh/grow.h"
#include "mesh/min_max.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A piece of a border between two cells, the lower number first, or several, and what runs out of each. */
typedef struct {
    uint32_t cell[2];
    double across[2], length, crest;
} piece;

#define CRACK                                                                                                          \
    0.02 /* of the wave, half a millimetre of water, the thickness of a film: it goes on over such a crack             \
          */

enum { RECENT = 4096 };

typedef struct {
    const sp_film_surface *surface;
    sp_film_links *links;
    bool *wet;                   /* [charts], that have a cell */
    sp_vec3 *normals, *tangents; /* [triangles], unit */
    size_t count, capacity;
    piece *pieces;
    uint32_t recent[RECENT]; /* by a hash of its cells, a piece that may be of the same border */
} gathering;

sp_vec3 sp_film_tangent(sp_vec3 normal, sp_vec3 down)
{
    sp_vec3 along = sp_along(down, -sp_dot(down, normal), normal);
    return sp_length(along) < SP_FILM_FLAT ? sp_v(0, 0, 0) : sp_unit(along);
}

bool sp_film_is_flat(const sp_film_surface *surface, uint32_t cell)
{
    return !(sp_length(sp_film_tangent(surface->cells->normal[cell], surface->down)) > 0);
}

bool sp_film_is_open(const sp_film_surface *surface, const sp_film_links *links, uint32_t cell)
{
    if (!(links->end_length[cell] > 0))
        return false;
    double across = sp_film_is_flat(surface, cell) ? links->end_length[cell] : links->end_across[cell];
    return across > SP_FILM_ACROSS * surface->cells->length[cell];
}

/* What of a border is an end to one cell on it. */
static void take_end(sp_film_links *links, uint32_t cell, double across, double length, sp_vec3 outward)
{
    links->end_across[cell] += fmax(0, across); /* nothing comes in from there */
    links->end_length[cell] += length;
    if (length > sp_length(links->end[cell]))
        links->end[cell] = outward;
}

/* Joins a piece with one of the same border that came shortly before, as most do. */
static bool take_piece(gathering *own, piece met)
{
    assert(met.cell[0] != met.cell[1] && met.length >= 0);
    if (met.cell[0] > met.cell[1])
        met = (piece){{met.cell[1], met.cell[0]}, {met.across[1], met.across[0]}, met.length, met.crest};
    uint32_t *recent = &own->recent[(met.cell[0] * 31 + met.cell[1]) % RECENT];
    piece *same = *recent < own->count ? &own->pieces[*recent] : NULL;
    if (same && same->cell[0] == met.cell[0] && same->cell[1] == met.cell[1]) {
        same->across[0] += met.across[0];
        same->across[1] += met.across[1];
        same->length += met.length;
        same->crest = sp_lesser(same->crest, met.crest);
        return true;
    }
    if (!sp_grow(&own->pieces, &own->capacity, own->count + 1, sizeof *own->pieces))
        return false;
    *recent = (uint32_t)own->count;
    own->pieces[own->count++] = met;
    own->links->start[met.cell[0] + 1]++;
    own->links->start[met.cell[1] + 1]++;
    return true;
}

/* True where the edge of a sheet, both of whose sides are wet, lies no lower than what is beside it: film does not get
 * there, but what stands behind it runs over. */
static bool is_rim(const gathering *own, const sp_border *border)
{
    const uint32_t *sides = own->surface->cell_of[border->texel[0]];
    sp_vec3 tangent = own->tangents[border->triangle[0]], outward = border->outward[0];
    return border->texel[1] == SP_NONE && sides[0] != SP_NONE && sides[1] != SP_NONE && sp_length(tangent) > 0 &&
           sp_dot(tangent, outward) <= SP_FILM_FLAT * sp_length(outward);
}

/* What a border of that length makes a side of a triangle weigh in the way that the cell faces. */
static void face(const gathering *own, uint32_t cell, unsigned side, uint32_t triangle, double length)
{
    sp_vec3 *facing = &own->links->facing[cell];
    *facing = sp_along(*facing, side ? -length : length, own->normals[triangle]);
}

/* From one side of a sheet to the other. */
static bool take_rim(gathering *own, const sp_border *border)
{
    const uint32_t *sides = own->surface->cell_of[border->texel[0]];
    sp_vec3 down = own->surface->down;
    double across = sp_lesser(0, sp_dot(own->tangents[border->triangle[0]], border->outward[0]));
    double crest = -sp_greater(sp_dot(border->at[0], down), sp_dot(border->at[1], down));
    double length = sp_length(border->outward[0]);
    for (unsigned side = 0; side < 2; side++)
        face(own, sides[side], side, border->triangle[0], length);
    return take_piece(own, (piece){{sides[0], sides[1]}, {across, across}, length, crest});
}

/* On one side of the surface; what lies beyond may be dry. */
static bool take_side(gathering *own, const sp_border *border, unsigned side)
{
    const uint32_t(*cell_of)[2] = own->surface->cell_of;
    sp_film_links *links = own->links;
    unsigned sides[2] = {side, side ^ border->turned};
    piece met = {.cell = {cell_of[border->texel[0]][sides[0]], SP_NONE}, .crest = SP_FILM_NO_CREST};
    if (border->texel[1] != SP_NONE)
        met.cell[1] = cell_of[border->texel[1]][sides[1]];
    if (met.cell[0] == met.cell[1])
        return true;
    met.length = sp_length(border->outward[0]);
    bool ends = met.cell[0] == SP_NONE || met.cell[1] == SP_NONE;
    for (int k = 0; k < 2; k++) {
        uint32_t cell = met.cell[k], triangle = border->triangle[k];
        if (cell == SP_NONE)
            continue;
        met.across[k] = sp_dot(own->tangents[triangle], border->outward[k]);
        face(own, cell, sides[k], triangle, met.length);
        if (ends)
            take_end(links, cell, met.across[k], met.length, border->outward[k]);
    }
    return ends || take_piece(own, met);
}

static bool take_border(void *user, const sp_border *border)
{
    if (is_rim(user, border))
        return take_rim(user, border);
    return (!border->on_front || take_side(user, border, 0)) && (!border->on_back || take_side(user, border, 1));
}

static bool find_borders(gathering *own, sp_error *error)
{
    const sp_mesh *mesh = own->surface->mesh;
    const sp_atlas *atlas = own->surface->atlas;
    own->wet = calloc(atlas->chart_count + 1, sizeof *own->wet);
    own->normals = malloc((mesh->triangle_count + 1) * sizeof *own->normals);
    own->tangents = malloc((mesh->triangle_count + 1) * sizeof *own->tangents);
    if (!own->wet || !own->normals || !own->tangents)
        return sp_fail_memory(error);
    for (size_t i = 0; i < own->surface->cells->count; i++)
        own->wet[atlas->chart[own->surface->cells->triangle[i]]] = true;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        own->normals[t] = sp_triangle_normal(mesh, t);
        if (own->wet[atlas->chart[t]])
            own->tangents[t] = sp_film_tangent(own->normals[t], own->surface->down);
    }
    sp_vec3 low, high;
    double crack = sp_lesser(SP_CRACK * sp_mesh_box(mesh, &low, &high), CRACK * own->surface->wave);
    return sp_atlas_visit_borders(atlas, mesh, crack, own->wet, own->normals, take_border, own, error);
}

/* What leads out of one cell, on its way into the links. */
typedef struct {
    sp_film_link link;
    uint32_t to;
} way;

/* Both ways over every piece, by the cell that they lead out of; start[i + 1] becomes where those of cell i end. NULL
 * where memory ran out. */
static way *list_ways(const gathering *own)
{
    size_t *start = own->links->start, sum = 0;
    way *ways = malloc((2 * own->count + 1) * sizeof *ways);
    for (size_t i = 0; i < own->links->count; i++) {
        size_t of_cell = start[i + 1];
        start[i + 1] = sum;
        sum += of_cell;
    }
    for (size_t i = 0; ways && i < own->count; i++)
        for (int k = 0; k < 2; k++) {
            const piece *met = &own->pieces[i];
            ways[start[met->cell[k] + 1]++] =
                (way){{met->across[k], met->across[1 - k], met->length, met->crest}, met->cell[1 - k]};
        }
    return ways;
}

/* Takes a way in among the links of its cell, which lie from `first` up to `end`; returns where they end then. */
static size_t take_way(sp_film_links *links, size_t first, size_t end, const way *way)
{
    size_t at = end;
    assert(end - first < 2 || links->to[end - 2] < links->to[end - 1]);
    while (at > first && links->to[at - 1] >= way->to)
        at--;
    if (at < end && links->to[at] == way->to) {
        links->links[at].across += way->link.across;
        links->links[at].into += way->link.into;
        links->links[at].length += way->link.length;
        links->links[at].crest = sp_lesser(links->links[at].crest, way->link.crest);
        return end;
    }
    memmove(&links->to[at + 1], &links->to[at], (end - at) * sizeof *links->to);
    memmove(&links->links[at + 1], &links->links[at], (end - at) * sizeof *links->links);
    links->to[at] = way->to;
    links->links[at] = way->link;
    return end + 1;
}

/* One link for all pieces of a border. */
static bool join(const gathering *own)
{
    sp_film_links *links = own->links;
    way *ways = list_ways(own);
    links->to = malloc((2 * own->count + 1) * sizeof *links->to);
    links->links = malloc((2 * own->count + 1) * sizeof *links->links);
    bool done = ways && links->to && links->links;
    size_t end = 0;
    for (size_t i = 0, at = 0; done && i < links->count; i++) {
        size_t first = end;
        for (; at < links->start[i + 1]; at++)
            end = take_way(links, first, end, &ways[at]);
        links->start[i] = first;
    }
    assert(end <= 2 * own->count);
    links->start[links->count] = end;
    free(ways);
    return done;
}

bool sp_film_links_create(const sp_film_surface *surface, sp_film_links *links, sp_error *error)
{
    size_t count = surface->cells->count;
    *links = (sp_film_links){.count = count,
                             .start = calloc(count + 1, sizeof *links->start),
                             .end_across = calloc(count + 1, sizeof *links->end_across),
                             .end_length = calloc(count + 1, sizeof *links->end_length),
                             .end = calloc(count + 1, sizeof *links->end),
                             .facing = calloc(count + 1, sizeof *links->facing)};
    gathering own = {.surface = surface, .links = links};
    bool done = links->start && links->end_across && links->end_length && links->end && links->facing &&
                find_borders(&own, error);
    if (done && own.count >= SP_NONE / 2) {
        sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "film: %zu borders of texels found, too many: take a coarser texel",
                own.count);
        done = false;
    }
    done = done && join(&own);
    free(own.pieces);
    free(own.wet);
    free(own.normals);
    free(own.tangents);
    if (done)
        return true;
    sp_film_links_free(links);
    return sp_fail_memory(error);
}

void sp_film_links_free(sp_film_links *links)
{
    free(links->start);
    free(links->to);
    free(links->links);
    free(links->end_across);
    free(links->end_length);
    free(links->end);
    free(links->facing);
    free(links->drips);
    *links = (sp_film_links){0};
}
