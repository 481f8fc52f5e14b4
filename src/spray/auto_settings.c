#include "auto_settings.h"

#include "clock.h"
#include "resolution.h"

#include <stdio.h>

#define SHORTER 0.7 /* of a texel that does not keep the accuracy */
#define SAVES 0.1   /* of the run: less is not worth lines */
#define LATE 0.25   /* of a time limit: what is found by then is taken */

/* What takes how long, in microseconds of one thread (results/accuracy.md). Only proportions matter. */
#define SOLVE 0.14 /* the flights to a place, parabolas */
#define SOLVE_LINE 0.08
#define RAY 0.27 /* traced as a parabola */
#define RAY_LINE 0.25
#define JUDGE 0.26      /* a point under one pattern, by parabolas */
#define POINTS 150000   /* that are judged in the end */
#define TRIANGLE 20     /* accelerator, charts and wet sides */
#define TRIANGLE_OPEN 5 /* the same where no cavity is named */
#define PATCH 1.4       /* cut out of the atlas */

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
        fidelity->jets = trial->evaluator->setup.fidelity.jets; /* told anew from the texel */
    return sp_texels_create(trial->evaluator, NULL, error) && sp_setting_trial_run(trial, error);
}

bool sp_setting_trial_keeps(const sp_setting_trial *trial)
{
    return trial->measured.estimate <= 0.5 * trial->evaluator->setup.fidelity.accuracy;
}

/* As a length, then what was measured of it. */
static void tell_texel(const sp_setting_trial *trial, const char *what)
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
    double texel = sp_texel_of(evaluator, SP_FEWEST_TEXELS), finest = sp_texel_of(evaluator, SP_MOST_TEXELS);
    if (sp_setting_trial_late(trial)) {
        snprintf(evaluator->choice.texel, SP_WHY, "the coarsest that auto takes, for lack of time: not measured");
        evaluator->fidelity.texel = texel;
        return sp_texels_create(evaluator, NULL, error);
    }
    if (!sp_setting_trial_at(trial, texel, error))
        return false;
    double told = texel * fmin(1, accuracy / fmax(trial->measured.misjudged, 1e-300));
    while ((told < texel || !sp_setting_trial_keeps(trial)) && texel > finest && !sp_setting_trial_late(trial)) {
        texel = told = fmax(told < texel ? told : SHORTER * texel, finest);
        if (!sp_setting_trial_at(trial, texel, error))
            return false;
    }
    evaluator->choice.missed = !sp_setting_trial_keeps(trial);
    tell_texel(trial, evaluator->choice.missed && texel > finest ? "as coarse as there was time for"
                      : texel > finest ? "the coarsest tried that errs by at most half the accuracy"
                                       : "the finest that auto takes");
    return true;
}

/* Microseconds of evaluating. */
static double evaluating(const sp_work *work, bool lines)
{
    return (double)work->places * (lines ? SOLVE_LINE : SOLVE) + (double)work->rays * (lines ? RAY_LINE : RAY);
}

static size_t pattern_count(const sp_layout *layout)
{
    size_t count = 0;
    for (size_t i = 0; i < layout->count; i++)
        count += sp_nozzle_pattern_count(&layout->nozzles[i]);
    return count;
}

/* The same of all that a simulation does besides. */
static double besides(const sp_setting_trial *trial)
{
    const sp_evaluator *evaluator = trial->evaluator;
    double triangle = evaluator->setup.cavity == SP_CAVITY_NONE ? TRIANGLE_OPEN : TRIANGLE;
    return triangle * (double)evaluator->setup.mesh->triangle_count + PATCH * (double)evaluator->patches.count +
           JUDGE * POINTS * (double)pattern_count(trial->layout);
}

static void fly(sp_evaluator *evaluator, sp_trajectory trajectory)
{
    evaluator->fidelity.trajectory = trajectory;
    evaluator->gravity = sp_gravity_for(&evaluator->setup, trajectory);
}

