#include "film/drips.h"

#include <math.h>
#include <stdlib.h>

#define CEILING 0.17453292519943295 /* rad, 10°: the slope below which a ceiling does not hold its film */
#define FOLD 0.52359877559829887    /* rad, 30°: what is turned more against a cell is another face */

/* Looked at about a cell; of cells shorter than a fifth of a wave these are less than a wave. */
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
            sp_vec3 off = sp_sub(point[cell], point[middle]);
            if (own->seen[cell] == middle + 1 || sp_dot(off, off) > own->surface->wave * own->surface->wave)
                continue;
            own->seen[cell] = middle + 1;
            own->near[own->count++] = cell;
        }
}

/* True where a vector points along a unit one by more than the angle of that cosine, above 0; of vectors without
 * length, too. */
static bool is_along(sp_vec3 vector, sp_vec3 unit, double cosine)
{
    double part = sp_dot(vector, unit);
    return part >= 0 && part * part >= cosine * cosine * sp_dot(vector, vector);
}

static bool is_ceiling(surroundings *own, uint32_t cell)
{
    const sp_vec3 *facing = own->links->facing, down = own->surface->down;
    if (!is_along(facing[cell], down, cos(CEILING + FOLD)))
        return false;
    sp_vec3 normal = own->surface->cells->normal[cell], sum = facing[cell];
    if (sp_length(sum) > 0)
        normal = sp_unit(sum);
    look_round(own, cell);
    for (size_t i = 1; i < own->count; i++)
        if (is_along(facing[own->near[i]], normal, cos(FOLD)))
            sum = sp_add(sum, facing[own->near[i]]);
    sum = sp_length(sum) > 0 ? sum : normal;
    return is_along(sum, down, cos(CEILING));
}

/* True where nothing lies lower than the cell and it does not face up: liquid that has come there hangs. A cell that
 * goes round an edge counts as what of it lies on its borders, whichever way its point faces. */
static bool is_tip(surroundings *own, uint32_t cell)
{
    const sp_film_links *links = own->links;
    const sp_vec3 *point = own->surface->cells->point, down = own->surface->down;
    double length = own->surface->cells->length[cell], facing = sp_dot(links->facing[cell], down) / length;
    double low = sp_dot(point[cell], down) + SP_FILM_FLAT * length; /* what is level with it is no lower */
    if (facing < -SP_FILM_FLAT)
        return false;
    for (size_t k = links->start[cell]; k < links->start[cell + 1]; k++)
        if ((facing < SP_FILM_FLAT && links->links[k].across > SP_FILM_ACROSS * length) ||
            sp_dot(point[links->to[k]], down) > low)
            return false;
    look_round(own, cell);
    for (size_t i = 1; i < own->count; i++)
        if (sp_dot(point[own->near[i]], down) > low)
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
