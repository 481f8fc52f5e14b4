#include "scoring/draft.h"

#include "mesh/grow.h"

#include "scoring/footprints.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    for (size_t m = 0; m < search->options->mount_count; m++)
        search->port_taken[m] |= search->options->mounts[m].kind == SP_MOUNT_PORT &&
                                 sp_port_holds(&search->options->mounts[m], nozzle->position, tolerance);
    bool done = sp_footprint_trace(search, nozzle, &footprint, error);
    if (done)
        sp_footprint_pour(search, &footprint, search->kept_hit, search->kept_film, search->kept_dry);
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
    for (size_t k = 0; k < search->candidates->make_count; k++)
        least = fmin(least, search->candidates->makes[k].flow);
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
                          .sweeps = sp_sweep_best(),
                          .coarse = coarse,
                          .patch_count = sp_evaluator_patches(coarse)->count,
                          .threshold = threshold,
                          .view_area = sp_evaluator_patches(visibility->evaluator)->total_area,
                          .plenty = threshold * sp_evaluator_patches(visibility->evaluator)->total_area,
                          .single = criterion->combine == SP_COMBINE_SINGLE,
                          .credit = criterion->combine == SP_COMBINE_SINGLE ? 0 : CREDIT};
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

/* Adds item i to what hits and runs, and to what is dry. */
static void pour_item(const sp_search *search, sp_draft *draft, size_t i)
{
    const float *field = draft->items[i].field, *more = field + search->patch_count;
    float *restrict hit = draft->hit, *restrict dry = draft->dry, *restrict film = draft->film;
    draft->flow += draft->items[i].flow;
    draft->outlay += sp_placed_outlay(search, &draft->items[i]);
    if (!sp_type_is_uniform(draft->items[i].nozzle.type)) {
        sp_footprint_pour(search, sp_footprints_look(search->footprints, draft->items[i].pose), hit, film, dry);
        return;
    }
    for (size_t p = 0; p < search->patch_count; p++)
        sp_pour(search, field[p], &hit[p], &dry[p]);
    for (size_t p = 0; film && p < search->patch_count; p++)
        film[p] += more[p];
}

/* Draws covered and value from what hits and runs, and what is dry. */
static void count_up(const sp_search *search, sp_draft *draft)
{
    for (size_t p = 0; draft->film && p < search->patch_count; p++)
        draft->wet[p] = fmaxf(draft->hit[p], draft->film[p]);
    draft->covered = draft->value = 0;
    for (size_t p = 0; p < search->patch_count; p++) {
        draft->value += (double)(search->area[p] * sp_worth(search, draft->wet[p], draft->dry[p]));
        draft->covered += (double)(search->area[p] * sp_covered(draft->wet[p], draft->dry[p]));
    }
    draft->value *= search->all;
    draft->covered *= search->all;
}

void sp_draft_refresh(const sp_search *search, sp_draft *draft)
{
    memcpy(draft->hit, search->kept_hit, search->patch_count * sizeof *draft->hit);
    if (draft->film)
        memcpy(draft->film, search->kept_film, search->patch_count * sizeof *draft->film);
    memcpy(draft->dry, search->kept_dry, search->patch_count * sizeof *draft->dry);
    draft->flow = draft->outlay = search->kept_flow;
    for (size_t i = 0; i < draft->count; i++)
        pour_item(search, draft, i);
    count_up(search, draft);
}

/* Room for what hits, runs and is dry. */
static bool reserve(const sp_search *search, sp_draft *draft, sp_error *error)
{
    *draft = (sp_draft){0};
    draft->hit = malloc((search->patch_count + 1) * sizeof *draft->hit);
    draft->dry = malloc((search->patch_count + 1) * sizeof *draft->dry);
    draft->film = search->kept_film ? malloc((search->patch_count + 1) * sizeof *draft->film) : NULL;
    draft->wet = search->kept_film ? malloc((search->patch_count + 1) * sizeof *draft->wet) : draft->hit;
    if (draft->hit && draft->dry && draft->wet && (draft->film || !search->kept_film))
        return true;
    sp_draft_free(draft);
    return sp_fail_memory(error);
}

bool sp_draft_create(const sp_search *search, sp_draft *draft, sp_error *error)
{
    if (!reserve(search, draft, error))
        return false;
    sp_draft_refresh(search, draft);
    return true;
}

void sp_draft_free(sp_draft *draft)
{
    for (size_t i = 0; i < draft->count; i++)
        free(draft->items[i].field);
    free(draft->items);
    if (draft->wet != draft->hit)
        free(draft->wet);
    free(draft->hit);
    free(draft->film);
    free(draft->dry);
    *draft = (sp_draft){0};
}

static bool append(sp_draft *draft, sp_placed placed, sp_error *error)
{
    if (!sp_grow(&draft->items, &draft->capacity, draft->count + 1, sizeof *draft->items)) {
        free(placed.field);
        return sp_fail_memory(error);
    }
    draft->items[draft->count++] = placed;
    return true;
}

