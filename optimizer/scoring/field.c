#include "scoring/field.h"

#include "nozzle/strength.h"
#include "scoring/footprints.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

sp_posed_spray sp_posed_spray_of(const sp_search *search, const sp_nozzle *nozzle)
{
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    sp_posed_spray posed = {.spray = sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle)),
                            .frame = sp_nozzle_frame(nozzle->axis, nozzle->roll, setup->up),
                            .type = nozzle->type,
                            .flow = sp_nozzle_flow(nozzle, &setup->liquid)};
    posed.strength = sp_strength(posed.flow, posed.spray.solid_angle, search->threshold);
    return posed;
}

/* What one arrival comes to. */
static float value_of(const sp_posed_spray *posed, sp_vec3 d, double breadth, double transfer)
{
    const sp_frame *frame = &posed->frame;
    double flux = transfer > 0 ? posed->strength * transfer : 0;
    if (flux >= 1) {
        float share = (float)sp_spray_share(&posed->spray, frame, d, breadth);
        return share < 1 ? -share : (float)flux;
    }
    return sp_spray_holds(&posed->spray, frame, d) ? (float)flux : 0;
}

sp_field_making sp_field_begin(const sp_search *search, const sp_posed_spray *posed, double scale, float *field)
{
    sp_field_making making = {.search = search, .posed = *posed, .field = field};
    memset(field, 0, search->field_count * sizeof *field);
    if (search->runoffs) {
        making.runoff = sp_search_runoff(search);
        making.arriving = sp_runoff_arriving(making.runoff);
        making.intensity = sp_strength(posed->flow, posed->spray.solid_angle, scale);
    }
    return making;
}

void sp_field_add(const sp_field_making *making, uint32_t patch, bool passes, sp_vec3 direction, double breadth,
                  double transfer, float part)
{
    const sp_posed_spray *posed = &making->posed;
    float *value = &making->field[patch];
    assert(patch < making->search->patch_count && part >= 0 && part <= 1 && *value >= -1);
    if (making->runoff) {
        double share = sp_spray_share(&posed->spray, &posed->frame, direction, breadth);
        making->arriving[patch] += share * (double)part * making->intensity * fmax(0, transfer);
    }
    if (passes)
        *value = sp_field_join(*value, value_of(posed, direction, breadth, transfer), part);
}

void sp_field_end(const sp_field_making *making)
{
    const sp_search *search = making->search;
    if (!making->runoff)
        return;
    /* no patch receives more than there is, however dense the flights are at its points */
    const double *area = sp_evaluator_patches(search->coarse)->area;
    for (size_t p = 0; p < search->patch_count; p++) {
        double all = making->arriving[p] * area[p], flow = making->posed.flow;
        making->arriving[p] = all < flow ? all : flow;
    }
    sp_runoff_find(making->runoff, making->posed.type, making->posed.flow, making->field + search->patch_count);
}

void sp_field_view(const sp_search *search, const sp_view *view, const sp_posed_spray *posed, float *field)
{
    const sp_bins *bins = &search->visibility->bins;
    float z[3] = {(float)posed->frame.z.x, (float)posed->frame.z.y, (float)posed->frame.z.z};
    sp_field_making making = sp_field_begin(search, posed, search->view_area, field);
    sp_cull cull;
    if (!view->start)
        return;
    sp_cull_create(bins, view, &posed->spray, SP_COUNT_SHARE, &cull);
    for (size_t b = 0; b < SP_BINS; b++) {
        if (bins->x[b] * z[0] + bins->y[b] * z[1] + bins->z[b] * z[2] < cull.outside[b])
            continue;
        for (uint32_t i = view->start[b]; i < view->start[b + 1]; i++) {
            sp_vec3 d = sp_unit(sp_v((double)view->x[i], (double)view->y[i], (double)view->z[i]));
            sp_field_add(&making, view->patch[i], !(view->fails && view->fails[i]), d, 1 / (double)view->sharp[i],
                         (double)view->transfer[i], sp_view_part(view, i));
        }
    }
    sp_field_end(&making);
}

/* What one arrival comes to; `count` is its share where it meets the criterion alone, else whether the spray
 * holds it. */
static inline float arrival_value(float flux, float count)
{
    float alone = count < 1 ? -count : flux;
    return flux >= 1 ? alone : count > 0 ? flux : 0;
}

