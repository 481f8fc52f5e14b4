#include "scoring/scoring.h"

#include "scoring/footprints.h"

#include <stdlib.h>

#define ROUNDED_MORE (1 + 1e-4) /* than single precision puts a sum of bins' totals wrong */

static bool scorer_create(const sp_search *search, sp_scorer *scorer, sp_error *error)
{
    /* whole vectors, and one that begins at the last arrival */
    size_t room = (search->visibility->largest + 2 * SP_LANES) / SP_LANES * SP_LANES;
    *scorer = (sp_scorer){.block = malloc(4 * room * sizeof *scorer->block)};
    if (!scorer->block)
        return sp_fail_memory(error);
    float **column[] = {&scorer->had, &scorer->area, &scorer->room, &scorer->gain};
    for (size_t i = 0; i < 4; i++)
        *column[i] = scorer->block + i * room;
    /* what lies behind a view's end is computed with, though never counted */
    for (size_t i = 0; i < 4 * room; i++)
        scorer->block[i] = 0;
    if (!search->runoffs && !search->footprints)
        return true;
    scorer->field = malloc((search->field_count + 1) * sizeof *scorer->field);
    scorer->fields = (sp_field_scratch){.cull = &scorer->cull,
                                        .share = scorer->had,
                                        .counts = scorer->area,
                                        .runs = malloc(SP_BINS * sizeof *scorer->fields.runs)};
    return (scorer->field && scorer->fields.runs) || sp_fail_memory(error);
}

sp_scorer *sp_scorers_create(const sp_search *search, int count, sp_error *error)
{
    sp_scorer *scorers = calloc((size_t)count, sizeof *scorers);
    if (!scorers)
        return sp_fail_memory(error);
    for (int i = 0; i < count; i++)
        if (!scorer_create(search, &scorers[i], error)) {
            sp_scorers_destroy(scorers, count);
            return NULL;
        }
    return scorers;
}

int sp_scorer_threads(const sp_search *search)
{
    return search->visibility->buffer_count;
}

void sp_scorers_forget(sp_scorer *scorers, int count)
{
    for (int i = 0; i < count; i++) {
        if (scorers[i].search)
            sp_visibility_release(scorers[i].search->visibility, &scorers[i].buffer);
        scorers[i].search = NULL;
    }
}

void sp_scorers_destroy(sp_scorer *scorers, int count)
{
    if (scorers)
        sp_scorers_forget(scorers, count);
    for (int i = 0; scorers && i < count; i++) {
        free(scorers[i].block);
        free(scorers[i].field);
        free(scorers[i].fields.runs);
    }
    free(scorers);
}

void sp_scorer_look(sp_scorer *scorer, const sp_search *search, const sp_partial *partial, uint32_t site, size_t launch)
{
    if (scorer->search == search && scorer->site == site && scorer->launch == launch)
        return;
    const sp_view *view = sp_visibility_look(search->visibility, site, launch, &scorer->buffer);
    scorer->search = search;
    scorer->variant = SIZE_MAX;
    scorer->view = view;
    scorer->site = site;
    scorer->launch = launch;
    scorer->frame = sp_nozzle_frame(search->sites->items[site].axis, 0, sp_evaluator_setup(search->coarse)->up);
    scorer->partial = partial;
    scorer->fields.view = view;
    if (!view->start || search->runoffs)
        return;
    for (uint32_t i = 0; i < view->count; i++) {
        scorer->had[i] = partial->wet[view->patch[i]];
        scorer->area[i] = search->area[view->patch[i]] * partial->dry[view->patch[i]] * sp_view_part(view, i);
    }
    sp_credit credit = {search->single, search->credit, 0};
    search->kernels->room(&credit, view->count, scorer->had, scorer->area, scorer->room);
    search->kernels->total(view, scorer->room, scorer->room_total);
}

void sp_scorer_take(sp_scorer *scorer, size_t variant)
{
    const sp_search *search = scorer->search;
    const sp_variant *own = &search->candidates->variants[variant];
    if (scorer->variant == variant)
        return;
    scorer->variant = variant;
    if (!sp_type_is_uniform(own->type))
        return;
    double strength = sp_variant_strength(search, own);
    sp_credit credit = {search->single, search->credit, (float)strength};
    scorer->region = sp_region_create(&own->spray, &scorer->frame, strength, 0);
    if (!scorer->view->start)
        return;
    sp_cull_create(&search->visibility->bins, scorer->view, &own->spray, SP_COUNT_SHARE, &scorer->cull);
    if (search->runoffs)
        return;
    search->kernels->gain(&credit, scorer->view->count, scorer->had, scorer->area, scorer->view->transfer,
                          scorer->gain);
    search->kernels->total(scorer->view, scorer->gain, scorer->gain_total);
}