bool sp_draft_copy(const sp_search *search, const sp_draft *from, sp_draft *to, sp_error *error)
{
    if (!reserve(search, to, error))
        return false;
    for (size_t i = 0; i < from->count; i++) {
        sp_placed placed = from->items[i];
        placed.field = malloc((search->field_count + 1) * sizeof *placed.field);
        if (placed.field)
            memcpy(placed.field, from->items[i].field, search->field_count * sizeof *placed.field);
        else
            sp_fail_memory(error);
        if (!placed.field || !append(to, placed, error)) {
            sp_draft_free(to);
            return false;
        }
    }
    sp_draft_refresh(search, to);
    return true;
}

bool sp_draft_add(const sp_search *search, sp_draft *draft, sp_placed placed, sp_error *error)
{
    if (!append(draft, placed, error))
        return false;
    pour_item(search, draft, draft->count - 1);
    count_up(search, draft);
    return true;
}

bool sp_draft_add_pose(const sp_search *search, sp_draft *draft, sp_pose pose, sp_error *error)
{
    sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, pose, sp_evaluator_setup(search->coarse)->up);
    sp_placed placed = {.nozzle = nozzle,
                        .origin = nozzle,
                        .pose = pose,
                        .site = search->sites->items[pose.site],
                        .flow = search->candidates->makes[pose.make].flow,
                        .field = malloc((search->field_count + 1) * sizeof *placed.field)};
    if (!placed.field)
        return sp_fail_memory(error);
    sp_field_pose(search, pose, placed.field);
    return sp_draft_add(search, draft, placed, error);
}

sp_placed sp_draft_take(const sp_search *search, sp_draft *draft, size_t i)
{
    sp_placed taken = draft->items[i];
    draft->count--;
    memmove(&draft->items[i], &draft->items[i + 1], (draft->count - i) * sizeof *draft->items);
    sp_draft_refresh(search, draft);
    return taken;
}

void sp_draft_remove(const sp_search *search, sp_draft *draft, size_t i)
{
    free(sp_draft_take(search, draft, i).field);
}

double sp_draft_counted(const sp_search *search, const sp_draft *draft)
{
    double area = 0;
    for (size_t p = 0; p < search->patch_count; p++)
        area += (double)(search->area[p] * sp_covered(draft->wet[p], draft->dry[p]));
    return area * search->all;
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

double sp_draft_costs(const sp_search *search, const sp_draft *draft)
{
    double costs = 0;
    for (size_t i = 0; i < draft->count; i++)
        costs += search->options->mounts[draft->items[i].site.mount].cost;
    return costs;
}

double sp_draft_water(const sp_search *search, const sp_draft *draft, double budget)
{
    return search->costly ? fmin(budget - sp_draft_costs(search, draft), search->options->max_water) : budget;
}

bool sp_draft_has_place(const sp_search *search, const sp_draft *draft, uint32_t mount)
{
    if (search->options->max_nozzles && search->kept_count + draft->count >= search->options->max_nozzles)
        return false;
    size_t room = search->port_taken[mount] ? 0 : sp_mount_room(&search->options->mounts[mount]);
    for (size_t i = 0; room > 0 && room <= draft->count && i < draft->count; i++)
        room -= draft->items[i].site.mount == mount;
    return room > 0;
}

static bool name_taken(const sp_layout *layout, size_t but, const char *name)
{
    for (size_t i = 0; i < layout->count; i++)
        if (i != but && !strcmp(layout->nozzles[i].name, name))
            return true;
    return false;
}

/* A nozzle that sits elsewhere and is called like a port, even one left empty, would be fitted there. */
static bool is_port(const sp_place_options *options, const char *name)
{
    for (size_t i = 0; i < options->mount_count + options->other_count; i++) {
        bool other = i >= options->mount_count;
        const sp_mount *mount = other ? &options->others[i - options->mount_count] : &options->mounts[i];
        if (mount->kind == SP_MOUNT_PORT && !strcmp(mount->name, name))
            return true;
    }
    return false;
}

/* A port's nozzle is called after the port, where that is taken the first free "name-2", ...; any other P1, P2, ... */
static void name_nozzle(const sp_search *search, const sp_layout *layout, size_t i, const char *port, size_t *number)
{
    char *name = layout->nozzles[i].name;
    if (port && port[0]) {
        snprintf(name, SP_NAME, "%s", port);
        for (size_t again = 2; name_taken(layout, i, name); again++)
            snprintf(name, SP_NAME, "%.40s-%zu", port, again);
        return;
    }
    do
        snprintf(name, SP_NAME, "P%zu", ++*number);
    while (name_taken(layout, i, name) || is_port(search->options, name));
}

sp_layout *sp_draft_layout(const sp_search *search, const sp_draft *draft, sp_error *error)
{
    sp_layout *layout = sp_layout_create(NULL, search->kept_count + draft->count, error);
    if (!layout)
        return NULL;
    for (size_t i = 0; i < search->kept_count; i++)
        layout->nozzles[i] = search->kept[i];
    size_t number = 0;
    /* ports first, so that none of their names is taken */
    for (int ports = 1; ports >= 0; ports--)
        for (size_t i = 0; i < draft->count; i++) {
            const sp_mount *mount = &search->options->mounts[draft->items[i].site.mount];
            size_t at = search->kept_count + i;
            if ((mount->kind == SP_MOUNT_PORT) != ports)
                continue;
            layout->nozzles[at] = draft->items[i].nozzle;
            layout->nozzles[at].name[0] = 0;
            name_nozzle(search, layout, at, ports ? mount->name : NULL, &number);
        }
    return layout;
}
