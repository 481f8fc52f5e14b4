/* What a layout does: deposits on every patch, and the figures drawn from them. */
#ifndef SPRAYPLAN_COVERAGE_H
#define SPRAYPLAN_COVERAGE_H

#include <sprayplan/error.h>
#include <sprayplan/export.h>
#include <sprayplan/vector.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Per patch (see sp_patches). Means are weighted by flux. Where no liquid arrives everything is 0. */
typedef struct {
    size_t count;
    double *flux;    /* all liquid that arrives, m³/s per m² */
    double *counted; /* of it, what the criterion counts: from jets that pass speed and incidence; with
                      * SP_COMBINE_SINGLE of the best nozzle alone */
    double *jets;    /* jets (forward) or arcs (inverse) that arrive */
    double *speed;   /* mean impact speed, m/s */
    double *speed_max;
    double *incidence; /* mean, rad from the normal */
    double *incidence_min;
    double *impact; /* mean pressure rho v_n² of the normal component, Pa */
    double *impact_max;
    double *even;  /* of the counted flux, what falls on all of the patch, m³/s per m² (see sp_wetting) */
    double *dry;   /* share of the patch that no nozzle's edge covers */
    double *film;  /* what runs down the patch, m²/s: flow per width; 0 where the criterion does not ask */
    double *share; /* of the patch, that is covered: all where `even` or `film` meets the criterion, else 1 - dry */
    bool *covered; /* at least half of it */
    bool *by_film; /* covered, and less than half of it by impact */
} sp_deposits;

/* What one pattern's passing arrivals bring to a patch that may lie across the edge of its spray. An arrival that meets
 * the criterion alone covers the share of the patch that lies inside the spray; one that does not may still do so with
 * others', and counts where the patch's point lies inside. The shares that several patterns cover are taken to lie
 * anywhere: together they leave dry the product of what each leaves dry; of nozzles that share their edges (see
 * sp_layout_repeats) these lie in one place and count once. Where patterns of one nozzle leave one point, one after the
 * other in their order, it is looked at how their shares lie: of edges that coincide the patch is dry by the least that
 * one leaves, and those that abut add up. Of a patch that is cut into cells (see sp_arrival) each covers a share of its
 * own part, or brings its part of what falls on all of the patch. Starts as {0, 1, 0}. */
typedef struct {
    double even;  /* flux on all of the patch, as `threshold` */
    double dry;   /* share that is not covered by the edges */
    double cells; /* share that cells cover by themselves */
} sp_wetting;
/* Whether this flux meets the criterion, a threshold of 0 being met by any. */
static inline bool sp_flux_suffices(double flux, double threshold)
{
    return flux > 0 && flux >= threshold;
}
/* `flux`: of the arrival inside the spray; `share` of the `part` of the patch that is inside; `holds`: its point is,
 * which is not asked of one that meets the criterion alone. */
static inline void sp_wetting_add(sp_wetting *wetting, double flux, double threshold, double part, double share,
                                  bool holds)
{
    bool alone = sp_flux_suffices(flux, threshold);
    if (alone && part < 1)
        wetting->cells += part * share;
    else if (alone && share < 1)
        wetting->dry *= 1 - share;
    else if (alone || holds)
        wetting->even += part * flux;
}
/* What one pattern's arrivals come to: all of the patch, or what its edge covers; what falls short besides is nothing.
 */
static inline sp_wetting sp_wetting_settle(sp_wetting wetting, double threshold)
{
    if (wetting.cells > 0) { /* sums of parts that are all there are round to 1 */
        sp_wetting cells = {0, wetting.cells < 1 - 1e-6 ? 1 - wetting.cells : 0, 0};
        return cells;
    }
    if (wetting.dry < 1 && sp_flux_suffices(wetting.even, threshold))
        wetting.dry = 1;
    else if (wetting.dry < 1)
        wetting.even = 0;
    return wetting;
}
/* The share covered by all that came together. */
static inline double sp_wetting_share(const sp_wetting *wetting, double threshold)
{
    return sp_flux_suffices(wetting->even, threshold) ? 1 : 1 - wetting->dry;
}

/* Why a patch is not attainable: how near the nozzle that comes nearest brings the point that it is judged by, of all
 * nozzles at the mounting points, aimed in any way that the mounts allow. */
typedef enum {
    SP_REASON_ATTAINABLE, /* it is */
    SP_REASON_UNKNOWN,    /* the search for a reason was cut short */
    SP_REASON_NO_LINE,    /* no flight from any mounting point arrives at that point; other parts of the patch may be
                           * reached */
    SP_REASON_REFLECTION, /* only liquid that a wall throws back does */
    SP_REASON_SLOW,       /* what arrives is slower than the criterion asks */
    SP_REASON_SLANTED,    /* what arrives fast enough is more slanted than the criterion allows */
    SP_REASON_FLUX,       /* what arrives fast and steeply enough is too little: too far for the flux, within the limits
                           * of number and water; without a flux these limits alone keep it away */
    SP_REASONS,
} sp_reason;

