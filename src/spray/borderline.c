/* What of the surface round-off could judge otherwise. */
#include "nozzle_bodies.h"
#include "reach.h"

#include <stdlib.h>

#define CLOSE 1e-9 /* of a criterion; rad */
#define SIDES 4    /* on which a flight is looked at again */

static bool is_close(double value, double criterion)
{
    return criterion > 0 && fabs(value - criterion) <= CLOSE * criterion;
}

/* One pattern while what it puts in doubt is found. */
typedef struct {
    const sp_emitter *emitter;
    double flow;           /* m³/s */
    const sp_reach *reach; /* with what is blocked */
    bool *found;           /* [patches] */
    uint8_t *fate;         /* [patches], bit `arc` where a flight arrives, bit 2 + `arc` where one is blocked */
    bool *concerned;       /* [patches] */
} inquiry;

/* Whether what decides about an arrival, and adds it to its patch's, is close to a criterion or to the spray's edge. */
static bool weigh(const inquiry *own, const sp_arrival *arrival, sp_wetting *wetting)
{
    const sp_emitter *emitter = own->emitter;
    const sp_criterion *criterion = &emitter->source.evaluator->setup.criterion;
    double share = sp_emitter_share(emitter, arrival), flux = sp_emitter_flux(emitter, own->flow, arrival, share);
    bool edge = share > 0 && share < 1;
    if (arrival->passes)
        sp_wetting_add(wetting, flux, criterion->flux, arrival->part, share,
                       edge ? sp_emitter_holds(emitter, arrival->direction) : share > 0);
    return is_close(arrival->speed, criterion->impact_speed) ||
           is_close(sp_arrival_incidence(arrival), criterion->incidence) || is_close(flux, criterion->flux) ||
           (edge && fabs(sp_emitter_margin(emitter, arrival->direction)) <= CLOSE);
}

static void find_close(const inquiry *own)
{
    double threshold = own->emitter->source.evaluator->setup.criterion.flux;
    const sp_arrival *arrivals = own->reach->arrivals;
    for (size_t i = 0, end; i < own->reach->count; i = end) {
        sp_wetting wetting = {0, 1, 0};
        uint32_t patch = arrivals[i].patch;
        for (end = i; end < own->reach->count && arrivals[end].patch == patch; end++)
            if (!arrivals[end].blocked && weigh(own, &arrivals[end], &wetting))
                own->found[patch] = true;
        own->found[patch] = own->found[patch] || is_close(wetting.even, threshold);
    }
}

/* Where nothing else is asked for, a wall that the liquid flies along is covered by as little as round-off. */
static void find_along(const inquiry *own)
{
    const sp_emitter *emitter = own->emitter;
    const sp_source *source = &emitter->source;
    const sp_patches *patches = &source->evaluator->patches;
    const sp_criterion *criterion = &source->evaluator->setup.criterion;
    if (criterion->flux > 0 || !is_close(criterion->incidence, M_PI / 2))
        return;
    for (size_t p = 0; p < patches->count; p++) {
        sp_flight flights[2];
        int count = sp_source_flights(source, patches->point[p], flights);
        for (int k = 0; k < count; k++)
            if (fabs(sp_dot(flights[k].velocity, patches->normal[p])) <= CLOSE * sp_length(flights[k].velocity) &&
                sp_emitter_margin(emitter, flights[k].direction) >= -CLOSE)
                own->found[p] = true;
    }
}

/* Patches some of whose flights are blocked, and those with neighbours to which flights fare otherwise. */
static void find_concerned(const inquiry *own)
{
    const sp_patches *patches = &own->emitter->source.evaluator->patches;
    for (size_t i = 0; i < own->reach->count; i++) {
        const sp_arrival *arrival = &own->reach->arrivals[i];
        own->fate[arrival->patch] |= (uint8_t)(1u << (arrival->arc + 2 * arrival->blocked));
    }
    for (size_t p = 0; p < patches->count; p++) {
        uint8_t fate = own->fate[p];
        own->concerned[p] = fate & fate >> 2;
        for (uint32_t n = patches->neighbour_start[p]; fate && n < patches->neighbour_start[p + 1]; n++)
            own->concerned[p] = own->concerned[p] || own->fate[patches->neighbours[n]] != fate;
    }
}

