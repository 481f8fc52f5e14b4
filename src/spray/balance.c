/* Where the liquid ends: on what is to be cleaned, on other surface, outside, or on a way that is not followed. */
#include "nozzle_bodies.h"
#include "emitter.h"
#include "launch.h"
#include "movers.h"
#include "watch.h"

#include <stdlib.h>

#define JETS 20000 /* of each nozzle, shared by its patterns; their number is part of the answer */
#define BLOCK 4096 /* jets between two questions whether to go on */

void sp_balance_add(sp_balance *balance, bool hit, bool clean, double arrived, double onward)
{
    double stays = arrived - onward;
    if (!hit)
        balance->left += arrived;
    else if (clean)
        balance->clean += stays;
    else
        balance->other += stays;
}

/* What is thrown back is not followed: the inverse evaluator knows the first impact only. */
static void end_jet(const sp_evaluator *evaluator, const sp_hit *hit, sp_vec3 velocity, double flow,
                    sp_balance *balance)
{
    bool is_hit = hit->triangle != SP_NONE, clean = false;
    double onward = 0;
    if (is_hit) {
        const sp_mesh *mesh = evaluator->setup.mesh;
        const sp_surface *surface = &evaluator->setup.surfaces[mesh->part[hit->triangle]];
        bool back = sp_dot(velocity, sp_triangle_normal(mesh, hit->triangle)) > 0;
        clean = sp_patch_at(evaluator, hit->triangle, hit->u, hit->v, back) != SP_NONE;
        onward = surface->restitution > 0 ? flow * surface->rebound : 0;
    }
    sp_balance_add(balance, is_hit, clean, flow, onward);
    balance->unfollowed += onward;
}

/* Room for JETS, which no pattern has more of. */
typedef struct {
    sp_ray *rays;
    sp_vec3 *offset; /* m, of goods that move */
    sp_hit *hits;
    sp_landing *landings; /* with drag alone */
} jets_room;

/* Where jets of one pattern, or drops, come to. False where it was stopped. */
static bool fly(const sp_evaluator *evaluator, const sp_nozzle *pattern, sp_vec3 acceleration, size_t jets,
                const jets_room *room, sp_watch *watch)
{
    const sp_setup *setup = &evaluator->setup;
    sp_drag drag = sp_drag_of(pattern, &setup->liquid, &setup->air);
    bool drops = sp_flies_as_drops(evaluator, pattern);
    for (size_t first = 0, count; first < jets; first += count) {
        const sp_ray *rays = room->rays + first;
        const sp_vec3 *offset = room->offset + first;
        count = jets - first < BLOCK ? jets - first : BLOCK;
        if (drops)
            sp_drops_land(evaluator, &drag, rays, acceleration, offset, count, sp_thread_count(setup->run.threads),
                          room->landings + first);
        else
            sp_jets_hit(evaluator, rays, acceleration, offset, count, setup->run.threads, room->hits + first);
        if (!sp_watch_goes_on(watch, count))
            return false;
    }
    return true;
}

static bool end_pattern(const sp_evaluator *evaluator, const sp_nozzle *pattern, const jets_room *room, sp_watch *watch,
                        sp_balance *balance)
{
    bool drops = sp_flies_as_drops(evaluator, pattern);
    sp_emitter emitter = sp_emitter_of(evaluator, pattern, NULL);
    double flow = sp_nozzle_flow(pattern, &evaluator->setup.liquid);
    size_t jets = (size_t)pattern->jets;
    if (!(emitter.source.speed > 0) || !(flow > 0))
        return true;
    for (size_t i = 0; i < jets; i++) {
        room->rays[i] = sp_emitter_jet(&emitter, i, jets);
        room->offset[i] = sp_jet_offset(evaluator, i);
    }
    sp_vec3 acceleration = emitter.source.gravity;
    if (!fly(evaluator, pattern, acceleration, jets, room, watch))
        return false;
    for (size_t i = 0; i < jets; i++) {
        const sp_landing *landing = drops ? &room->landings[i] : NULL;
        const sp_hit *hit = landing ? &landing->hit : &room->hits[i];
        sp_vec3 velocity = landing ? landing->velocity : sp_ray_velocity(&room->rays[i], acceleration, hit->t);
        end_jet(evaluator, hit, velocity, flow / (double)jets, balance);
    }
    return true;
}

bool sp_evaluate_balance(const sp_evaluator *evaluator, const sp_layout *layout, sp_coverage *coverage, sp_error *error)
{
    if (!evaluator || !layout || !coverage)
        return false;
    if (coverage->balance.known)
        return true;
    sp_bodies bodies;
    bool done = sp_bodies_create_with(evaluator, layout, JETS, &bodies, error);
    bool drag = done && sp_bodies_hold_drops(evaluator, &bodies);
    jets_room room = {malloc(JETS * sizeof *room.rays), malloc(JETS * sizeof *room.offset),
                      malloc(JETS * sizeof *room.hits), drag ? malloc(JETS * sizeof *room.landings) : NULL};
    done = done && ((room.rays && room.offset && room.hits && (room.landings || !drag)) || sp_fail_memory(error));
    sp_balance balance = {.known = true};
    sp_watch watch = sp_watch_start(evaluator, "liquid", JETS * layout->count);
    for (size_t n = 0; done && n < bodies.patterns->count; n++)
        done = end_pattern(evaluator, &bodies.patterns->nozzles[n], &room, &watch, &balance) ||
               sp_watch_fail(&watch, error);
    done = done && sp_watch_end(&watch, error);
    sp_bodies_free(&bodies);
    free(room.rays);
    free(room.offset);
    free(room.hits);
    free(room.landings);
    coverage->balance = done ? balance : coverage->balance;
    return done;
}
