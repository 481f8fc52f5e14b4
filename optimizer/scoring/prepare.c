#include "scoring/prepare.h"

#include "scoring/footprints.h"

#include <stdlib.h>

#define CREDIT 0.2f /* of a patch that has almost the flux it needs: a saturating surrogate misleads the search */

static void kept_free(sp_search *search)
{
    free(search->kept_hit);
    free(search->kept_film);
    free(search->kept_dry);
    free(search->port_taken);
    free(search->kept);
}

/* Nothing is kept yet. */
static bool kept_reserve(sp_search *search, sp_error *error)
{
    const sp_place_options *options = search->options;
    bool film = search->field_count > search->patch_count;
    search->kept_count = 0;
    search->kept_flow = 0;
    search->kept = calloc((options->kept ? options->kept->count : 0) + 1, sizeof *search->kept);
    search->port_taken = calloc(options->mount_count, sizeof *search->port_taken);
    search->kept_hit = calloc(search->patch_count + 1, sizeof *search->kept_hit);
    search->kept_film = film ? calloc(search->patch_count + 1, sizeof *search->kept_film) : NULL;
    search->kept_dry = malloc((search->patch_count + 1) * sizeof *search->kept_dry);
    for (uint32_t p = 0; search->kept_dry && p < search->patch_count; p++)
        search->kept_dry[p] = 1;
    return (search->kept && search->port_taken && search->kept_hit && search->kept_dry &&
            (search->kept_film || !film)) ||
           sp_fail_memory(error);
}

static bool keep(sp_search *search, const sp_nozzle *nozzle, sp_error *error)
{
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    double tolerance = sp_mount_tolerance(setup);
    sp_footprint footprint;
    search->kept[search->kept_count++] = *nozzle;
    search->kept_flow += sp_nozzle_flow(nozzle, &setup->liquid);
    search->bodies |= nozzle->type->body > 0;
    for (size_t m = 0; m < search->options->mount_count; m++)
        search->port_taken[m] |= search->options->mounts[m].kind == SP_MOUNT_PORT &&
                                 sp_port_holds(&search->options->mounts[m], nozzle->position, tolerance);
    bool done = sp_footprint_trace(search, nozzle, &footprint, error);
    if (done)
        sp_footprint_pour(search, &footprint, false, search->kept_hit, search->kept_film, search->kept_dry);
    sp_footprint_free(&footprint);
    return done;
}

/* Of the scene's own nozzles those marked, or all. */
static bool kept_create(sp_search *search, bool all, sp_error *error)
{
    const sp_layout *own = search->options->kept;
    bool done = kept_reserve(search, error);
    for (size_t i = 0; done && own && i < own->count; i++)
        done = !(all || own->nozzles[i].keep) || keep(search, &own->nozzles[i], error);
    return done;
}

/* What is to be cleaned of the patches, and what runs over them. */
static bool set_patches(sp_search *search, sp_error *error)
{
    size_t threads = (size_t)sp_threads(&search->options->run);
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    bool film = setup->criterion.film > 0 || setup->sweep.speed > 0;
    search->all_feeds = setup->criterion.film > 0;
    search->field_count = (film ? 2 : 1) * search->patch_count;
    search->area = malloc((search->patch_count + 1) * sizeof *search->area);
    search->level = omp_get_level();
    search->runoffs = film ? calloc(threads + 1, sizeof *search->runoffs) : NULL;
    if (!search->area || (film && !search->runoffs))
        return sp_fail_memory(error);
    for (uint32_t p = 0; p < search->patch_count; p++)
        search->all += sp_evaluator_counted(search->coarse, p);
    for (uint32_t p = 0; p < search->patch_count; p++)
        search->area[p] = (float)(sp_evaluator_counted(search->coarse, p) / search->all);
    for (size_t i = 0; film && i < threads; i++)
        if (!(search->runoffs[i] = sp_runoff_create(search->coarse, error)))
            return false;
    return true;
}

/* Whatever the number of nozzles that max_water lets be placed, each in the dearest mount. */
static void set_outlay(sp_search *search)
{
    const sp_place_options *options = search->options;
    double dearest = 0, least = INFINITY;
    for (size_t m = 0; m < options->mount_count; m++)
        dearest = fmax(dearest, options->mounts[m].cost);
    for (size_t k = 0; k < search->candidates->variant_count; k++)
        least = fmin(least, search->candidates->variants[k].flow);
    search->costly = dearest > 0;
    search->outlay_most = options->max_water;
    if (!search->costly || isinf(options->max_water))
        return;
    double number = fmax(0, floor((options->max_water - search->kept_flow) / least * (1 + SP_ROUNDING)));
    if (options->max_nozzles)
        number = fmin(number, (double)options->max_nozzles);
    search->outlay_most += number * dearest;
}

bool sp_search_create(const sp_evaluator *coarse, const sp_place_options *options, const sp_sites *sites,
                      const sp_candidates *candidates, const sp_visibility *visibility, sp_search *search,
                      sp_error *error)
{
    const sp_criterion *criterion = &sp_evaluator_setup(coarse)->criterion;
    double threshold = sp_evaluator_setup(coarse)->sweep.speed > 0 ? INFINITY : criterion->flux;
    *search = (sp_search){.options = options,
                          .sites = sites,
                          .candidates = candidates,
                          .visibility = visibility,
                          .kernels = sp_pattern_kernels_best(),
                          .coarse = coarse,
                          .patch_count = sp_evaluator_patches(coarse)->count,
                          .threshold = threshold,
                          .view_area = sp_evaluator_patches(visibility->evaluator)->total_area,
                          .plenty = threshold * sp_evaluator_patches(visibility->evaluator)->total_area,
                          .single = criterion->combine == SP_COMBINE_SINGLE,
                          .alone = criterion->combine == SP_COMBINE_SINGLE || threshold <= 0,
                          .credit = criterion->combine == SP_COMBINE_SINGLE ? 0 : CREDIT};
    for (size_t t = 0; t < options->type_count; t++)
        search->bodies |= options->types[t]->body > 0;
    bool done = set_patches(search, error) && kept_create(search, false, error) &&
                sp_footprints_create(search, &search->footprints, error);
    if (!done) {
        sp_search_free(search);
        return false;
    }
    set_outlay(search);
    return true;
}

bool sp_search_keep_all(const sp_search *search, sp_search *keeping, sp_error *error)
{
    *keeping = *search;
    if (kept_create(keeping, true, error))
        return true;
    kept_free(keeping);
    return false;
}

void sp_search_keep_all_free(sp_search *keeping)
{
    kept_free(keeping);
}

void sp_search_free(sp_search *search)
{
    sp_footprints_destroy(search->footprints);
    free(search->area);
    for (int i = 0; search->runoffs && search->runoffs[i]; i++)
        sp_runoff_destroy(search->runoffs[i]);
    free(search->runoffs);
    kept_free(search);
    *search = (sp_search){0};
}

double sp_own_outlay(const sp_search *search)
{
    const sp_layout *own = search->options->kept;
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    double outlay = own ? sp_layout_flow(own, &setup->liquid) : 0;
    for (size_t i = 0; search->costly && own && i < own->count; i++) {
        size_t mount =
            sp_mount_at(setup, search->options->mounts, search->options->mount_count, own->nozzles[i].position);
        outlay += own->nozzles[i].keep || mount == SIZE_MAX ? 0 : search->options->mounts[mount].cost;
    }
    return outlay;
}
