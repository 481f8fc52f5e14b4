#include "resolution.h"

#include "texel_sizes.h"
#include "movers.h"

#include <stdio.h>
#include <stdlib.h>

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
#define MOST_POSITIONS 1e5
#define WELL_WITHIN 0.5 /* of the longest chart that fits a page: shorter ones are as they would be on any page */

static double counted_area(const sp_evaluator *evaluator)
{
    double area = 0;
    for (uint32_t t = 0; t < evaluator->setup.mesh->triangle_count; t++)
        area += sp_counted_area(evaluator, t);
    return area;
}

double sp_texel_of(const sp_evaluator *evaluator, double texels)
{
    return sqrt(counted_area(evaluator) / texels);
}

static double jets_per_texel(const sp_evaluator *evaluator)
{
    return evaluator->setup.criterion.flux > 0 ? AUTO_JETS_AT_THRESHOLD : AUTO_JETS_TO_TOUCH;
}

/* That texels of this length want. */
static double jets_wanted(const sp_evaluator *evaluator, double texel)
{
    return ceil(jets_per_texel(evaluator) * counted_area(evaluator) / (texel * texel));
}

uint64_t sp_jets_for(const sp_evaluator *evaluator, double texel)
{
    return (uint64_t)fmin(AUTO_MOST_JETS, jets_wanted(evaluator, texel));
}

double sp_evaluator_jets_wanted(const sp_evaluator *evaluator)
{
    const sp_fidelity *fidelity = &evaluator->fidelity;
    bool enough = evaluator->choice.jets[0] && !evaluator->choice.missed; /* as measured */
    if (fidelity->method != SP_METHOD_FORWARD || enough)
        return 0;
    double wanted = jets_wanted(evaluator, fidelity->texel);
    return wanted > (double)fidelity->jets ? wanted : 0;
}

double sp_evaluator_jets_met(const sp_evaluator *evaluator)
{
    return jets_per_texel(evaluator) * (double)evaluator->fidelity.jets /
           jets_wanted(evaluator, evaluator->fidelity.texel);
}

/* Shorter texels than the jets can meet each would look dry, and few thin parts are not worth more jets for all. */
static sp_texel_limits texel_limits(const sp_evaluator *evaluator)
{
    const sp_fidelity *fidelity = &evaluator->fidelity;
    sp_texel_limits limits = {.texel = fidelity->texel, .page = PAGE_EDGE - PAGE_MARGIN};
    if (fidelity->method == SP_METHOD_INVERSE)
        return limits;
    double jets = fidelity->jets > 0 ? (double)fidelity->jets : AUTO_MOST_JETS;
    limits.least = sqrt(counted_area(evaluator) * jets_per_texel(evaluator) / jets);
    limits.spare = SPARE * fidelity->accuracy;
    return limits;
}

static bool check_number(double texel, double texels, sp_error *error)
{
    return texels <= SP_ATLAS_TEXELS_MOST ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "texel: %g m found, too small for a surface of %g m2; expected at least %.3g m", texel,
                   texels * texel * texel, texel * sqrt(texels / SP_ATLAS_TEXELS_MOST));
}

static bool set_positions(sp_evaluator *evaluator, double texel, sp_error *error)
{
    const sp_sweep *sweep = &evaluator->setup.sweep;
    double travel = sp_distance(sweep->from, sweep->to);
    if (travel / texel > MOST_POSITIONS)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "texel: %g m found, too small for a sweep of %g m, which is followed in steps no longer; "
                       "expected at least %.3g m",
                       texel, travel, travel / MOST_POSITIONS);
    evaluator->positions = sp_pass_positions(&evaluator->setup, texel);
    return true;
}

/* What is left to do once there is an atlas. */
static bool cut_patches(sp_evaluator *evaluator, sp_error *error)
{
    return evaluator->atlas && sp_evaluator_stage(evaluator, "atlas", 0.5, error) &&
           sp_fragments_create(&evaluator->fragments, evaluator->atlas, evaluator->setup.mesh, error) &&
           sp_evaluator_stage(evaluator, "atlas", 0.7, error) && sp_patches_create(evaluator, error) &&
           (evaluator->patches.total_area > 0 || sp_fail_nothing(error));
}

/* The atlas on pages of the usual size, or larger ones where a single triangle must have them. */
static bool build_atlas(sp_evaluator *evaluator, const sp_charts *charts, const sp_texel_sizes *texel_sizes,
                        sp_error *error)
{
    double texel = evaluator->fidelity.texel;
    double page = fmin(fmax(ceil(texel_sizes->longest) + PAGE_MARGIN, PAGE_EDGE), MOST_PAGE_EDGE);
    sp_atlas_options options = {.texel = texel, .page_edge = (uint32_t)page, .chart_texel = texel_sizes->texel};
    if (sp_texel_is_resolved(evaluator, texel, error) && check_number(texel, texel_sizes->texels, error) &&
        set_positions(evaluator, texel, error))
        evaluator->atlas = sp_atlas_create(evaluator->setup.mesh, charts, &options, error);
    return cut_patches(evaluator, error);
}

