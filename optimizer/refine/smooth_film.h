/* The film of a layout as refinement sees it: linear in what the nozzles bring, so that its derivatives are the film of
 * theirs. */
#ifndef OPTIMIZER_SMOOTH_FILM_H
#define OPTIMIZER_SMOOTH_FILM_H

#include "refine/smooth_arrivals.h"

/* One nozzle's. */
typedef struct {
    const sp_pose_parameters *parameters;
    const sp_sight *sight;
    size_t first;       /* of its unknowns */
    sp_brought brought; /* by arrival */
    float *film;        /* [patch_count], over what is asked for */
    float *slope;       /* [parameters->count][patch_count], by unknown */
} sp_smooth_runoff;

typedef struct {
    const sp_search *search;
    double width; /* of the step, in logarithm of film */
    size_t count;
    sp_smooth_runoff *runs; /* [count] */
} sp_smooth_film;

/* For nozzles with these pose parameters, whose unknowns follow one another. Borrows all; freed in any case. */
bool sp_smooth_film_create(const sp_search *search, const sp_pose_parameters *parameters, const sp_sight *const *sights,
                           size_t count, double width, sp_smooth_film *film, sp_error *error);
void sp_smooth_film_free(sp_smooth_film *film);
/* Draws nozzle i's film from what it brings, and the slopes where they are asked for; what brought.slope holds is
 * multiplied by chain[k] for unknown k. One thread a nozzle. */
void sp_smooth_film_set(sp_smooth_film *film, size_t i, const double *chain);
/* How far all films cover a patch, and by how much that changes per film. */
double sp_smooth_film_cover(const sp_smooth_film *film, size_t patch, double *rise);

#endif
