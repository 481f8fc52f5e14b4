/* Which cells share a border, and how much of what runs on one crosses it. */
#ifndef FILM_LINKS_H
#define FILM_LINKS_H

#include "film/film_surface.h"

#define SP_FILM_FLAT 1e-3 /* sine of the slope: less is level, as geometry in single precision tells it */
#define SP_FILM_NO_CREST (-INFINITY)
#define SP_FILM_ACROSS 1e-9 /* of a cell's edge: less across the flow is round-off */

/* From one cell to another, over all their common border. */
typedef struct {
    double across; /* m, Σ t·b: what runs out over the border, above 0, or may run in from beyond */
    double into;   /* m, the same, of what runs in from there */
    double length; /* m */
    double crest;  /* m, height of the free edge of a sheet over which it leads to the sheet's other side, above which
                    * liquid has to stand; SP_FILM_NO_CREST */
} sp_film_link;

typedef struct {
    size_t count;  /* of cells */
    size_t *start; /* [count + 1], links of cell i are start[i] up to start[i + 1], ascending by `to` */
    uint32_t *to;
    sp_film_link *links;
    double *end_across; /* [count], m, as `across`, of borders where the surface ends or goes on dry */
    double *end_length; /* [count], m, of these */
    sp_vec3 *end;       /* [count], m, b of the longest of these */
    sp_vec3 *facing;    /* [count], m, Σ over all borders of length times the unit normal of the side there */
    bool *drips;        /* [count], all that comes there drips off: a ceiling so flat that it does not hold its film, or
                         * what hangs lower than all beside it; see film/drips.h */
} sp_film_links;

bool sp_film_links_create(const sp_film_surface *surface, sp_film_links *links, sp_error *error);
void sp_film_links_free(sp_film_links *links);

static inline bool sp_film_is_over_rim(const sp_film_link *link)
{
    return link->crest > SP_FILM_NO_CREST;
}

/* Unit vector in the plane with that normal (unit) along which gravity pulls; 0 where the plane is level. */
sp_vec3 sp_film_tangent(sp_vec3 normal, sp_vec3 down);
bool sp_film_is_flat(const sp_film_surface *surface, uint32_t cell);
/* True where liquid of the cell gets to where the surface ends; on a flat, where the surface ends there at all. */
bool sp_film_is_open(const sp_film_surface *surface, const sp_film_links *links, uint32_t cell);

#endif
