/* sprayplan study: speed against accuracy on one scene. */
#include "cli.h"

#include <stdlib.h>

static bool add_file(sp_output *output, const char *name, char *text, sp_error *error)
{
    bool good = text && sp_output_text(output, name, text, error);
    free(text);
    return good;
}

static bool write_files(const cli_options *options, const sp_scene *scene, const sp_study *study, sp_error *error)
{
    if (!options->output)
        return true;
    const char *path = cli_input_name(options->inputs[0]);
    sp_output *output = cli_output_open(options, options->output, &scene, 1, error);
    bool good = output && sp_output_supersede(output, error) &&
                add_file(output, "study.json", sp_study_json(study, path, error), error) &&
                (study->run_count == 0 || add_file(output, "study.csv", sp_study_csv(study, error), error)) &&
                (study->place_count == 0 || add_file(output, "place.csv", sp_study_place_csv(study, error), error)) &&
                add_file(output, "report.html", sp_study_html(study, path, error), error);
    if (good)
        return sp_output_commit(output, error);
    sp_output_discard(output);
    return false;
}

static bool print_json(const cli_options *options, const sp_study *study, sp_error *error)
{
    char *text = sp_study_json(study, cli_input_name(options->inputs[0]), error);
    if (text)
        fputs(text, stdout);
    free(text);
    return text != NULL;
}

static bool print(const cli_options *options, const sp_study *study, sp_error *error)
{
    cli_progress_end();
    if (options->json)
        return print_json(options, study, error);
    char *text = options->quiet ? NULL : sp_study_text(study, error);
    if (text)
        fputs(text, stdout);
    free(text);
    return options->quiet || text;
}

static sp_study *measure(const cli_options *options, const sp_scene *scene, sp_error *error)
{
    bool place = sp_scene_has_place(scene);
    sp_place_options placing = sp_scene_place_options(scene);
    sp_study_options how = {.run = cli_run(options), .meter_start = cli_meter_start, .meter_peak = cli_meter_peak};
    sp_study *study =
        sp_study_create(sp_scene_setup(scene), sp_scene_layout(scene), place ? &placing : NULL, &how, error);
    if (!study)
        sp_scene_locate(scene, error);
    return study;
}

int cli_study(const cli_options *options)
{
    sp_error error = {0};
    static const char *const stages[] = {"geometry", "reference", "runs", "report", NULL};
    static const char *const all_stages[] = {"geometry", "reference", "runs", "place", "report", NULL};
    const sp_run run = cli_run(options);
    cli_progress_plan(stages, 0, 0, 1);
    cli_progress_stage(options, "geometry");
    sp_scene *scene = cli_load_scene(options->inputs[0], options, &run, &error);
    static const char *const files[] = {"study.json", "study.csv", "place.csv", "report.html", NULL};
    if (sp_scene_has_place(scene))
        cli_progress_plan(all_stages, 0, 0, 1);
    bool ready = scene && cli_output_ready(options, scene, files, &error);
    sp_study *study = ready ? measure(options, scene, &error) : NULL;
    cli_progress_stage(options, "report");
    bool good = study && write_files(options, scene, study, &error) && print(options, study, &error);
    int status = !good ? cli_fail(&error) : study->interrupted && cli_interrupted() ? EXIT_INTERRUPTED : EXIT_DONE;
    if (good && study->interrupted)
        fprintf(stderr, "sprayplan: %s; this is what there is so far\n",
                cli_interrupted() ? "interrupted" : "the time is over");
    sp_study_destroy(study);
    sp_scene_destroy(scene);
    return status;
}
