/* What a command leaves in a folder. */
#include "cli.h"

#include <stdlib.h>
#include <string.h>

const char *const cli_result_files[] = {
    "result.json",  "report.html",  "layout.yaml", "nozzles.csv", "nozzles-all.csv", "nozzles.stl", "swabs.csv",
    "coverage.png", "deposits.exr", "model.glb",   "surface.vtp", "texels.vtp",      NULL};

void cli_layout_name(size_t alternative, char name[CLI_LAYOUT_NAME])
{
    snprintf(name, CLI_LAYOUT_NAME, "layout-%zu.yaml", alternative + 1);
}

static bool protect_scene(const sp_scene *scene, sp_output *output, sp_error *error)
{
    bool good = true;
    for (size_t i = 0; i < sp_scene_file_count(scene) && good; i++) {
        char *path = sp_scene_file_path(scene, i, error);
        good = path && sp_output_protect(output, path, error);
        free(path);
    }
    return good;
}

bool cli_names_obj(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
    return dot && dot != name && !strcmp(dot, ".obj");
}

char *cli_folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    size_t length = slash ? (size_t)(slash - path) : 0;
    return slash ? strndup(path, length ? length : 1) : strdup(".");
}

sp_output *cli_output_open(const cli_options *options, const char *folder, const sp_scene *const *scenes, int count,
                           sp_error *error)
{
    sp_output *output = sp_output_open(folder, error);
    bool good = output != NULL;
    for (int i = 0; i < options->input_count && good; i++)
        good = sp_output_protect(output, cli_input_path(options->inputs[i]), error);
    for (int i = 0; i < count && good; i++)
        good = protect_scene(scenes[i], output, error);
    if (good)
        return output;
    sp_output_discard(output);
    return NULL;
}

bool cli_output_ready(const cli_options *options, const sp_scene *scene, const char *const *names, sp_error *error)
{
    if (!options->output)
        return true;
    sp_output *output = cli_output_open(options, options->output, &scene, 1, error);
    bool good = output != NULL;
    for (; *names && good; names++)
        good = !strncmp(*names, "layout", 6) ? sp_output_may_replace(output, *names, options->force, error)
                                             : sp_output_path(output, *names, error) != NULL;
    sp_output_discard(output);
    return good;
}

static bool write_layout(const cli_options *options, const sp_scene *scene, const sp_design *design, const char *name,
                         sp_output *output, sp_error *error)
{
    const sp_fidelity *fidelity = sp_evaluator_fidelity(design->evaluator);
    char *text = sp_scene_text(scene, design->layout, fidelity, options->output, error);
    bool good = text && sp_output_scene(output, name, text, options->force, error);
    free(text);
    return good;
}

/* Whose place in the scene its file is called after. */
static size_t alternative_named(const sp_scene *scene, const char *name)
{
    size_t at = 0;
    while (strcmp(sp_scene_alternative_name(scene, at), name) != 0)
        at++;
    return at;
}

/* The main layout, and those of the alternatives that it was chosen from. */
static bool write_layouts(const cli_options *options, const sp_result *result, const sp_scene *scene,
                          const sp_layout *layout, sp_output *output, sp_error *error)
{
    bool good = true;
    for (size_t i = 0; good && i < result->design_count; i++) {
        const sp_design *design = &result->designs[i];
        char name[CLI_LAYOUT_NAME];
        if (design->layout == layout) {
            good = write_layout(options, scene, design, "layout.yaml", output, error);
        } else if (design->alternative) {
            cli_layout_name(alternative_named(scene, design->name), name);
            good = write_layout(options, scene, design, name, output, error);
        }
    }
    return good;
}

/* All but the layouts; where there is a layout, time for it, and nobody minds, the page evaluates changed ones. */
static bool write_report(const cli_options *options, const sp_result *result, const sp_scene *const *scenes,
                         const sp_layout *layout, sp_output *output, sp_error *error)
{
    if (!layout || options->no_live || result->picture_share < 0)
        return sp_report_write(result, output, error);
    size_t own = 0;
    while (own + 1 < result->design_count && result->designs[own].layout != layout)
        own++;
    const sp_fidelity *fidelity = sp_evaluator_fidelity(result->designs[own].evaluator);
    char *text = sp_scene_text(scenes[0], layout, fidelity, options->output, error);
    sp_editing editing = {.options = sp_scene_place_options(scenes[0]), .scene = text};
    sp_result edited = *result;
    edited.editing = &editing;
    bool good = text && sp_report_write(&edited, output, error);
    free(text);
    return good;
}

bool cli_write(const cli_options *options, const sp_result *result, const sp_scene *const *scenes,
               const sp_layout *layout, char **written, sp_error *error)
{
    if (!options->output)
        return true;
    sp_output *output = cli_output_open(options, options->output, scenes, options->input_count, error);
    bool good =
        output && sp_output_supersede(output, error) && write_report(options, result, scenes, layout, output, error);
    good = good && (!layout || write_layouts(options, result, scenes[0], layout, output, error));
    if (good)
        return cli_commit(output, options->output, written, error);
    sp_output_discard(output);
    return false;
}

bool cli_write_wet(const cli_options *options, const cli_scene *opened, sp_error *error)
{
    if (!options->output)
        return true;
    const sp_scene *scene = opened->scene;
    sp_output *output = cli_output_open(options, options->output, &scene, 1, error);
    const char *path = output ? sp_output_path(output, "wet.png", error) : NULL;
    if (path && sp_report_wet_png(opened->evaluator, path, error))
        return sp_output_commit(output, error);
    sp_output_tell(output, error);
    sp_output_discard(output);
    return false;
}
