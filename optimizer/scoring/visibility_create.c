#include "scoring/visibility_work.h"

#include <assert.h>
#include <stdlib.h>

#define MEMORY 1e9 /* bytes, for all views and footprints, where the options do not say */

double sp_visibility_memory(const sp_place_options *options)
{
    return options->memory > 0 ? options->memory : MEMORY;
}

double sp_visibility_needed(const sp_place_options *options, const sp_candidates *candidates, const sp_site *site,
                            size_t launch)
{
    double reach = -1;
    for (size_t k = 0; k < candidates->variant_count; k++)
        if (candidates->variants[k].launch == launch && sp_type_is_uniform(candidates->variants[k].type) &&
            sp_candidates_axes(candidates, site->mount, k)->count)
            reach = fmax(reach, candidates->variants[k].reach);
    return reach < 0 ? reach : fmin(M_PI, reach + options->mounts[site->mount].tilt + 1e-6);
}

uint8_t *sp_visibility_sights(const sp_visibility *visibility, size_t at)
{
    assert(at < visibility->site_count * visibility->launch_count);
    return &visibility->sights[at * visibility->sight_bytes];
}

bool sp_visibility_trace(const sp_visibility *visibility, size_t at, sp_sightings *sightings, sp_error *error)
{
    const sp_site *site = &visibility->sites->items[at / visibility->launch_count];
    size_t launch = at % visibility->launch_count;
    double half_angle = sp_visibility_needed(visibility->options, visibility->candidates, site, launch);
    const uint8_t *known = visibility->known[at] ? sp_visibility_sights(visibility, at) : NULL;
    *sightings = (sp_sightings){0};
    return half_angle >= 0 && sp_sightings_trace(visibility->evaluator, site, visibility->candidates->launches[launch],
                                                 half_angle, known, sightings, error);
}

double sp_visibility_patterns(const sp_sites *sites, const sp_candidates *candidates, double *poses)
{
    double patterns = 0;
    for (size_t i = 0; i < sites->count; i++)
        for (size_t k = 0; k < candidates->variant_count; k++) {
            const sp_variant *variant = &candidates->variants[k];
            double count =
                (double)(sp_candidates_axes(candidates, sites->items[i].mount, k)->count * variant->roll_count);
            if (sp_type_is_uniform(variant->type))
                continue;
            *poses += count;
            patterns += count * (double)sp_nozzle_pattern_count(&(sp_nozzle){.type = variant->type});
        }
    return patterns;
}

bool sp_visibility_create(const sp_evaluator *coarse, const sp_place_options *options, const sp_sites *sites,
                          const sp_candidates *candidates, sp_deadline *deadline, sp_visibility *visibility,
                          sp_error *error)
{
    size_t views = sites->count * candidates->launch_count, patches = sp_evaluator_patches(coarse)->count;
    double footprints = 0;
    sp_visibility_patterns(sites, candidates, &footprints);
    *visibility = (sp_visibility){.evaluator = coarse,
                                  .options = options,
                                  .sites = sites,
                                  .candidates = candidates,
                                  .site_count = sites->count,
                                  .launch_count = candidates->launch_count,
                                  .sight_bytes = patches / 4 + 1,
                                  .memory = sp_visibility_memory(options),
                                  .prints = footprints * SP_PRINT * ((double)patches + 1)};
    sp_bins_create(&visibility->bins);
    visibility->views = calloc(views + 1, sizeof *visibility->views);
    visibility->known = calloc(views + 1, sizeof *visibility->known);
    visibility->sights = calloc(views + 1, visibility->sight_bytes);
    bool done = (visibility->views && visibility->known && visibility->sights) || sp_fail_memory(error);
    done = done && sp_visibility_survey(visibility, deadline, error);
    if (!done)
        sp_visibility_free(visibility);
    return done;
}

void sp_visibility_free(sp_visibility *visibility)
{
    for (size_t i = 0; visibility->views && i < visibility->site_count * visibility->launch_count; i++)
        free(visibility->views[i].start);
    sp_view_buffers_destroy(visibility->buffers, visibility->buffer_count);
    free(visibility->views);
    free(visibility->known);
    free(visibility->sights);
    *visibility = (sp_visibility){0};
}
