/* sprayplan place: a proposed layout, compared with the scene's own nozzles. */
#include "cli.h"

typedef struct {
    sp_coverage *manual; /* NULL where the scene has no nozzles */
    sp_proposal *proposal;
} placement;

/* What all designs are counted on. */
static const sp_evaluator *counted_on(const cli_scene *opened, const placement *found)
{
    return found->proposal->again ? found->proposal->again : opened->evaluator;
}

static size_t list_designs(const cli_scene *opened, const placement *found, sp_design designs[3])
{
    const sp_evaluator *evaluator = counted_on(opened, found);
    size_t count = 0;
    if (found->manual)
        designs[count++] = cli_design(opened, "manual", evaluator, sp_scene_layout(opened->scene), found->manual);
    designs[count++] =
        cli_design(opened, "greedy", evaluator, found->proposal->greedy, found->proposal->greedy_coverage);
    designs[count++] = cli_design(opened, "proposed", evaluator, found->proposal->layout, found->proposal->coverage);
    return count;
}

static void say_what_is_missing(const sp_proposal *proposal)
{
    const sp_coverage *coverage = proposal->coverage;
    double percent = 100 / coverage->area;
    if (!(proposal->target_area > 0))
        fprintf(stderr,
                "sprayplan: no nozzle that is allowed, at any mounting point that takes it, covers anything by the "
                "criteria\n");
    else if (coverage->covered_area >= proposal->asked_area)
        fprintf(stderr, "sprayplan: the nozzles to keep are more, or take more water, than max_nozzles and max_water "
                        "allow\n");
    else if (proposal->attainable_area < proposal->asked_area)
        fprintf(stderr,
                "sprayplan: %.4g %% of the surface was asked for, of which no more than %.1f %% is attainable: the "
                "proposal covers %.1f %%, %.1f %% of what is attainable\n",
                percent * proposal->asked_area, percent * proposal->attainable_area, 100 * coverage->fraction,
                100 * coverage->covered_area / proposal->attainable_area);
    else
        fprintf(stderr, "sprayplan: the proposal covers %.1f %% of the surface (%.3f m2), not the %.4g %% asked for\n",
                100 * coverage->fraction, coverage->covered_area, percent * proposal->asked_area);
}

static int report(const cli_options *options, const cli_scene *opened, const placement *found, const cli_clock *clock,
                  sp_error *error)
{
    sp_design designs[3];
    sp_result result = {.command = "place",
                        .scene = options->inputs[0],
                        .design_count = list_designs(opened, found, designs),
                        .designs = designs,
                        .proposal = found->proposal,
                        .stage_count = clock->count,
                        .stages = clock->stages};
    const sp_scene *scene = opened->scene;
    if (!cli_report(options, &result, &scene, &opened->inputs, found->proposal->layout, error))
        return cli_fail_in(opened, error);
    if (cli_interrupted()) {
        fprintf(stderr, "sprayplan: interrupted; this is the best layout so far\n");
        return EXIT_INTERRUPTED;
    }
    if (found->proposal->reached)
        return EXIT_DONE;
    say_what_is_missing(found->proposal);
    return EXIT_SHORT;
}

/* Of the time limit, after what was done before; 0 where there is none. */
static double time_left(const cli_options *options, const cli_clock *clock)
{
    double left = options->time_limit;
    for (size_t i = 0; i < clock->count; i++)
        left -= clock->stages[i].seconds;
    return options->time_limit > 0 && left < 1e-3 ? 1e-3 : options->time_limit > 0 ? left : 0;
}

/* The scene's own nozzles, where everything else was counted again. */
static bool count_manual_again(const cli_scene *opened, placement *found, sp_error *error)
{
    if (!found->manual || !found->proposal->again)
        return true;
    sp_coverage_destroy(found->manual);
    found->manual = sp_evaluate(found->proposal->again, sp_scene_layout(opened->scene), error);
    return found->manual != NULL;
}

/* Where the liquid of every layout goes. */
static bool follow_liquid(const cli_scene *opened, const placement *found, sp_error *error)
{
    const sp_evaluator *evaluator = counted_on(opened, found);
    const sp_proposal *proposal = found->proposal;
    return (!found->manual || sp_evaluate_balance(evaluator, sp_scene_layout(opened->scene), found->manual, error)) &&
           sp_evaluate_balance(evaluator, proposal->greedy, proposal->greedy_coverage, error) &&
           sp_evaluate_balance(evaluator, proposal->layout, proposal->coverage, error);
}

/* How far the coverage of the other layouts is off: the proposal's is measured. */
static bool measure_errors(const cli_scene *opened, const placement *found, sp_error *error)
{
    const sp_proposal *proposal = found->proposal;
    const sp_evaluator *evaluator = counted_on(opened, found);
    return (!found->manual || cli_measure(evaluator, sp_scene_layout(opened->scene), found->manual, error)) &&
           cli_measure(evaluator, proposal->greedy, proposal->greedy_coverage, error) &&
           cli_find_borderline(evaluator, proposal->layout, proposal->coverage, error);
}

/* A nozzle of the scene's own that could not stand where it is drawn: what the proposal is compared with is in doubt.
 */
static bool warn_of_own(const cli_scene *opened, const sp_layout *own, sp_error *failure)
{
    for (size_t i = 0; i < own->count; i++) {
        sp_error error = {0};
        if (own->nozzles[i].keep || cli_admits(opened, &own->nozzles[i], &error))
            continue;
        if (error.kind == SP_ERROR_MEMORY)
            return sp_fail_memory(failure);
        cli_progress_end();
        fprintf(stderr, "sprayplan: the layout compared with is in doubt: %s\n", error.message);
    }
    return true;
}

static int place(const cli_options *options, const cli_scene *opened, cli_clock *clock, sp_error *error)
{
    placement found = {0};
    if (!cli_output_ready(options, opened->scene, cli_result_files, error))
        return cli_fail(error);
    const sp_layout *own = sp_scene_layout(opened->scene);
    if (!sp_scene_has_place(opened->scene))
        sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "place: found no mounts, expected where nozzles may be mounted");
    else if (own->count == 0 || (found.manual = sp_evaluate(opened->evaluator, own, error))) {
        cli_clock_stage(clock, "simulate");
        sp_place_options how = sp_scene_place_options(opened->scene);
        how.run = cli_run(options);
        how.run.time_limit = time_left(options, clock);
        how.memory = options->memory;
        how.prove = options->prove;
        found.proposal = sp_place(opened->evaluator, &how, error);
    }
    bool good = found.proposal && count_manual_again(opened, &found, error) && follow_liquid(opened, &found, error) &&
                measure_errors(opened, &found, error);
    good = good && (options->quiet || warn_of_own(opened, own, error));
    int status = good ? report(options, opened, &found, clock, error) : cli_fail_in(opened, error);
    sp_proposal_destroy(found.proposal);
    sp_coverage_destroy(found.manual);
    return status;
}

int cli_place(const cli_options *options)
{
    return cli_with_scene(options, true, place);
}
