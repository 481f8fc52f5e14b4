/* Where the liquid ends: on what is to be cleaned, on other surface, outside, or on a way that is not followed. */
#include "nozzle_bodies.h"
#include "emitter.h"
#include "launch.h"
#include "movers.h"

#include <stdlib.h>

#define JETS 20000 /* of each nozzle, shared by its patterns; their number is part of the answer */

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

/* Where jets of one pattern, or drops, come to. */
static void fly(const sp_evaluator *evaluator, const sp_nozzle *pattern, sp_vec3 acceleration, size_t jets,
                const jets_room *room)
{
    const sp_setup *setup = &evaluator->setup;
    sp_drag drag = sp_drag_of(pattern, &setup->liquid, &setup->air);
    if (sp_flies_as_drops(evaluator, pattern))
        sp_drops_land(evaluator, &drag, room->rays, acceleration, room->offset, jets,
                      sp_thread_count(setup->run.threads), room->landings);
    else
        sp_jets_hit(evaluator, room->rays, acceleration, room->offset, jets, setup->run.threads, room->hits);
}

static void end_pattern(const sp_evaluator *evaluator, const sp_nozzle *pattern, const jets_room *room,
                        sp_balance *balance)
{
    bool drops = sp_flies_as_drops(evaluator, pattern);
    sp_emitter emitter = sp_emitter_of(evaluator, pattern, NULL);
    double flow = sp_nozzle_flow(pattern, &evaluator->setup.liquid);
    size_t jets = (size_t)pattern->jets;
    if (!(emitter.source.speed > 0) || !(flow > 0))
        return;
    for (size_t i = 0; i < jets; i++) {
        room->rays[i] = sp_emitter_jet(&emitter, i, jets);
        room->offset[i] = sp_jet_offset(evaluator, i);
    }
    sp_vec3 acceleration = emitter.source.gravity;
    fly(evaluator, pattern, acceleration, jets, room);
    for (size_t i = 0; i < jets; i++) {
        const sp_landing *landing = drops ? &room->landings[i] : NULL;
        const sp_hit *hit = landing ? &landing->hit : &room->hits[i];
        sp_vec3 velocity = landing ? landing->velocity : sp_ray_velocity(&room->rays[i], acceleration, hit->t);
        end_jet(evaluator, hit, velocity, flow / (double)jets, balance);
    }
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
    for (size_t n = 0; done && n < bodies.patterns->count; n++)
        end_pattern(evaluator, &bodies.patterns->nozzles[n], &room, &balance);
    sp_bodies_free(&bodies);
    free(room.rays);
    free(room.offset);
    free(room.hits);
    free(room.landings);
    coverage->balance = done ? balance : coverage->balance;
    return done;
}
