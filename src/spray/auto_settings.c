#include "auto_settings.h"

#include "clock.h"
#include "resolution.h"

#include <stdio.h>

#define SHORTER 0.7 /* of a texel that does not keep the accuracy */
#define LATE 0.25   /* of a time limit: what is found by then is taken */

bool sp_setting_trial_late(const sp_setting_trial *trial)
{
    double limit = trial->evaluator->setup.run.time_limit;
    return limit > 0 && sp_now() - trial->evaluator->began > LATE * limit;
}

bool sp_setting_trial_run(sp_setting_trial *trial, sp_error *error)
{
    sp_coverage_destroy(trial->coverage);
    trial->coverage = sp_evaluate(trial->evaluator, trial->layout, error);
    return trial->coverage &&
           sp_measure_roughly(trial->evaluator, trial->layout, trial->coverage, &trial->measured, error);
}

bool sp_setting_trial_at(sp_setting_trial *trial, double texel, sp_error *error)
{
    sp_fidelity *fidelity = &trial->evaluator->fidelity;
    fidelity->texel = texel;
    if (fidelity->method == SP_METHOD_INVERSE)
        fidelity->jets = trial->evaluator->setup.fidelity.jets; /* found anew from the texel */
    return sp_texels_create(trial->evaluator, NULL, error) && sp_setting_trial_run(trial, error);
}

bool sp_setting_trial_keeps(const sp_setting_trial *trial)
{
    return trial->measured.estimate <= 0.5 * trial->evaluator->setup.fidelity.accuracy;
}

double sp_shortest_auto_texel(const sp_evaluator *evaluator)
{
    return sp_texel_of(evaluator, evaluator->movers ? SP_PLAIN_TEXELS : SP_MOST_TEXELS);
}

/* As a length, then what was measured of it. */
static void explain_texel(const sp_setting_trial *trial, const char *what)
{
    snprintf(trial->evaluator->choice.texel, SP_WHY, "%s: error within %.2f points of coverage, %.2f %% misjudged",
             what, 100 * trial->measured.estimate, 100 * trial->measured.misjudged);
}

/* The area misjudged tells the texel, since it shrinks about as the texel does. The error, which is only its balance
 * between too much and too little, is then measured, and alone decides. */
static bool choose_texel(sp_setting_trial *trial, sp_error *error)
{
    sp_evaluator *evaluator = trial->evaluator;
    double accuracy = evaluator->setup.fidelity.accuracy;
    double texel = sp_texel_of(evaluator, SP_FEWEST_TEXELS), finest = sp_shortest_auto_texel(evaluator);
    if (sp_setting_trial_late(trial)) {
        snprintf(evaluator->choice.texel, SP_WHY, "the coarsest that auto takes, for lack of time: not measured");
        evaluator->fidelity.texel = texel;
        return sp_texels_create(evaluator, NULL, error);
    }
    if (!sp_setting_trial_at(trial, texel, error))
        return false;
    double wanted = texel * fmin(1, accuracy / fmax(trial->measured.misjudged, 1e-300));
    while ((wanted < texel || !sp_setting_trial_keeps(trial)) && texel > finest && !sp_setting_trial_late(trial)) {
        texel = wanted = fmax(wanted < texel ? wanted : SHORTER * texel, finest);
        if (!sp_setting_trial_at(trial, texel, error))
            return false;
    }
    evaluator->choice.missed = !sp_setting_trial_keeps(trial);
    explain_texel(trial, evaluator->choice.missed && texel > finest ? "as coarse as there was time for"
                         : texel > finest ? "the coarsest tried that errs by at most half the accuracy"
                                          : "the finest that auto takes");
    return true;
}

static void explain_method(sp_evaluator *evaluator)
{
    const char *why = evaluator->fidelity.method == SP_METHOD_INVERSE ? "inverse: no wall throws liquid back"
                      : evaluator->fidelity.splat == SP_SPLAT_LINEAR  ? "forward: jets alone are shared among texels"
                                                                      : "forward: walls throw liquid back";
    snprintf(evaluator->choice.method, SP_WHY, "%s", why);
}

/* An evaluation of goods that move takes long, and lines save little of it: their positions are as many. */
static bool choose_trajectory(sp_setting_trial *trial, sp_error *error)
{
    sp_evaluator *evaluator = trial->evaluator;
    if (!evaluator->movers)
        return sp_auto_trajectory(trial, error);
    snprintf(evaluator->choice.trajectory, SP_WHY, "parabolas: of goods that move lines are not tried");
    return true;
}

bool sp_auto_settings(sp_evaluator *evaluator, const sp_layout *layout, sp_error *error)
{
    const sp_fidelity *open = &evaluator->setup.fidelity;
    sp_setting_trial trial = {.evaluator = evaluator, .layout = layout};
    bool done;
    if (open->method == SP_METHOD_AUTO)
        explain_method(evaluator);
    evaluator->stage = "settings";
    if (evaluator->fidelity.method == SP_METHOD_FORWARD)
        done = sp_auto_forward(&trial, error);
    else if (!(open->texel > 0))
        done = choose_texel(&trial, error);
    else
        done = sp_texels_create(evaluator, NULL, error);
    bool inverse = evaluator->fidelity.method == SP_METHOD_INVERSE;
    if (done && inverse && open->trajectory == SP_TRAJECTORY_AUTO && evaluator->setup.gravity > 0)
        done = choose_trajectory(&trial, error);
    evaluator->stage = NULL;
    sp_coverage_destroy(trial.coverage);
    return done;
}
