#include "film/drips.h"

#include <math.h>
#include <stdlib.h>

#define CEILING 0.17453292519943295 /* rad, 10°: the slope below which a ceiling does not hold its film */
#define FOLD 0.8660254037844387     /* cosine of 30°: what is turned more against a cell is another face */
#define LIKELY 0.7660444431189780   /* cosine of 40° = CEILING + 30°: what slopes more is no ceiling */

enum { MOST = 64 };

/* The cells about one, nearest first in links. */
typedef struct {
    const sp_film_surface *surface;
    const sp_film_links *links;
    uint32_t *seen; /* [cells], the last cell whose surroundings it was in, plus 1 */
    uint32_t near[MOST];
    size_t count;
} surroundings;

/* Those within a wave, by links. */
static void look_round(surroundings *own, uint32_t middle)
{
    const sp_film_links *links = own->links;
    const sp_vec3 *point = own->surface->cells->point;
    own->count = 1;
    own->near[0] = middle;
    own->seen[middle] = middle + 1;
    for (size_t i = 0; i < own->count; i++)
        for (size_t k = links->start[own->near[i]]; k < links->start[own->near[i] + 1] && own->count < MOST; k++) {
            uint32_t cell = links->to[k];
            if (own->seen[cell] == middle + 1 || sp_distance(point[cell], point[middle]) > own->surface->wave)
                continue;
            own->seen[cell] = middle + 1;
            own->near[own->count++] = cell;
        }
}

static sp_vec3 facing(const surroundings *own, uint32_t cell)
{
    sp_vec3 sum = own->links->facing[cell];
    return sp_length(sum) > 0 ? sp_unit(sum) : own->surface->cells->normal[cell];
}

static bool is_ceiling(surroundings *own, uint32_t cell)
{
    sp_vec3 normal = facing(own, cell), sum = {0}, down = own->surface->down;
    if (sp_dot(normal, down) < LIKELY)
        return false;
    look_round(own, cell);
    for (size_t i = 0; i < own->count; i++)
        if (sp_dot(facing(own, own->near[i]), normal) > FOLD)
            sum = sp_add(sum, own->links->facing[own->near[i]]);
    sum = sp_length(sum) > 0 ? sp_unit(sum) : normal;
    return sp_dot(sum, down) > cos(CEILING);
}

/* True where nothing lies lower than the cell and it does not face up: liquid that has come there hangs. A cell that
 * goes round an edge counts as what of it lies on its borders, whichever way its point faces. */
static bool is_tip(surroundings *own, uint32_t cell)
{
    const sp_film_links *links = own->links;
    const sp_vec3 *point = own->surface->cells->point, down = own->surface->down;
    double length = own->surface->cells->length[cell], facing = sp_dot(links->facing[cell], down) / length;
    if (facing < -SP_FILM_FLAT)
        return false;
    for (size_t k = links->start[cell]; k < links->start[cell + 1]; k++)
        if (sp_dot(point[links->to[k]], down) > sp_dot(point[cell], down) ||
            (facing < SP_FILM_FLAT && links->across[k] > SP_FILM_ACROSS * length))
            return false;
    look_round(own, cell);
    for (size_t i = 0; i < own->count; i++)
        if (sp_dot(point[own->near[i]], down) > sp_dot(point[cell], down))
            return false;
    return true;
}

bool sp_film_drips_find(const sp_film_surface *surface, sp_film_links *links, sp_error *error)
{
    surroundings own = {surface, links, calloc(links->count + 1, sizeof *own.seen), {0}, 0};
    links->drips = calloc(links->count + 1, sizeof *links->drips);
    bool done = own.seen && links->drips;
    /* over an open end liquid runs on: what hangs there is no tip */
    for (uint32_t i = 0; done && i < links->count; i++)
        links->drips[i] = is_ceiling(&own, i) || (!sp_film_is_open(surface, links, i) && is_tip(&own, i));
    free(own.seen);
    return done || sp_fail_memory(error);
}
