#include "attainable/by_fields.h"

#include "attainable/patch_at.h"
#include "scoring/mount_capacity.h"
#include "scoring/strided.h"
#include "scoring/scoring.h"

#include <omp.h>
#include <stdlib.h>

/* Of the time left, at most: a first layout takes two to four times as long, so that with less it would be poor. */
#define SHARE 0.3

/* What is asked of the fields of candidates. */
typedef enum {
    FILM,       /* of all of them */
    FOOTPRINTS, /* what hits, of those that no pattern kernel sums */
} question;

typedef struct {
    question question;
    const sp_search *search;
    sp_deadline *deadline;
    const sp_scope *scopes;
    size_t count;    /* of patches that are asked about */
    uint32_t *asked; /* [count], coarse */
    size_t places;   /* offers for each */
    int threads;
    sp_offer *offers; /* [threads][count][2][places] */
    sp_scorer *scorers;
    double water_left; /* m³/s */
} running;

static sp_place_offers offers_of(const running *r, int thread, size_t i)
{
    sp_offer *first = &r->offers[((size_t)thread * r->count + i) * 2 * r->places];
    return (sp_place_offers){first, first + r->places, r->places};
}

/* Coarse patches in which something is not attained yet. */
static bool list_asked(running *r, const sp_evaluator *fine, const sp_reason *reasons)
{
    const sp_evaluator *coarse = r->search->coarse;
    bool *wanted = calloc(r->search->patch_count + 1, sizeof *wanted);
    r->asked = malloc((r->search->patch_count + 1) * sizeof *r->asked);
    for (size_t p = 0; wanted && p < sp_evaluator_patches(fine)->count; p++) {
        uint32_t patch = reasons[p] == SP_REASON_ATTAINABLE ? SP_NONE : sp_coarse_patch(fine, coarse, p);
        if (patch != SP_NONE)
            wanted[patch] = true;
    }
    for (uint32_t p = 0; wanted && r->asked && p < r->search->patch_count; p++)
        if (wanted[p])
            r->asked[r->count++] = p;
    bool done = wanted && r->asked;
    free(wanted);
    return done;
}

/* What a field brings to a patch over what is asked for. */
static double brought(const running *r, const float *field, uint32_t patch)
{
    float hit = field[patch];
    if (r->question == FILM)
        return (double)field[r->search->patch_count + patch];
    return hit < 0 ? hit <= -0.5f ? INFINITY : 0 : (double)hit;
}

/* All that a variant at a site offers. */
static void look_at_variant(const running *r, int thread, uint32_t site, uint32_t variant)
{
    const sp_search *search = r->search;
    const sp_variant *own = &search->candidates->variants[variant];
    const sp_scope *scope = &r->scopes[variant];
    sp_scorer *scorer = &r->scorers[thread];
    uint32_t mount = search->sites->items[site].mount;
    size_t place = sp_mount_capacity(&search->options->mounts[mount]) == 1 ? mount : search->options->mount_count;
    size_t axes = sp_candidates_axes(search->candidates, mount, variant)->count;
    if (scope->flow_low > r->water_left || search->port_taken[mount])
        return;
    for (uint32_t a = 0; a < axes; a++)
        for (uint32_t roll = 0; roll < own->roll_count; roll++) {
            const float *field = sp_scorer_field(scorer, a, roll);
            for (size_t i = 0; i < r->count; i++) {
                double ratio = brought(r, field, r->asked[i]) / own->flow;
                sp_place_offers offers = offers_of(r, thread, i);
                if (ratio > 0)
                    sp_place_offers_take(&offers, place,
                                         (sp_offer){ratio, scope->flow_low, fmin(scope->flow_high, r->water_left)});
            }
        }
}

