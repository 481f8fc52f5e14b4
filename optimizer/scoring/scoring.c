#include "scoring/scoring.h"

#include "scoring/footprints.h"

#include <stdlib.h>

#define ROUNDED_MORE (1 + 1e-4) /* than single precision puts a sum of bins' totals wrong */

static bool sweeper_create(const sp_search *search, sp_sweeper *sweeper, sp_error *error)
{
    /* whole vectors, and one that begins at the last arrival */
    size_t room = (search->visibility->largest + 2 * SP_LANES) / SP_LANES * SP_LANES;
    *sweeper = (sp_sweeper){.block = malloc(4 * room * sizeof *sweeper->block)};
    if (!sweeper->block)
        return sp_fail_memory(error);
    float **column[] = {&sweeper->had, &sweeper->area, &sweeper->room, &sweeper->gain};
    for (size_t i = 0; i < 4; i++)
        *column[i] = sweeper->block + i * room;
    /* what lies behind a view's end is computed with, though never counted */
    for (size_t i = 0; i < 4 * room; i++)
        sweeper->block[i] = 0;
    if (!search->runoffs && !search->footprints)
        return true;
    sweeper->field = malloc((search->field_count + 1) * sizeof *sweeper->field);
    sweeper->fields = (sp_field_sweeper){.cull = &sweeper->cull,
                                         .share = sweeper->had,
                                         .counts = sweeper->area,
                                         .runs = malloc(SP_BINS * sizeof *sweeper->fields.runs)};
    return (sweeper->field && sweeper->fields.runs) || sp_fail_memory(error);
}

sp_sweeper *sp_sweepers_create(const sp_search *search, int count, sp_error *error)
{
    sp_sweeper *sweepers = calloc((size_t)count, sizeof *sweepers);
    if (!sweepers)
        return sp_fail_memory(error);
    for (int i = 0; i < count; i++)
        if (!sweeper_create(search, &sweepers[i], error)) {
            sp_sweepers_destroy(sweepers, count);
            return NULL;
        }
    return sweepers;
}

int sp_sweeper_threads(const sp_search *search)
{
    return search->visibility->buffer_count;
}

void sp_sweepers_forget(sp_sweeper *sweepers, int count)
{
    for (int i = 0; i < count; i++) {
        if (sweepers[i].search)
            sp_visibility_release(sweepers[i].search->visibility, &sweepers[i].buffer);
        sweepers[i].search = NULL;
    }
}

void sp_sweepers_destroy(sp_sweeper *sweepers, int count)
{
    if (sweepers)
        sp_sweepers_forget(sweepers, count);
    for (int i = 0; sweepers && i < count; i++) {
        free(sweepers[i].block);
        free(sweepers[i].field);
        free(sweepers[i].fields.runs);
    }
    free(sweepers);
}

void sp_sweeper_look(sp_sweeper *sweeper, const sp_search *search, const sp_partial *partial, uint32_t site,
                     size_t launch)
{
    if (sweeper->search == search && sweeper->site == site && sweeper->launch == launch)
        return;
    const sp_view *view = sp_visibility_look(search->visibility, site, launch, &sweeper->buffer);
    sweeper->search = search;
    sweeper->variant = SIZE_MAX;
    sweeper->view = view;
    sweeper->site = site;
    sweeper->launch = launch;
    sweeper->frame = sp_nozzle_frame(search->sites->items[site].axis, 0, sp_evaluator_setup(search->coarse)->up);
    sweeper->partial = partial;
    sweeper->fields.view = view;
    if (!view->start || search->runoffs)
        return;
    for (uint32_t i = 0; i < view->count; i++) {
        sweeper->had[i] = partial->wet[view->patch[i]];
        sweeper->area[i] = search->area[view->patch[i]] * partial->dry[view->patch[i]] * sp_view_part(view, i);
    }
    sp_credit credit = {search->single, search->credit, 0};
    search->sweeps->room(&credit, view->count, sweeper->had, sweeper->area, sweeper->room);
    search->sweeps->total(view, sweeper->room, sweeper->room_total);
}

void sp_sweeper_take(sp_sweeper *sweeper, size_t variant)
{
    const sp_search *search = sweeper->search;
    const sp_variant *own = &search->candidates->variants[variant];
    if (sweeper->variant == variant)
        return;
    sweeper->variant = variant;
    if (!sp_type_is_uniform(own->type))
        return;
    double strength = sp_variant_strength(search, own);
    sp_credit credit = {search->single, search->credit, (float)strength};
    sweeper->region = sp_region_create(&own->spray, &sweeper->frame, strength, 0);
    if (!sweeper->view->start)
        return;
    sp_cull_create(&search->visibility->bins, sweeper->view, &own->spray, SP_COUNT_SHARE, &sweeper->cull);
    if (search->runoffs)
        return;
    search->sweeps->gain(&credit, sweeper->view->count, sweeper->had, sweeper->area, sweeper->view->transfer,
                         sweeper->gain);
    search->sweeps->total(sweeper->view, sweeper->gain, sweeper->gain_total);
}

