#include "restore.h"

#include "atlas/texels/texels.h"

#include <stdlib.h>

static bool is_simple(const sp_setup *setup, const sp_fidelity *fidelity)
{
    bool flies = fidelity->trajectory == SP_TRAJECTORY_LINE || fidelity->trajectory == SP_TRAJECTORY_PARABOLA;
    return flies && fidelity->method == SP_METHOD_INVERSE && fidelity->texel > 0 && !(setup->criterion.film > 0) &&
           !(setup->sweep.speed > 0);
}

bool sp_evaluator_is_simple(const sp_evaluator *evaluator)
{
    return is_simple(&evaluator->setup, &evaluator->fidelity);
}

bool sp_evaluator_wet_arrays(const sp_evaluator *evaluator, sp_wet_arrays *arrays, sp_error *error)
{
    return sp_wet_arrays_create(evaluator->wet, evaluator->setup.mesh->triangle_count, arrays, error);
}

static bool make_patches(sp_evaluator *evaluator, sp_error *error)
{
    const sp_setup *setup = &evaluator->setup;
    evaluator->tracer = sp_tracer_create(setup->mesh, SP_ACCELERATOR_BVH, setup->run.threads, error);
    return evaluator->tracer && sp_atlas_cut(evaluator->atlas, setup->mesh, error) &&
           sp_fragments_create(&evaluator->fragments, evaluator->atlas, setup->mesh, error) &&
           sp_patches_create(evaluator, error) && (evaluator->patches.total_area > 0 || sp_fail_nothing(error));
}

sp_evaluator *sp_evaluator_restore(const sp_setup *setup, sp_atlas *atlas, sp_wet *wet, sp_error *error)
{
    sp_evaluator *evaluator = calloc(1, sizeof *evaluator);
    if (!evaluator) {
        sp_atlas_destroy(atlas);
        sp_wet_destroy(wet);
        return sp_fail_memory(error);
    }
    evaluator->setup = *setup;
    evaluator->fidelity = setup->fidelity;
    evaluator->gravity = sp_gravity_for(setup, setup->fidelity.trajectory);
    evaluator->atlas = atlas;
    evaluator->wet = wet;
    evaluator->positions = 1;
    sp_mesh_box(setup->mesh, &evaluator->low, &evaluator->high);
    evaluator->farthest = sp_farthest_coordinate(evaluator->low, evaluator->high);
    if (!is_simple(setup, &setup->fidelity))
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                "evaluator: restored for something but lines or parabolas, inverse, without film and sweep");
    else if (sp_geometry_is_resolved(setup, error) && make_patches(evaluator, error))
        return evaluator;
    sp_evaluator_destroy(evaluator);
    return NULL;
}
