/* sprayplan simulate: what the scene's own nozzles do. */
#include "cli.h"

/* Where nothing can be covered place proposes no nozzles, and a layout of none is simulated as any other that it wrote;
 * elsewhere a scene without nozzles is a mistake. */
static bool has_layout(const sp_scene *scene)
{
    return sp_scene_layout(scene)->count > 0 || (sp_scene_has_place(scene) && sp_scene_lists_nozzles(scene));
}

static int simulate(const cli_options *options, const cli_scene *opened, cli_clock *clock, sp_error *error)
{
    const sp_layout *layout = sp_scene_layout(opened->scene);
    if (!has_layout(opened->scene)) {
        sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "nozzles: found none, expected at least one to simulate");
        return cli_fail_in(opened, error);
    }
    if (!cli_output_ready(options, opened->scene, cli_result_files, error))
        return cli_fail(error);
    cli_progress_stage(options, "simulate");
    sp_coverage *coverage = cli_simulated(opened, layout, error);
    cli_clock_stage(clock, "simulate");
    cli_progress_stage(options, "measured error");
    bool good = cli_measure(opened->evaluator, layout, coverage, error);
    cli_clock_stage(clock, "measured error");
    sp_design design = cli_design(opened, "manual", opened->evaluator, layout, coverage);
    sp_result result = {.command = "simulate",
                        .scene = cli_input_name(options->inputs[0]),
                        .design_count = 1,
                        .designs = &design,
                        .stage_count = clock->count,
                        .stages = clock->stages};
    const sp_scene *scene = opened->scene;
    cli_progress_stage(options, "report");
    good = good && cli_report(options, &result, &scene, &opened->inputs, layout, error);
    sp_coverage_destroy(coverage);
    return good ? cli_done() : cli_fail_in(opened, error);
}

int cli_simulate(const cli_options *options)
{
    cli_progress_plan(cli_evaluation_stages, 0, 0, 1);
    return cli_with_scene(options, true, simulate);
}
