#include "movers.h"

#include <assert.h>
#include <stdlib.h>

/* The triangles that stand, or those that move, as a mesh of the same parts. */
static bool take(const sp_setup *setup, sp_motion motion, sp_movers *movers, sp_error *error)
{
    const sp_mesh *mesh = setup->mesh;
    size_t room = mesh->triangle_count + 1, count = 0;
    uint32_t(*triangles)[3] = malloc(room * sizeof *triangles), *part = malloc(room * sizeof *part);
    const char **names = malloc((mesh->part_count + 1) * sizeof *names);
    uint32_t *whole = movers->whole[motion] = malloc(room * sizeof *whole);
    bool done = (triangles && part && names && whole) || sp_fail_memory(error);
    for (size_t i = 0; done && i < mesh->part_count; i++)
        names[i] = mesh->parts[i].name;
    for (uint32_t t = 0; done && t < mesh->triangle_count; t++) {
        if (setup->surfaces[mesh->part[t]].moves != (motion == SP_MOVING))
            continue;
        for (int k = 0; k < 3; k++)
            triangles[count][k] = mesh->triangles[t][k];
        part[count] = mesh->part[t];
        movers->own[t] = (uint32_t)count;
        whole[count++] = t;
    }
    if (done)
        movers->mesh[motion] = sp_mesh_create(mesh->vertices, mesh->vertex_count, (const uint32_t(*)[3])triangles,
                                              count, part, names, mesh->part_count, error);
    free(triangles);
    free(part);
    free(names);
    if (movers->mesh[motion])
        movers->tracer[motion] = sp_tracer_create(movers->mesh[motion], SP_ACCELERATOR_BVH, setup->run.threads, error);
    return movers->tracer[motion] != NULL;
}

sp_movers *sp_movers_create(const sp_setup *setup, sp_error *error)
{
    sp_movers *movers = calloc(1, sizeof *movers);
    if (!movers)
        return sp_fail_memory(error);
    movers->own = malloc((setup->mesh->triangle_count + 1) * sizeof *movers->own);
    if ((movers->own || sp_fail_memory(error)) && take(setup, SP_STANDING, movers, error) &&
        take(setup, SP_MOVING, movers, error)) {
        assert(movers->mesh[SP_STANDING]->triangle_count + movers->mesh[SP_MOVING]->triangle_count ==
               setup->mesh->triangle_count); /* each is in one of them */
        return movers;
    }
    sp_movers_destroy(movers);
    return NULL;
}

void sp_movers_destroy(sp_movers *movers)
{
    if (!movers)
        return;
    for (int i = 0; i < 2; i++) {
        sp_tracer_destroy(movers->tracer[i]);
        sp_mesh_destroy(movers->mesh[i]);
        free(movers->whole[i]);
    }
    free(movers->own);
    free(movers);
}

size_t sp_pass_positions(const sp_setup *setup, double texel)
{
    double travel = sp_distance(setup->sweep.from, setup->sweep.to);
    return setup->sweep.speed > 0 ? (size_t)fmax(1, ceil(travel / texel * (1 - 1e-9))) : 1;
}

double sp_pass_step(const sp_evaluator *evaluator)
{
    const sp_sweep *sweep = &evaluator->setup.sweep;
    return sp_distance(sweep->from, sweep->to) / (double)evaluator->positions;
}

size_t sp_evaluator_positions(const sp_evaluator *evaluator)
{
    return evaluator->positions;
}

/* The ray as one of the two meshes meets it. */
static sp_ray ray_for(const sp_evaluator *evaluator, sp_motion motion, const sp_ray *ray, sp_vec3 offset)
{
    sp_ray own = *ray;
    if (motion == SP_MOVING)
        own.origin = sp_sub(own.origin, offset);
    if (own.skip != SP_NONE)
        own.skip = sp_motion_of(evaluator, own.skip) == motion ? evaluator->movers->own[own.skip] : SP_NONE;
    return own;
}

