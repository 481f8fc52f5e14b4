/* A study from the first run to the last. */
#include "state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FEWEST_POINTS 10000
#define MOST_POINTS 10000000
#define PASSING 16 /* times fewer where goods move */

/* What comes of a placement after its layout is there. */
static bool comes_after(const char *stage)
{
    return !strcmp(stage, "forward check") || !strcmp(stage, "certificate") || !strcmp(stage, "every aim");
}

/* True where the placement under way is to end here. */
static bool ends_placement(sp_studying *studying, const char *stage)
{
    if (!studying->placing || studying->laid)
        return studying->placing;
    sp_clock_reading taken = sp_moment_since(studying->began);
    studying->laid = comes_after(stage);
    studying->cut = !studying->laid && taken.wall > studying->limit;
    if (studying->laid)
        studying->taken = taken;
    return studying->laid || studying->cut;
}

static bool progress(void *user, const char *stage, double done)
{
    sp_studying *studying = user;
    const sp_run *run = &studying->options->run;
    (void)done;
    double part = studying->expected > 0 ? sp_moment_since(studying->since).wall / studying->expected : 0;
    double whole = studying->done + studying->step * fmin(part, 1);
    if (run->progress && !run->progress(run->user, studying->stage, whole))
        studying->cancelled = true;
    if (sp_study_left(studying) <= 0)
        studying->cancelled = true;
    return !ends_placement(studying, stage) && !studying->cancelled;
}

/* What ends a placement early, or the study, lets its evaluations end: without them there would be no layout. */
static bool evaluation_progress(void *user, const char *stage, double done)
{
    const sp_studying *studying = user;
    return progress(user, stage, done) || studying->placing;
}

sp_setup sp_study_setup(sp_studying *studying, const sp_fidelity *fidelity)
{
    sp_setup setup = *studying->setup;
    setup.fidelity = *fidelity;
    setup.run = sp_study_place_run(studying);
    setup.run.progress = evaluation_progress;
    return setup;
}

sp_run sp_study_place_run(sp_studying *studying)
{
    return (sp_run){.threads = studying->options->run.threads, .progress = progress, .user = studying};
}

double sp_study_left(const sp_studying *studying)
{
    double limit = studying->options->run.time_limit;
    return limit > 0 ? limit - sp_moment_since(studying->start).wall : INFINITY;
}

bool sp_study_next(sp_studying *studying, const char *stage, size_t index, size_t count, double expected,
                   sp_error *error)
{
    studying->stage = stage;
    studying->done = (double)index / (double)count;
    studying->step = 1 / (double)count;
    studying->expected = expected;
    studying->since = sp_moment_now();
    return progress(studying, stage, 0) ||
           sp_fail(error, SP_ERROR_INTERRUPTED, NULL, 0, 0, "interrupted, or out of time");
}

void sp_study_placing(sp_studying *studying, double limit)
{
    studying->placing = true;
    studying->laid = studying->cut = false;
    studying->limit = limit;
    studying->began = sp_moment_now();
}

sp_clock_reading sp_study_placed(sp_studying *studying, bool *ended_early)
{
    *ended_early = !studying->laid;
    studying->placing = false;
    return studying->laid ? studying->taken : sp_moment_since(studying->began);
}

/* So many that twice the standard error of one misjudged point in a hundred is a sixty-fourth of the accuracy, about;
 * where goods move, and a point is looked at in a hundred places, a sixteenth of it. */
static size_t points_for(const sp_setup *setup)
{
    double accuracy = setup->fidelity.accuracy, points = accuracy > 0 ? 100 / (accuracy * accuracy) : MOST_POINTS;
    points = setup->sweep.speed > 0 ? points / PASSING : points;
    return 2 * (size_t)ceil(0.5 * fmin(fmax(points, FEWEST_POINTS), MOST_POINTS) - 1e-6);
}

static bool admits(const sp_evaluator *evaluator, const sp_layout *layout, sp_error *error)
{
    for (size_t i = 0; i < layout->count; i++)
        if (!sp_evaluator_admits(evaluator, &layout->nozzles[i], error))
            return false;
    return true;
}

/* The nozzles with no number of jets of their own, which the grid sets. */
static sp_layout *freed(const sp_studying *studying, sp_error *error)
{
    sp_layout *layout = sp_layout_create(studying->layout->nozzles, studying->layout->count, error);
    for (size_t i = 0; layout && !studying->setup->fidelity.jets && i < layout->count; i++)
        layout->nozzles[i].jets = 0;
    return layout;
}