sp_region sp_scorer_region(const sp_scorer *scorer, uint32_t axis, uint32_t roll)
{
    const sp_search *search = scorer->search;
    const sp_variant *variant = &search->candidates->variants[scorer->variant];
    uint32_t mount = search->sites->items[scorer->site].mount;
    sp_vec3 lean = sp_candidates_axes(search->candidates, mount, scorer->variant)->axes[axis];
    sp_vec3 z = sp_frame_axis(&scorer->frame, lean), up = sp_evaluator_setup(search->coarse)->up;
    sp_region region = scorer->region;
    sp_frame frame = region.outline.flat ? sp_nozzle_frame(z, sp_variant_roll(variant, roll), up) : (sp_frame){z, z, z};
    sp_outline_turn(&region.outline, &frame);
    return region;
}

/* The footprint of a pose at hand; NULL where the kernels sum its variant. */
static const sp_footprint *footprint_at(const sp_scorer *scorer, uint32_t axis, uint32_t roll)
{
    const sp_search *search = scorer->search;
    sp_pose pose = {scorer->site, (uint32_t)scorer->variant, axis, roll};
    return sp_type_is_uniform(search->candidates->variants[pose.variant].type)
               ? NULL
               : sp_footprints_look(search->footprints, pose);
}

const float *sp_scorer_field(const sp_scorer *scorer, uint32_t axis, uint32_t roll)
{
    const sp_search *search = scorer->search;
    const sp_footprint *footprint = footprint_at(scorer, axis, roll);
    if (footprint) {
        sp_footprint_field(search, footprint, scorer->field);
        return scorer->field;
    }
    sp_region region = sp_scorer_region(scorer, axis, roll);
    sp_field_region(search, &scorer->fields, &search->candidates->variants[scorer->variant], &region, scorer->field);
    return scorer->field;
}

sp_score sp_scorer_score(const sp_scorer *scorer, uint32_t axis, uint32_t roll, double least)
{
    const sp_search *search = scorer->search;
    const sp_footprint *footprint = footprint_at(scorer, axis, roll);
    if (footprint)
        return sp_footprint_score(search, scorer->partial, footprint);
    if (!scorer->view->start)
        return (sp_score){0};
    /* film knows no bins: what runs down comes from everywhere above */
    if (search->runoffs)
        return sp_field_score(search, scorer->partial, sp_scorer_field(scorer, axis, roll));
    sp_region region = sp_scorer_region(scorer, axis, roll);
    const sp_weight weights[] = {{scorer->gain, scorer->gain_total}, {scorer->room, scorer->room_total}};
    double sums[2];
    search->kernels->sum(&search->visibility->bins, &scorer->cull, &region, scorer->view, weights, 2,
                         least / search->all, sums);
    return (sp_score){sums[0] * search->all, sums[1] * search->all};
}

double sp_scorer_most(const sp_scorer *scorer)
{
    const sp_search *search = scorer->search;
    double sum = 0;
    if (search->runoffs || !sp_type_is_uniform(search->candidates->variants[scorer->variant].type))
        return INFINITY;
    for (size_t b = 0; scorer->view->start && b < SP_BINS; b++)
        sum += (double)scorer->gain_total[b];
    return ROUNDED_MORE * sum * search->all;
}

sp_score sp_score_pose(sp_scorer *scorer, const sp_search *search, const sp_partial *partial, sp_pose pose,
                       double least)
{
    sp_scorer_look(scorer, search, partial, pose.site, search->candidates->variants[pose.variant].launch);
    sp_scorer_take(scorer, pose.variant);
    return sp_scorer_score(scorer, pose.axis, pose.roll, least);
}

bool sp_search_knows(const sp_search *search, uint32_t site, size_t variant)
{
    const sp_variant *own = &search->candidates->variants[variant];
    return sp_type_is_uniform(own->type) ? sp_visibility_known(search->visibility, site, own->launch)
                                         : sp_footprints_know(search->footprints, site, (uint32_t)variant);
}