/* True where charts made for pages of one length (m) are those of the other too: none comes near either. */
static bool serve_both(const sp_charts *charts, double one, double other)
{
    double most = WELL_WITHIN * fmin(one, other);
    double(*box)[4] = malloc((charts->chart_count + 1) * sizeof *box);
    bool serve = box != NULL;
    for (size_t c = 0; serve && c < charts->chart_count; c++)
        for (int k = 0; k < 2; k++) {
            box[c][k] = INFINITY;
            box[c][2 + k] = -INFINITY;
        }
    for (uint32_t t = 0; serve && t < charts->triangle_count; t++)
        for (int i = 0; i < 6; i++) {
            double *b = box[charts->chart[t]], at = charts->flat[t][i / 2][i % 2];
            b[i % 2] = fmin(b[i % 2], at);
            b[2 + i % 2] = fmax(b[2 + i % 2], at);
        }
    for (size_t c = 0; serve && c < charts->chart_count; c++)
        serve = !(hypot(box[c][2] - box[c][0], box[c][3] - box[c][1]) > most);
    free(box);
    return serve;
}

static sp_charts *charts_of_files(const sp_setup *setup, sp_error *error)
{
    sp_atlas *atlas =
        sp_atlas_of_files(setup->mesh, setup->unfolded, setup->unfolded_count, setup->unfolded_texel, error);
    sp_charts *charts = atlas ? sp_charts_of_atlas(atlas, error) : NULL;
    sp_atlas_destroy(atlas);
    return charts;
}

/* The files' own, or such that fit on pages of the usual size. */
static bool make_charts(sp_evaluator *evaluator, sp_error *error)
{
    const sp_setup *setup = &evaluator->setup;
    double extent = (PAGE_EDGE - PAGE_MARGIN) * evaluator->fidelity.texel;
    if (evaluator->charts &&
        (setup->unfolded || evaluator->extent == extent || serve_both(evaluator->charts, evaluator->extent, extent)))
        return true;
    sp_charts_destroy(evaluator->charts);
    evaluator->extent = extent;
    evaluator->charts = setup->unfolded ? charts_of_files(setup, error) : sp_charts_create(setup->mesh, extent, error);
    return evaluator->charts != NULL;
}

/* On texels of any other length the files' charts might not keep a pixel apart. */
static bool is_laid(const sp_evaluator *evaluator)
{
    return evaluator->setup.unfolded && evaluator->fidelity.texel == evaluator->setup.unfolded_texel;
}

/* On such texels as were asked for the files' pages are too short, or their charts too close. */
static void take_shorter(sp_evaluator *evaluator, double asked)
{
    evaluator->fidelity.texel = evaluator->setup.unfolded_texel = evaluator->atlas->texel;
    snprintf(evaluator->choice.texel, SP_WHY, "not the %.4g mm asked for: the files' pages carry no longer ones",
             1e3 * asked);
}

static bool lay(sp_evaluator *evaluator, sp_error *error)
{
    const sp_setup *setup = &evaluator->setup;
    sp_fidelity *fidelity = &evaluator->fidelity;
    double texel = fidelity->texel, finest = INFINITY;
    if (!sp_texel_is_resolved(evaluator, texel, error) ||
        !check_number(texel, sp_mesh_area(setup->mesh) / (texel * texel), error) ||
        !set_positions(evaluator, texel, error) ||
        !(evaluator->atlas = sp_atlas_of_files(setup->mesh, setup->unfolded, setup->unfolded_count, texel, error)))
        return false;
    if (evaluator->atlas->texel < 0.75 * texel)
        take_shorter(evaluator, texel);
    for (size_t c = 0; c < evaluator->atlas->chart_count; c++)
        finest = fmin(finest, evaluator->atlas->chart_texel[c]);
    if (fidelity->jets == 0)
        fidelity->jets = sp_jets_for(evaluator, fidelity->method == SP_METHOD_INVERSE ? texel : finest);
    if (!evaluator->charts)
        evaluator->charts = sp_charts_of_atlas(evaluator->atlas, error);
    return evaluator->charts && cut_patches(evaluator, error);
}

bool sp_texels_create(sp_evaluator *evaluator, const sp_evaluator *fine, sp_error *error)
{
    sp_texel_sizes texel_sizes;
    sp_fidelity *fidelity = &evaluator->fidelity;
    sp_texel_limits limits = texel_limits(evaluator);
    sp_texels_free(evaluator);
    if (is_laid(evaluator))
        return lay(evaluator, error);
    if (!evaluator->origin && !make_charts(evaluator, error))
        return false;
    if (!(fine ? sp_texel_sizes_like(evaluator, evaluator->charts, fine, &texel_sizes, error)
               : sp_texel_sizes_create(evaluator, evaluator->charts, &limits, &texel_sizes, error)))
        return false;
    if (fidelity->jets == 0)
        fidelity->jets =
            sp_jets_for(evaluator, fidelity->method == SP_METHOD_INVERSE ? fidelity->texel : texel_sizes.finest);
    bool done = build_atlas(evaluator, evaluator->charts, &texel_sizes, error);
    sp_texel_sizes_free(&texel_sizes);
    return done;
}

void sp_texels_free(sp_evaluator *evaluator)
{
    sp_atlas_destroy(evaluator->atlas);
    sp_fragments_destroy(&evaluator->fragments);
    sp_patches_free(&evaluator->patches);
    free(evaluator->texel_patch);
    evaluator->atlas = NULL;
    evaluator->texel_patch = NULL;
}
