/* What all of a search share: what is asked for, where nozzles may be, the patches, and what every layout contains. */
#ifndef OPTIMIZER_SEARCH_H
#define OPTIMIZER_SEARCH_H

#include "scoring/pattern_kernels.h"

#include <omp.h>

#define SP_ROUNDING 1e-9 /* share of the water by which a sum of flows may lie above what is allowed */
/* Shares of the area by which equal things may differ, so that where geometry is mirrored or repeated the first of
 * equals is taken, not the one that round-off favours: what a partial layout covers, and scores, which are summed in
 * single precision. */
#define SP_TIE 1e-9
#define SP_SCORE_TIE 1e-6

/* Everything that the search's files share. Read-only once made. */
typedef struct {
    const sp_place_options *options;
    const sp_sites *sites;
    const sp_candidates *candidates;
    const sp_visibility *visibility;
    const sp_evaluator *coarse;
    size_t patch_count;
    size_t field_count;  /* of a nozzle's field: one for each patch, and where film is asked for as many for that */
    sp_runoff **runoffs; /* [threads], by sp_search_runoff; NULL: neither film nor a dose is asked for. In all that
                          * follows a dose of goods that move is a film that stays where it arrives, and no hit */
    bool all_feeds;      /* the film, whether it passes speed and incidence or not */
    int level;           /* parallel regions around the caller of the placement, whose threads are not the search's */
    double all;          /* m² of all patches that are cleaned */
    float *area; /* [patch_count], share of all, 0 of what is only run over: what is rounded to single precision has
                  * no unit of length */
    double threshold; /* m³/s per m² that cover; 0: any liquid */
    double plenty;    /* m³/s that cover all that the views show, spread evenly; 0: any liquid */
    double view_area; /* m² of all patches that the views show: of a unit of their transfers */
    bool single;      /* one nozzle alone must cover */
    bool alone;       /* one nozzle covers or none does: single, or any liquid is enough */
    float credit;     /* worth of an uncovered patch per share of the threshold that it has */
    const sp_pattern_kernels *kernels;
    size_t kept_count;
    sp_nozzle *kept; /* the nozzles that every layout contains */
    double kept_flow;
    bool costly;        /* some mount costs something; else a layout's outlay is its water */
    double outlay_most; /* m³/s that no layout is looked for beyond: max_water, and what mounts may cost besides */
    float *kept_hit;    /* [patch_count], flux over threshold on all of a patch */
    float *kept_film;   /* [patch_count], film over what is asked for; NULL where none is */
    float *kept_dry;    /* [patch_count], share of a patch that their edges do not cover */
    bool *port_taken;   /* [mount_count], by a kept nozzle */
    bool bodies;        /* some type or kept nozzle has one: two may overlap */
    struct sp_footprints *footprints; /* of poses that no pattern kernel sums; NULL: there are none */
} sp_search;

/* The calling thread's own. */
static inline sp_runoff *sp_search_runoff(const sp_search *search)
{
    int own = search->level + 1;
    return search->runoffs[omp_get_level() >= own ? omp_get_ancestor_thread_num(own) : 0];
}
/* How wet the kept nozzles leave a patch: it is covered from SP_ENOUGH. */
static inline float sp_kept_wet(const sp_search *search, size_t patch)
{
    return search->kept_film ? fmaxf(search->kept_hit[patch], search->kept_film[patch]) : search->kept_hit[patch];
}

/* What a nozzle of this flow takes there, m³/s. */
static inline double sp_outlay_at(const sp_search *search, uint32_t mount, double flow)
{
    return flow + search->options->mounts[mount].cost;
}
/* That of a pose to a power, by which merits count. */
static inline double sp_merit_price(const sp_search *search, const sp_pose *pose, double power)
{
    uint32_t mount = search->sites->items[pose->site].mount;
    return pow(sp_outlay_at(search, mount, search->candidates->variants[pose->variant].flow), power);
}
/* m³/s that layouts take at most besides their outlay's limit. */
static inline double sp_water_most(const sp_search *search)
{
    return search->costly ? search->options->max_water * (1 + SP_ROUNDING) : INFINITY;
}
/* True where one more nozzle of this flow fits within an outlay of `budget`, and within max_water. */
static inline bool sp_affords(const sp_search *search, double flow, double outlay, uint32_t mount, double more,
                              double budget)
{
    return outlay + sp_outlay_at(search, mount, more) <= budget && flow + more <= sp_water_most(search);
}

#endif
