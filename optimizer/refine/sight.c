#include "refine/sight.h"

#include "scoring/field.h"
#include "scoring/footprints.h"

#include <stdlib.h>
#include <string.h>

#define NEAR 0.2  /* of a texel */
#define SPARE 0.2 /* rad beyond what the nozzle can reach from its place, for when it moves */

bool sp_sights_reserve(sp_sights *sights, size_t capacity, sp_error *error)
{
    if (capacity <= sights->capacity)
        return true;
    sp_sight *items = realloc(sights->items, capacity * sizeof *items);
    if (!items)
        return sp_fail_memory(error);
    memset(&items[sights->capacity], 0, (capacity - sights->capacity) * sizeof *items);
    sights->items = items;
    sights->capacity = capacity;
    return true;
}

bool sp_sights_create(const sp_search *search, size_t capacity, bool exact, sp_sights *sights, sp_error *error)
{
    *sights = (sp_sights){.search = search,
                          .asked = capacity,
                          .tolerance = exact ? 0 : NEAR * sp_evaluator_fidelity(search->coarse)->texel};
    return sp_sights_reserve(sights, capacity, error);
}

void sp_sights_forget(sp_sights *sights)
{
    for (size_t i = 0; i < sights->capacity; i++) {
        sp_reach_destroy(sights->items[i].reach);
        sights->items[i] = (sp_sight){0};
    }
    /* what room an earlier layout needed must not tell what is remembered of the next */
    sights->capacity = sights->asked;
}

void sp_sights_free(sp_sights *sights)
{
    sp_sights_forget(sights);
    free(sights->items);
    *sights = (sp_sights){0};
}

/* Half-angle about the candidate's axis that holds the pattern as far as it may turn and open. */
static double needed(const sp_search *search, const sp_placed *placed)
{
    const sp_place_options *options = search->options;
    double low, high;
    sp_angle_range(options, placed->nozzle.type, &low, &high);
    sp_spray spray = sp_spray_create(placed->nozzle.type, fmax(high, sp_nozzle_angle(&placed->nozzle)));
    double turn = fmin(options->refine.axis, 2 * options->mounts[placed->site.mount].tilt);
    return fmin(M_PI, sp_spray_reach(&spray) + turn + SPARE);
}

static bool equal(sp_vec3 a, sp_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool is_same(const sp_launch *a, const sp_launch *b)
{
    return a->speed == b->speed && a->fronts == b->fronts && a->trajectory == b->trajectory;
}

static bool trace(const sp_search *search, sp_sight *sight, sp_error *error)
{
    sight->reach = search->all_feeds ? sp_evaluator_reach(search->coarse, sight->position, sight->launch, sight->axis,
                                                          sight->half_angle, error)
                                     : sp_evaluator_reach_passing(search->coarse, sight->position, sight->launch,
                                                                  sight->axis, sight->half_angle, NULL, error);
    if (!sight->reach)
        return false;
    sight->count = sight->reach->count;
    sight->seen = sight->reach->arrivals;
    return true;
}

/* The sight nearest to the one wanted of those that will do; NULL for none. */
static sp_sight *known(const sp_sights *sights, const sp_sight *wanted)
{
    sp_sight *best = NULL;
    double nearest = nextafter(sights->tolerance, INFINITY);
    for (size_t i = 0; i < sights->capacity; i++) {
        sp_sight *item = &sights->items[i];
        if (!item->reach || !is_same(&item->launch, &wanted->launch) || item->half_angle < wanted->half_angle ||
            (item->half_angle < M_PI && !equal(item->axis, wanted->axis)))
            continue;
        double distance = sp_distance(item->position, wanted->position);
        if (distance < nearest) {
            best = item;
            nearest = distance;
        }
    }
    return best;
}

const sp_sight *sp_sights_look(sp_sights *sights, const sp_placed *placed, sp_error *error)
{
    static const sp_sight nothing = {0};
    const sp_search *search = sights->search;
    if (!sp_type_is_uniform(placed->nozzle.type))
        return &nothing;
    sp_sight wanted = {
        .position = placed->nozzle.position, .axis = placed->origin.axis, .half_angle = needed(search, placed)};
    if (!sp_launch_table_find(search->candidates->table, &placed->nozzle, &wanted.launch, error))
        return NULL;
    wanted.gravity = sp_evaluator_gravity(search->coarse, &wanted.launch);
    sp_sight *sight = known(sights, &wanted);
    if (!sight) {
        sight = &sights->items[0];
        for (size_t i = 1; i < sights->capacity; i++)
            if (sights->items[i].used < sight->used)
                sight = &sights->items[i];
        sp_reach_destroy(sight->reach);
        *sight = (sp_sight){0};
        if (!trace(search, &wanted, error))
            return NULL;
        *sight = wanted;
    }
    sight->used = ++sights->clock;
    return sight;
}

bool sp_sight_fly(const sp_search *search, const sp_sight *sight, const sp_arrival *seen, sp_vec3 position,
                  sp_flight *flight, double *transfer)
{
    sp_flight near = {.direction = seen->direction, .time = seen->time};
    if (!sp_launch_flight_near(&sight->launch, position, seen->point, sight->gravity, (int)seen->arc, &near, flight))
        return false;
    double against = -sp_dot(flight->velocity, seen->normal);
    if (sp_evaluator_patches(search->coarse)->side[seen->patch] == SP_SIDE_BOTH)
        against = fabs(against);
    *transfer = fmax(0, against) / flight->spread;
    return *transfer > 0;
}

void sp_sight_field(const sp_search *search, const sp_sight *sight, const sp_placed *placed, const sp_partial *partial,
                    float *field)
{
    const sp_patches *patches = sp_evaluator_patches(search->coarse);
    const sp_nozzle *nozzle = &placed->nozzle;
    sp_posed_spray posed = sp_posed_spray_of(search, nozzle);
    bool moved = !equal(nozzle->position, sight->position);
    sp_field_making making = sp_field_begin(search, &posed, 1, field);
    for (size_t i = 0; i < sight->count; i++) {
        const sp_arrival *seen = &sight->seen[i];
        if (partial && partial->wet[seen->patch] >= SP_ENOUGH && !search->runoffs)
            continue;
        sp_flight flight = {.direction = seen->direction};
        double transfer = seen->transfer, breadth = seen->breadth;
        if (moved) {
            if (!sp_sight_fly(search, sight, seen, nozzle->position, &flight, &transfer))
                continue;
            breadth = sp_flight_breadth(&flight, patches->length[seen->patch]);
        }
        sp_field_add(&making, seen->patch, seen->passes, flight.direction, breadth, transfer, (float)seen->part);
    }
    sp_field_end(&making);
}

bool sp_sights_field(sp_sights *sights, const sp_placed *placed, const sp_partial *partial, float *field,
                     sp_error *error)
{
    if (!sp_type_is_uniform(placed->nozzle.type)) {
        sp_field_pose(sights->search, placed->pose, field);
        return sp_footprints_sound(sights->search->footprints, error);
    }
    const sp_sight *sight = sp_sights_look(sights, placed, error);
    if (sight)
        sp_sight_field(sights->search, sight, placed, partial, field);
    return sight;
}
