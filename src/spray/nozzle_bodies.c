#include "nozzle_bodies.h"

#include "launch.h"
#include "nozzle/valid.h"

#include <stdlib.h>

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

static bool drops_are_sound(const sp_evaluator *evaluator, const sp_layout *patterns, sp_error *error)
{
    for (size_t i = 0; i < patterns->count; i++)
        if (sp_flies_as_drops(evaluator, &patterns->nozzles[i]) &&
            !sp_are_drops(&evaluator->setup, &patterns->nozzles[i], error))
            return false;
    return true;
}

bool sp_bodies_create_with(const sp_evaluator *evaluator, const sp_layout *layout, uint64_t jets, sp_bodies *bodies,
                           sp_error *error)
{
    *bodies = (sp_bodies){.layout = layout};
    return sp_layout_is_valid(layout, error) && sp_evaluator_takes(evaluator, layout, error) &&
           take_apart(evaluator, jets, bodies, error) && drops_are_sound(evaluator, bodies->patterns, error);
}

bool sp_bodies_create(const sp_evaluator *evaluator, const sp_layout *layout, sp_bodies *bodies, sp_error *error)
{
    return sp_bodies_create_with(evaluator, layout, 0, bodies, error);
}

bool sp_bodies_hold_drops(const sp_evaluator *evaluator, const sp_bodies *bodies)
{
    for (size_t i = 0; i < bodies->patterns->count; i++)
        if (sp_flies_as_drops(evaluator, &bodies->patterns->nozzles[i]))
            return true;
    return false;
}

/* m, as far as anything of the geometry is from a point, or comes on its pass. */
static double farthest_from(const sp_evaluator *evaluator, sp_vec3 point)
{
    sp_vec3 low = evaluator->low, high = evaluator->high;
    return sp_length(sp_v(fmax(high.x - point.x, point.x - low.x), fmax(high.y - point.y, point.y - low.y),
                          fmax(high.z - point.z, point.z - low.z))) +
           sp_sweep_reach(&evaluator->setup.sweep);
}

bool sp_bodies_fly(const sp_evaluator *evaluator, sp_bodies *bodies, sp_error *error)
{
    const sp_layout *patterns = bodies->patterns;
    double far = 0;
    if (!sp_bodies_hold_drops(evaluator, bodies))
        return true;
    for (size_t i = 0; i < patterns->count; i++)
        far = fmax(far, farthest_from(evaluator, patterns->nozzles[i].position));
    bodies->table = sp_launch_table_create(evaluator, far, error);
    bodies->launches = calloc(patterns->count + 1, sizeof *bodies->launches);
    if (!bodies->table || !bodies->launches)
        return sp_fail_memory(error);
    for (size_t i = 0; i < patterns->count; i++)
        if (!sp_launch_table_add(bodies->table, &patterns->nozzles[i], error) ||
            !sp_launch_table_find(bodies->table, &patterns->nozzles[i], &bodies->launches[i], error))
            return false;
    return true;
}

sp_emitter sp_bodies_emitter(const sp_evaluator *evaluator, const sp_bodies *bodies, size_t i)
{
    return sp_emitter_of(evaluator, &bodies->patterns->nozzles[i],
                         bodies->launches ? bodies->launches[i].fronts : NULL);
}

void sp_bodies_free(sp_bodies *bodies)
{
    free(bodies->launches);
    sp_launch_table_destroy(bodies->table);
    sp_layout_destroy(bodies->patterns);
    free(bodies->first);
    *bodies = (sp_bodies){0};
}