static bool run_grid(sp_studying *studying, const sp_fidelity *cells, size_t count, sp_study *study, sp_error *error)
{
    sp_layout *layout = freed(studying, error);
    study->runs = calloc(count + 1, sizeof *study->runs);
    bool good = layout && (study->runs || sp_fail_memory(error));
    for (size_t i = 0; good && i <= count; i++) {
        bool chosen = i == count;
        sp_study_run *run = &study->runs[i];
        run->chosen = chosen;
        good = sp_study_next(studying, "runs", i, count + 1, 0, error) &&
               sp_study_measure(studying, chosen ? &studying->setup->fidelity : &cells[i],
                                chosen ? studying->layout : layout, run, error);
        study->run_count += good;
    }
    sp_layout_destroy(layout);
    return good;
}

/* Which runs are worth their seconds. */
static bool find_fronts(sp_study *study, sp_error *error)
{
    size_t count = study->run_count;
    double *figures = malloc((3 * count + 1) * sizeof *figures);
    bool *on = malloc((2 * count + 1) * sizeof *on);
    if (figures && on) {
        for (size_t i = 0; i < count; i++) {
            const sp_study_run *run = &study->runs[i];
            figures[i] = run->speed.evaluate;
            figures[count + i] = fabs(run->error) + run->spread;
            figures[2 * count + i] = run->misjudged;
        }
        sp_study_front(figures, figures + count, count, on);
        sp_study_front(figures, figures + 2 * count, count, on + count);
        for (size_t i = 0; i < count; i++) {
            study->runs[i].speed.front = on[i];
            study->runs[i].speed.front_misjudged = on[count + i];
        }
    }
    bool good = (figures && on) || sp_fail_memory(error);
    free(figures);
    free(on);
    return good;
}

static bool measure(sp_studying *studying, double texel, sp_study *study, sp_error *error)
{
    size_t nozzles = studying->layout->count, count = 0;
    if (nozzles == 0)
        return true;
    sp_fidelity *cells = sp_study_grid(studying->setup, nozzles, texel, &count, error);
    bool good = cells && sp_study_next(studying, "reference", 0, 1, 0, error) &&
                sp_study_refer(studying, texel, study, error) && run_grid(studying, cells, count, study, error);
    free(cells);
    return good;
}

static bool work(sp_studying *studying, const sp_place_options *place, sp_study *study, sp_error *error)
{
    sp_setup setup = sp_study_setup(studying, &studying->setup->fidelity);
    if (!sp_study_next(studying, "reference", 0, 1, 0, error))
        return false;
    sp_evaluator *own = sp_evaluator_create(&setup, error);
    bool good = own && admits(own, studying->layout, error);
    studying->own = own;
    study->area = good ? sp_evaluator_patches(own)->total_area : 0;
    double texel = sp_study_texel(studying->setup, study->area);
    good = good && measure(studying, texel, study, error) &&
           (!place || sp_study_run_places(studying, place, texel, study, error));
    sp_evaluator_destroy(own);
    return good;
}

sp_study *sp_study_create(const sp_setup *setup, const sp_layout *layout, const sp_place_options *place,
                          const sp_study_options *options, sp_error *error)
{
    if (!setup || !layout || !options)
        return NULL;
    if (layout->count == 0 && !place)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "nozzles: found none, expected at least one to study, or mounts under place:"),
               NULL;
    sp_studying studying = {
        .setup = setup, .layout = layout, .options = options, .start = sp_moment_now(), .points = points_for(setup)};
    sp_study *study = calloc(1, sizeof *study);
    studying.values = malloc(studying.points * sizeof *studying.values);
    sp_error failure = {0};
    bool good = (study && studying.values) || sp_fail_memory(&failure);
    if (good) {
        study->points = studying.points;
        good = work(&studying, place, study, &failure);
        study->interrupted = failure.kind == SP_ERROR_INTERRUPTED && study->run_count + study->place_count > 0;
        failure.kind = study->interrupted ? SP_OK : failure.kind;
        good = (good || study->interrupted) && find_fronts(study, &failure) && sp_study_find_orders(study, &failure);
    }
    free(studying.values);
    free(studying.truth);
    if (good)
        return study;
    if (error && error->kind == SP_OK)
        *error = failure;
    sp_study_destroy(study);
    return NULL;
}

void sp_study_destroy(sp_study *study)
{
    if (!study)
        return;
    free(study->runs);
    free(study->orders);
    free(study->places);
    free(study);
}
