/* Whether lines do in place of parabolas. */
#include "auto_settings.h"

#include <stdio.h>

#define SAVES 0.1 /* of the run: less is not worth lines */

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

bool sp_auto_trajectory(sp_setting_trial *trial, sp_error *error)
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
