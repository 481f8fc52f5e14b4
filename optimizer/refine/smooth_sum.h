/* The smooth objective: what of every patch a layout misses, squared and weighed by area, and the normal matrix of its
 * derivatives. */
#ifndef OPTIMIZER_SMOOTH_SUM_H
#define OPTIMIZER_SMOOTH_SUM_H

#include "refine/smooth_film.h"

#define SP_SMOOTH_CHUNKS 16 /* of patches; fixed, so that sums do not depend on the number of threads */

/* One nozzle of the layout. */
typedef struct {
    const sp_pose_parameters *parameters;
    const sp_sight *sight;
    size_t first; /* of its unknowns */
    sp_smooth_arrivals arrivals;
} sp_smooth_nozzle;

/* A patch's arrivals are links[start[p]] to links[start[p + 1]]. */
typedef struct {
    uint32_t nozzle, arrival;
} sp_smooth_link;

/* Of a layout, in all unknowns of its nozzles. */
typedef struct {
    const sp_search *search;
    sp_width width;
    double budget;
    size_t nozzle_count, unknowns;
    sp_smooth_nozzle *nozzles;
    size_t *start; /* [patch_count + 1] */
    sp_smooth_link *links;
    sp_smooth_film film;                                /* of no nozzles where film is not asked for */
    double *chunk_cost, *chunk_gradient, *chunk_normal; /* [SP_SMOOTH_CHUNKS][1], [][unknowns], [][unknowns²] */
    sp_error *error; /* of the solver, which does not know why residuals are missing: what is reported first stays */
} sp_smooth_objective;

/* From the nozzles' arrivals and films as they are set, sums cost and, where slopes are asked for, gradient and the
 * lower triangle of the normal matrix over all patches into the first chunk's. False where memory ran out. */
bool sp_smooth_sum(sp_smooth_objective *smooth, bool slopes);

#endif
