#include "sight.h"

#include <stdlib.h>
#include <string.h>

bool sp_sights_create(const sp_search *search, size_t capacity, sp_sights *sights, sp_error *error)
{
    *sights = (sp_sights){.search = search, .capacity = capacity};
    sights->items = calloc(capacity, sizeof *sights->items);
    return sights->items || sp_fail_memory(error);
}

void sp_sights_free(sp_sights *sights)
{
    for (size_t i = 0; sights->items && i < sights->capacity; i++)
        free(sights->items[i].seen);
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
    return fmin(M_PI, sp_spray_reach(&spray) + turn + 1e-6);
}

static bool equal(sp_vec3 a, sp_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool trace(const sp_search *search, sp_sight *sight, sp_error *error)
{
    const sp_patches *patches = sp_evaluator_patches(search->coarse);
    sp_vec3 gravity = sp_evaluator_gravity(search->coarse);
    sp_reach *reach = sp_evaluator_reach_passing(search->coarse, sight->position, sight->speed, sight->axis,
                                                 sight->half_angle, error);
    if (!reach)
        return false;
    sight->seen = malloc((reach->count ? reach->count : 1) * sizeof *sight->seen);
    for (size_t i = 0; sight->seen && i < reach->count; i++) {
        const sp_arrival *arrival = &reach->arrivals[i];
        sp_flight flights[2];
        int count = sp_flights(sight->position, patches->point[arrival->patch], sight->speed, gravity, flights);
        uint32_t arc = count == 2 && sp_dot(flights[1].direction, arrival->direction) >
                                         sp_dot(flights[0].direction, arrival->direction);
        sight->seen[sight->count++] = (sp_seen){arrival->patch, arc, arrival->direction, arrival->transfer};
    }
    sp_reach_destroy(reach);
    return sight->seen || sp_fail_memory(error);
}

const sp_sight *sp_sights_look(sp_sights *sights, const sp_placed *placed, sp_error *error)
{
    const sp_search *search = sights->search;
    double speed = sp_nozzle_speed(&placed->nozzle, &sp_evaluator_setup(search->coarse)->liquid);
    sp_sight wanted = {.position = placed->nozzle.position,
                       .speed = speed,
                       .axis = placed->origin.axis,
                       .half_angle = needed(search, placed),
                       .used = ++sights->clock};
    sp_sight *oldest = &sights->items[0];
    for (size_t i = 0; i < sights->capacity; i++) {
        sp_sight *item = &sights->items[i];
        if (item->seen && item->speed == speed && equal(item->position, wanted.position) &&
            (item->half_angle >= M_PI || (equal(item->axis, wanted.axis) && item->half_angle >= wanted.half_angle))) {
            item->used = sights->clock;
            return item;
        }
        if (item->used < oldest->used)
            oldest = item;
    }
    free(oldest->seen);
    *oldest = (sp_sight){0};
    if (!trace(search, &wanted, error)) {
        free(wanted.seen);
        return NULL;
    }
    *oldest = wanted;
    return oldest;
}

/* Cones without an inverse trigonometric function, fans by the pattern itself. */
static bool holds(const sp_spray *spray, double inner, double outer, const sp_frame *frame, sp_vec3 d)
{
    double z = sp_dot(d, frame->z);
    if (spray->kind != SP_PATTERN_FLAT_FAN)
        return z >= outer && z <= inner;
    return sp_spray_intensity(spray, sp_v(sp_dot(d, frame->x), sp_dot(d, frame->y), z)) > 0;
}

bool sp_sights_field(sp_sights *sights, sp_placed *placed, float *field, sp_error *error)
{
    const sp_sight *sight = sp_sights_look(sights, placed, error);
    if (!sight)
        return false;
    const sp_search *search = sights->search;
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    const sp_nozzle *nozzle = &placed->nozzle;
    sp_spray spray = sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle));
    sp_frame frame = sp_nozzle_frame(nozzle->axis, nozzle->roll, setup->up);
    double inner = spray.inner > 0 ? cos(spray.inner) : 2, outer = spray.outer < M_PI ? cos(spray.outer) : -2;
    double strength = sp_nozzle_flow(nozzle, &setup->liquid) / (spray.solid_angle * search->threshold);
    memset(field, 0, search->patch_count * sizeof *field);
    for (size_t i = 0; i < sight->count; i++) {
        const sp_seen *seen = &sight->seen[i];
        if (seen->transfer > 0 && holds(&spray, inner, outer, &frame, seen->direction))
            field[seen->patch] += search->threshold > 0 ? (float)(strength * seen->transfer) : INFINITY;
    }
    return true;
}
