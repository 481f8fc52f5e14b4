/* Everything that a command leaves in a folder. */
#include "scaled_files.h"

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

/* What is written of the main design alone: a manual one has its own from `simulate`. */
static bool write_main(const sp_design *design, sp_output *output, sp_error *error)
{
    static const struct {
        const char *name;
        bool (*write)(const sp_design *design, const char *path, sp_error *error);
    } files[] = {{"surface.vtp", sp_report_surface_vtp},
                 {"texels.vtp", sp_report_texels_vtp},
                 {"nozzles.stl", sp_report_nozzles_stl}};
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
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

static char *nozzles_csv(const sp_design *design, sp_error *error)
{
    sp_fitting_sheet *sheet = sp_fitting_sheet_create(design->layout, sp_evaluator_setup(design->evaluator),
                                                      design->mounts, design->mount_count, error);
    char *text = sheet ? sp_nozzles_csv(sheet, error) : NULL;
    sp_fitting_sheet_destroy(sheet);
    return text;
}

static bool write_designs(const sp_result *result, const sp_design *main, sp_output *output, sp_error *error)
{
    sp_colour_scale scale = sp_colour_scale_of(result->designs, result->design_count, result->style);
    for (size_t i = 0; i < result->design_count; ++i) {
        const sp_design *design = &result->designs[i];
        const char *suffix = design == main                        ? ""
                             : strcmp(design->name, "manual") == 0 ? "-manual"
                             : strcmp(design->name, "greedy") == 0 ? "-greedy"
                                                                   : NULL;
        if (design->evaluator && suffix && !write_design(design, &scale, suffix, output, error))
            return false;
    }
    if (!main || !main->evaluator)
        return true;
    return write_text(output, "nozzles.csv", nozzles_csv(main, error), error) &&
           write_text(output, "swabs.csv", sp_swabs_csv(main, error), error) && write_main(main, output, error);
}

bool sp_report_write(const sp_result *result, sp_output *output, sp_error *error)
{
    bool compared = strcmp(result->command, "compare") == 0;
    return write_text(output, "result.json", sp_result_json(result, error), error) &&
           (compared || write_designs(result, main_design(result), output, error)) &&
           write_text(output, "report.html", sp_report_html(result, error), error);
}
