/* Footprints: what a nozzle brings to the patches that it reaches, whatever patterns it has, as the measure counts it.
 * For clusters, and for what does not spray as densely all over, which no pattern kernel sums over a view. */
#ifndef OPTIMIZER_FOOTPRINT_H
#define OPTIMIZER_FOOTPRINT_H

#include "scoring/wetness.h"

/* One patch of it. */
typedef struct {
    uint32_t patch;
    float hit;  /* flux over threshold on all of the patch, INFINITY where any liquid covers */
    float edge; /* share of the patch that the edges of patterns cover by themselves */
    float film; /* over what is asked for */
} sp_print;

typedef struct {
    size_t count;
    sp_print *prints; /* [count], ascending by patch, none of them nothing at all */
} sp_footprint;

/* Of any nozzle, traced on the search's patches. For sp_footprint_free where true. */
bool sp_footprint_trace(const sp_search *search, const sp_nozzle *nozzle, sp_footprint *footprint, sp_error *error);
void sp_footprint_free(sp_footprint *footprint);
/* Adds it to what hits a search's patches, runs (NULL: film is not asked for) and is dry. */
void sp_footprint_pour(const sp_search *search, const sp_footprint *footprint, bool again, float *hit, float *film,
                       float *dry);
/* As a field, which has room for one of hit and edge: of a patch that has both, and is not covered by the hit alone,
 * the edge. */
void sp_footprint_field(const sp_search *search, const sp_footprint *footprint, float *field);

#endif