/* The share of the run that lines save at the very most. */
static double most_saved(const sp_setting_trial *trial)
{
    size_t places = pattern_count(trial->layout) * trial->evaluator->patches.count;
    const sp_work parabolas = {places, places}, lines = {places, 0};
    double evaluation = evaluating(&parabolas, false);
    return (evaluation - evaluating(&lines, true)) / (evaluation + besides(trial));
}

/* Evaluates by lines and compares. */
static bool try_lines(sp_setting_trial *trial, double *saved, sp_error *error)
{
    const sp_work parabolas = trial->coverage->work;
    fly(trial->evaluator, SP_TRAJECTORY_LINE);
    if (!sp_setting_trial_run(trial, error))
        return false;
    double before = evaluating(&parabolas, false);
    *saved = (before - evaluating(&trial->coverage->work, true)) / (before + besides(trial));
    if (*saved < SAVES || !sp_setting_trial_keeps(trial) ||
        trial->measured.misjudged > trial->evaluator->setup.fidelity.accuracy)
        fly(trial->evaluator, SP_TRAJECTORY_PARABOLA);
    return true;
}

/* Lines in place of parabolas, where that is worth it. */
static bool choose_trajectory(sp_setting_trial *trial, sp_error *error)
{
    sp_evaluator *evaluator = trial->evaluator;
    char *why = evaluator->choice.trajectory;
    double saved = most_saved(trial);
    if (sp_setting_trial_late(trial)) {
        snprintf(why, SP_WHY, "parabolas: for lack of time lines were not tried");
        return true;
    }
    if (saved >= SAVES &&
        ((!trial->coverage && !sp_setting_trial_run(trial, error)) || !try_lines(trial, &saved, error)))
        return false;
    double points = 100 * trial->measured.estimate;
    if (evaluator->fidelity.trajectory == SP_TRAJECTORY_LINE)
        snprintf(why, SP_WHY,
                 "lines: error against parabolas within %.2f points of coverage, %.0f %% of the work saved", points,
                 100 * saved);
    else if (saved >= SAVES)
        snprintf(why, SP_WHY, "parabolas: by lines coverage errs by up to %.2f points, %.2f %% misjudged", points,
                 100 * trial->measured.misjudged);
    else
        snprintf(why, SP_WHY, "parabolas: lines save less than a tenth of the work");
    return true;
}

static void tell_method(sp_evaluator *evaluator)
{
    const char *why = evaluator->fidelity.method == SP_METHOD_INVERSE ? "inverse: no wall throws liquid back"
                      : evaluator->fidelity.splat == SP_SPLAT_LINEAR  ? "forward: jets alone are shared among texels"
                                                                      : "forward: walls throw liquid back";
    snprintf(evaluator->choice.method, SP_WHY, "%s", why);
}

/* Points tell nothing of goods that move: what is left open stays as plain as without a layout. */
static bool choose_unmeasured(sp_evaluator *evaluator, sp_error *error)
{
    const sp_fidelity *open = &evaluator->setup.fidelity;
    if (!(open->texel > 0))
        snprintf(evaluator->choice.texel, SP_WHY, "the plain length: of goods that move no error is measured");
    if (open->trajectory == SP_TRAJECTORY_AUTO && evaluator->setup.gravity > 0)
        snprintf(evaluator->choice.trajectory, SP_WHY, "parabolas: of goods that move no error is measured");
    return sp_texels_create(evaluator, NULL, error);
}

bool sp_auto_settings(sp_evaluator *evaluator, const sp_layout *layout, sp_error *error)
{
    const sp_fidelity *open = &evaluator->setup.fidelity;
    sp_setting_trial trial = {.evaluator = evaluator, .layout = layout};
    bool done;
    if (open->method == SP_METHOD_AUTO)
        tell_method(evaluator);
    if (evaluator->movers)
        return choose_unmeasured(evaluator, error);
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