bool sp_movers_occlude(const sp_evaluator *evaluator, sp_motion motion, const sp_ray *ray, sp_vec3 acceleration,
                       sp_vec3 offset)
{
    sp_ray own = ray_for(evaluator, motion, ray, offset);
    return sp_trace_occluded(evaluator->movers->tracer[motion], &own, acceleration);
}

static sp_hit nearest(const sp_evaluator *evaluator, const sp_ray *ray, sp_vec3 acceleration, sp_vec3 offset)
{
    const sp_movers *movers = evaluator->movers;
    sp_hit hits[2];
    for (sp_motion motion = SP_STANDING; motion <= SP_MOVING; motion++) {
        sp_ray own = ray_for(evaluator, motion, ray, offset);
        hits[motion] = sp_trace_nearest(movers->tracer[motion], &own, acceleration);
        if (hits[motion].triangle != SP_NONE)
            hits[motion].triangle = movers->whole[motion][hits[motion].triangle];
    }
    const sp_hit *stands = &hits[SP_STANDING], *moves = &hits[SP_MOVING];
    bool first = stands->t < moves->t || (stands->t == moves->t && stands->triangle < moves->triangle);
    return first ? *stands : *moves;
}

/* The fraction of √2, by which jets step on over the pass: like the one by which their directions do (see
 * sp_spray_direction) it is badly approximated by fractions, and not made of that one either. */
#define PASS_STEP UINT64_C(0x6a09e667f3bcc909)

sp_vec3 sp_jet_offset(const sp_evaluator *evaluator, uint64_t index)
{
    if (!evaluator->movers)
        return sp_v(0, 0, 0);
    uint64_t start = sp_scramble(sp_scramble(sp_scramble(evaluator->fidelity.seed)));
    return sp_pass_offset(evaluator, sp_fraction(index * PASS_STEP + start));
}

void sp_jets_hit(const sp_evaluator *evaluator, const sp_ray *rays, sp_vec3 acceleration, const sp_vec3 *offset,
                 size_t count, int threads, sp_hit *hits)
{
    if (!evaluator->movers) {
        sp_trace_nearest_many(evaluator->tracer, rays, count, acceleration, threads, hits);
        return;
    }
#pragma omp parallel for num_threads(sp_thread_count(threads)) schedule(dynamic, 1024)
    for (size_t i = 0; i < count; i++)
        hits[i] = nearest(evaluator, &rays[i], acceleration, offset[i]);
}

/* Where a drop comes to, of what stands and of what moves. */
static sp_landing land(const sp_evaluator *evaluator, const sp_drag *drag, const sp_ray *ray, sp_vec3 acceleration,
                       sp_vec3 offset, const sp_vec3 box[2][2])
{
    const sp_movers *movers = evaluator->movers;
    sp_obstacle obstacles[2];
    for (sp_motion motion = SP_STANDING; motion <= SP_MOVING; motion++)
        obstacles[motion] = (sp_obstacle){.tracer = movers->tracer[motion],
                                          .offset = motion == SP_MOVING ? offset : sp_v(0, 0, 0),
                                          .box = box[motion],
                                          .skip = ray_for(evaluator, motion, ray, offset).skip};
    sp_landing landing = sp_drag_trace(obstacles, 2, drag, ray, acceleration);
    if (landing.hit.triangle != SP_NONE)
        landing.hit.triangle = movers->whole[landing.obstacle][landing.hit.triangle];
    return landing;
}

void sp_drops_land(const sp_evaluator *evaluator, const sp_drag *drag, const sp_ray *rays, sp_vec3 acceleration,
                   const sp_vec3 *offset, size_t count, int threads, sp_landing *landings)
{
    if (!evaluator->movers) {
        sp_drag_trace_many(evaluator->tracer, drag, rays, count, acceleration, threads, landings);
        return;
    }
    sp_vec3 box[2][2];
    for (int i = 0; i < 2; i++)
        sp_mesh_box(evaluator->movers->mesh[i], &box[i][0], &box[i][1]);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 256)
    for (size_t i = 0; i < count; i++)
        landings[i] = land(evaluator, drag, &rays[i], acceleration, offset[i], (const sp_vec3(*)[2])box);
}
