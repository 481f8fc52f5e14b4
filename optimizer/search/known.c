#include "search/known.h"

#include "scoring/bodies.h"
#include "scoring/field.h"
#include "scoring/footprints.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    sp_front_point point; /* area below 0: not known */
    size_t count;
    sp_placed *items; /* [count], without fields, which are of one placement's patches */
} found_layout;

struct sp_found {
    sp_mount *mounts; /* that the sites are of */
    size_t count;
    found_layout *layouts;
};

static bool write_down(sp_found *found, const sp_partial *partial, const sp_front_point *point, sp_error *error)
{
    found_layout *layout = &found->layouts[found->count];
    *layout = (found_layout){*point, partial->count, malloc((partial->count + 1) * sizeof *layout->items)};
    if (!layout->items)
        return sp_fail_memory(error);
    found->count++;
    for (size_t i = 0; i < partial->count; i++) {
        layout->items[i] = partial->items[i];
        layout->items[i].field = NULL;
        layout->items[i].moved = NULL;
    }
    return true;
}

sp_found *sp_found_create(const sp_front *front, const sp_search *search, bool counted_again, sp_error *error)
{
    const sp_front_list *lists[] = {&front->by_water, &front->by_number};
    size_t mounts = search->options->mount_count, most = 1 + lists[0]->count + lists[1]->count;
    sp_found *found = calloc(1, sizeof *found);
    if (!found)
        return sp_fail_memory(error);
    found->mounts = malloc((mounts + 1) * sizeof *found->mounts);
    found->layouts = malloc(most * sizeof *found->layouts);
    bool done = (found->mounts && found->layouts) || sp_fail_memory(error);
    if (done)
        memcpy(found->mounts, search->options->mounts, mounts * sizeof *found->mounts);
    done = done && write_down(found, &front->best, &front->measured, error);
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; done && i < lists[k]->count; i++)
            done = write_down(found, &lists[k]->entries[i].partial, &lists[k]->entries[i].point, error);
    for (size_t i = 0; counted_again && i < found->count; i++)
        found->layouts[i].point.area = -1;
    if (done)
        return found;
    sp_found_destroy(found);
    return NULL;
}

void sp_found_destroy(sp_found *found)
{
    if (!found)
        return;
    for (size_t i = 0; i < found->count; i++)
        free(found->layouts[i].items);
    free(found->layouts);
    free(found->mounts);
    free(found);
}

