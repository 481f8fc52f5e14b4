/* The film that runs down the walls: ∇·(Γ t) = q, steady, on a surface cut into cells, by upwind finite volumes.
 * q (m/s) is the liquid that arrives per area, t the tangent of gravity, Γ (m²/s) the flow per width across t. All of
 * it is linear in q. No inertia, no rivulets, no hold-up: what has arrived runs down at once. */
#ifndef SPRAYPLAN_FILM_H
#define SPRAYPLAN_FILM_H

#include "film/film_surface.h"

/* Where a film ends, m³/s. */
typedef struct {
    double left;   /* runs or drips out of the geometry */
    double astray; /* drips on surface that is not wet: where a cavity leaks, or bodies overlap */
    double held;   /* stands where it cannot drain */
} sp_film_ends;

typedef struct sp_film sp_film;

/* Where the liquid of every cell runs: over its borders in proportion to t·b, b the outward normal of a border times
 * its length, also across cracks of the mesh no wider than a film is thick; from the end of a wall to what it meets
 * within 2.5 texels, or drips on, from that of a gutter on along it; to what lies beneath from ceilings flatter than
 * 10° on the mean over a wave, and from what hangs lower than all within it. Hollows and flats are filled to their rim
 * and run over there (priority flood, Barnes et al. 2014). Nothing is kept of the surface. NULL on error; the caller
 * destroys. */
sp_film *sp_film_create(const sp_film_surface *surface, sp_error *error);
void sp_film_destroy(sp_film *film);

/* The flow per width (m²/s) on every cell from what arrives on each (m³/s), both [cells]; of a pool, what leaves it
 * per length of its rim; 0 where it stands. *ends may be NULL; its parts come to what arrives. False where memory ran
 * out. */
bool sp_film_run(const sp_film *film, const double *arriving, double *per_width, sp_film_ends *ends, sp_error *error);
/* The same without memory of its own: `flow` [sp_film_flows] is the caller's. */
size_t sp_film_flows(const sp_film *film);
void sp_film_run_in(const sp_film *film, const double *arriving, double *flow, double *per_width, sp_film_ends *ends);
/* The transpose of that: what a unit (m³/s) that arrives on each cell adds to Σ weight per_width. [cells] */
bool sp_film_adjoint(const sp_film *film, const double *weight, double *worth, sp_error *error);

/* A hollow or flat that is filled before liquid leaves it. */
typedef struct {
    uint32_t lowest; /* its lowest cell */
    double area;     /* m², of its cells */
    bool drains;     /* over a rim, and not only by being emptied */
} sp_film_pool;
/* Owned by the film; by number of the first cell. */
const sp_film_pool *sp_film_pools(const sp_film *film, size_t *count);

#endif
