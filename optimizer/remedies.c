#include "remedies.h"

#include "attainable/patch_at.h"
#include "scoring/bodies.h"
#include "scoring/partial_packing.h"
#include "spray/criterion.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* Mounting points, those that promise most, of which it is counted what they do: the search's patches may see more of
 * what is thin than there is. Jets are too dear for it. */
#define TRIALS 5

/* A site's best pose for the shadow in hand. */
typedef struct {
    sp_pose pose;
    double gain; /* m²; 0: none */
} site_best;

/* What promises most for a shadow, in that order. */
typedef struct {
    size_t count;
    site_best sites[TRIALS];
} promise;

typedef struct {
    const sp_search *search;
    const sp_evaluator *fine;
    const sp_coverage *coverage;
    uint32_t *number;         /* [fine patches], of the shadow that each lies in, from 1 */
    uint32_t *coarse_of;      /* [fine patches], the search's patch of those that lie in a shadow */
    sp_place_options options; /* without limits */
    sp_search masked;         /* to which nothing but the shadow in hand is worth anything */
    site_best *best;          /* [sites] */
    int threads;
    sp_scorer *scorers; /* [threads] */
} remedying;

static void remedying_free(remedying *r)
{
    free(r->number);
    free(r->coarse_of);
    free(r->masked.area);
    free(r->best);
    sp_scorers_destroy(r->scorers, r->threads);
}

static bool remedying_create(remedying *r, const sp_shadow *shadows, size_t count, sp_error *error)
{
    size_t patches = sp_evaluator_patches(r->fine)->count;
    r->options = *r->search->options;
    r->options.max_nozzles = 0;
    r->masked = *r->search;
    r->masked.options = &r->options;
    r->masked.credit = 0;
    r->masked.area = malloc((r->search->patch_count + 1) * sizeof *r->masked.area);
    r->number = malloc((patches + 1) * sizeof *r->number);
    r->coarse_of = malloc((patches + 1) * sizeof *r->coarse_of);
    r->best = malloc((r->search->sites->count + 1) * sizeof *r->best);
    if (!r->masked.area || !r->number || !r->coarse_of || !r->best)
        return sp_fail_memory(error);
    if (!sp_shadow_numbers(r->fine, r->coverage, shadows, count, r->number, error))
        return false;
    for (size_t p = 0; p < patches; p++)
        r->coarse_of[p] = r->number[p] ? sp_coarse_patch(r->fine, r->search->coarse, p) : SP_NONE;
    r->threads = sp_scorer_threads(&r->masked);
    r->scorers = sp_scorers_create(&r->masked, r->threads, error);
    return r->scorers != NULL;
}

/* Leaves the shadow alone worth something. What the search's patches, which may be coarser, see as covered of it is dry
 * to begin with. */
static void mask(remedying *r, uint32_t shadow, sp_partial *partial)
{
    const sp_patches *patches = sp_evaluator_patches(r->fine);
    const sp_deposits *deposits = &r->coverage->deposits;
    memset(r->masked.area, 0, r->search->patch_count * sizeof *r->masked.area);
    for (size_t p = 0; p < patches->count; p++) {
        uint32_t coarse = r->coarse_of[p];
        if (r->number[p] != shadow || coarse == SP_NONE)
            continue;
        r->masked.area[coarse] += (float)((1 - deposits->share[p]) * patches->area[p] / r->search->all);
        if (partial->wet[coarse] < SP_ENOUGH)
            continue;
        partial->hit[coarse] = partial->wet[coarse] = 0;
        if (partial->film)
            partial->film[coarse] = 0;
        partial->dry[coarse] = 1;
    }
}

/* The first of the equally good. */
static void scan_variant(const remedying *r, const sp_partial *partial, sp_scorer *scorer, uint32_t variant,
                         site_best *best)
{
    const sp_candidates *candidates = r->search->candidates;
    uint32_t mount = r->search->sites->items[scorer->site].mount;
    size_t axes = sp_candidates_axes(candidates, mount, variant)->count;
    double tie = SP_SCORE_TIE * r->search->all;
    sp_scorer_take(scorer, variant);
    double most = sp_scorer_most(scorer); /* mounting points see little of one shadow, and soon all of that is wet */
    for (uint32_t a = 0; a < axes && most > best->gain + tie; a++)
        for (uint32_t roll = 0; roll < candidates->variants[variant].roll_count; roll++) {
            sp_pose pose = {scorer->site, variant, a, roll};
            double gain = sp_scorer_score(scorer, a, roll, best->gain + tie).gain;
            gain = sp_gain_at(&r->masked, partial, pose, gain);
            if (gain > best->gain + tie)
                *best = (site_best){pose, gain};
        }
}

