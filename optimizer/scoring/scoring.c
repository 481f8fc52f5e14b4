#include "scoring/scoring.h"

#include <stdlib.h>

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
    return true;
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
    return search->visibility->desk_count;
}

void sp_sweepers_forget(sp_sweeper *sweepers, int count)
{
    for (int i = 0; i < count; i++) {
        if (sweepers[i].search)
            sp_visibility_leave(sweepers[i].search->visibility, &sweepers[i].desk);
        sweepers[i].search = NULL;
    }
}

void sp_sweepers_destroy(sp_sweeper *sweepers, int count)
{
    if (sweepers)
        sp_sweepers_forget(sweepers, count);
    for (int i = 0; sweepers && i < count; i++)
        free(sweepers[i].block);
    free(sweepers);
}

static double strength_of(const sp_search *search, const sp_make *make)
{
    return search->plenty > 0 ? make->flow / (make->spray.solid_angle * search->plenty) : INFINITY;
}

void sp_sweeper_look(sp_sweeper *sweeper, const sp_search *search, const sp_draft *draft, uint32_t site, size_t speed)
{
    if (sweeper->search == search && sweeper->site == site && sweeper->speed == speed)
        return;
    const sp_view *view = sp_visibility_look(search->visibility, site, speed, &sweeper->desk);
    sweeper->search = search;
    sweeper->make = SIZE_MAX;
    sweeper->view = view;
    sweeper->site = site;
    sweeper->speed = speed;
    sweeper->frame = sp_nozzle_frame(search->sites->items[site].axis, 0, sp_evaluator_setup(search->coarse)->up);
    if (!view->start)
        return;
    for (uint32_t i = 0; i < view->count; i++) {
        sweeper->had[i] = draft->wet[view->patch[i]];
        sweeper->area[i] = search->area[view->patch[i]] * draft->dry[view->patch[i]] * sp_view_part(view, i);
    }
    sp_credit credit = {search->single, search->credit, 0};
    search->sweeps->room(&credit, view->count, sweeper->had, sweeper->area, sweeper->room);
    search->sweeps->total(view, sweeper->room, sweeper->room_total);
}

void sp_sweeper_take(sp_sweeper *sweeper, size_t make)
{
    const sp_search *search = sweeper->search;
    const sp_make *own = &search->candidates->makes[make];
    double strength = strength_of(search, own);
    sp_credit credit = {search->single, search->credit, (float)strength};
    if (sweeper->make == make)
        return;
    sweeper->make = make;
    sweeper->region = sp_region_create(&own->spray, &sweeper->frame, strength, 0);
    if (!sweeper->view->start)
        return;
    sp_cull_create(&search->visibility->bins, sweeper->view, &own->spray, SP_COUNT_SHARE, &sweeper->cull);
    search->sweeps->gain(&credit, sweeper->view->count, sweeper->had, sweeper->area, sweeper->view->transfer,
                         sweeper->gain);
    search->sweeps->total(sweeper->view, sweeper->gain, sweeper->gain_total);
}

sp_region sp_sweeper_region(const sp_sweeper *sweeper, uint32_t axis, uint32_t roll)
{
    const sp_search *search = sweeper->search;
    const sp_make *make = &search->candidates->makes[sweeper->make];
    uint32_t mount = search->sites->items[sweeper->site].mount;
    sp_vec3 lean = sp_candidates_axes(search->candidates, mount, sweeper->make)->axes[axis];
    sp_vec3 z = sp_frame_axis(&sweeper->frame, lean), up = sp_evaluator_setup(search->coarse)->up;
    sp_region region = sweeper->region;
    sp_frame frame = region.fan ? sp_nozzle_frame(z, sp_make_roll(make, roll), up) : (sp_frame){z, z, z};
    sp_region_turn(&region, &frame);
    return region;
}

sp_score sp_sweeper_score(const sp_sweeper *sweeper, uint32_t axis, uint32_t roll, double least)
{
    const sp_search *search = sweeper->search;
    if (!sweeper->view->start)
        return (sp_score){0};
    sp_region region = sp_sweeper_region(sweeper, axis, roll);
    const sp_weight weights[] = {{sweeper->gain, sweeper->gain_total}, {sweeper->room, sweeper->room_total}};
    double sums[2];
    search->sweeps->sum(&search->visibility->bins, &sweeper->cull, &region, sweeper->view, weights, 2,
                        least / search->all, sums);
    return (sp_score){sums[0] * search->all, sums[1] * search->all};
}

sp_score sp_score_pose(sp_sweeper *sweeper, const sp_search *search, const sp_draft *draft, sp_pose pose, double least)
{
    sp_sweeper_look(sweeper, search, draft, pose.site, search->candidates->makes[pose.make].speed_class);
    sp_sweeper_take(sweeper, pose.make);
    return sp_sweeper_score(sweeper, pose.axis, pose.roll, least);
}