/* Flights to the patches concerned that fare otherwise a hair beside. */
static bool find_edges(const inquiry *own, const sp_aim *aim, sp_error *error)
{
    sp_aim again = *aim;
    again.among = own->concerned;
    for (unsigned side = 1; side <= SIDES; side++) {
        again.beside = side;
        sp_reach *beside = sp_reach_create(&own->emitter->source, &again, error);
        if (!beside)
            return false;
        for (size_t i = 0, k = 0; k < beside->count; i++)
            if (own->concerned[own->reach->arrivals[i].patch] &&
                own->reach->arrivals[i].blocked != beside->arrivals[k++].blocked)
                own->found[own->reach->arrivals[i].patch] = true;
        sp_reach_destroy(beside);
    }
    return true;
}

static bool inquire(const sp_emitter *emitter, double flow, sp_watch *watch, bool *found, sp_error *error)
{
    size_t room = emitter->source.evaluator->patches.count + 1;
    sp_aim aim = sp_aim_at(emitter->frame.z, sp_spray_reach(&emitter->spray));
    aim.emitter = emitter;
    aim.blocked = true;
    aim.watch = watch;
    sp_reach *reach = sp_reach_create(&emitter->source, &aim, error);
    inquiry own = {emitter, flow, reach, found, calloc(room, sizeof *own.fate), calloc(room, sizeof *own.concerned)};
    bool done = reach && ((own.fate && own.concerned) || sp_fail_memory(error));
    if (done) {
        find_close(&own);
        find_along(&own);
        find_concerned(&own);
        done = find_edges(&own, &aim, error);
    }
    free(own.fate);
    free(own.concerned);
    sp_reach_destroy(reach);
    return done;
}

bool sp_find_borderline(const sp_evaluator *evaluator, const sp_layout *layout, const sp_coverage *coverage,
                        bool *patches, sp_borderline *borderline, sp_error *error)
{
    if (!evaluator || !layout || !coverage)
        return false;
    *borderline = (sp_borderline){.known = false};
    size_t count = evaluator->patches.count;
    for (size_t p = 0; patches && p < count; p++)
        patches[p] = false;
    if (evaluator->movers)
        return true;
    bool *found = calloc(count + 1, sizeof *found);
    sp_bodies bodies;
    bool done = sp_bodies_create(evaluator, layout, &bodies, error) && sp_bodies_fly(evaluator, &bodies, error) &&
                (found || sp_fail_memory(error));
    sp_watch watch = sp_watch_start(evaluator, "borderline", done ? (1 + SIDES) * bodies.patterns->count * count : 0);
    for (size_t i = 0; done && i < bodies.patterns->count; i++) {
        const sp_nozzle *pattern = &bodies.patterns->nozzles[i];
        sp_emitter emitter = sp_bodies_emitter(evaluator, &bodies, i);
        double flow = sp_nozzle_flow(pattern, &evaluator->setup.liquid);
        done = !(flow > 0) || inquire(&emitter, flow, &watch, found, error);
    }
    done = done && sp_watch_end(&watch, error);
    sp_bodies_free(&bodies);
    double area = 0;
    for (size_t p = 0; done && p < count; p++) {
        found[p] = found[p] || is_close(coverage->deposits.even[p], evaluator->setup.criterion.flux);
        area += found[p] ? evaluator->patches.area[p] : 0;
        if (patches)
            patches[p] = found[p];
    }
    if (done)
        *borderline = (sp_borderline){true, area};
    free(found);
    return done;
}
