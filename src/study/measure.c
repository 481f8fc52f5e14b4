/* What is compared with, and the runs that are. */
#include "state.h"

#include <math.h>
#include <stdlib.h>

#define DEEP 8 /* reflections that a reference follows, where the setup does not say how many */

/* What points say by themselves. */
static bool judge_points(sp_studying *studying, sp_study *study, sp_error *error)
{
    sp_trajectory trajectory = sp_study_reference_trajectory(studying->setup);
    sp_reference *reference = sp_reference_create(studying->own, studying->layout, trajectory, error);
    bool judged = sp_sample_covered(studying, reference, studying->truth, error);
    study->passing = studying->setup->sweep.speed > 0;
    study->reference_film_cell = judged ? sp_reference_film_cell(reference) : 0;
    sp_reference_destroy(reference);
    if (!judged)
        return false;
    sp_point_mean sample = sp_sample_of(studying->truth, studying->points);
    study->reference = (sp_fidelity){.trajectory = trajectory};
    study->reference_coverage = sample.mean;
    study->reference_spread = sample.spread;
    study->reference_check = NAN;
    return true;
}

/* Jets of another seed than the runs', to which they would else be near by sharing them. */
static sp_fidelity reference_of(const sp_studying *studying, double texel)
{
    sp_fidelity fidelity = studying->setup->fidelity;
    fidelity.trajectory = sp_study_reference_trajectory(studying->setup);
    fidelity.method = SP_METHOD_FORWARD;
    fidelity.reflections = fidelity.reflections < 0 ? DEEP : fidelity.reflections;
    fidelity.texel = texel;
    fidelity.jets = sp_study_most_jets(studying->setup, studying->layout->count);
    fidelity.seed++;
    return fidelity;
}

/* The mean of what a run differs from the truth so far; its shares, at the points, into `values`. */
static bool fly(sp_studying *studying, const sp_fidelity *fidelity, const double *truth, sp_point_mean *sample,
                sp_error *error)
{
    sp_setup setup = sp_study_setup(studying, fidelity);
    sp_evaluator *evaluator = sp_evaluator_create(&setup, error);
    sp_coverage *coverage = evaluator ? sp_evaluate(evaluator, studying->layout, error) : NULL;
    bool good = coverage && sp_sample_difference(studying, evaluator, coverage, truth, studying->values, error);
    if (good)
        *sample = sp_sample_of(studying->values, studying->points);
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    return good;
}

/* Jets that are thrown back: points know nothing of them. How good so many jets are on such texels is measured where
 * points can tell, at the first impact. */
static bool fly_reference(sp_studying *studying, double texel, sp_study *study, sp_error *error)
{
    sp_point_mean sample;
    sp_fidelity deep = reference_of(studying, texel), first = deep;
    first.reflections = 0;
    if (!fly(studying, &first, studying->truth, &sample, error))
        return false;
    study->reference_check = sample.mean;
    if (!fly(studying, &deep, NULL, &sample, error))
        return false;
    double *shares = studying->values;
    studying->values = studying->truth;
    studying->truth = shares;
    study->reference = deep;
    study->reference_coverage = sample.mean;
    study->reference_spread = sample.spread;
    return true;
}

bool sp_study_refer(sp_studying *studying, double texel, sp_study *study, sp_error *error)
{
    studying->truth = malloc(studying->points * sizeof *studying->truth);
    if (!studying->truth)
        return sp_fail_memory(error);
    return judge_points(studying, study, error) &&
           (!sp_study_reflects(studying->setup) || fly_reference(studying, texel, study, error));
}

static sp_evaluator *prepare(const sp_setup *setup, const sp_layout *layout, sp_study_run *run, sp_error *error)
{
    sp_stopwatch watch = {.count = 0};
    sp_evaluator *evaluator = NULL;
    do {
        sp_evaluator_destroy(evaluator);
        sp_clock_reading start = sp_moment_now();
        evaluator = sp_evaluator_create_for(setup, run->chosen ? layout : NULL, error);
        watch.rounds[watch.count++] = sp_moment_since(start);
    } while (evaluator && sp_stopwatch_wants(&watch));
    sp_clock_reading median = sp_stopwatch_median(&watch);
    run->speed.prepare = median.wall;
    run->speed.prepare_cpu = median.cpu;
    return evaluator;
}

static sp_coverage *evaluate(const sp_evaluator *evaluator, const sp_layout *layout, sp_study_run *run, sp_error *error)
{
    sp_stopwatch watch = {.count = 0};
    sp_coverage *coverage = NULL;
    do {
        sp_coverage_destroy(coverage);
        sp_clock_reading start = sp_moment_now();
        coverage = sp_evaluate(evaluator, layout, error);
        watch.rounds[watch.count++] = sp_moment_since(start);
    } while (coverage && sp_stopwatch_wants(&watch));
    sp_clock_reading median = sp_stopwatch_median(&watch);
    run->speed.evaluate = median.wall;
    run->speed.evaluate_cpu = median.cpu;
    return coverage;
}

bool sp_study_measure(sp_studying *studying, const sp_fidelity *fidelity, const sp_layout *layout, sp_study_run *run,
                      sp_error *error)
{
    const sp_study_options *options = studying->options;
    sp_setup setup = sp_study_setup(studying, fidelity);
    if (options->meter_start)
        options->meter_start();
    sp_evaluator *evaluator = prepare(&setup, layout, run, error);
    sp_coverage *coverage = evaluator ? evaluate(evaluator, layout, run, error) : NULL;
    run->speed.memory = options->meter_peak ? options->meter_peak() : 0;
    bool good =
        coverage && sp_sample_difference(studying, evaluator, coverage, studying->truth, studying->values, error);
    if (good) {
        sp_point_mean sample = sp_sample_of(studying->values, studying->points);
        run->fidelity = *sp_evaluator_fidelity(evaluator);
        run->texels = sp_evaluator_patches(evaluator)->count;
        run->coverage = coverage->fraction;
        run->error = sample.mean;
        run->spread = sample.spread;
        run->misjudged = sample.size;
    }
    sp_coverage_destroy(coverage);
    sp_evaluator_destroy(evaluator);
    return good;
}
