/* A scene and its evaluator, opened with the command line's overrides. */
#include "cli.h"
#include "size.h"

#include <math.h>

bool cli_scene_open(cli_scene *opened, const char *path, const cli_options *options, bool evaluates, cli_clock *clock,
                    sp_error *error)
{
    *opened = (cli_scene){0};
    const sp_run run = cli_run(options);
    cli_progress_stage(options, "geometry");
    opened->scene = cli_load_scene(path, options, &run, error);
    if (!opened->scene)
        return false;
    if ((options->output || options->json) && !cli_inputs_add_scene(&opened->inputs, path, opened->scene, error)) {
        cli_scene_close(opened);
        return false;
    }
    cli_clock_stage(clock, "load");
    if (options->command == CLI_PLACE && sp_scene_alternative_count(opened->scene) > 0)
        cli_progress_rounds(sp_scene_alternative_count(opened->scene));
    sp_setup setup = *sp_scene_setup(opened->scene);
    setup.run = run;
    /* ranks have to choose alike, which none does that has less time */
    setup.run.time_limit =
        options->command == CLI_PLACE && !cli_ranks() && options->time_limit > 0 ? fmax(cli_time_left(), 1e-3) : 0;
    opened->evaluator = sp_evaluator_create_for(&setup, evaluates ? sp_scene_layout(opened->scene) : NULL, error);
    cli_clock_stage(clock, "atlas");
    if (!opened->evaluator) {
        sp_scene_locate(opened->scene, error);
        cli_size_ask_after(opened->scene, error);
        cli_scene_close(opened);
    }
    return opened->evaluator != NULL;
}

void cli_scene_close(cli_scene *opened)
{
    sp_evaluator_destroy(opened->evaluator);
    sp_scene_destroy(opened->scene);
    cli_inputs_free(&opened->inputs);
    *opened = (cli_scene){0};
}

bool cli_admits(const cli_scene *opened, const sp_nozzle *nozzle, sp_error *error)
{
    const sp_place_options place = sp_scene_place_options(opened->scene);
    return sp_evaluator_admits(opened->evaluator, nozzle, error) &&
           sp_mounts_admit(sp_scene_setup(opened->scene), place.mounts, place.mount_count, nozzle, error);
}

sp_design cli_design(const cli_scene *opened, const char *name, const sp_evaluator *evaluator, const sp_layout *layout,
                     const sp_coverage *coverage)
{
    const sp_place_options place = sp_scene_place_options(opened->scene);
    return (sp_design){.name = name,
                       .evaluator = evaluator,
                       .layout = layout,
                       .coverage = coverage,
                       .mounts = place.mounts,
                       .mount_count = place.mount_count,
                       .water_cost = sp_scene_water_cost(opened->scene)};
}

sp_coverage *cli_simulated(const cli_scene *opened, const sp_layout *layout, sp_error *error)
{
    for (size_t i = 0; i < layout->count; i++)
        if (!cli_admits(opened, &layout->nozzles[i], error))
            return NULL;
    sp_coverage *coverage = sp_evaluate(opened->evaluator, layout, error);
    if (coverage && sp_evaluate_balance(opened->evaluator, layout, coverage, error))
        return coverage;
    sp_coverage_destroy(coverage);
    return NULL;
}

bool cli_find_borderline(const sp_evaluator *evaluator, const sp_layout *layout, sp_coverage *coverage, sp_error *error)
{
    return sp_evaluator_fidelity(evaluator)->method != SP_METHOD_INVERSE ||
           sp_find_borderline(evaluator, layout, coverage, NULL, &coverage->borderline, error);
}

bool cli_bounds_lines(const sp_evaluator *evaluator)
{
    const sp_fidelity *fidelity = sp_evaluator_fidelity(evaluator);
    bool moves = sp_evaluator_setup(evaluator)->sweep.speed > 0; /* of what passes by nothing is proved */
    return fidelity->trajectory == SP_TRAJECTORY_LINE && fidelity->method == SP_METHOD_INVERSE && !moves;
}

bool cli_bound_lines(const sp_evaluator *evaluator, const sp_layout *layout, sp_coverage *coverage, sp_error *error)
{
    if (!cli_bounds_lines(evaluator))
        return true;
    coverage->line_error.known = sp_bound_lines(evaluator, layout, &coverage->line_error.share, NULL, error);
    return coverage->line_error.known;
}

bool cli_measure(const sp_evaluator *evaluator, const sp_layout *layout, sp_coverage *coverage, sp_error *error)
{
    uint64_t seed = sp_evaluator_fidelity(evaluator)->seed;
    return coverage &&
           sp_measure_error(evaluator, layout, coverage, SP_TRAJECTORY_AUTO, seed, &coverage->measured, error) &&
           cli_find_borderline(evaluator, layout, coverage, error) &&
           cli_bound_lines(evaluator, layout, coverage, error);
}

int cli_fail_in(const cli_scene *opened, sp_error *error)
{
    sp_scene_locate(opened->scene, error);
    return cli_fail(error);
}

int cli_with_scene(const cli_options *options, bool evaluates, cli_work *work)
{
    sp_error error = {0};
    cli_clock clock;
    cli_scene opened;
    cli_clock_start(&clock);
    if (!cli_scene_open(&opened, options->inputs[0], options, evaluates, &clock, &error))
        return cli_fail(&error);
    int status = work(options, &opened, &clock, &error);
    cli_scene_close(&opened);
    return status;
}