sp_region sp_sweeper_region(const sp_sweeper *sweeper, uint32_t axis, uint32_t roll)
{
    const sp_search *search = sweeper->search;
    const sp_variant *variant = &search->candidates->variants[sweeper->variant];
    uint32_t mount = search->sites->items[sweeper->site].mount;
    sp_vec3 lean = sp_candidates_axes(search->candidates, mount, sweeper->variant)->axes[axis];
    sp_vec3 z = sp_frame_axis(&sweeper->frame, lean), up = sp_evaluator_setup(search->coarse)->up;
    sp_region region = sweeper->region;
    sp_frame frame = region.outline.flat ? sp_nozzle_frame(z, sp_variant_roll(variant, roll), up) : (sp_frame){z, z, z};
    sp_outline_turn(&region.outline, &frame);
    return region;
}

/* The footprint of a pose at hand; NULL where sweeps know its variant. */
static const sp_footprint *footprint_at(const sp_sweeper *sweeper, uint32_t axis, uint32_t roll)
{
    const sp_search *search = sweeper->search;
    sp_pose pose = {sweeper->site, (uint32_t)sweeper->variant, axis, roll};
    return sp_type_is_uniform(search->candidates->variants[pose.variant].type)
               ? NULL
               : sp_footprints_look(search->footprints, pose);
}

const float *sp_sweeper_field(const sp_sweeper *sweeper, uint32_t axis, uint32_t roll)
{
    const sp_search *search = sweeper->search;
    const sp_footprint *footprint = footprint_at(sweeper, axis, roll);
    if (footprint) {
        sp_footprint_field(search, footprint, sweeper->field);
        return sweeper->field;
    }
    sp_region region = sp_sweeper_region(sweeper, axis, roll);
    sp_field_sweep(search, &sweeper->fields, &search->candidates->variants[sweeper->variant], &region, sweeper->field);
    return sweeper->field;
}

sp_score sp_sweeper_score(const sp_sweeper *sweeper, uint32_t axis, uint32_t roll, double least)
{
    const sp_search *search = sweeper->search;
    const sp_footprint *footprint = footprint_at(sweeper, axis, roll);
    if (footprint)
        return sp_footprint_score(search, sweeper->partial, footprint);
    if (!sweeper->view->start)
        return (sp_score){0};
    /* film knows no bins: what runs down comes from everywhere above */
    if (search->runoffs)
        return sp_field_score(search, sweeper->partial, sp_sweeper_field(sweeper, axis, roll));
    sp_region region = sp_sweeper_region(sweeper, axis, roll);
    const sp_weight weights[] = {{sweeper->gain, sweeper->gain_total}, {sweeper->room, sweeper->room_total}};
    double sums[2];
    search->sweeps->sum(&search->visibility->bins, &sweeper->cull, &region, sweeper->view, weights, 2,
                        least / search->all, sums);
    return (sp_score){sums[0] * search->all, sums[1] * search->all};
}

double sp_sweeper_most(const sp_sweeper *sweeper)
{
    const sp_search *search = sweeper->search;
    double sum = 0;
    if (search->runoffs || !sp_type_is_uniform(search->candidates->variants[sweeper->variant].type))
        return INFINITY;
    for (size_t b = 0; sweeper->view->start && b < SP_BINS; b++)
        sum += (double)sweeper->gain_total[b];
    return ROUNDED_MORE * sum * search->all;
}

sp_score sp_score_pose(sp_sweeper *sweeper, const sp_search *search, const sp_partial *partial, sp_pose pose,
                       double least)
{
    sp_sweeper_look(sweeper, search, partial, pose.site, search->candidates->variants[pose.variant].launch);
    sp_sweeper_take(sweeper, pose.variant);
    return sp_sweeper_score(sweeper, pose.axis, pose.roll, least);
}

bool sp_search_knows(const sp_search *search, uint32_t site, size_t variant)
{
    const sp_variant *own = &search->candidates->variants[variant];
    return sp_type_is_uniform(own->type) ? sp_visibility_known(search->visibility, site, own->launch)
                                         : sp_footprints_know(search->footprints, site, (uint32_t)variant);
}
