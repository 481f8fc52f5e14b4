#include "film/links.h"

#include "atlas/order.h"
#include "atlas/texels/borders.h"
#include "mesh/grow.h"

#include <math.h>
#include <stdlib.h>

#define LEAST_ACROSS 1e-9           /* of a cell's edge: less is round-off */
#define CEILING 0.17453292519943295 /* rad, 10°: the slope below which a ceiling does not hold its film */

/* A piece of a border between two cells. */
typedef struct {
    uint32_t from, to;
    double across, length;
} piece;

typedef struct {
    const sp_film_surface *surface;
    sp_film_links *links;
    sp_vec3 *tangents; /* [triangles] */
    double *facing;    /* [triangles], the cosine of the front to straight down */
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
    double across = sp_film_is_flat(surface, cell) ? links->end_length[cell] : links->end_across[cell];
    return across > LEAST_ACROSS * surface->cells->length[cell];
}

static bool add_piece(gathering *own, piece added)
{
    if (!sp_grow(&own->pieces, &own->capacity, own->count + 1, sizeof *own->pieces))
        return false;
    own->pieces[own->count++] = added;
    return true;
}

static bool take_border(void *user, const sp_border *border)
{
    gathering *own = user;
    const sp_film_surface *surface = own->surface;
    uint32_t from = surface->cell_of[border->texel][border->side];
    uint32_t to = border->other == SP_NONE ? SP_NONE : surface->cell_of[border->other][border->other_side];
    if (from == SP_NONE || from == to)
        return true;
    double across = sp_dot(own->tangents[border->triangle], border->outward), length = sp_length(border->outward);
    own->links->facing[from] += length * (border->side ? -1 : 1) * own->facing[border->triangle];
    if (to != SP_NONE)
        return add_piece(own, (piece){from, to, across, length});
    own->links->end_across[from] += across;
    own->links->end_length[from] += length;
    if (length > sp_length(own->links->end[from]))
        own->links->end[from] = border->outward;
    return true;
}

static bool find_borders(gathering *own, sp_error *error)
{
    const sp_mesh *mesh = own->surface->mesh;
    own->tangents = malloc((mesh->triangle_count + 1) * sizeof *own->tangents);
    own->facing = malloc((mesh->triangle_count + 1) * sizeof *own->facing);
    if (!own->tangents || !own->facing)
        return sp_fail_memory(error);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        sp_vec3 normal = sp_triangle_normal(mesh, t);
        own->tangents[t] = sp_film_tangent(normal, own->surface->down);
        own->facing[t] = sp_dot(normal, own->surface->down);
    }
    return sp_atlas_visit_borders(own->surface->atlas, mesh, take_border, own, error);
}

/* The pieces in the order of the cells that they are between; NULL where memory ran out. */
static uint32_t *order_of(const gathering *own)
{
    uint64_t *keys = malloc((own->count + 1) * sizeof *keys);
    uint32_t *order = malloc((own->count + 1) * sizeof *order);
    bool done = keys && order;
    for (size_t i = 0; done && i < own->count; i++)
        keys[i] = (uint64_t)own->pieces[i].from << 32 | own->pieces[i].to;
    done = done && sp_order_by_key(keys, own->count, order);
    free(keys);
    if (done)
        return order;
    free(order);
    return NULL;
}

/* One link for all pieces of a border. */
static bool join(const gathering *own)
{
    sp_film_links *links = own->links;
    uint32_t *order = order_of(own);
    links->to = malloc((own->count + 1) * sizeof *links->to);
    links->across = malloc((own->count + 1) * sizeof *links->across);
    links->length = malloc((own->count + 1) * sizeof *links->length);
    bool done = order && links->to && links->across && links->length;
    size_t count = 0;
    for (size_t i = 0; done && i < own->count; i++) {
        const piece *next = &own->pieces[order[i]], *last = i ? &own->pieces[order[i - 1]] : NULL;
        if (!last || last->from != next->from || last->to != next->to) {
            links->to[count] = next->to;
            links->across[count] = links->length[count] = 0;
            links->start[next->from + 1] = ++count;
        }
        links->across[count - 1] += next->across;
        links->length[count - 1] += next->length;
    }
    for (size_t i = 0; done && i < links->count; i++)
        if (links->start[i + 1] < links->start[i])
            links->start[i + 1] = links->start[i];
    free(order);
    return done;
}

/* True where nothing lies lower than the cell and it does not face up: liquid that has come there hangs. A cell that
 * goes round an edge counts as what of it lies on its borders, whichever way its point faces. */
static bool is_tip(const sp_film_surface *surface, const sp_film_links *links, uint32_t cell)
{
    const sp_vec3 *point = surface->cells->point;
    double length = surface->cells->length[cell], facing = links->facing[cell] / length;
    if (facing < -SP_FILM_FLAT)
        return false;
    for (size_t k = links->start[cell]; k < links->start[cell + 1]; k++)
        if (sp_dot(point[links->to[k]], surface->down) > sp_dot(point[cell], surface->down) ||
            (facing < SP_FILM_FLAT && links->across[k] > LEAST_ACROSS * length))
            return false;
    return true;
}

/* Over an open end liquid runs on: what hangs there is no tip. */
static void find_drips(const sp_film_surface *surface, sp_film_links *links)
{
    for (uint32_t i = 0; i < links->count; i++)
        links->drips[i] = sp_dot(surface->cells->normal[i], surface->down) > cos(CEILING) ||
                          (!sp_film_is_open(surface, links, i) && is_tip(surface, links, i));
}

bool sp_film_links_create(const sp_film_surface *surface, sp_film_links *links, sp_error *error)
{
    size_t count = surface->cells->count;
    *links = (sp_film_links){.count = count,
                             .start = calloc(count + 1, sizeof *links->start),
                             .end_across = calloc(count + 1, sizeof *links->end_across),
                             .end_length = calloc(count + 1, sizeof *links->end_length),
                             .end = calloc(count + 1, sizeof *links->end),
                             .facing = calloc(count + 1, sizeof *links->facing),
                             .drips = calloc(count + 1, sizeof *links->drips)};
    gathering own = {.surface = surface, .links = links};
    bool done = links->start && links->end_across && links->end_length && links->end && links->facing && links->drips &&
                find_borders(&own, error);
    if (done && own.count >= SP_NONE) {
        sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "film: %zu borders of texels found, too many: take a coarser texel",
                own.count);
        done = false;
    }
    done = done && join(&own);
    free(own.pieces);
    free(own.tangents);
    free(own.facing);
    if (done) {
        find_drips(surface, links);
        return true;
    }
    sp_film_links_free(links);
    return sp_fail_memory(error);
}

void sp_film_links_free(sp_film_links *links)
{
    free(links->start);
    free(links->to);
    free(links->across);
    free(links->length);
    free(links->end_across);
    free(links->end_length);
    free(links->end);
    free(links->facing);
    free(links->drips);
    *links = (sp_film_links){0};
}