static bool same_vector(sp_vec3 a, sp_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool same_step(sp_step a, sp_step b)
{
    return a.count == b.count && a.unit == b.unit;
}

/* The same place with the same settings: how many nozzles it takes, which types and at what cost is each placement's
 * own matter. */
static bool same_mount(const sp_mount *a, const sp_mount *b)
{
    return a->kind == b->kind && !strcmp(a->name, b->name) && same_vector(a->position, b->position) &&
           same_vector(a->axis, b->axis) && a->tilt == b->tilt && a->depth_from == b->depth_from &&
           a->depth_to == b->depth_to && a->depth_spacing == b->depth_spacing &&
           same_step(a->depth_step, b->depth_step) && same_step(a->tilt_step, b->tilt_step) &&
           a->geometry == b->geometry && a->part == b->part && a->standoff == b->standoff && a->spacing == b->spacing &&
           same_vector(a->from, b->from) && same_vector(a->to, b->to);
}

/* The search's own; SP_NONE where it has none. */
static uint32_t mount_like(const sp_search *search, const sp_mount *mount)
{
    for (uint32_t m = 0; m < search->options->mount_count; m++)
        if (same_mount(&search->options->mounts[m], mount))
            return m;
    return SP_NONE;
}

/* Whether the search may choose the nozzle's type at its pressure there. */
static bool is_offered(const sp_search *search, uint32_t mount, const sp_nozzle *nozzle)
{
    bool offered = false;
    for (size_t k = 0; k < search->candidates->variant_count; k++) {
        const sp_variant *variant = &search->candidates->variants[k];
        offered |= variant->type == nozzle->type && variant->pressure == nozzle->pressure;
    }
    return offered && sp_mount_takes(&search->options->mounts[mount], nozzle->type);
}

/* True, and which, where a candidate at the mounting point sprays as the nozzle does. */
static bool find_pose_at(const sp_search *search, uint32_t site, const sp_nozzle *nozzle, sp_pose *pose)
{
    const sp_candidates *candidates = search->candidates;
    sp_vec3 up = sp_evaluator_setup(search->coarse)->up;
    for (uint32_t k = 0; k < candidates->variant_count; k++) {
        size_t axes = sp_candidates_axes(candidates, search->sites->items[site].mount, k)->count;
        for (uint32_t axis = 0; candidates->variants[k].type == nozzle->type && axis < axes; axis++)
            for (uint32_t roll = 0; roll < candidates->variants[k].roll_count; roll++) {
                *pose = (sp_pose){site, k, axis, roll};
                sp_nozzle there = sp_pose_nozzle(candidates, search->sites, *pose, up);
                if (sp_nozzles_spray_alike(&there, nozzle))
                    return true;
            }
    }
    return false;
}

/* The candidate that sprays as the nozzle does, of no site where none does: axes lie farther apart where there are more
 * places. */
static sp_pose find_pose(const sp_search *search, uint32_t mount, const sp_nozzle *nozzle)
{
    sp_pose pose;
    for (uint32_t i = 0; i < search->sites->count; i++)
        if (search->sites->items[i].mount == mount && same_vector(search->sites->items[i].position, nozzle->position) &&
            find_pose_at(search, i, nozzle, &pose))
            return pose;
    return (sp_pose){SP_NONE, SP_NONE, SP_NONE, SP_NONE};
}

/* Adds nozzles without fields. False where some mount, type or number does not allow them, or a type that no pattern
 * kernel knows stands where this search has no candidate. */
static bool admit(const sp_search *search, const sp_found *found, const found_layout *layout, sp_partial *bare)
{
    for (size_t i = 0; i < layout->count; i++) {
        sp_placed *item = &bare->items[i];
        *item = layout->items[i];
        /* what it became in its place is what has to be allowed there */
        bool changed = item->nozzle.type != item->origin.type;
        const sp_nozzle *offered = changed ? &item->nozzle : &item->origin;
        item->site.mount = mount_like(search, &found->mounts[item->site.mount]);
        if (item->site.mount == SP_NONE || !is_offered(search, item->site.mount, offered) ||
            !sp_partial_has_place(search, bare, item->site.mount) ||
            !sp_body_clear(search, bare, sp_nozzle_body(&item->nozzle)))
            return false;
        item->pose = find_pose(search, item->site.mount, &item->origin);
        if (!sp_type_is_uniform(item->nozzle.type) && (changed || item->pose.site == SP_NONE))
            return false;
        bare->count++;
    }
    return layout->point.flow <= search->options->max_water * (1 + SP_ROUNDING);
}

static bool add_with_field(const sp_search *search, sp_partial *partial, sp_placed placed, sp_error *error)
{
    placed.field = malloc((search->field_count + 1) * sizeof *placed.field);
    if (!placed.field)
        return sp_fail_memory(error);
    bool uniform = sp_type_is_uniform(placed.nozzle.type);
    bool done = uniform ? sp_field_nozzle(search, &placed.nozzle, NULL, placed.field, error)
                        : sp_footprints_include(search->footprints, placed.pose, error);
    if (!done) {
        free(placed.field);
        return false;
    }
    if (!uniform)
        sp_field_pose(search, placed.pose, placed.field);
    return sp_partial_add(search, partial, placed, error);
}

/* What the scene says of it is known from now on; drafts are measured as drafts. */
static bool enter(sp_front *front, const sp_search *search, const sp_partial *partial, sp_front_point point,
                  sp_error *error)
{
    sp_front_point draft = {.area = -1};
    if (!sp_front_note(front, search, partial, front->draft_jets ? &draft : &point, error))
        return false;
    return point.area < 0 || sp_front_count(front, search, partial, &point, error);
}

/* Whether one that was counted covers as much, takes no more and has no more nozzles. */
static bool is_bettered(const sp_front *front, const sp_front_point *point)
{
    bool bettered = false;
    for (size_t i = 0; i < front->counted.count; i++) {
        const sp_front_point *other = &front->counted.entries[i].point;
        bettered |= other->area >= point->area && other->outlay <= point->outlay && other->nozzles <= point->nozzles;
    }
    return bettered && point->area >= 0;
}

static bool take(sp_front *front, const sp_search *search, const sp_found *found, const found_layout *layout,
                 sp_error *error)
{
    sp_partial bare = {.items = malloc((layout->count + 1) * sizeof *bare.items)}, partial = {0};
    if (!bare.items)
        return sp_fail_memory(error);
    bool done = true;
    if (admit(search, found, layout, &bare)) {
        sp_front_point point = layout->point;
        point.outlay = point.flow + sp_partial_costs(search, &bare);
        if (!is_bettered(front, &point)) {
            done = sp_partial_create(search, &partial, error);
            for (size_t i = 0; done && i < bare.count; i++)
                done = add_with_field(search, &partial, bare.items[i], error);
            done = done && enter(front, search, &partial, point, error);
            sp_partial_free(&partial);
        }
    }
    free(bare.items);
    return done;
}

bool sp_take_known(sp_front *front, const sp_search *search, sp_error *error)
{
    for (size_t k = 0; k < search->options->known_count; k++) {
        const sp_found *found = search->options->known[k]->found;
        for (size_t i = 0; i < found->count; i++)
            if (!take(front, search, found, &found->layouts[i], error))
                return false;
    }
    return true;
}
