#include "film/links.h"

#include "atlas/texels/borders.h"
#include "mesh/grow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How a triangle lies. */
typedef struct {
    sp_vec3 tangent, normal;
} slope;

/* A piece of a border between two cells, and what it is to each. */
typedef struct {
    uint32_t cell[2];
    double across[2], length[2];
} piece;

typedef struct {
    const sp_film_surface *surface;
    sp_film_links *links;
    slope *slopes; /* [triangles] */
    size_t count, capacity;
    piece *pieces;
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

/* On one side of the surface; what lies beyond may be dry. */
static bool take_side(gathering *own, const sp_border *border, unsigned side)
{
    const uint32_t(*cell_of)[2] = own->surface->cell_of;
    unsigned sides[2] = {side, side ^ border->turned};
    piece met = {.cell = {cell_of[border->texel[0]][sides[0]], SP_NONE}};
    if (border->texel[1] != SP_NONE)
        met.cell[1] = cell_of[border->texel[1]][sides[1]];
    if (met.cell[0] == met.cell[1])
        return true;
    for (int k = 0; k < 2; k++) {
        if (met.cell[k] == SP_NONE)
            continue;
        const slope *slope = &own->slopes[border->triangle[k]];
        met.across[k] = sp_dot(slope->tangent, border->outward[k]);
        met.length[k] = sp_length(border->outward[k]);
        sp_vec3 *facing = &own->links->facing[met.cell[k]];
        *facing = sp_along(*facing, sides[k] ? -met.length[k] : met.length[k], slope->normal);
        if (met.cell[1 - k] == SP_NONE)
            take_end(own->links, met.cell[k], met.across[k], met.length[k], border->outward[k]);
    }
    if (met.cell[0] == SP_NONE || met.cell[1] == SP_NONE)
        return true;
    if (!sp_grow(&own->pieces, &own->capacity, own->count + 1, sizeof *own->pieces))
        return false;
    own->pieces[own->count++] = met;
    for (int k = 0; k < 2; k++)
        own->links->start[met.cell[k] + 1]++;
    return true;
}

static bool take_border(void *user, const sp_border *border)
{
    return (!border->on_front || take_side(user, border, 0)) && (!border->on_back || take_side(user, border, 1));
}

static bool find_borders(gathering *own, sp_error *error)
{
    const sp_mesh *mesh = own->surface->mesh;
    own->slopes = malloc((mesh->triangle_count + 1) * sizeof *own->slopes);
    if (!own->slopes)
        return sp_fail_memory(error);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        sp_vec3 normal = sp_triangle_normal(mesh, t);
        own->slopes[t] = (slope){sp_film_tangent(normal, own->surface->down), normal};
    }
    return sp_atlas_visit_borders(own->surface->atlas, mesh, take_border, own, error);
}

/* Both ways over every piece, 2 piece + way, by the cell that they lead out of; their numbers become where those of
 * each cell lie. NULL where memory ran out. */
static uint32_t *list_ways(const gathering *own)
{
    size_t *start = own->links->start, sum = 0;
    uint32_t *ways = malloc((2 * own->count + 1) * sizeof *ways);
    for (size_t i = 0; i < own->links->count; i++) {
        size_t of_cell = start[i + 1];
        start[i + 1] = sum;
        sum += of_cell;
    }
    for (size_t i = 0; ways && i < own->count; i++)
        for (uint32_t k = 0; k < 2; k++)
            ways[start[own->pieces[i].cell[k] + 1]++] = 2 * (uint32_t)i + k;
    return ways;
}

/* Links of cell i lie from start[i] up to end[i]: moves them together. */
static void close_gaps(sp_film_links *links, const size_t *end)
{
    size_t count = 0;
    for (size_t i = 0; i < links->count; i++) {
        size_t first = links->start[i], of_cell = end[i] - first;
        memmove(&links->to[count], &links->to[first], of_cell * sizeof *links->to);
        memmove(&links->across[count], &links->across[first], of_cell * sizeof *links->across);
        memmove(&links->into[count], &links->into[first], of_cell * sizeof *links->into);
        memmove(&links->length[count], &links->length[first], of_cell * sizeof *links->length);
        links->start[i] = count;
        count += of_cell;
    }
    links->start[links->count] = count;
}

/* One link for all pieces of a border. What leads out of the cells, taken in their order, leads into each of the others
 * in that order too: turned round it is sorted. */
static bool join(const gathering *own)
{
    sp_film_links *links = own->links;
    uint32_t *ways = list_ways(own);
    size_t *end = malloc((links->count + 1) * sizeof *end), room = 2 * own->count + 1;
    links->to = malloc(room * sizeof *links->to);
    links->across = malloc(room * sizeof *links->across);
    links->into = malloc(room * sizeof *links->into);
    links->length = malloc(room * sizeof *links->length);
    bool done = ways && end && links->to && links->across && links->into && links->length;
    if (done)
        memcpy(end, links->start, links->count * sizeof *end);
    for (uint32_t cell = 0; done && cell < links->count; cell++)
        for (size_t i = links->start[cell]; i < links->start[cell + 1]; i++) {
            const piece *crossed = &own->pieces[ways[i] / 2];
            int k = 1 - (int)(ways[i] % 2);
            uint32_t from = crossed->cell[k];
            if (end[from] == links->start[from] || links->to[end[from] - 1] != cell) {
                links->to[end[from]] = cell;
                links->across[end[from]] = links->into[end[from]] = links->length[end[from]] = 0;
                end[from]++;
            }
            links->across[end[from] - 1] += crossed->across[k];
            links->into[end[from] - 1] += crossed->across[1 - k];
            links->length[end[from] - 1] += crossed->length[k];
        }
    if (done)
        close_gaps(links, end);
    free(ways);
    free(end);
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
    free(own.slopes);
    if (done)
        return true;
    sp_film_links_free(links);
    return sp_fail_memory(error);
}

void sp_film_links_free(sp_film_links *links)
{
    free(links->start);
    free(links->to);
    free(links->across);
    free(links->into);
    free(links->length);
    free(links->end_across);
    free(links->end_length);
    free(links->end);
    free(links->facing);
    free(links->drips);
    *links = (sp_film_links){0};
}
