/* Everything that a command leaves in a folder. */
#include "scaled_files.h"
#include "sheet.h"

#include <sprayplan/report.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef bool writer(const sp_design *design, const sp_colour_scale *scale, const char *path, sp_error *error);

static bool deposits(const sp_design *design, const sp_colour_scale *scale, const char *path, sp_error *error)
{
    (void)scale;
    return sp_report_deposits_exr(design, path, error);
}

/* What is written of the main design alone: a manual one has its own from `simulate`. `shows`: patches as well. */
static bool write_main(const sp_design *design, bool shows, sp_output *output, sp_error *error)
{
    static const struct {
        const char *name;
        bool (*write)(const sp_design *design, const char *path, sp_error *error);
        bool shows;
    } files[] = {{"surface.vtp", sp_report_surface_vtp, true},
                 {"texels.vtp", sp_report_texels_vtp, true},
                 {"nozzles.stl", sp_report_nozzles_stl, false}};
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        if (files[i].shows && !shows)
            continue;
        const char *path = sp_output_path(output, files[i].name, error);
        if (!path || !files[i].write(design, path, error)) {
            sp_output_tell(output, error);
            return false;
        }
    }
    return true;
}

static bool write_design(const sp_design *design, const sp_colour_scale *scale, const char *suffix, sp_output *output,
                         sp_error *error)
{
    const struct {
        const char *name, *extension;
        writer *write;
    } files[] = {{"coverage", "png", sp_coverage_png}, {"deposits", "exr", deposits}, {"model", "glb", sp_model_glb}};
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        char name[64];
        snprintf(name, sizeof name, "%s%s.%s", files[i].name, suffix, files[i].extension);
        const char *path = sp_output_path(output, name, error);
        if (!path || !files[i].write(design, scale, path, error)) {
            sp_output_tell(output, error);
            return false;
        }
    }
    return true;
}

static bool write_text(sp_output *output, const char *name, char *text, sp_error *error)
{
    bool written = text && sp_output_text(output, name, text, error);
    free(text);
    return written;
}

/* The proposed design, or the only one; NULL where several are compared. Of the other alternatives there are scenes. */
static const sp_design *main_design(const sp_result *result)
{
    if (result->design_count == 1)
        return result->designs;
    if (sp_result_has_alternatives(result))
        return &result->designs[sp_result_proposed(result)];
    for (size_t i = 0; i < result->design_count; ++i)
        if (strcmp(result->designs[i].name, "proposed") == 0)
            return &result->designs[i];
    return NULL;
}

/* Of the main design; where more than one may be built, of all of these as well. */
static bool write_sheets(const sp_result *result, const sp_design *main, sp_output *output, sp_error *error)
{
    size_t count = 0;
    const char **names = malloc((result->design_count + 1) * sizeof *names);
    const sp_fitting_sheet **written = malloc((result->design_count + 1) * sizeof(sp_fitting_sheet *));
    sp_fitting_sheet **sheets = names && written ? sp_fitting_sheets_of(result, error) : sp_fail_memory(error);
    bool done = sheets != NULL;
    for (size_t i = 0; done && i < result->design_count; ++i) {
        if (!sheets[i])
            continue;
        names[count] = result->designs[i].name;
        written[count++] = sheets[i];
        if (main == &result->designs[i])
            done = write_text(output, "nozzles.csv", sp_nozzles_csv(sheets[i], error), error);
    }
    if (done && count > (main != NULL))
        done = write_text(output, SP_ALL_NOZZLES, sp_all_nozzles_csv(written, names, count, error), error);
    sp_fitting_sheets_destroy(sheets, result->design_count);
    free(written);
    free(names);
    return done;
}

static bool write_designs(const sp_result *result, const sp_design *main, sp_output *output, sp_error *error)
{
    bool shows = result->picture_share >= 0;
    sp_colour_scale scale = sp_colour_scale_of(result->designs, result->design_count, result->style);
    for (size_t i = 0; i < result->design_count; ++i) {
        const sp_design *design = &result->designs[i];
        const char *suffix = design == main                        ? ""
                             : strcmp(design->name, "manual") == 0 ? "-manual"
                             : strcmp(design->name, "greedy") == 0 ? "-greedy"
                                                                   : NULL;
        if (shows && design->evaluator && suffix && !write_design(design, &scale, suffix, output, error))
            return false;
    }
    if (!main || !main->evaluator)
        return true;
    return write_text(output, "swabs.csv", sp_swabs_csv(main, error), error) && write_main(main, shows, output, error);
}

bool sp_report_write(const sp_result *result, sp_output *output, sp_error *error)
{
    if (!result || !output)
        return false;
    bool compared = strcmp(result->command, "compare") == 0;
    const sp_design *main = compared ? NULL : main_design(result);
    return write_text(output, "result.json", sp_result_json(result, error), error) &&
           (compared || write_designs(result, main, output, error)) && write_sheets(result, main, output, error) &&
           write_text(output, "report.html", sp_report_html(result, error), error);
}
