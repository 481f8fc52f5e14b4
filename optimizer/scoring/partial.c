#include "scoring/partial.h"

#include "mesh/grow.h"
#include "scoring/field.h"
#include "scoring/footprints.h"
#include "scoring/mount_capacity.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

const sp_footprint *sp_placed_footprint(const sp_search *search, const sp_placed *placed)
{
    return placed->moved ? placed->moved : sp_footprints_look(search->footprints, placed->pose);
}

/* Whether item i's edges are item k's, which sprays more, or as much and comes first (see sp_layout_repeats). */
static bool repeats_item(const sp_search *search, const sp_partial *partial, size_t i, size_t k)
{
    const sp_placed *own = &partial->items[i], *other = &partial->items[k];
    return (other->flow > own->flow || (other->flow >= own->flow && k < i)) &&
           sp_nozzles_share_edges(&other->nozzle, &own->nozzle, &sp_evaluator_setup(search->coarse)->liquid);
}

static bool repeats(const sp_search *search, const sp_partial *partial, size_t i)
{
    bool found = false;
    for (size_t k = 0; k < partial->count && !found; k++)
        found = k != i && repeats_item(search, partial, i, k);
    return found;
}

/* Adds item i to what hits and runs, and to what is dry. */
static void pour_item(const sp_search *search, sp_partial *partial, size_t i)
{
    bool again = partial->items[i].again = repeats(search, partial, i);
    const float *field = partial->items[i].field, *more = field + search->patch_count;
    float *restrict hit = partial->hit, *restrict dry = partial->dry, *restrict film = partial->film;
    partial->flow += partial->items[i].flow;
    partial->outlay += sp_placed_outlay(search, &partial->items[i]);
    if (!sp_type_is_uniform(partial->items[i].nozzle.type)) {
        sp_footprint_pour(search, sp_placed_footprint(search, &partial->items[i]), again, hit, film, dry);
        return;
    }
    for (size_t p = 0; p < search->patch_count && !again; p++)
        sp_pour(search, field[p], &hit[p], &dry[p]);
    for (size_t p = 0; p < search->patch_count && again; p++)
        sp_pour(search, sp_without_edge(field[p]), &hit[p], &dry[p]);
    for (size_t p = 0; film && p < search->patch_count; p++)
        film[p] += more[p];
}

/* Draws covered and value from what hits and runs, and what is dry. */
static void count_up(const sp_search *search, sp_partial *partial)
{
    for (size_t p = 0; partial->film && p < search->patch_count; p++)
        partial->wet[p] = fmaxf(partial->hit[p], partial->film[p]);
    partial->covered = partial->value = 0;
    for (size_t p = 0; p < search->patch_count; p++) {
        partial->value += (double)(search->area[p] * sp_worth(search, partial->wet[p], partial->dry[p]));
        partial->covered += (double)(search->area[p] * sp_covered(partial->wet[p], partial->dry[p]));
    }
    assert(partial->covered >= 0 && partial->covered <= partial->value);
    partial->value *= search->all;
    partial->covered *= search->all;
}

void sp_partial_refresh(const sp_search *search, sp_partial *partial)
{
    memcpy(partial->hit, search->kept_hit, search->patch_count * sizeof *partial->hit);
    if (partial->film)
        memcpy(partial->film, search->kept_film, search->patch_count * sizeof *partial->film);
    memcpy(partial->dry, search->kept_dry, search->patch_count * sizeof *partial->dry);
    partial->flow = partial->outlay = search->kept_flow;
    for (size_t i = 0; i < partial->count; i++)
        pour_item(search, partial, i);
    count_up(search, partial);
}

/* The same of one patch. */
static void refresh_patch(const sp_search *search, sp_partial *partial, size_t p)
{
    partial->hit[p] = search->kept_hit[p];
    partial->dry[p] = search->kept_dry[p];
    if (partial->film)
        partial->film[p] = search->kept_film[p];
    for (size_t i = 0; i < partial->count; i++) {
        const float *field = partial->items[i].field;
        float value = partial->items[i].again ? sp_without_edge(field[p]) : field[p];
        sp_pour(search, value, &partial->hit[p], &partial->dry[p]);
        if (partial->film)
            partial->film[p] += field[search->patch_count + p];
    }
}

/* The same after this nozzle was taken out: what it brings nothing to is as before. Footprints say more of a patch than
 * fields do. */
static void refresh_without(const sp_search *search, sp_partial *partial, const sp_placed *taken)
{
    const float *film = partial->film ? taken->field + search->patch_count : NULL;
    if (search->footprints) {
        sp_partial_refresh(search, partial);
        return;
    }
    for (size_t i = 0; i < partial->count; i++)
        partial->items[i].again = repeats(search, partial, i);
    for (size_t p = 0; p < search->patch_count; p++)
        if (taken->field[p] != 0 || (film && film[p] != 0))
            refresh_patch(search, partial, p);
    partial->flow = partial->outlay = search->kept_flow;
    for (size_t i = 0; i < partial->count; i++) {
        partial->flow += partial->items[i].flow;
        partial->outlay += sp_placed_outlay(search, &partial->items[i]);
    }
    count_up(search, partial);
}

