/* Where the liquid ends: on what is to be cleaned, on other surface, outside, or on a way that is not followed. */
#include "emitter.h"

#include <stdlib.h>

#define JETS 20000 /* of each nozzle; their number is part of the answer */

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

bool sp_evaluate_balance(const sp_evaluator *evaluator, const sp_layout *layout, sp_coverage *coverage, sp_error *error)
{
    if (!evaluator || !layout || !coverage)
        return false;
    if (coverage->balance.known)
        return true;
    sp_ray *rays = malloc(JETS * sizeof *rays);
    sp_hit *hits = malloc(JETS * sizeof *hits);
    bool done = rays && hits;
    sp_balance balance = {.known = true};
    for (size_t n = 0; done && n < layout->count; n++) {
        sp_emitter emitter = sp_emitter_of(evaluator, &layout->nozzles[n]);
        double flow = sp_nozzle_flow(&layout->nozzles[n], &evaluator->setup.liquid);
        if (!(emitter.source.speed > 0) || !(flow > 0))
            continue;
        for (size_t i = 0; i < JETS; i++)
            rays[i] = sp_emitter_jet(&emitter, i, JETS);
        sp_trace_nearest_many(evaluator->tracer, rays, JETS, evaluator->gravity, evaluator->setup.run.threads, hits);
        for (size_t i = 0; i < JETS; i++)
            end_jet(evaluator, &rays[i], &hits[i], flow / JETS, &balance);
    }
    free(rays);
    free(hits);
    coverage->balance = done ? balance : coverage->balance;
    return done || sp_fail_memory(error);
}