void sp_field_region(const sp_search *search, const sp_field_scratch *scratch, const sp_variant *variant,
                     const sp_region *region, float *field)
{
    const sp_view *view = scratch->view;
    sp_posed_spray posed = {.spray = variant->spray, .type = variant->type, .flow = variant->flow};
    sp_field_making making = sp_field_begin(search, &posed, search->view_area, field);
    float strength = (float)sp_variant_strength(search, variant) * (1 + scratch->more);
    float intensity = (float)making.intensity * (1 + scratch->more);
    size_t runs = search->kernels->shares(&search->visibility->bins, scratch->cull, region, view, scratch->share,
                                          scratch->counts, scratch->runs);
    for (size_t r = 0; r < runs; r++)
        for (uint32_t i = scratch->runs[r].first; i < scratch->runs[r].end; i++) {
            uint32_t p = view->patch[i];
            float share = scratch->share[i], part = sp_view_part(view, i),
                  flux = view->transfer[i] > 0 ? strength * view->transfer[i] : 0;
            if (share + scratch->more > 0 && making.runoff)
                making.arriving[p] += (double)((share + scratch->more) * part * view->transfer[i] * intensity);
            if (scratch->counts[i] > 0 && !(view->fails && view->fails[i]))
                field[p] = sp_field_join(field[p], arrival_value(flux, scratch->counts[i]), part);
        }
    sp_field_end(&making);
}

double sp_variant_strength(const sp_search *search, const sp_variant *variant)
{
    return sp_strength(variant->flow, variant->spray.solid_angle, search->plenty);
}

void sp_field_pose(const sp_search *search, sp_pose pose, float *field)
{
    const sp_variant *variant = &search->candidates->variants[pose.variant];
    sp_view_buffer *buffer = NULL;
    if (!sp_type_is_uniform(variant->type)) {
        sp_footprint_field(search, sp_footprints_look(search->footprints, pose), field);
        return;
    }
    const sp_view *view = sp_visibility_look(search->visibility, pose.site, variant->launch, &buffer);
    sp_vec3 up = sp_evaluator_setup(search->coarse)->up;
    sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, pose, up);
    sp_posed_spray posed = {.spray = variant->spray,
                            .frame = sp_nozzle_frame(nozzle.axis, nozzle.roll, up),
                            .strength = sp_variant_strength(search, variant),
                            .type = variant->type,
                            .flow = variant->flow};
    sp_field_view(search, view, &posed, field);
    sp_visibility_release(search->visibility, &buffer);
}

/* What is in reach of a nozzle, where `wet` is given only on the patches that are dry, unless film runs from one to the
 * next. */
static sp_reach *reach_of(const sp_search *search, const sp_nozzle *nozzle, const float *wet, sp_error *error)
{
    sp_spray spray = sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle));
    double half_angle = fmin(M_PI, sp_spray_reach(&spray) + 1e-6);
    sp_launch launch;
    if (!sp_launch_table_find(search->candidates->table, nozzle, &launch, error))
        return NULL;
    if (search->all_feeds)
        return sp_evaluator_reach(search->coarse, nozzle->position, launch, nozzle->axis, half_angle, error);
    bool *dry = wet ? malloc((search->patch_count + 1) * sizeof *dry) : NULL;
    if (wet && !dry)
        return sp_fail_memory(error);
    for (size_t p = 0; dry && p < search->patch_count; p++)
        dry[p] = wet[p] < SP_ENOUGH;
    sp_reach *reach =
        sp_evaluator_reach_passing(search->coarse, nozzle->position, launch, nozzle->axis, half_angle, dry, error);
    free(dry);
    return reach;
}

bool sp_field_nozzle(const sp_search *search, const sp_nozzle *nozzle, const float *wet, float *field, sp_error *error)
{
    sp_reach *reach = reach_of(search, nozzle, wet, error);
    if (!reach)
        return false;
    sp_posed_spray posed = sp_posed_spray_of(search, nozzle);
    sp_field_making making = sp_field_begin(search, &posed, 1, field);
    for (size_t i = 0; i < reach->count; i++) {
        const sp_arrival *arrival = &reach->arrivals[i];
        sp_field_add(&making, arrival->patch, arrival->passes, arrival->direction, arrival->breadth, arrival->transfer,
                     (float)arrival->part);
    }
    sp_field_end(&making);
    sp_reach_destroy(reach);
    return true;
}
