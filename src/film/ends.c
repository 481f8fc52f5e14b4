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

/* What is met on that way along a wall and beyond its end, or lies beneath there. */
static uint32_t along_wall(const sp_film_surface *surface, uint32_t cell, sp_vec3 way, bool *met_on_way)
{
    sp_vec3 from = before(surface, cell);
    double reach = REACH * surface->cells->length[cell], distance;
    uint32_t met = met_by(surface, from, way, reach, &distance);
    *met_on_way = met != SP_FILM_LEFT;
    return *met_on_way ? met : beneath(surface, sp_along(from, reach, way));
}

/* Beyond the end of a wall, in the direction in which liquid runs; where that is into the other side of a valley, which
 * ends here as well, straight out of it. */
static uint32_t beyond_wall(const sp_film_surface *surface, const sp_film_links *links, uint32_t cell)
{
    bool on_way;
    sp_vec3 way = sp_film_tangent(surface->cells->normal[cell], surface->down);
    uint32_t met = along_wall(surface, cell, way, &on_way);
    return on_way && is_beside(links, cell, met) ? along_wall(surface, cell, sp_unit(links->end[cell]), &on_way) : met;
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

/* True where liquid of the cell runs to a lower one beside it. */
static bool runs_lower(const sp_film_surface *surface, const sp_film_links *links, uint32_t cell)
{
    const sp_vec3 *point = surface->cells->point;
    double low = sp_dot(point[cell], surface->down);
    for (size_t k = links->start[cell]; k < links->start[cell + 1]; k++)
        if (links->links[k].across > 0 && sp_dot(point[links->to[k]], surface->down) > low)
            return true;
    return false;
}

/* Two walls that end at each other, sharing no edge, make a gutter. Where the lower cell of two has no other way, the
 * gutter ends there: on along it. */
static void leave_gutters(const sp_film_surface *surface, const sp_film_links *links, uint32_t *ends)
{
    const sp_patches *cells = surface->cells;
    for (uint32_t i = 0; i < links->count; i++) {
        uint32_t other = ends[i];
        if (!sp_film_is_cell(other) || ends[other] != i || links->drips[i] || links->drips[other] ||
            sp_dot(sp_sub(cells->point[i], cells->point[other]), surface->down) < 0 || runs_lower(surface, links, i))
            continue;
        sp_vec3 along = sp_cross(cells->normal[i], cells->normal[other]);
        double fall = sp_dot(along, surface->down), length = sp_length(along);
        bool on_way;
        if (fabs(fall) > SP_FILM_FLAT * length)
            ends[i] = along_wall(surface, i, sp_scale(along, copysign(1 / length, fall)), &on_way);
    }
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
    leave_gutters(surface, links, ends);
    return ends;
}
