/* sprayplan compare: scenes and results side by side. */
#include "cli.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* One input of the command line: a scene that is evaluated, or the figures of a result.json. */
typedef struct {
    cli_scene opened; /* of a result, no more than that it was read */
    sp_coverage *coverage;
    sp_figures *figures;
    size_t figure_count;
} compared;

typedef struct {
    cli_options options;     /* with the result in place of a folder */
    compared *inputs;        /* [input_count] */
    const sp_scene **scenes; /* [input_count], NULL for a result */
    char *files[CLI_INPUTS_MOST];
    cli_inputs read;
    sp_design *designs;
    char **names; /* of the designs, where a result holds several */
    size_t design_count;
    const sp_figures **read_figures; /* [design_count], as they were read; NULL of scenes */
    sp_figures *shared;              /* [design_count], of those that show what another run found; they borrow all */
    cli_clock clock;
} comparison;

/* A folder that a run left stands for the result in it. Malloc'd; NULL with an error. */
static char *file_of(const char *path, sp_error *error)
{
    static const char name[] = "result.json";
    struct stat status;
    bool folder = !cli_is_standard_input(path) && stat(path, &status) == 0 && S_ISDIR(status.st_mode);
    size_t length = strlen(path), size = length + sizeof name + 1;
    char *file = malloc(size);
    if (!file) {
        sp_fail_memory(error);
        return NULL;
    }
    const char *slash = folder && path[length - 1] != '/' ? "/" : "";
    snprintf(file, size, "%s%s%s", path, slash, folder ? name : "");
    if (!folder || access(file, F_OK) == 0)
        return file;
    free(file);
    sp_fail(error, SP_ERROR_INPUT, path, 0, 0,
            "found a folder without a result.json, expected a scene, a result.json, or the folder of one");
    return NULL;
}

static bool find_files(comparison *all, sp_error *error)
{
    for (int i = 0; i < all->options.input_count; i++)
        if (!(all->options.inputs[i] = all->files[i] = file_of(all->options.inputs[i], error)))
            return false;
    return true;
}

static bool is_result(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && !strcasecmp(dot, ".json");
}

static bool open_input(compared *input, const char *path, const cli_options *options, cli_clock *clock, sp_error *error)
{
    if (is_result(path)) {
        input->figures = sp_figures_read(path, &input->figure_count, error);
        return input->figures && cli_inputs_add(&input->opened.inputs, path, error);
    }
    if (!cli_scene_open(&input->opened, path, options, true, clock, error))
        return false;
    const sp_layout *layout = sp_scene_layout(input->opened.scene);
    if (layout->count == 0) {
        sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "nozzles: found none, expected at least one to compare");
        sp_scene_locate(input->opened.scene, error);
        return false;
    }
    cli_progress_stage(options, "simulate");
    input->coverage = cli_simulated(&input->opened, layout, error);
    cli_clock_stage(clock, "simulate");
    cli_progress_stage(options, "measured error");
    bool good = cli_measure(input->opened.evaluator, layout, input->coverage, error);
    cli_clock_stage(clock, "measured error");
    if (!good)
        sp_scene_locate(input->opened.scene, error);
    return good;
}

static char *name_of(const char *path, const char *layout)
{
    size_t size = strlen(path) + strlen(layout) + 4;
    char *name = malloc(size);
    if (name)
        snprintf(name, size, *layout ? "%s (%s)" : "%s", path, layout);
    return name;
}

static bool add_design(comparison *all, sp_design design, const char *path, const char *layout, sp_error *error)
{
    char *name = name_of(path, layout);
    if (!name)
        return sp_fail_memory(error);
    design.name = all->names[all->design_count] = name;
    all->read_figures[all->design_count] = design.figures;
    all->designs[all->design_count++] = design;
    return true;
}

static bool add_input(comparison *all, const compared *input, const char *path, sp_error *error)
{
    if (!input->figures) {
        const sp_layout *layout = sp_scene_layout(input->opened.scene);
        return add_design(all, cli_design(&input->opened, "", input->opened.evaluator, layout, input->coverage), path,
                          "", error);
    }
    for (size_t i = 0; i < input->figure_count; i++)
        if (!add_design(all, (sp_design){.figures = &input->figures[i]}, path,
                        input->figure_count > 1 ? input->figures[i].name : "", error))
            return false;
    return true;
}

static bool list_designs(comparison *all, const cli_options *options, sp_error *error)
{
    size_t most = 0;
    for (int i = 0; i < options->input_count; i++)
        most += 1 + all->inputs[i].figure_count;
    all->designs = calloc(most, sizeof *all->designs);
    all->names = calloc(most, sizeof *all->names);
    all->read_figures = calloc(most, sizeof *all->read_figures);
    if (!all->designs || !all->names || !all->read_figures)
        return sp_fail_memory(error);
    for (int i = 0; i < options->input_count; i++)
        if (!add_input(all, &all->inputs[i], cli_input_name(options->inputs[i]), error))
            return false;
    return true;
}

