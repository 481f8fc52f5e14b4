#include "bodies.h"

#include <stdlib.h>

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

bool sp_bodies_create_with(const sp_evaluator *evaluator, const sp_layout *layout, uint64_t jets, sp_bodies *bodies,
                           sp_error *error)
{
    *bodies = (sp_bodies){.layout = layout};
    return are_whole(layout, error) && sp_evaluator_takes(evaluator, layout, error) &&
           take_apart(evaluator, jets, bodies, error);
}

bool sp_bodies_create(const sp_evaluator *evaluator, const sp_layout *layout, sp_bodies *bodies, sp_error *error)
{
    return sp_bodies_create_with(evaluator, layout, 0, bodies, error);
}

void sp_bodies_free(sp_bodies *bodies)
{
    sp_layout_destroy(bodies->patterns);
    free(bodies->first);
    *bodies = (sp_bodies){0};
}