/* What a layout's liquid lacks where it does not cover. */
typedef enum {
    SP_LACK_NOTHING, /* it covers */
    SP_LACK_REACH,   /* no liquid arrives */
    SP_LACK_SPEED,   /* all that arrives is slower than the criterion asks */
    SP_LACK_ANGLE,   /* what arrives fast enough is more slanted than the criterion allows */
    SP_LACK_FLUX,    /* what arrives fast and steeply enough is too little */
    SP_LACKS,
} sp_lack;

/* A connected region without coverage. */
typedef struct {
    double area;           /* m², of its patches; no more than all that is not covered */
    sp_vec3 centroid;      /* m */
    uint32_t part;         /* of the mesh: the part with most of the area */
    uint32_t first;        /* its lowest patch */
    double reachable_area; /* m² of it that is attainable; -1 where attainable area was not computed */
    sp_reason reason;      /* of most of its area that is not attainable; attainable or unknown where there is none */
    sp_lack lack;          /* of most of its area; of equal ones the first */
} sp_shadow;

/* Where a layout's liquid ends, m³/s; the sum is what leaves its nozzles. */
typedef struct {
    bool known;        /* false: nothing below means anything */
    double clean;      /* stays on surface that is cleaned and counted */
    double other;      /* stays on obstacles and dry sides */
    double left;       /* flies out of the geometry and meets nothing */
    double unfollowed; /* is thrown back from a wall and not followed any further */
} sp_balance;

/* What has hit a wall and runs down it, m³/s, and what that does. */
typedef struct {
    bool known;       /* false: the criterion does not ask for film, and nothing below means anything */
    double arriving;  /* on wet surface, cleaned or not, at the first impact */
    double left;      /* of it, runs or drips out of the geometry */
    double astray;    /* drips on surface that is not wet */
    double held;      /* stands where it cannot drain */
    double area;      /* m² that impact does not cover and film does */
    double per_girth; /* m²/s: `arriving` over the girth of the wet walls, the perimeter of their convex hull seen from
                       * above, as rules of thumb have it; not what the criterion asks for */
} sp_film_balance;

/* How far a coverage is off, measured at points (see sp_measure_error); shares of the area. */
typedef struct {
    bool known;       /* false: nothing below means anything */
    double estimate;  /* the error of the coverage is hardly ever larger than this */
    double bias;      /* mean difference that was found: above 0, too much is covered */
    double misjudged; /* mean size of what each point is off by, whichever way */
    size_t points;    /* as many were judged */
} sp_measured_error;

/* How much of the surface round-off could judge otherwise (see sp_find_borderline). */
typedef struct {
    bool known;  /* false: nothing below means anything */
    double area; /* m², of patches whole */
} sp_borderline;

/* What is proved of how far lines may be from parabolas (see sp_bound_lines). */
typedef struct {
    bool known;   /* false: nothing below means anything */
    double share; /* of the area */
} sp_line_error;

/* Counted, so that it is the same on every machine. */
typedef struct {
    size_t places; /* patches and cells to which flights were solved for */
    size_t rays;   /* traced */
} sp_work;

typedef struct {
    double area;                                    /* clean (and wet) area, m² */
    double covered_area;                            /* Σ share area, m² */
    double fraction;                                /* covered_area / area */
    double flow;                                    /* m³/s */
    double area_per_water;                          /* covered area over flow, m² per m³/s; 0 without flow */
    double flux_min, flux_mean, flux_p05, flux_max; /* m³/s per m² over the clean area, by area; p05: 5th percentile */
    sp_balance balance; /* known from the forward evaluator; else sp_evaluate_balance works it out */
    sp_film_balance film;
    sp_measured_error measured; /* not known until sp_measure_error is asked for it */
    sp_borderline borderline;   /* not known until sp_find_borderline is asked for it */
    sp_line_error line_error;   /* not known until sp_bound_lines is asked for it */
    sp_work work;               /* of evaluating */
    sp_deposits deposits;
} sp_coverage;

SP_API void sp_coverage_destroy(sp_coverage *coverage);

struct sp_evaluator;
/* Connected uncovered regions, largest first (equal area: lowest patch first). `reasons` [patches] may be NULL.
 * On success *shadows is malloc'd (NULL where there are none) and the caller frees it. */
SP_API bool sp_shadows(const struct sp_evaluator *evaluator, const sp_coverage *coverage, const sp_reason *reasons,
                       sp_shadow **shadows, size_t *count, sp_error *error);
/* Which of the first `count` of these shadows each patch lies in: numbers [patches], the caller's, from 1, 0 for none.
 */
SP_API bool sp_shadow_numbers(const struct sp_evaluator *evaluator, const sp_coverage *coverage,
                              const sp_shadow *shadows, size_t count, uint32_t *numbers, sp_error *error);
/* What a patch lacks. */
SP_API sp_lack sp_patch_lack(const struct sp_evaluator *evaluator, const sp_coverage *coverage, uint32_t patch);

#ifdef __cplusplus
}
#endif
#endif
