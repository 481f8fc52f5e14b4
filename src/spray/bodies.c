#include "bodies.h"

#include "spray/drag/fronts.h"

#include <stdlib.h>

#define DROP_LEAST 1e-9 /* m */

static bool are_whole(const sp_layout *layout, sp_error *error)
{
    for (size_t i = 0; i < layout->count; i++)
        if (!sp_type_is_whole(layout->nozzles[i].type, error))
            return false;
    return true;
}

/* `jets` for each nozzle, 0: its own number, or the simulation's. */
static bool take_apart(const sp_evaluator *evaluator, uint64_t jets, sp_bodies *bodies, sp_error *error)
{
    const sp_setup *setup = &evaluator->setup;
    const sp_layout *layout = bodies->layout;
    size_t *first = bodies->first = malloc((layout->count + 1) * sizeof *first);
    if (!first)
        return sp_fail_memory(error);
    first[0] = 0;
    for (size_t b = 0; b < layout->count; b++)
        first[b + 1] = first[b] + sp_nozzle_pattern_count(&layout->nozzles[b]);
    bodies->patterns = sp_layout_create(NULL, first[layout->count], error);
    for (size_t b = 0; bodies->patterns && b < layout->count; b++) {
        sp_nozzle nozzle = layout->nozzles[b];
        nozzle.jets = jets ? jets : nozzle.jets ? nozzle.jets : evaluator->fidelity.jets;
        sp_nozzle_patterns(&nozzle, &setup->liquid, setup->up, &bodies->patterns->nozzles[first[b]]);
    }
    return bodies->patterns != NULL;
}

/* Drops so small that air stops them at once are none; nor is anything said of them. */
static bool are_drops(const sp_layout *patterns, sp_error *error)
{
    for (size_t i = 0; i < patterns->count; i++)
        if (!(patterns->nozzles[i].type->drop >= DROP_LEAST))
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                           "trajectory: drag found with drops of %g m from nozzle %s; expected at least %g m",
                           patterns->nozzles[i].type->drop, patterns->nozzles[i].name, DROP_LEAST);
    return true;
}

bool sp_bodies_create_with(const sp_evaluator *evaluator, const sp_layout *layout, uint64_t jets, sp_bodies *bodies,
                           sp_error *error)
{
    *bodies = (sp_bodies){.layout = layout};
    return are_whole(layout, error) && sp_evaluator_takes(evaluator, layout, error) &&
           take_apart(evaluator, jets, bodies, error) &&
           (evaluator->fidelity.trajectory != SP_TRAJECTORY_DRAG || are_drops(bodies->patterns, error));
}

bool sp_bodies_create(const sp_evaluator *evaluator, const sp_layout *layout, sp_bodies *bodies, sp_error *error)
{
    return sp_bodies_create_with(evaluator, layout, 0, bodies, error);
}

/* m, as far as anything of the geometry is from a point. */
static double farthest_from(const sp_mesh *mesh, sp_vec3 point)
{
    sp_vec3 low, high;
    sp_mesh_box(mesh, &low, &high);
    return sp_length(sp_v(fmax(high.x - point.x, point.x - low.x), fmax(high.y - point.y, point.y - low.y),
                          fmax(high.z - point.z, point.z - low.z)));
}

static bool is_like(const sp_drag *a, double speed, const sp_drag *b, double other)
{
    return speed == other && a->stokes == b->stokes && a->form == b->form && a->delay == b->delay;
}

bool sp_bodies_fly(const sp_evaluator *evaluator, sp_bodies *bodies, sp_error *error)
{
    if (evaluator->fidelity.trajectory != SP_TRAJECTORY_DRAG)
        return true;
    const sp_setup *setup = &evaluator->setup;
    const sp_layout *patterns = bodies->patterns;
    double far = 0;
    bodies->fronts = calloc(patterns->count + 1, sizeof *bodies->fronts);
    if (!bodies->fronts)
        return sp_fail_memory(error);
    for (size_t i = 0; i < patterns->count; i++)
        far = fmax(far, farthest_from(setup->mesh, patterns->nozzles[i].position));
    for (size_t i = 0; i < patterns->count; i++) {
        const sp_nozzle *pattern = &patterns->nozzles[i];
        double speed = sp_nozzle_speed(pattern, &setup->liquid);
        sp_drag drag = sp_drag_of(pattern, &setup->liquid, &setup->air);
        for (size_t k = 0; k < i && !bodies->fronts[i]; k++)
            if (bodies->fronts[k] && is_like(&drag, speed, &bodies->fronts[k]->drag, bodies->fronts[k]->speed))
                bodies->fronts[i] = bodies->fronts[k];
        if (speed > 0 && !bodies->fronts[i])
            bodies->fronts[i] = sp_fronts_create(&drag, speed, evaluator->gravity, far, error);
        if (speed > 0 && !bodies->fronts[i])
            return false;
    }
    return true;
}

sp_emitter sp_bodies_emitter(const sp_evaluator *evaluator, const sp_bodies *bodies, size_t i)
{
    return sp_emitter_of(evaluator, &bodies->patterns->nozzles[i], bodies->fronts ? bodies->fronts[i] : NULL);
}

void sp_bodies_free(sp_bodies *bodies)
{
    for (size_t i = 0; bodies->fronts && i < bodies->patterns->count; i++) {
        sp_fronts *own = bodies->fronts[i];
        for (size_t k = i; k < bodies->patterns->count; k++)
            bodies->fronts[k] = bodies->fronts[k] == own ? NULL : bodies->fronts[k];
        sp_fronts_destroy(own);
    }
    free(bodies->fronts);
    sp_layout_destroy(bodies->patterns);
    free(bodies->first);
    *bodies = (sp_bodies){0};
}
