/* What it costs to consider a pose: the seconds that a placement spends on tracing what its mounting points reach and
 * on its greedy rounds over all poses, per pose, against the seconds of simulating one nozzle. Uses two threads, or as
 * many as the second argument says. */
#include <sprayplan/sprayplan.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Mean seconds of simulating one nozzle of each type that the placement may choose, at every position and axis of the
 * scene's own nozzles and the proposal's; negative on error. */
static double simulate_each(const sp_evaluator *evaluator, const sp_place_options *options, const sp_layout *places,
                            size_t *count, sp_error *error)
{
    double start = now();
    *count = 0;
    for (size_t i = 0; i < places->count; i++)
        for (size_t t = 0; t < options->type_count; t++) {
            sp_nozzle nozzle = {.type = options->types[t],
                                .position = places->nozzles[i].position,
                                .axis = places->nozzles[i].axis,
                                .pressure = options->pressures[0]};
            sp_layout *layout = sp_layout_create(&nozzle, 1, error);
            sp_coverage *coverage = sp_evaluate(evaluator, layout, error);
            bool done = coverage != NULL;
            sp_coverage_destroy(coverage);
            sp_layout_destroy(layout);
            if (!done)
                return -1;
            ++*count;
        }
    return (now() - start) / (double)*count;
}

static double stage_of(const sp_proposal *proposal, const char *name)
{
    for (size_t i = 0; i < proposal->stage_count; i++)
        if (!strcmp(proposal->stages[i].name, name))
            return proposal->stages[i].seconds;
    return 0;
}

static bool compare(const sp_scene *scene, int threads, sp_error *error)
{
    sp_setup setup = *sp_scene_setup(scene);
    sp_place_options options = sp_scene_place_options(scene);
    options.refine = (sp_refine){0};
    options.run.threads = setup.run.threads = threads;
    double start = now();
    sp_evaluator *evaluator = sp_evaluator_create(&setup, error);
    double built = now() - start;
    start = now();
    sp_proposal *proposal = sp_place(evaluator, &options, error);
    double placed = now() - start, each = -1;
    size_t count = 0;
    if (proposal)
        each = simulate_each(evaluator, &options, proposal->layout, &count, error);
    if (each > 0) {
        double visibility = stage_of(proposal, "visibility"), greedy = stage_of(proposal, "greedy");
        double cost = (visibility + greedy) / (double)proposal->candidates;
        printf("%zu positions, %zu poses, %d threads\n", proposal->positions, proposal->candidates, threads);
        printf("atlas and accelerator %.2f s, placement without refinement %.2f s\n", built, placed);
        printf("visibility %.2f s and greedy %.2f s: %.3g s a pose\n", visibility, greedy, cost);
        printf("simulating one nozzle: %.3g s (mean of %zu), %.0f times as much\n", each, count, each / cost);
    }
    sp_proposal_destroy(proposal);
    sp_evaluator_destroy(evaluator);
    return each > 0;
}

int main(int count, char **arguments)
{
    if (count < 2 || count > 3) {
        fprintf(stderr, "usage: pose_cost SCENE [THREADS]\n");
        return 2;
    }
    sp_error error = {0};
    int threads = count > 2 ? atoi(arguments[2]) : 2;
    sp_scene *scene = sp_scene_load(arguments[1], &error);
    bool done = scene && compare(scene, threads > 0 ? threads : 2, &error);
    if (!done)
        fprintf(stderr, "%s\n", error.message);
    sp_scene_destroy(scene);
    return done ? 0 : 1;
}