/* False where there was no time for all of them. */
static bool look_at_sites(const running *r, const sp_partial *nothing)
{
    const sp_candidates *candidates = r->search->candidates;
    bool late = !sp_deadline_goes_on(r->deadline, "attainable", 1);
#pragma omp parallel for num_threads(r->threads) schedule(dynamic, 1) reduction(|| : late)
    for (size_t i = 0; i < r->search->sites->count; i++)
        for (uint32_t k = 0; k < candidates->variant_count; k++) {
            sp_scorer *scorer = &r->scorers[omp_get_thread_num()];
            uint32_t site = (uint32_t)sp_strided(i, r->search->sites->count);
            bool uniform = sp_type_is_uniform(candidates->variants[k].type);
            late = late || !sp_deadline_goes_on(r->deadline, "attainable", 1);
            if (late || (uniform && r->question == FOOTPRINTS))
                continue;
            sp_scorer_look(scorer, r->search, nothing, site, candidates->variants[k].launch);
            if (uniform && !scorer->view->start)
                continue;
            sp_scorer_take(scorer, k);
            look_at_variant(r, omp_get_thread_num(), site, k);
        }
    sp_scorers_forget(r->scorers, r->threads);
    return !late;
}

/* Whether all threads' offers suffice for what is asked about i-th. */
static bool suffice(const running *r, size_t i)
{
    const sp_search *search = r->search;
    sp_place_offers all = offers_of(r, 0, i);
    size_t most = search->options->max_nozzles, left = most > search->kept_count ? most - search->kept_count : 0;
    for (int t = 1; t < r->threads; t++) {
        sp_place_offers more = offers_of(r, t, i);
        for (size_t place = 0; place < r->places; place++) {
            sp_place_offers_take(&all, place, more.strongest[place]);
            sp_place_offers_take(&all, place, more.thriftiest[place]);
        }
    }
    if (r->question == FILM)
        return sp_place_offers_suffice(&all, most ? left : SIZE_MAX, r->water_left,
                                       1 - (double)search->kept_film[r->asked[i]]);
    size_t nozzles = most && left < 1 ? 0 : search->alone ? 1 : most ? left : SIZE_MAX;
    return sp_place_offers_suffice(&all, nozzles, r->water_left,
                                   search->alone ? 1 : 1 - (double)search->kept_hit[r->asked[i]]);
}

static void note(const running *r, const sp_evaluator *fine, const bool *attained, sp_reason *reasons)
{
    for (size_t p = 0; p < sp_evaluator_patches(fine)->count; p++) {
        uint32_t patch = reasons[p] == SP_REASON_ATTAINABLE ? SP_NONE : sp_coarse_patch(fine, r->search->coarse, p);
        if (patch != SP_NONE && attained[patch])
            reasons[p] = SP_REASON_ATTAINABLE;
    }
}

static bool ask(const sp_evaluator *fine, running *r, sp_reason *reasons, bool *whole, sp_error *error)
{
    const sp_search *search = r->search;
    sp_partial nothing = {0};
    bool *attained = calloc(search->patch_count + 1, sizeof *attained);
    bool done = (attained && list_asked(r, fine, reasons)) || sp_fail_memory(error);
    if (done && r->count) {
        r->offers = calloc((size_t)r->threads * r->count, 2 * r->places * sizeof *r->offers);
        r->scorers = r->offers ? sp_scorers_create(search, r->threads, error) : sp_fail_memory(error);
        done = r->scorers && sp_partial_create(search, &nothing, error);
        if (done)
            *whole &= look_at_sites(r, &nothing);
        for (size_t i = 0; done && i < r->count; i++)
            attained[r->asked[i]] = suffice(r, i);
        if (done)
            note(r, fine, attained, reasons);
    }
    sp_partial_free(&nothing);
    sp_scorers_destroy(r->scorers, r->threads);
    free(r->offers);
    free(r->asked);
    free(attained);
    return done;
}

bool sp_attain_by_fields(const sp_evaluator *fine, const sp_search *search, const sp_scope *scopes,
                         sp_deadline *deadline, sp_reason *reasons, bool *whole, sp_error *error)
{
    double share = deadline->share;
    running r = {.search = search,
                 .deadline = deadline,
                 .scopes = scopes,
                 .places = search->options->mount_count + 1,
                 .threads = sp_scorer_threads(search),
                 .water_left = search->options->max_water - search->kept_flow};
    running hits = r, film = r;
    hits.question = FOOTPRINTS;
    *whole = true;
    sp_deadline_lend(deadline, SHARE);
    bool done = (!search->footprints || ask(fine, &hits, reasons, whole, error)) &&
                (!search->runoffs || ask(fine, &film, reasons, whole, error));
    sp_deadline_allow(deadline, share);
    return done;
}
