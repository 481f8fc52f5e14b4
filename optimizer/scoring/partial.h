/* A partial layout: the nozzles that the search has placed, and refinement moves, with what each brings to the coarse
 * patches. */
#ifndef OPTIMIZER_PARTIAL_H
#define OPTIMIZER_PARTIAL_H

#include "scoring/footprint.h"
#include "scoring/wetness.h"

typedef struct {
    sp_nozzle nozzle;
    sp_nozzle origin; /* the candidate that it was, from which refinement's limits count */
    sp_pose pose;     /* the same, where it is still there: of a type that no pattern kernel sums; of no site where
                       * another placement had that candidate, not this one */
    const sp_footprint *moved; /* of such a type that stands elsewhere in the end, on the search's patches; else NULL */
    sp_site site;              /* where it is now: a surface's axis changes along it */
    double flow;               /* m³/s */
    bool again;                /* its edges are another's in the partial layout, and count as that one's */
    /* [field_count], what it brings to a patch (see sp_wetting): flux over threshold on all of it, INFINITY where any
     * liquid covers; or, below 0, less the share that it covers by itself at its spray's edge. Behind these, where film
     * is asked for, the film that comes of it over what is asked for. */
    float *field;
} sp_placed;

typedef struct {
    size_t count, capacity;
    sp_placed *items; /* besides the kept nozzles */
    float *hit;       /* [patch_count], all nozzles together, flux over threshold on all of a patch */
    float *film;      /* [patch_count], film over what is asked for; NULL where none is */
    float *wet;       /* [patch_count], the greater of both; `hit` itself where there is but that */
    float *dry;       /* [patch_count], share of a patch that no edge covers */
    double flow;      /* m³/s, kept nozzles included */
    double outlay;    /* m³/s, the same with what the mounts cost */
    double covered;   /* m² of coarse patches */
    double value;     /* covered, and the credit for what is on the way */
} sp_partial;

/* A partial layout of the kept nozzles alone. */
bool sp_partial_create(const sp_search *search, sp_partial *partial, sp_error *error);
bool sp_partial_copy(const sp_search *search, const sp_partial *from, sp_partial *to, sp_error *error);
void sp_partial_free(sp_partial *partial);
/* Adds a nozzle and takes its field over, also on failure. */
bool sp_partial_add(const sp_search *search, sp_partial *partial, sp_placed placed, sp_error *error);
/* The same with a copy of a nozzle of another one. */
bool sp_partial_add_copy(const sp_search *search, sp_partial *partial, const sp_placed *from, sp_error *error);
bool sp_partial_add_pose(const sp_search *search, sp_partial *partial, sp_pose pose, sp_error *error);
void sp_partial_remove(const sp_search *search, sp_partial *partial, size_t i);
/* Removes item i and hands it over. */
sp_placed sp_partial_take(const sp_search *search, sp_partial *partial, size_t i);
/* Draws wet, dry, flow, outlay, covered and value from the items. */
void sp_partial_refresh(const sp_search *search, sp_partial *partial);
/* What it covers of the search's patches, m², added up in their order: their areas in double precision, which patches
 * at edges alone are covered a share of in single precision. */
double sp_partial_counted(const sp_search *search, const sp_partial *partial);
/* True where a covers more than b, and not the same but for round-off. */
static inline bool sp_covers_more(const sp_search *search, const sp_partial *a, const sp_partial *b)
{
    return a->covered > b->covered + SP_TIE * search->all;
}
/* What a nozzle brings of a type that no pattern kernel sums. */
const sp_footprint *sp_placed_footprint(const sp_search *search, const sp_placed *placed);
/* What a nozzle takes where it is, m³/s. */
static inline double sp_placed_outlay(const sp_search *search, const sp_placed *placed)
{
    return sp_outlay_at(search, placed->site.mount, placed->flow);
}
/* What the partial layout's mounts cost, m³/s; and the water (m³/s) that its nozzles may take within an outlay of
 * `budget`. */
double sp_partial_costs(const sp_search *search, const sp_partial *partial);
double sp_partial_water(const sp_search *search, const sp_partial *partial, double budget);
/* True where one more nozzle of this variant fits within an outlay of `budget`, and within max_water. */
bool sp_partial_affords(const sp_search *search, const sp_partial *partial, uint32_t mount, size_t variant,
                        double budget);
/* True where the partial layout may take one more nozzle at the site: number and ports, not water. */
bool sp_partial_has_place(const sp_search *search, const sp_partial *partial, uint32_t mount);
/* The nozzle that sprays most of those with the edges of this pose's; NULL: none. */
const sp_placed *sp_partial_edges_at(const sp_search *search, const sp_partial *partial, sp_pose pose);
/* True where it stands in its pose, unmoved. */
static inline bool sp_placed_is_candidate(const sp_placed *placed)
{
    return placed->pose.site != SP_NONE && sp_nozzles_spray_alike(&placed->nozzle, &placed->origin);
}
/* Named nozzles, the kept ones first. */
sp_layout *sp_partial_to_layout(const sp_search *search, const sp_partial *partial, sp_error *error);

#endif