sp_posed_spray sp_posed_spray_of(const sp_search *search, const sp_nozzle *nozzle)
{
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    sp_posed_spray posed = {sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle)),
                            sp_nozzle_frame(nozzle->axis, nozzle->roll, setup->up), INFINITY};
    if (search->threshold > 0)
        posed.strength = sp_nozzle_flow(nozzle, &setup->liquid) / (posed.spray.solid_angle * search->threshold);
    return posed;
}

float sp_posed_spray_value(const sp_posed_spray *posed, sp_vec3 d, double breadth, double transfer)
{
    const sp_frame *frame = &posed->frame;
    double flux = transfer > 0 ? posed->strength * transfer : 0;
    if (flux >= 1) {
        float share = (float)sp_spray_share(&posed->spray, frame, d, breadth);
        return share < 1 ? -share : (float)flux;
    }
    sp_vec3 local = sp_v(sp_dot(d, frame->x), sp_dot(d, frame->y), sp_dot(d, frame->z));
    return sp_spray_intensity(&posed->spray, local) > 0 ? (float)flux : 0;
}

/* The arrival `i` of a view. */
static float value_in_view(const sp_posed_spray *posed, const sp_view *view, uint32_t i)
{
    sp_vec3 d = sp_unit(sp_v((double)view->x[i], (double)view->y[i], (double)view->z[i]));
    return sp_posed_spray_value(posed, d, 1 / (double)view->sharp[i], (double)view->transfer[i]);
}

void sp_field_view(const sp_search *search, const sp_view *view, const sp_spray *spray, const sp_frame *frame,
                   double strength, float *field)
{
    const sp_bins *bins = &search->visibility->bins;
    sp_posed_spray posed = {*spray, *frame, strength};
    float z[3] = {(float)frame->z.x, (float)frame->z.y, (float)frame->z.z};
    sp_cull cull;
    for (size_t p = 0; p < search->patch_count; p++)
        field[p] = 0;
    if (!view->start)
        return;
    sp_cull_create(bins, view, spray, SP_COUNT_SHARE, &cull);
    for (size_t b = 0; b < SP_BINS; b++) {
        if (bins->x[b] * z[0] + bins->y[b] * z[1] + bins->z[b] * z[2] < cull.outside[b])
            continue;
        for (uint32_t i = view->start[b]; i < view->start[b + 1]; i++) {
            float *value = &field[view->patch[i]];
            *value = sp_field_join(*value, value_in_view(&posed, view, i), sp_view_part(view, i));
        }
    }
}

void sp_field_pose(const sp_search *search, sp_pose pose, float *field)
{
    const sp_make *make = &search->candidates->makes[pose.make];
    sp_desk *desk = NULL;
    const sp_view *view = sp_visibility_look(search->visibility, pose.site, make->speed_class, &desk);
    sp_vec3 up = sp_evaluator_setup(search->coarse)->up;
    sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, pose, up);
    sp_frame frame = sp_nozzle_frame(nozzle.axis, nozzle.roll, up);
    sp_field_view(search, view, &make->spray, &frame, strength_of(search, make), field);
    sp_visibility_leave(search->visibility, &desk);
}

static void field_reach(const sp_search *search, const sp_nozzle *nozzle, const sp_reach *reach, float *field)
{
    sp_posed_spray posed = sp_posed_spray_of(search, nozzle);
    for (size_t p = 0; p < search->patch_count; p++)
        field[p] = 0;
    for (size_t i = 0; i < reach->count; i++) {
        const sp_arrival *arrival = &reach->arrivals[i];
        float *value = &field[arrival->patch];
        if (arrival->passes)
            *value = sp_field_join(
                *value, sp_posed_spray_value(&posed, arrival->direction, arrival->breadth, arrival->transfer),
                (float)arrival->part);
    }
}

bool sp_field_nozzle(const sp_search *search, const sp_nozzle *nozzle, const sp_draft *draft, float *field,
                     sp_error *error)
{
    sp_spray spray = sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle));
    double speed = sp_nozzle_speed(nozzle, &sp_evaluator_setup(search->coarse)->liquid);
    bool *dry = draft ? malloc(search->patch_count * sizeof *dry) : NULL;
    if (draft && !dry)
        return sp_fail_memory(error);
    for (size_t p = 0; dry && p < search->patch_count; p++)
        dry[p] = draft->wet[p] < SP_ENOUGH;
    sp_reach *reach = sp_evaluator_reach_passing(search->coarse, nozzle->position, speed, nozzle->axis,
                                                 fmin(M_PI, sp_spray_reach(&spray) + 1e-6), dry, error);
    free(dry);
    if (!reach)
        return false;
    field_reach(search, nozzle, reach, field);
    sp_reach_destroy(reach);
    return true;
}

double sp_field_gain(const sp_search *search, const sp_draft *draft, const float *field)
{
    double gain = 0;
    for (size_t p = 0; p < search->patch_count; p++)
        if (field[p] != 0 && draft->wet[p] < SP_ENOUGH) {
            float wet = draft->wet[p], dry = draft->dry[p];
            sp_pour(search, field[p], &wet, &dry);
            gain += (double)(search->area[p] *
                             (sp_worth(search, wet, dry) - sp_worth(search, draft->wet[p], draft->dry[p])));
        }
    return gain * search->all;
}
