#include "film/ends.h"

#include <math.h>
#include <stdlib.h>

#define CEILING 0.17453292519943295 /* rad, 10°: the slope below which a ceiling does not hold its film */
#define REACH 2.5                   /* texels that a film is followed beyond its wall's end */
#define LIFT 1e-3                   /* texels off its wall that it is followed at */
#define LEAST_ACROSS 1e-9           /* of a cell's edge: less is round-off */

bool sp_film_drips(const sp_film_surface *surface, uint32_t cell)
{
    return sp_dot(surface->cells->normal[cell], surface->down) > cos(CEILING);
}

/* The cell that a line hits, or SP_FILM_ASTRAY; SP_FILM_LEFT where it hits nothing within its length. */
static uint32_t met_by(const sp_film_surface *surface, sp_vec3 from, sp_vec3 direction, double length)
{
    sp_ray ray = {.origin = from, .velocity = direction, .t_max = length, .skip = SP_NONE};
    sp_hit hit = sp_trace_nearest(surface->tracer, &ray, sp_v(0, 0, 0));
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

/* Beyond the end of a wall, in the direction in which liquid runs, or of a flat, out over its edge. */
static uint32_t beyond(const sp_film_surface *surface, const sp_film_links *links, uint32_t cell)
{
    sp_vec3 tangent = sp_film_tangent(surface->cells->normal[cell], surface->down), from = before(surface, cell);
    bool flat = !(sp_length(tangent) > 0);
    sp_vec3 along = flat ? sp_unit(links->end[cell]) : tangent;
    double reach = REACH * surface->cells->length[cell];
    uint32_t met = met_by(surface, from, along, reach);
    if (met != SP_FILM_LEFT)
        return flat ? SP_FILM_SHUT : met;
    return met_by(surface, sp_along(from, reach, along), surface->down, INFINITY);
}

uint32_t *sp_film_ends_find(const sp_film_surface *surface, const sp_film_links *links, sp_error *error)
{
    uint32_t *ends = malloc((links->count + 1) * sizeof *ends);
    if (!ends)
        return sp_fail_memory(error);
    for (uint32_t i = 0; i < links->count; i++) {
        bool flat = !(sp_length(sp_film_tangent(surface->cells->normal[i], surface->down)) > 0);
        double open = flat ? sp_length(links->end[i]) : links->end_across[i];
        ends[i] = SP_NONE;
        if (sp_film_drips(surface, i))
            ends[i] = met_by(surface, before(surface, i), surface->down, INFINITY);
        else if (open > LEAST_ACROSS * surface->cells->length[i])
            ends[i] = beyond(surface, links, i);
    }
    return ends;
}
