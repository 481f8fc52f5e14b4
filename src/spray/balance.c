/* Where the liquid ends: on what is to be cleaned, on other surface, outside, or on a way that is not followed. */
#include "bodies.h"
#include "emitter.h"
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
static void end_jet(const sp_evaluator *evaluator, const sp_ray *ray, const sp_hit *hit, double flow,
                    sp_balance *balance)
{
    bool is_hit = hit->triangle != SP_NONE, clean = false;
    double onward = 0;
    if (is_hit) {
        const sp_mesh *mesh = evaluator->setup.mesh;
        const sp_surface *surface = &evaluator->setup.surfaces[mesh->part[hit->triangle]];
        sp_vec3 velocity = sp_ray_velocity(ray, evaluator->gravity, hit->t);
        bool back = sp_dot(velocity, sp_triangle_normal(mesh, hit->triangle)) > 0;
        clean = sp_patch_at(evaluator, hit->triangle, hit->u, hit->v, back) != SP_NONE;
        onward = surface->restitution > 0 ? flow * surface->rebound : 0;
    }
    sp_balance_add(balance, is_hit, clean, flow, onward);
    balance->unfollowed += onward;
}

/* Room for JETS rays, offsets and hits is the caller's: no pattern has more. */
static void end_pattern(const sp_evaluator *evaluator, const sp_nozzle *pattern, sp_ray *rays, sp_vec3 *offset,
                        sp_hit *hits, sp_balance *balance)
{
    sp_emitter emitter = sp_emitter_of(evaluator, pattern);
    double flow = sp_nozzle_flow(pattern, &evaluator->setup.liquid);
    size_t jets = (size_t)pattern->jets;
    if (!(emitter.source.speed > 0) || !(flow > 0))
        return;
    for (size_t i = 0; i < jets; i++) {
        rays[i] = sp_emitter_jet(&emitter, i, jets);
        offset[i] = sp_jet_offset(evaluator, i);
    }
    sp_jets_hit(evaluator, rays, offset, jets, evaluator->setup.run.threads, hits);
    for (size_t i = 0; i < jets; i++)
        end_jet(evaluator, &rays[i], &hits[i], flow / (double)jets, balance);
}

bool sp_evaluate_balance(const sp_evaluator *evaluator, const sp_layout *layout, sp_coverage *coverage, sp_error *error)
{
    if (!evaluator || !layout || !coverage)
        return false;
    if (coverage->balance.known)
        return true;
    sp_bodies bodies;
    sp_ray *rays = malloc(JETS * sizeof *rays);
    sp_vec3 *offset = malloc(JETS * sizeof *offset);
    sp_hit *hits = malloc(JETS * sizeof *hits);
    bool done = sp_bodies_create_with(evaluator, layout, JETS, &bodies, error) &&
                ((rays && offset && hits) || sp_fail_memory(error));
    sp_balance balance = {.known = true};
    for (size_t n = 0; done && n < bodies.patterns->count; n++)
        end_pattern(evaluator, &bodies.patterns->nozzles[n], rays, offset, hits, &balance);
    sp_bodies_free(&bodies);
    free(rays);
    free(offset);
    free(hits);
    coverage->balance = done ? balance : coverage->balance;
    return done;
}
