/* Building an evaluator, choosing what is left to auto, and asking it. */
#include "auto_settings.h"
#include "clock.h"
#include "falling_film.h"
#include "movers.h"
#include "nozzle/valid.h"
#include "resolution.h"
#include "spray/wet/wet.h"

#include <stdio.h>
#include <stdlib.h>

bool sp_evaluator_progress(const sp_setup *setup, const char *stage, double done, sp_error *error)
{
    if (!setup->run.progress || setup->run.progress(setup->run.user, stage, done))
        return true;
    return sp_fail(error, SP_ERROR_INTERRUPTED, NULL, 0, 0, "interrupted");
}

bool sp_evaluator_stage(const sp_evaluator *evaluator, const char *stage, double done, sp_error *error)
{
    return sp_evaluator_progress(&evaluator->setup, evaluator->stage ? evaluator->stage : stage, done, error);
}

bool sp_fail_nothing(sp_error *error)
{
    return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "nothing is to be cleaned: no part with role clean faces the cavity");
}

/* With a layout that has nozzles, sizes and flights that are left open are chosen for it. */
static bool build(sp_evaluator *evaluator, const sp_layout *layout, sp_error *error)
{
    const sp_setup *setup = &evaluator->setup;
    if (!sp_evaluator_progress(setup, "accelerator", 0, error))
        return false;
    evaluator->tracer = sp_tracer_create(setup->mesh, SP_ACCELERATOR_BVH, setup->run.threads, error);
    if (!evaluator->tracer)
        return false;
    if (setup->sweep.speed > 0 && !(evaluator->movers = sp_movers_create(setup, error)))
        return false;
    if (!sp_evaluator_progress(setup, "wet sides", 0, error))
        return false;
    evaluator->wet = sp_wet_create(setup, evaluator->tracer, error);
    if (!evaluator->wet || !sp_evaluator_progress(setup, "atlas", 0, error))
        return false;
    double plain = sp_texel_of(evaluator, SP_PLAIN_TEXELS);
    if (!(plain > 0))
        return sp_fail_nothing(error);
    if (!(evaluator->fidelity.texel > 0))
        evaluator->fidelity.texel = plain;
    return (layout && layout->count ? sp_auto_settings(evaluator, layout, error)
                                    : sp_texels_create(evaluator, NULL, error)) &&
           sp_evaluator_progress(setup, "atlas", 1, error);
}

sp_vec3 sp_gravity_for(const sp_setup *setup, sp_trajectory trajectory)
{
    return trajectory == SP_TRAJECTORY_LINE ? sp_v(0, 0, 0) : sp_scale(sp_unit(setup->up), -setup->gravity);
}

sp_trajectory sp_trajectory_of(const sp_evaluator *evaluator, sp_trajectory own)
{
    return own == SP_TRAJECTORY_AUTO ? evaluator->fidelity.trajectory : own;
}

sp_vec3 sp_acceleration_at(const sp_evaluator *evaluator, sp_trajectory own)
{
    return own == SP_TRAJECTORY_AUTO ? evaluator->gravity : sp_gravity_for(&evaluator->setup, own);
}

sp_evaluator *sp_evaluator_create_for(const sp_setup *setup, const sp_layout *layout, sp_error *error)
{
    if (!setup || !sp_setup_is_valid(setup, error) || (layout && !sp_layout_is_valid(layout, error)))
        return NULL;
    sp_evaluator *evaluator = calloc(1, sizeof *evaluator);
    if (!evaluator)
        return sp_fail_memory(error);
    evaluator->setup = *setup;
    evaluator->began = sp_now();
    if (!sp_auto_method(setup, &evaluator->fidelity, error)) {
        sp_evaluator_destroy(evaluator);
        return NULL;
    }
    evaluator->gravity = sp_gravity_for(setup, evaluator->fidelity.trajectory);
    sp_mesh_box(setup->mesh, &evaluator->low, &evaluator->high);
    evaluator->farthest = sp_farthest_coordinate(evaluator->low, evaluator->high) + sp_sweep_reach(&setup->sweep);
    if (!build(evaluator, layout, error) || !sp_falling_film_create(evaluator, error)) {
        sp_evaluator_destroy(evaluator);
        return NULL;
    }
    return evaluator;
}

sp_evaluator *sp_evaluator_create(const sp_setup *setup, sp_error *error)
{
    return sp_evaluator_create_for(setup, NULL, error);
}

sp_evaluator *sp_evaluator_share(const sp_evaluator *fine, double texel, sp_error *error)
{
    const sp_evaluator *origin = fine->origin ? fine->origin : fine;
    sp_evaluator *evaluator = calloc(1, sizeof *evaluator);
    if (!evaluator)
        return sp_fail_memory(error);
    evaluator->setup = fine->setup;
    evaluator->fidelity = fine->fidelity;
    evaluator->fidelity.texel = texel;
    evaluator->choice = fine->choice;
    evaluator->gravity = fine->gravity;
    evaluator->low = fine->low;
    evaluator->high = fine->high;
    evaluator->farthest = fine->farthest;
    evaluator->origin = origin;
    evaluator->tracer = origin->tracer;
    evaluator->charts = origin->charts;
    evaluator->wet = origin->wet;
    evaluator->movers = origin->movers;
    return evaluator;
}

