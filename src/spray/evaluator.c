/* Building an evaluator, choosing what is left to auto, and asking it. */
#include "density.h"
#include "spray/wet/wet.h"

#include <stdlib.h>

#define AUTO_TEXELS 100000 /* on what is cleaned and counted */
#define AUTO_REFLECTIONS 3
/* Jets per nozzle and texel of all that is to be cleaned: with a flux criterion what a texel at the threshold then
 * receives from a nozzle that would flood it all at the threshold; without one a texel must merely not be missed. The
 * bound, for the time that tracing takes, binds where the texel is left to auto too. */
#define AUTO_MOST_JETS 4e6
#define AUTO_JETS_AT_THRESHOLD 150
#define AUTO_JETS_TO_TOUCH 20
#define SPARE 0.1      /* of the accuracy asked for, that may be lost on thin parts which the jets do not follow */
#define PAGE_EDGE 4096 /* texels */
#define MOST_PAGE_EDGE 16384 /* texels, for a triangle longer than PAGE_EDGE */
#define PAGE_MARGIN 4        /* texels that a page needs beyond its chart */
#define MOST_TEXELS 1e9

bool sp_evaluator_progress(const sp_setup *setup, const char *stage, double done, sp_error *error)
{
    if (!setup->run.progress || setup->run.progress(setup->run.user, stage, done))
        return true;
    return sp_fail(error, SP_ERROR_INTERRUPTED, NULL, 0, 0, "interrupted");
}

static bool in_range(double value, double low, double high)
{
    return value >= low && value <= high;
}

static bool check_surfaces(const sp_setup *setup, sp_error *error)
{
    bool clean = false;
    for (size_t i = 0; i < setup->mesh->part_count; i++) {
        const sp_surface *surface = &setup->surfaces[i];
        if (!in_range(surface->restitution, 0, 1) || !in_range(surface->rebound, 0, 1))
            return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                           "part \"%s\": restitution %g and rebound %g found, expected 0 to 1",
                           setup->mesh->parts[i].name, surface->restitution, surface->rebound);
        clean = clean || surface->clean;
    }
    return clean || sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "nothing is to be cleaned: every part is an obstacle");
}

static bool check_caps(const sp_setup *setup, sp_error *error)
{
    for (size_t i = 0; i < setup->cap_count; i++) {
        const sp_cap *cap = &setup->caps[i];
        if (!isfinite(sp_length(cap->point)) || !in_range(sp_length(cap->normal), 1e-300, 1e300) ||
            !in_range(cap->radius, 1e-300, 1e300))
            return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                           "cap %zu: expected a finite point, a normal of some length and a radius above 0", i + 1);
    }
    return true;
}

static bool check_setup(const sp_setup *setup, sp_error *error)
{
    const sp_criterion *criterion = &setup->criterion;
    const sp_fidelity *fidelity = &setup->fidelity;
    const char *wrong = NULL;
    if (!setup->mesh || !setup->surfaces || setup->mesh->triangle_count == 0)
        wrong = "a mesh with triangles and a surface for each of its parts";
    else if (!in_range(setup->liquid.density, 1e-300, 1e300))
        wrong = "a positive density of the liquid";
    else if (!in_range(setup->gravity, 0, 1e300))
        wrong = "a gravity of 0 or more";
    else if (!in_range(criterion->flux, 0, 1e300) || !in_range(criterion->impact_speed, 0, 1e300) ||
             !in_range(criterion->incidence, 0, M_PI / 2))
        wrong = "a criterion with flux and impact speed of 0 or more and incidence of 0 to 90 deg";
    else if (!in_range(fidelity->texel, 0, 1e300) || fidelity->reflections < -1)
        wrong = "a texel of 0 (auto) or more and reflections of -1 (auto) or more";
    else if (setup->cavity == SP_CAVITY_POINT && !isfinite(sp_length(setup->cavity_point)))
        wrong = "a finite point of the cavity";
    if (wrong)
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "evaluator: expected %s", wrong);
    return check_caps(setup, error) && check_surfaces(setup, error) && sp_geometry_is_resolved(setup, error);
}

static bool anything_reflects(const sp_setup *setup)
{
    for (size_t i = 0; i < setup->mesh->part_count; i++)
        if (setup->surfaces[i].restitution > 0)
            return true;
    return false;
}

static bool resolve_method(const sp_setup *setup, sp_fidelity *fidelity, sp_error *error)
{
    bool reflects = fidelity->reflections != 0 && anything_reflects(setup);
    if (fidelity->method == SP_METHOD_INVERSE && fidelity->reflections > 0)
        return sp_fail(
            error, SP_ERROR_INPUT, NULL, 0, 0,
            "reflections: %d found with evaluator inverse, which knows primary impact only; expected 0 or auto, "
            "or evaluator forward",
            fidelity->reflections);
    if (fidelity->method == SP_METHOD_INVERSE && fidelity->splat == SP_SPLAT_LINEAR)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "splat: linear found with evaluator inverse, which has no jets to share; expected nearest, or "
                       "evaluator forward");
    if (fidelity->method == SP_METHOD_AUTO)
        fidelity->method = reflects || fidelity->splat == SP_SPLAT_LINEAR ? SP_METHOD_FORWARD : SP_METHOD_INVERSE;
    if (fidelity->method == SP_METHOD_INVERSE)
        fidelity->reflections = 0;
    else if (fidelity->reflections < 0)
        fidelity->reflections = reflects ? AUTO_REFLECTIONS : 0;
    return true;
}

