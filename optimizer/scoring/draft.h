/* A layout during the search: nozzles with what each brings to the coarse patches. */
#ifndef OPTIMIZER_DRAFT_H
#define OPTIMIZER_DRAFT_H

#include "scoring/sweep.h"

#include <omp.h>

#define SP_ROUNDING 1e-9 /* share of the water by which a sum of flows may lie above what is allowed */
/* Flux over threshold that covers: so much more than 1 that what was rounded up to it in single precision is no less
 * than the threshold. Refinement would else stop where the search sees a patch covered and the evaluator does not. */
#define SP_ENOUGH (1 + 0x1p-20f)
/* Shares of the area by which equal things may differ, so that where geometry is mirrored or repeated the first of
 * equals is taken, not the one that round-off favours: what a draft covers, and scores, which are summed in single
 * precision. */
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
    float credit;     /* worth of an uncovered patch per share of the threshold that it has */
    const sp_sweep_set *sweeps;
    size_t kept_count;
    sp_nozzle *kept; /* the nozzles that every layout contains */
    double kept_flow;
    bool costly;        /* some mount costs something; else a layout's outlay is its water */
    double outlay_most; /* m³/s that no layout is looked for beyond: max_water, and what mounts may cost besides */
    float *kept_hit;    /* [patch_count], flux over threshold on all of a patch */
    float *kept_film;   /* [patch_count], film over what is asked for; NULL where none is */
    float *kept_dry;    /* [patch_count], share of a patch that their edges do not cover */
    bool *port_taken;   /* [mount_count], by a kept nozzle */
    struct sp_footprints *footprints; /* of poses that no sweep knows; NULL: there are none */
} sp_search;

typedef struct {
    sp_nozzle nozzle;
    sp_nozzle origin; /* the candidate that it was, from which refinement's limits count */
    sp_pose pose;     /* the same, where it is still there: of a type that no sweep knows */
    sp_site site;     /* where it is now: a surface's axis changes along it */
    double flow;      /* m³/s */
    /* [field_count], what it brings to a patch (see sp_wetting): flux over threshold on all of it, INFINITY where any
     * liquid covers; or, below 0, less the share that it covers by itself at its spray's edge. Behind these, where film
     * is asked for, the film that comes of it over what is asked for. */
    float *field;
} sp_placed;

/* What a patch's field and one more flight to `part` of it come to (see sp_wetting_settle). */
static inline float sp_field_join(float a, float b, float part)
{
    if (part < 1 && (b < 0 || b >= 1))
        return fmaxf(fminf(a, 0) - part * fminf(fabsf(b), 1), -1);
    if (part < 1)
        return a < 0 ? a : a + part * b;
    if (a < 0 && b < 0)
        return a + b + a * b;
    if (a >= 0 && b >= 0)
        return a + b;
    return fmaxf(a, b) >= 1 ? fmaxf(a, b) : fminf(a, b);
}

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
} sp_draft;

bool sp_search_create(const sp_evaluator *coarse, const sp_place_options *options, const sp_sites *sites,
                      const sp_candidates *candidates, const sp_visibility *visibility, sp_search *search,
                      sp_error *error);
void sp_search_free(sp_search *search);
/* The same of layouts that contain all of the scene's own nozzles, not only those that are marked; for drafts and
 * scores, with the limits on water as they were. Borrows all else of `search`. False, and nothing to free, on error. */
bool sp_search_keep_all(const sp_search *search, sp_search *keeping, sp_error *error);
void sp_search_keep_all_free(sp_search *keeping);

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

/* A draft of the kept nozzles alone. */
bool sp_draft_create(const sp_search *search, sp_draft *draft, sp_error *error);
bool sp_draft_copy(const sp_search *search, const sp_draft *from, sp_draft *to, sp_error *error);
void sp_draft_free(sp_draft *draft);
/* Adds a nozzle and takes its field over, also on failure. */
bool sp_draft_add(const sp_search *search, sp_draft *draft, sp_placed placed, sp_error *error);
bool sp_draft_add_pose(const sp_search *search, sp_draft *draft, sp_pose pose, sp_error *error);
void sp_draft_remove(const sp_search *search, sp_draft *draft, size_t i);
/* Removes item i and hands it over. */
sp_placed sp_draft_take(const sp_search *search, sp_draft *draft, size_t i);
/* Adds a nozzle's field value to what hits a patch and what is left dry of it; without a branch, so that loops over
 * patches can take several at a time. */
static inline void sp_pour(const sp_search *search, float field, float *hit, float *dry)
{
    float more = field > 0 ? field : 0, edge = field < 0 ? 1 + field : 1, sum = *hit + more;
    *dry *= edge;
    *hit = !search->single ? sum : more > *hit ? more : *hit;
}
/* The share of a patch that is covered. */
static inline float sp_covered(float wet, float dry)
{
    return wet >= SP_ENOUGH ? 1 : 1 - dry;
}
/* Draws wet, dry, flow, outlay, covered and value from the items. */
void sp_draft_refresh(const sp_search *search, sp_draft *draft);
/* What it covers of the search's patches, m², added up in their order. */
double sp_draft_counted(const sp_search *search, const sp_draft *draft);
/* True where a covers more than b, and not the same but for round-off. */
static inline bool sp_covers_more(const sp_search *search, const sp_draft *a, const sp_draft *b)
{
    return a->covered > b->covered + SP_TIE * search->all;
}
/* What a nozzle of this flow takes there, m³/s. */
static inline double sp_outlay_at(const sp_search *search, uint32_t mount, double flow)
{
    return flow + search->options->mounts[mount].cost;
}
static inline double sp_placed_outlay(const sp_search *search, const sp_placed *placed)
{
    return sp_outlay_at(search, placed->site.mount, placed->flow);
}
/* m³/s that the scene's own layout would take, with what the mounts that its nozzles lie on cost. */
double sp_own_outlay(const sp_search *search);
/* What the draft's mounts cost, m³/s; and the water (m³/s) that its nozzles may take within an outlay of `budget`. */
double sp_draft_costs(const sp_search *search, const sp_draft *draft);
double sp_draft_water(const sp_search *search, const sp_draft *draft, double budget);
/* True where one more nozzle of this flow fits within an outlay of `budget`, and within max_water. */
static inline bool sp_affords(const sp_search *search, double flow, double outlay, uint32_t mount, double more,
                              double budget)
{
    return outlay + sp_outlay_at(search, mount, more) <= budget &&
           (!search->costly || flow + more <= search->options->max_water * (1 + SP_ROUNDING));
}
/* True where the draft may take one more nozzle at the site: number and ports, not water. */
bool sp_draft_has_place(const sp_search *search, const sp_draft *draft, uint32_t mount);
/* Named nozzles, the kept ones first. */
sp_layout *sp_draft_layout(const sp_search *search, const sp_draft *draft, sp_error *error);

#endif