static void scan_site(remedying *r, const sp_partial *partial, uint32_t site)
{
    const sp_candidates *candidates = r->search->candidates;
    sp_scorer *scorer = &r->scorers[omp_get_thread_num()];
    r->best[site] = (site_best){.gain = 0};
    if (!sp_partial_has_place(&r->masked, partial, r->search->sites->items[site].mount))
        return;
    for (size_t s = 0; s < candidates->launch_count; s++) {
        sp_scorer_look(scorer, &r->masked, partial, site, s);
        for (uint32_t k = 0; k < candidates->variant_count; k++)
            if (candidates->variants[k].launch == s && sp_search_knows(&r->masked, site, k) &&
                sp_body_clear(&r->masked, partial, sp_pose_body(&r->masked, &(sp_pose){.site = site, .variant = k})))
                scan_variant(r, partial, scorer, k, &r->best[site]);
    }
}

static sp_ranks *ranks_of(const remedying *r)
{
    return r->search->options->run.ranks;
}

/* Of all sites, of which each rank scans its own. */
static bool scan(remedying *r, const sp_partial *partial, sp_error *error)
{
    size_t sites = r->search->sites->count;
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    memset(r->best, 0, sites * sizeof *r->best);
#pragma omp parallel for num_threads(r->threads) schedule(dynamic, 1)
    for (size_t i = 0; i < sites; i++)
        if (sp_ranks_mine(ranks_of(r), i))
            scan_site(r, partial, (uint32_t)i);
    sp_scorers_forget(r->scorers, r->threads);
    for (size_t i = 0; i < sites; i++)
        if (sp_ranks_mine(ranks_of(r), i))
            sp_pack(&outgoing, &r->best[i], sizeof r->best[i]);
    if (!sp_ranks_gather(ranks_of(r), "shadow", &outgoing, &gathered, error))
        return false;
    for (size_t i = 0; i < sites; i++)
        if (!sp_ranks_mine(ranks_of(r), i))
            sp_unpack(&gathered, sp_ranks_owner(ranks_of(r), i), &r->best[i], sizeof r->best[i]);
    sp_gathered_free(&gathered);
    return true;
}

/* Takes the site that promises most, the first of equals; NULL where none promises anything. */
static site_best *take_best(remedying *r)
{
    site_best *best = NULL;
    for (size_t i = 0; i < r->search->sites->count; i++)
        if (r->best[i].gain > (best ? best->gain : 0) + SP_SCORE_TIE * r->search->all)
            best = &r->best[i];
    return best;
}

/* Whether the last nozzle's edges are another's, which were counted before. */
static bool shares_edges(const remedying *r, const sp_layout *layout)
{
    size_t last = layout->count - 1, k = 0;
    while (k < last &&
           !sp_nozzles_share_edges(&layout->nozzles[k], &layout->nozzles[last], &sp_evaluator_setup(r->fine)->liquid))
        k++;
    return k < last;
}

/* m² of the shadow that the layout covers with the last nozzle, of which `alone` says what it brings, and not without
 * it: liquid of one does not depend on the others'. */
static double newly_covered(const remedying *r, uint32_t shadow, const sp_layout *layout, const sp_coverage *alone)
{
    const sp_patches *patches = sp_evaluator_patches(r->fine);
    const sp_criterion *criterion = &sp_evaluator_setup(r->fine)->criterion;
    const sp_deposits *had = &r->coverage->deposits, *more = &alone->deposits;
    bool edges = !shares_edges(r, layout);
    double area = 0;
    for (size_t p = 0; p < patches->count; p++) {
        if (r->number[p] != shadow)
            continue;
        double even = sp_combined(criterion, had->even[p], more->even[p]), dry = edges ? more->dry[p] : 1;
        double share = sp_share_covered(criterion, even, had->dry[p] * dry, had->film[p] + more->film[p]);
        area += patches->area[p] * (share - had->share[p]);
    }
    return fmax(0, area);
}

/* The layout with that nozzle, by the scene's own settings: *remedy becomes it where it covers more. */
static bool measure(const remedying *r, const sp_partial *partial, sp_pose pose, uint32_t shadow, sp_remedy *remedy,
                    sp_error *error)
{
    sp_partial more;
    if (!sp_partial_copy(r->search, partial, &more, error))
        return false;
    sp_layout *layout =
        sp_partial_add_pose(r->search, &more, pose, error) ? sp_partial_to_layout(r->search, &more, error) : NULL;
    const sp_layout one = {.count = 1, .nozzles = layout ? &layout->nozzles[layout->count - 1] : NULL};
    sp_coverage *alone = layout ? sp_evaluate(r->fine, &one, error) : NULL;
    const sp_mount *mount = &r->search->options->mounts[r->search->sites->items[pose.site].mount];
    bool done = alone != NULL;
    double area = done ? newly_covered(r, shadow, layout, alone) : 0;
    if (done && (!remedy->nozzle.type || area > remedy->area)) {
        *remedy = (sp_remedy){
            .nozzle = one.nozzles[0], .in_port = mount->kind == SP_MOUNT_PORT, .area = area, .flow = alone->flow};
        if (remedy->in_port) /* a nozzle that sits elsewhere may be called like it */
            memcpy(remedy->nozzle.name, mount->name, sizeof remedy->nozzle.name);
    }
    sp_coverage_destroy(alone);
    sp_layout_destroy(layout);
    sp_partial_free(&more);
    return done;
}

