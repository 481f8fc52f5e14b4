#include "scoring/draft.h"

#include "mesh/grow.h"
#include "scoring/field.h"
#include "scoring/footprints.h"

#include <stdlib.h>
#include <string.h>

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
                        .flow = search->candidates->variants[pose.variant].flow,
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