static bool same_nozzle(const sp_nozzle_figures *a, const sp_nozzle_figures *b)
{
    const double *x = &a->position.x, *y = &b->position.x, *u = &a->axis.x, *v = &b->axis.x;
    bool same = !strcmp(a->type, b->type) && a->roll == b->roll && a->angle == b->angle && a->pressure == b->pressure &&
                a->flow == b->flow && a->speed == b->speed;
    for (int k = 0; k < 3; k++)
        same = same && x[k] == y[k] && u[k] == v[k];
    return same;
}

/* The same nozzles in the same geometry, asked for the same and counted the same way but on texels of their own, and
 * told apart by no more than their errors: what else may differ, such as the liquid, would show. */
static bool same_layout(const sp_figures *a, const sp_figures *b)
{
    bool same = a->nozzle_count == b->nozzle_count && a->nozzle_count > 0 && a->triangles == b->triangles &&
                a->area == b->area && !strcmp(a->trajectory, b->trajectory) && !strcmp(a->evaluator, b->evaluator) &&
                a->reflections == b->reflections && a->criterion_known && sp_same_criterion(a, b) &&
                fabs(a->coverage - b->coverage) <= a->error_estimate + b->error_estimate;
    for (size_t i = 0; same && i < a->nozzle_count; i++)
        same = same_nozzle(&a->nozzles[i], &b->nozzles[i]);
    return same;
}

/* What one run found of a layout, as far as that is of the layout alone: what is out of reach follows from the places
 * that a run allows. */
static sp_figures found_by(const sp_figures *other, const sp_figures *own)
{
    sp_figures figures = *other;
    figures.name = own->name;
    figures.attainable_area = own->attainable_area;
    memcpy(figures.missing_area, own->missing_area, sizeof figures.missing_area);
    figures.missing_count = own->missing_count;
    figures.missing = own->missing;
    figures.shadows_known = own->shadows_known;
    figures.shadow_count = own->shadow_count;
    figures.shadows = own->shadows;
    figures.of_attainable = own->attainable_area > 0 ? fmin(other->covered_area / own->attainable_area, 1) : NAN;
    return figures;
}

/* One layout has one figure, whichever run it is read from: that of the run with the least error. */
static bool share_figures(comparison *all, sp_error *error)
{
    all->shared = calloc(all->design_count + 1, sizeof *all->shared);
    if (!all->shared)
        return sp_fail_memory(error);
    for (size_t i = 0; i < all->design_count; i++) {
        const sp_figures *own = all->designs[i].figures, *best = own;
        for (size_t k = 0; own && k < all->design_count; k++) {
            const sp_figures *other = all->read_figures[k];
            if (other && other->coverage != own->coverage && same_layout(own, other) &&
                other->error_estimate < best->error_estimate)
                best = other;
        }
        if (best == own)
            continue;
        all->shared[i] = found_by(best, own);
        all->designs[i].figures = &all->shared[i];
    }
    return true;
}

static bool compare(comparison *all, sp_error *error)
{
    const cli_options *options = &all->options;
    if (!find_files(all, error))
        return false;
    all->inputs = calloc((size_t)options->input_count, sizeof *all->inputs);
    all->scenes = calloc((size_t)options->input_count, sizeof *all->scenes);
    if (!all->inputs || !all->scenes)
        return sp_fail_memory(error);
    static const char *const files[] = {"result.json", "report.html", "nozzles-all.csv", NULL};
    if (!cli_output_ready(options, NULL, files, error))
        return false;
    cli_progress_plan(cli_evaluation_stages, 0, 4, (size_t)options->input_count);
    for (int i = 0; i < options->input_count; i++) {
        cli_progress_round((size_t)i);
        if (!open_input(&all->inputs[i], options->inputs[i], options, &all->clock, error) ||
            !cli_inputs_join(&all->read, &all->inputs[i].opened.inputs, error))
            return false;
    }
    for (int i = 0; i < options->input_count; i++)
        all->scenes[i] = all->inputs[i].opened.scene;
    if (!list_designs(all, options, error))
        return false;
    if (!share_figures(all, error))
        return false;
    sp_result result = {.command = "compare",
                        .scene = cli_input_name(options->inputs[0]),
                        .design_count = all->design_count,
                        .designs = all->designs,
                        .stage_count = all->clock.count,
                        .stages = all->clock.stages};
    cli_progress_stage(options, "report");
    return cli_report(options, &result, all->scenes, &all->read, NULL, error);
}

int cli_compare(const cli_options *options)
{
    sp_error error = {0};
    comparison all = {.options = *options};
    cli_clock_start(&all.clock);
    bool good = compare(&all, &error);
    for (int i = 0; all.inputs && i < options->input_count; i++) {
        sp_coverage_destroy(all.inputs[i].coverage);
        cli_scene_close(&all.inputs[i].opened);
        sp_figures_destroy(all.inputs[i].figures, all.inputs[i].figure_count);
    }
    for (size_t i = 0; i < all.design_count; i++)
        free(all.names[i]);
    for (int i = 0; i < options->input_count; i++)
        free(all.files[i]);
    free(all.names);
    free(all.read_figures);
    free(all.shared);
    free(all.designs);
    free(all.scenes);
    cli_inputs_free(&all.read);
    free(all.inputs);
    return good ? cli_done() : cli_fail(&error);
}