/* Room for what hits, runs and is dry. */
static bool reserve(const sp_search *search, sp_partial *partial, sp_error *error)
{
    *partial = (sp_partial){0};
    partial->hit = malloc((search->patch_count + 1) * sizeof *partial->hit);
    partial->dry = malloc((search->patch_count + 1) * sizeof *partial->dry);
    partial->film = search->kept_film ? malloc((search->patch_count + 1) * sizeof *partial->film) : NULL;
    partial->wet = search->kept_film ? malloc((search->patch_count + 1) * sizeof *partial->wet) : partial->hit;
    if (partial->hit && partial->dry && partial->wet && (partial->film || !search->kept_film))
        return true;
    sp_partial_free(partial);
    return sp_fail_memory(error);
}

bool sp_partial_create(const sp_search *search, sp_partial *partial, sp_error *error)
{
    if (!reserve(search, partial, error))
        return false;
    sp_partial_refresh(search, partial);
    return true;
}

void sp_partial_free(sp_partial *partial)
{
    for (size_t i = 0; i < partial->count; i++)
        free(partial->items[i].field);
    free(partial->items);
    if (partial->wet != partial->hit)
        free(partial->wet);
    free(partial->hit);
    free(partial->film);
    free(partial->dry);
    *partial = (sp_partial){0};
}

static bool append(sp_partial *partial, sp_placed placed, sp_error *error)
{
    if (!sp_grow(&partial->items, &partial->capacity, partial->count + 1, sizeof *partial->items)) {
        free(placed.field);
        return sp_fail_memory(error);
    }
    assert(placed.flow >= 0 && partial->count < partial->capacity);
    partial->items[partial->count++] = placed;
    return true;
}

bool sp_partial_copy(const sp_search *search, const sp_partial *from, sp_partial *to, sp_error *error)
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
            sp_partial_free(to);
            return false;
        }
    }
    sp_partial_refresh(search, to);
    return true;
}

bool sp_partial_add(const sp_search *search, sp_partial *partial, sp_placed placed, sp_error *error)
{
    if (!append(partial, placed, error))
        return false;
    size_t added = partial->count - 1, k = 0;
    while (k < added && !repeats_item(search, partial, k, added))
        k++;
    if (k < added) {
        sp_partial_refresh(search, partial);
        return true;
    }
    pour_item(search, partial, added);
    count_up(search, partial);
    return true;
}

bool sp_partial_add_copy(const sp_search *search, sp_partial *partial, const sp_placed *from, sp_error *error)
{
    sp_placed placed = *from;
    placed.field = malloc((search->field_count + 1) * sizeof *placed.field);
    if (!placed.field)
        return sp_fail_memory(error);
    memcpy(placed.field, from->field, search->field_count * sizeof *placed.field);
    return sp_partial_add(search, partial, placed, error);
}

bool sp_partial_add_pose(const sp_search *search, sp_partial *partial, sp_pose pose, sp_error *error)
{
    sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, pose, sp_evaluator_setup(search->coarse)->up);
    sp_placed placed = {.nozzle = nozzle,
                        .origin = nozzle,
                        .pose = pose,
                        .site = search->sites->items[pose.site],
                        .flow = search->candidates->variants[pose.variant].flow,
                        .field = malloc((search->field_count + 1) * sizeof *placed.field)};
    if (!placed.field)
        return sp_fail_memory(error);
    sp_field_pose(search, pose, placed.field);
    return sp_partial_add(search, partial, placed, error);
}

sp_placed sp_partial_take(const sp_search *search, sp_partial *partial, size_t i)
{
    assert(i < partial->count);
    sp_placed taken = partial->items[i];
    partial->count--;
    memmove(&partial->items[i], &partial->items[i + 1], (partial->count - i) * sizeof *partial->items);
    refresh_without(search, partial, &taken);
    return taken;
}

void sp_partial_remove(const sp_search *search, sp_partial *partial, size_t i)
{
    free(sp_partial_take(search, partial, i).field);
}

double sp_partial_counted(const sp_search *search, const sp_partial *partial)
{
    double area = 0;
    for (size_t p = 0; p < search->patch_count; p++)
        area +=
            sp_evaluator_counted(search->coarse, (uint32_t)p) * (double)sp_covered(partial->wet[p], partial->dry[p]);
    return area;
}

double sp_partial_costs(const sp_search *search, const sp_partial *partial)
{
    double costs = 0;
    for (size_t i = 0; i < partial->count; i++)
        costs += search->options->mounts[partial->items[i].site.mount].cost;
    return costs;
}

double sp_partial_water(const sp_search *search, const sp_partial *partial, double budget)
{
    return search->costly ? fmin(budget - sp_partial_costs(search, partial), search->options->max_water) : budget;
}

bool sp_partial_affords(const sp_search *search, const sp_partial *partial, uint32_t mount, size_t variant,
                        double budget)
{
    return sp_affords(search, partial->flow, partial->outlay, mount, search->candidates->variants[variant].flow,
                      budget);
}

bool sp_partial_has_place(const sp_search *search, const sp_partial *partial, uint32_t mount)
{
    size_t capacity = sp_mount_left(search, mount), there = 0;
    for (size_t i = 0; capacity <= partial->count && i < partial->count; i++)
        there += partial->items[i].site.mount == mount;
    return there < capacity && sp_number_allows(search, partial->count);
}

const sp_placed *sp_partial_edges_at(const sp_search *search, const sp_partial *partial, sp_pose pose)
{
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    const sp_placed *most = NULL;
    for (size_t i = 0; i < partial->count; i++) {
        const sp_placed *item = &partial->items[i];
        if (item->pose.site != pose.site || (most && item->flow <= most->flow))
            continue;
        sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, pose, setup->up);
        if (sp_nozzles_share_edges(&item->nozzle, &nozzle, &setup->liquid))
            most = item;
    }
    return most;
}