/* The plain safe choice for what the setup leaves to auto, but for sizes, which wait for the wet sides. */
static bool resolve(const sp_setup *setup, sp_fidelity *fidelity, sp_error *error)
{
    *fidelity = setup->fidelity;
    if (fidelity->trajectory == SP_TRAJECTORY_AUTO)
        fidelity->trajectory = SP_TRAJECTORY_PARABOLA;
    return resolve_method(setup, fidelity, error);
}

static bool fail_nothing(sp_error *error)
{
    return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "nothing is to be cleaned: no part with role clean faces the cavity");
}

/* What is cleaned and counted, m²; what else there is, however large, does not make texels longer. */
static double counted_area(const sp_evaluator *evaluator)
{
    double area = 0;
    for (uint32_t t = 0; t < evaluator->setup.mesh->triangle_count; t++)
        area += sp_counted_area(evaluator, t);
    return area;
}

static double jets_per_texel(const sp_evaluator *evaluator)
{
    return evaluator->setup.criterion.flux > 0 ? AUTO_JETS_AT_THRESHOLD : AUTO_JETS_TO_TOUCH;
}

static double jets_for(const sp_evaluator *evaluator, double texel)
{
    return ceil(jets_per_texel(evaluator) * counted_area(evaluator) / (texel * texel));
}

/* Shorter texels than the jets can meet each would look dry, and few thin parts are not worth more jets for all. */
static sp_density_limits density_limits(const sp_evaluator *evaluator)
{
    const sp_fidelity *fidelity = &evaluator->fidelity;
    sp_density_limits limits = {.texel = fidelity->texel, .page = PAGE_EDGE - PAGE_MARGIN};
    if (fidelity->method == SP_METHOD_INVERSE)
        return limits;
    double jets = fidelity->jets > 0 ? (double)fidelity->jets : AUTO_MOST_JETS;
    limits.least = sqrt(counted_area(evaluator) * jets_per_texel(evaluator) / jets);
    limits.spare = SPARE * fidelity->accuracy;
    return limits;
}

static bool check_number(double texel, double texels, sp_error *error)
{
    return texels <= MOST_TEXELS ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "texel: %g m found, too small for a surface of %g m2; expected at least %.3g m", texel,
                   texels * texel * texel, texel * sqrt(texels / MOST_TEXELS));
}

/* The atlas on pages of the usual size, or larger ones where a single triangle must have them. */
static bool build_atlas(sp_evaluator *evaluator, const sp_charts *charts, const sp_density *density, sp_error *error)
{
    double texel = evaluator->fidelity.texel;
    double page = fmin(fmax(ceil(density->longest) + PAGE_MARGIN, PAGE_EDGE), MOST_PAGE_EDGE);
    sp_atlas_options options = {.texel = texel, .page_edge = (uint32_t)page, .chart_texel = density->texel};
    if (sp_texel_is_resolved(evaluator, texel, error) && check_number(texel, density->texels, error))
        evaluator->atlas = sp_atlas_create(evaluator->setup.mesh, charts, &options, error);
    return evaluator->atlas &&
           sp_fragments_create(&evaluator->fragments, evaluator->atlas, evaluator->setup.mesh, error) &&
           sp_patches_create(evaluator, error) && (evaluator->patches.total_area > 0 || fail_nothing(error));
}

/* Texels of the evaluator's own lengths, or in proportion to those of `fine`. */
static bool build_texels(sp_evaluator *evaluator, const sp_charts *charts, const sp_evaluator *fine, sp_error *error)
{
    sp_density density;
    sp_fidelity *fidelity = &evaluator->fidelity;
    sp_density_limits limits = density_limits(evaluator);
    if (!(fine ? sp_density_like(evaluator, charts, fine, &density, error)
               : sp_density_create(evaluator, charts, &limits, &density, error)))
        return false;
    if (fidelity->jets == 0)
        fidelity->jets =
            (uint64_t)fmin(AUTO_MOST_JETS, jets_for(evaluator, fidelity->method == SP_METHOD_INVERSE ? fidelity->texel
                                                                                                     : density.finest));
    bool done = build_atlas(evaluator, charts, &density, error);
    sp_density_free(&density);
    return done;
}

