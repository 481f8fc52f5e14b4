#include "scoring/visibility_work.h"

#include <math.h>

#define PATCHES_MOST 30000.0
#define HURRIED_PATCHES_MOST 1700.0 /* the same where time is short; what is found is refined on the final ones */
#define PATCHES_LEAST 500.0
#define SAME 1.2         /* times longer texels are not worth patches of the search's own */
#define RAYS_MOST 1e8    /* patches times views */
#define SUMS_MOST 1.2e10 /* patches times poses */
#define DRAG_PATCHES_MOST 10000.0
#define DRAG_RAYS_MOST 7e6 /* the same with drag, where flights have to be looked for */
#define FILM_PATCHES_MOST 8000.0
#define FILM_SUMS_MOST 2e9 /* the same, where film runs down */
#define PASS_PATCHES_MOST 8000.0
#define PASS_RAYS_MOST 5e6 /* patches times positions times views, where goods move */
#define PASS_SUMS_MOST 2e9 /* patches times positions times poses */

/* Patches on whose texels goods that move are looked at in few enough positions: with p patches of texels t, p t² being
 * the surface, p / t times the way over which they move is what a view has at most. */
static double patches_that_pass(const sp_evaluator *fine, double views, double poses, double most)
{
    const sp_sweep *sweep = &sp_evaluator_setup(fine)->sweep;
    double finer = sp_evaluator_fidelity(fine)->texel, count = (double)sp_evaluator_patches(fine)->count;
    double each = fmin(PASS_RAYS_MOST / views, PASS_SUMS_MOST / poses);
    double patches = cbrt(pow(each * finer / sp_distance(sweep->from, sweep->to), 2) * count);
    return fmax(PATCHES_LEAST, fmin(fmin(most, PASS_PATCHES_MOST), patches));
}

/* m, no shorter than the fine one's, for no more than `most` patches: of goods that stand still as many as are
 * `bearable`. */
static double texel_for(const sp_evaluator *fine, double views, double poses, double bearable, double most)
{
    double finer = sp_evaluator_fidelity(fine)->texel, count = (double)sp_evaluator_patches(fine)->count;
    double patches = sp_evaluator_setup(fine)->sweep.speed > 0 ? patches_that_pass(fine, views, poses, most)
                                                               : fmax(PATCHES_LEAST, fmin(most, bearable));
    return fmax(finer, finer * sqrt(count / patches));
}

static bool any_drops(const sp_candidates *candidates)
{
    for (size_t i = 0; i < candidates->launch_count; i++)
        if (candidates->launches[i].fronts)
            return true;
    return false;
}

bool sp_visibility_fit(const sp_evaluator *fine, const sp_place_options *options, const sp_sites *sites,
                       const sp_candidates *candidates, sp_deadline *deadline, sp_evaluator **resampled,
                       sp_visibility *visibility, sp_error *error)
{
    double views = (double)sites->count * (double)candidates->launch_count, footprints = 0;
    double poses = (double)candidates->pose_start[sites->count];
    views += sp_visibility_patterns(sites, candidates, &footprints);
    const sp_setup *setup = sp_evaluator_setup(fine);
    bool film = setup->criterion.film > 0, drag = any_drops(candidates);
    double most = film ? FILM_PATCHES_MOST : PATCHES_MOST, sums = film ? FILM_SUMS_MOST : SUMS_MOST;
    most = fmin(most, SP_PRINTS_SHARE * sp_visibility_memory(options) / (SP_PRINT * fmax(1, footprints)));
    most = drag ? fmin(most, DRAG_PATCHES_MOST) : most;
    double rays = drag ? DRAG_RAYS_MOST : RAYS_MOST, bearable = fmin(rays / views, sums / poses);
    double leisurely = texel_for(fine, views, poses, bearable, most), texel = leisurely;
    if (sp_run_hurries(&options->run))
        texel = texel_for(fine, views, poses, bearable, fmin(most, HURRIED_PATCHES_MOST));
    *resampled = NULL;
    if (film || texel > SAME * sp_evaluator_fidelity(fine)->texel) {
        *resampled = sp_evaluator_resample(fine, texel, error);
        if (!*resampled)
            return false;
    }
    if (sp_visibility_create(*resampled ? *resampled : fine, options, sites, candidates, deadline, visibility, error)) {
        visibility->hurried |= *resampled && texel > leisurely;
        return true;
    }
    sp_evaluator_destroy(*resampled);
    *resampled = NULL;
    return false;
}