sp_evaluator *sp_evaluator_resample(const sp_evaluator *fine, double texel, sp_error *error)
{
    if (!fine)
        return NULL;
    if (!(texel >= 1e-300 && texel <= 1e300)) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "evaluator: a texel of %g m found, expected more than 0", texel);
        return NULL;
    }
    sp_evaluator *evaluator = sp_evaluator_share(fine, texel, error);
    if (!evaluator)
        return NULL;
    evaluator->everything = fine->setup.criterion.film > 0;
    evaluator->fidelity.method = SP_METHOD_INVERSE;
    evaluator->fidelity.reflections = 0;
    evaluator->fidelity.splat = SP_SPLAT_NEAREST;
    if (sp_texels_create(evaluator, fine, error) && sp_falling_film_create(evaluator, error))
        return evaluator;
    sp_evaluator_destroy(evaluator);
    return NULL;
}

bool sp_evaluator_again(const sp_evaluator *evaluator, bool shorter, sp_evaluator **again, sp_error *error)
{
    *again = NULL;
    if (!evaluator)
        return false;
    const sp_fidelity *open = &evaluator->setup.fidelity, *now = &evaluator->fidelity;
    bool lines = open->trajectory == SP_TRAJECTORY_AUTO && now->trajectory == SP_TRAJECTORY_LINE;
    double texel = now->texel;
    if (shorter && !(open->texel > 0))
        texel = fmin(texel, fmax(0.5 * texel, sp_shortest_auto_texel(evaluator)));
    if (!lines && texel == now->texel)
        return true;
    sp_evaluator *finer = sp_evaluator_share(evaluator, texel, error);
    if (!finer)
        return false;
    finer->fidelity.trajectory = lines ? SP_TRAJECTORY_PARABOLA : now->trajectory;
    finer->gravity = sp_gravity_for(&finer->setup, finer->fidelity.trajectory);
    if (lines)
        snprintf(finer->choice.trajectory, SP_WHY, "parabolas: what was found by lines, counted again");
    if (texel < now->texel)
        snprintf(finer->choice.texel, SP_WHY, "counted again: on texels of %.3g m the accuracy was not kept",
                 now->texel);
    if (!sp_texels_create(finer, NULL, error) || !sp_falling_film_create(finer, error)) {
        sp_evaluator_destroy(finer);
        return false;
    }
    *again = finer;
    return true;
}

bool sp_evaluator_counts_thrown_back(const sp_evaluator *evaluator)
{
    return evaluator && evaluator->fidelity.reflections > 0 && sp_setup_throws_back(&evaluator->setup);
}

void sp_evaluator_destroy(sp_evaluator *evaluator)
{
    if (!evaluator)
        return;
    if (!evaluator->origin) {
        sp_tracer_destroy(evaluator->tracer);
        sp_charts_destroy(evaluator->charts);
        sp_wet_destroy(evaluator->wet);
        sp_movers_destroy(evaluator->movers);
    }
    sp_texels_free(evaluator);
    sp_falling_film_destroy(evaluator);
    free(evaluator);
}

const sp_setup *sp_evaluator_setup(const sp_evaluator *evaluator)
{
    return &evaluator->setup;
}

const sp_fidelity *sp_evaluator_fidelity(const sp_evaluator *evaluator)
{
    return &evaluator->fidelity;
}

const sp_choice *sp_evaluator_choice(const sp_evaluator *evaluator)
{
    return &evaluator->choice;
}

const sp_atlas *sp_evaluator_atlas(const sp_evaluator *evaluator)
{
    return evaluator->atlas;
}

const sp_patches *sp_evaluator_patches(const sp_evaluator *evaluator)
{
    return &evaluator->patches;
}

const sp_tracer *sp_evaluator_tracer(const sp_evaluator *evaluator)
{
    return evaluator->tracer;
}

unsigned sp_evaluator_wet(const sp_evaluator *evaluator, uint32_t triangle)
{
    return evaluator->wet->sides[triangle];
}

unsigned sp_evaluator_wet_at(const sp_evaluator *evaluator, uint32_t triangle, double u, double v)
{
    return sp_wet_at(evaluator->wet, triangle, u, v);
}

const sp_hollow *sp_evaluator_hollows(const sp_evaluator *evaluator, size_t *count)
{
    *count = evaluator->falling_film ? evaluator->falling_film->hollow_count : 0;
    return evaluator->falling_film ? evaluator->falling_film->hollows : NULL;
}

const sp_flaw *sp_evaluator_cracks(const sp_evaluator *evaluator, double *width)
{
    const sp_falling_film *falling_film = evaluator->falling_film;
    *width = falling_film ? falling_film->flaws.crack : 0;
    return falling_film ? &falling_film->flaws.cracks : NULL;
}

sp_vec3 sp_evaluator_gravity(const sp_evaluator *evaluator, const sp_launch *launch)
{
    return sp_acceleration_at(evaluator, launch ? launch->trajectory : SP_TRAJECTORY_AUTO);
}

sp_coverage *sp_evaluate(const sp_evaluator *evaluator, const sp_layout *layout, sp_error *error)
{
    if (!evaluator || !layout)
        return NULL;
    return evaluator->fidelity.method == SP_METHOD_FORWARD ? sp_evaluate_jets(evaluator, layout, NULL, error)
                                                           : sp_evaluate_inverse(evaluator, layout, error);
}