static bool look_for(remedying *r, const sp_partial *partial, uint32_t shadow, promise *found, sp_error *error)
{
    sp_partial dry;
    size_t trials = sp_evaluator_fidelity(r->fine)->method == SP_METHOD_INVERSE ? TRIALS : 1;
    *found = (promise){.count = 0};
    if (!sp_partial_copy(r->search, partial, &dry, error))
        return false;
    mask(r, shadow, &dry);
    bool done = scan(r, &dry, error);
    sp_partial_free(&dry);
    for (site_best *best; done && found->count < trials && (best = take_best(r)); best->gain = 0)
        found->sites[found->count++] = *best;
    return done;
}

static bool try_out(const remedying *r, const sp_partial *partial, uint32_t shadow, const promise *found,
                    sp_remedy *remedy, sp_error *error)
{
    *remedy = (sp_remedy){.area = 0};
    for (size_t i = 0; i < found->count; i++) {
        if (remedy->nozzle.type && remedy->area >= found->sites[i].gain)
            break; /* what it promises is rarely too little */
        if (!measure(r, partial, found->sites[i].pose, shadow, remedy, error))
            return false;
    }
    return true;
}

/* What the others have found for their shadows, first to end. */
static bool share(const remedying *r, sp_remedy *remedies, size_t first, size_t end, sp_error *error)
{
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    for (size_t i = first; i < end; i++)
        if (sp_ranks_mine(ranks_of(r), i)) {
            sp_pack(&outgoing, &remedies[i], sizeof remedies[i]);
            sp_pack_nozzle(r->search, &remedies[i].nozzle, &outgoing);
        }
    if (!sp_ranks_gather(ranks_of(r), "remedies", &outgoing, &gathered, error))
        return false;
    for (size_t i = first; i < end; i++) {
        size_t rank = sp_ranks_owner(ranks_of(r), i);
        if (!sp_ranks_mine(ranks_of(r), i) && sp_unpack(&gathered, rank, &remedies[i], sizeof remedies[i]))
            sp_unpack_nozzle(r->search, &gathered, rank, &remedies[i].nozzle);
    }
    sp_gathered_free(&gathered);
    return true;
}

/* Those of a few shadows, first to end: all ranks look for what promises most, then each tries that for its own. */
static bool find_some(remedying *r, const sp_partial *partial, size_t first, size_t end, sp_remedy *remedies,
                      sp_error *error)
{
    promise found[SP_REMEDIES];
    bool done = true;
    for (size_t i = first; i < end; i++)
        remedies[i] = (sp_remedy){.area = 0};
    for (size_t i = first; done && i < end; i++)
        done = look_for(r, partial, (uint32_t)i + 1, &found[i], error);
    for (size_t i = first; done && i < end; i++)
        if (sp_ranks_mine(ranks_of(r), i))
            done = try_out(r, partial, (uint32_t)i + 1, &found[i], &remedies[i], error);
    return done && share(r, remedies, first, end, error);
}

bool sp_remedies_find(const sp_search *search, const sp_evaluator *fine, const sp_partial *partial,
                      const sp_coverage *coverage, sp_deadline *deadline, sp_remedy *remedies, size_t *count,
                      sp_error *error)
{
    remedying r = {.search = search, .fine = fine, .coverage = coverage};
    sp_shadow *shadows = NULL;
    size_t found = 0;
    *count = 0;
    if (!sp_shadows(fine, coverage, NULL, &shadows, &found, error))
        return false;
    found = found < SP_REMEDIES ? found : SP_REMEDIES;
    bool done = remedying_create(&r, shadows, found, error);
    while (done && *count < found && sp_deadline_has_time(deadline, "remedies", (double)*count / (double)found)) {
        size_t end = *count + sp_ranks_count(ranks_of(&r));
        end = end < found ? end : found;
        done = find_some(&r, partial, *count, end, remedies, error);
        *count = done && !sp_ranks_lost(ranks_of(&r)) ? end : *count;
    }
    if (*count < found)
        sp_deadline_cut(deadline, "remedies");
    remedying_free(&r);
    free(shadows);
    return done;
}
