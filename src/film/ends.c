#include "film/ends.h"

#include <math.h>
#include <stdlib.h>

#define REACH 2.5 /* texels that a film is followed beyond its wall's end */
#define LIFT 1e-3 /* texels off its wall that it is followed at */

/* The cell that a line hits, or SP_FILM_ASTRAY, and how far off; SP_FILM_LEFT where it hits nothing within its length.
 */
static uint32_t met_by(const sp_film_surface *surface, sp_vec3 from, sp_vec3 direction, double length, double *distance)
{
    sp_ray ray = {.origin = from, .velocity = direction, .t_max = length, .skip = SP_NONE};
    sp_hit hit = sp_trace_nearest(surface->tracer, &ray, sp_v(0, 0, 0));
    *distance = hit.t;
    if (hit.triangle == SP_NONE)
        return SP_FILM_LEFT;
    bool back = sp_dot(direction, sp_triangle_normal(surface->mesh, hit.triangle)) > 0;
    uint32_t cell = surface->cell_of[sp_atlas_texel(surface->atlas, hit.triangle, hit.u, hit.v)][back];
    return cell == SP_NONE ? SP_FILM_ASTRAY : cell;
}

static sp_vec3 before(const sp_film_surface *surface, uint32_t cell)
{
    const sp_patches *cells = surface->cells;
    return sp_along(cells->point[cell], LIFT * cells->length[cell], cells->normal[cell]);
}

static uint32_t beneath(const sp_film_surface *surface, sp_vec3 from)
{
    double fall;
    return met_by(surface, from, surface->down, INFINITY, &fall);
}

/* True where it is the cell itself, which goes round an edge, or one beside it. */
static bool is_beside(const sp_film_links *links, uint32_t cell, uint32_t other)
{
    bool beside = other == cell;
    for (size_t k = links->start[cell]; k < links->start[cell + 1]; k++)
        beside = beside || links->to[k] == other;
    return beside;
}

/* Beyond the end of a wall, in the direction in which liquid runs; where that is into the other side of a valley, which
 * ends here as well, straight out of it. */
static uint32_t beyond_wall(const sp_film_surface *surface, const sp_film_links *links, uint32_t cell)
{
    sp_vec3 along = sp_film_tangent(surface->cells->normal[cell], surface->down), from = before(surface, cell);
    double reach = REACH * surface->cells->length[cell], distance;
    uint32_t met = met_by(surface, from, along, reach, &distance);
    if (is_beside(links, cell, met)) {
        along = sp_unit(links->end[cell]);
        met = met_by(surface, from, along, reach, &distance);
    }
    return met != SP_FILM_LEFT ? met : beneath(surface, sp_along(from, reach, along));
}

/* Out over the edge of a flat, to what lies below; or a body stands so close there that nothing falls between. */
static uint32_t beyond_flat(const sp_film_surface *surface, const sp_film_links *links, uint32_t cell)
{
    sp_vec3 along = sp_unit(links->end[cell]), from = before(surface, cell);
    double lift = LIFT * surface->cells->length[cell], reach = REACH * surface->cells->length[cell], distance, fall;
    if (met_by(surface, from, along, reach, &distance) != SP_FILM_LEFT)
        reach = fmax(0, distance - lift);
    uint32_t met = met_by(surface, sp_along(from, reach, along), surface->down, INFINITY, &fall);
    return fall > 2 * lift ? met : SP_FILM_SHUT;
}

uint32_t *sp_film_ends_find(const sp_film_surface *surface, const sp_film_links *links, sp_error *error)
{
    uint32_t *ends = malloc((links->count + 1) * sizeof *ends);
    if (!ends)
        return sp_fail_memory(error);
    for (uint32_t i = 0; i < links->count; i++) {
        ends[i] = SP_NONE;
        if (links->drips[i])
            ends[i] = beneath(surface, before(surface, i));
        else if (sp_film_is_open(surface, links, i))
            ends[i] = sp_film_is_flat(surface, i) ? beyond_flat(surface, links, i) : beyond_wall(surface, links, i);
    }
    return ends;
}