static bool build(sp_evaluator *evaluator, sp_error *error)
{
    const sp_setup *setup = &evaluator->setup;
    if (!sp_evaluator_progress(setup, "accelerator", 0, error))
        return false;
    evaluator->tracer = sp_tracer_create(setup->mesh, SP_ACCELERATOR_BVH, setup->run.threads, error);
    if (!evaluator->tracer || !sp_evaluator_progress(setup, "wet sides", 0, error))
        return false;
    evaluator->wet = sp_wet_create(setup, evaluator->tracer, error);
    if (!evaluator->wet || !sp_evaluator_progress(setup, "atlas", 0, error))
        return false;
    double counted = counted_area(evaluator);
    if (!(counted > 0))
        return fail_nothing(error);
    if (!(evaluator->fidelity.texel > 0))
        evaluator->fidelity.texel = sqrt(counted / AUTO_TEXELS);
    double extent = (PAGE_EDGE - PAGE_MARGIN) * evaluator->fidelity.texel;
    evaluator->charts = sp_charts_create(setup->mesh, extent, error);
    return evaluator->charts && build_texels(evaluator, evaluator->charts, NULL, error) &&
           sp_evaluator_progress(setup, "atlas", 1, error);
}

sp_vec3 sp_gravity_for(const sp_setup *setup, sp_trajectory trajectory)
{
    return trajectory == SP_TRAJECTORY_LINE ? sp_v(0, 0, 0) : sp_scale(sp_unit(setup->up), -setup->gravity);
}

sp_evaluator *sp_evaluator_create(const sp_setup *setup, sp_error *error)
{
    if (!setup || !check_setup(setup, error))
        return NULL;
    sp_evaluator *evaluator = calloc(1, sizeof *evaluator);
    if (!evaluator)
        return sp_fail_memory(error);
    evaluator->setup = *setup;
    if (!resolve(setup, &evaluator->fidelity, error)) {
        sp_evaluator_destroy(evaluator);
        return NULL;
    }
    evaluator->gravity = sp_gravity_for(setup, evaluator->fidelity.trajectory);
    evaluator->farthest = sp_farthest_coordinate(setup->mesh);
    if (!build(evaluator, error)) {
        sp_evaluator_destroy(evaluator);
        return NULL;
    }
    return evaluator;
}

sp_evaluator *sp_evaluator_resample(const sp_evaluator *fine, double texel, sp_error *error)
{
    if (!fine)
        return NULL;
    if (!in_range(texel, 1e-300, 1e300)) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "evaluator: a texel of %g m found, expected more than 0", texel);
        return NULL;
    }
    const sp_evaluator *origin = fine->origin ? fine->origin : fine;
    sp_evaluator *evaluator = calloc(1, sizeof *evaluator);
    if (!evaluator)
        return sp_fail_memory(error);
    evaluator->setup = fine->setup;
    evaluator->fidelity = fine->fidelity;
    evaluator->fidelity.method = SP_METHOD_INVERSE;
    evaluator->fidelity.reflections = 0;
    evaluator->fidelity.splat = SP_SPLAT_NEAREST;
    evaluator->fidelity.texel = texel;
    evaluator->gravity = fine->gravity;
    evaluator->farthest = fine->farthest;
    evaluator->origin = origin;
    evaluator->tracer = origin->tracer;
    evaluator->charts = origin->charts;
    evaluator->wet = origin->wet;
    if (!build_texels(evaluator, origin->charts, fine, error)) {
        sp_evaluator_destroy(evaluator);
        return NULL;
    }
    return evaluator;
}

void sp_evaluator_destroy(sp_evaluator *evaluator)
{
    if (!evaluator)
        return;
    if (!evaluator->origin) {
        sp_tracer_destroy(evaluator->tracer);
        sp_charts_destroy(evaluator->charts);
        sp_wet_destroy(evaluator->wet);
    }
    sp_atlas_destroy(evaluator->atlas);
    sp_fragments_destroy(&evaluator->fragments);
    sp_patches_free(&evaluator->patches);
    free(evaluator->texel_patch);
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

double sp_evaluator_jets_wanted(const sp_evaluator *evaluator)
{
    const sp_fidelity *fidelity = &evaluator->fidelity;
    double wanted = fidelity->method == SP_METHOD_FORWARD ? jets_for(evaluator, fidelity->texel) : 0;
    return wanted > (double)fidelity->jets ? wanted : 0;
}

double sp_evaluator_jets_met(const sp_evaluator *evaluator)
{
    return jets_per_texel(evaluator) * (double)evaluator->fidelity.jets /
           jets_for(evaluator, evaluator->fidelity.texel);
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

sp_vec3 sp_evaluator_gravity(const sp_evaluator *evaluator)
{
    return evaluator->gravity;
}

sp_coverage *sp_evaluate(const sp_evaluator *evaluator, const sp_layout *layout, sp_error *error)
{
    if (!evaluator || !layout)
        return NULL;
    return evaluator->fidelity.method == SP_METHOD_FORWARD ? sp_evaluate_jets(evaluator, layout, error)
                                                           : sp_evaluate_inverse(evaluator, layout, error);
}
