/* Loading a scene, and what it hands out. */
#include "scene/locale.h"
#include "scene/state.h"

#include <stdlib.h>
#include <string.h>

bool sp_scene_read(sp_scene *scene, const sp_reader *reader)
{
    const sp_fields in = {reader, &sp_block_scene, scene->tree};
    bool good = sp_read_block(&in, "scene") && sp_scene_read_physics(scene, reader) &&
                sp_scene_read_datum(scene, reader) && sp_scene_read_catalogue(scene, reader) &&
                sp_scene_read_nozzles(scene, reader) && sp_scene_read_simulate(scene, reader) &&
                sp_scene_read_geometry(scene, reader) && sp_scene_read_place(scene, reader) &&
                sp_scene_read_report(scene, reader);
    scene->setup.mesh = scene->mesh;
    scene->setup.surfaces = scene->surfaces;
    scene->setup.caps = scene->caps;
    return good;
}

/* From the stream, where there is one: it lies in no folder but the working directory. */
static bool load(sp_scene *scene, FILE *stream, const char *path, const char *const *overrides, size_t count,
                 sp_error *error)
{
    scene->path = strdup(path);
    if (!scene->path)
        return sp_fail_memory(error);
    scene->streamed = stream != NULL;
    scene->directory = sp_path_directory(stream ? "." : path, error);
    if (scene->directory)
        scene->tree = stream ? sp_yaml_load_stream(stream, path, error) : sp_yaml_load(path, error);
    if (!scene->tree)
        return false;
    sp_units *units = sp_units_create(error);
    sp_reader reader = {units, error};
    bool good = units != NULL;
    if (good && scene->tree->kind != SP_YAML_MAP)
        good = sp_read_fail(&reader, scene->tree, "scene", "keys and values, such as geometry: ...");
    for (size_t i = 0; good && i < count; i++)
        good = sp_scene_override(scene->tree, overrides[i], error);
    good = good && sp_scene_read(scene, &reader);
    sp_units_destroy(units);
    return good;
}

static sp_scene *load_from(FILE *stream, const char *path, const char *const *overrides, size_t count,
                           const sp_run *run, sp_error *error)
{
    sp_error local = {0}, *kept = error ? error : &local;
    sp_locale change;
    if (!path) {
        sp_fail(kept, SP_ERROR_ARGUMENT, NULL, 0, 0, "a scene needs a path");
        return NULL;
    }
    sp_scene *scene = calloc(1, sizeof *scene);
    if (!scene)
        return sp_fail_memory(kept);
    scene->setup = sp_setup_default();
    if (run)
        scene->run = *run;
    scene->place = sp_place_options_default();
    bool entered = sp_locale_enter(&change, kept);
    bool good = entered && load(scene, stream, path, overrides, count, kept);
    if (entered)
        sp_locale_leave(&change);
    if (good)
        return scene;
    sp_scene_destroy(scene);
    return NULL;
}

sp_scene *sp_scene_load_with(const char *path, const char *const *overrides, size_t count, const sp_run *run,
                             sp_error *error)
{
    return load_from(NULL, path, overrides, count, run, error);
}

sp_scene *sp_scene_load_stream(FILE *stream, const char *name, const char *const *overrides, size_t count,
                               const sp_run *run, sp_error *error)
{
    return load_from(stream, name, overrides, count, run, error);
}

sp_scene *sp_scene_load(const char *path, sp_error *error)
{
    return sp_scene_load_with(path, NULL, 0, NULL, error);
}

void sp_scene_destroy(sp_scene *scene)
{
    if (!scene)
        return;
    sp_scene_free_alternatives(scene);
    for (size_t i = 0; scene->mount_types && i < scene->mount_count; i++)
        free(scene->mount_types[i]);
    free(scene->mount_types);
    free(scene->mounts);
    free(scene->pressures);
    free(scene->place_types);
    sp_layout_destroy(scene->layout);
    for (size_t i = 0; i < scene->type_count; i++)
        free(scene->types[i].members);
    free(scene->types);
    for (size_t i = 0; i < scene->image_count; i++) {
        free(scene->images[i].path);
        for (size_t k = 0; k < scene->images[i].layer_count; k++)
            sp_patternation_destroy(scene->images[i].layers[k].patternation);
    }
    free(scene->images);
    free(scene->caps);
    sp_mesh_destroy(scene->mesh);
    free(scene->surfaces);
    free(scene->cads);
    free(scene->file_units);
    for (size_t i = 0; scene->unfolded && i < scene->cad_count; i++)
        sp_unfolding_destroy(scene->unfolded[i]);
    free(scene->unfolded);
    sp_yaml_destroy(scene->tree);
    free(scene->directory);
    free(scene->path);
    free(scene);
}

const char *sp_scene_path(const sp_scene *scene)
{
    return scene ? scene->path : NULL;
}
const sp_setup *sp_scene_setup(const sp_scene *scene)
{
    return scene ? &scene->setup : NULL;
}
const sp_layout *sp_scene_layout(const sp_scene *scene)
{
    return scene ? scene->layout : NULL;
}
sp_place_options sp_scene_place_options(const sp_scene *scene)
{
    return scene ? scene->place : sp_place_options_default();
}
const sp_cad_account *sp_scene_cad(const sp_scene *scene, size_t geometry)
{
    return scene && geometry < scene->cad_count && scene->cads[geometry].triangles ? &scene->cads[geometry] : NULL;
}

double sp_scene_file_unit(const sp_scene *scene, size_t geometry)
{
    return scene && geometry < scene->cad_count ? scene->file_units[geometry] : 0;
}
sp_picture_style sp_scene_picture_style(const sp_scene *scene)
{
    return scene ? scene->style : (sp_picture_style){0};
}

bool sp_scene_has_place(const sp_scene *scene)
{
    return scene && scene->mount_count > 0;
}

bool sp_scene_lists_nozzles(const sp_scene *scene)
{
    return scene && sp_yaml_get(scene->tree, "nozzles");
}

static bool parse_quantity(const char *text, const char *unit, double *value, sp_error *error)
{
    sp_units *units = sp_units_create(error);
    if (!units)
        return false;
    bool bare = strcmp(unit, "m") == 0 || strcmp(unit, "1") == 0 || !unit[0];
    sp_dimension dimension = {"a quantity", unit[0] ? unit : "1", "", bare};
    char why[200];
    bool good = sp_units_read(units, text, &dimension, value, why, sizeof why);
    if (!good)
        sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "found '%.80s', expected a number %s%s%s%s", text,
                unit[0] && strcmp(unit, "1") != 0 ? "and a unit that measures the same as " : "without unit",
                strcmp(unit, "1") != 0 ? unit : "", why[0] ? ": " : "", why);
    sp_units_destroy(units);
    return good;
}

bool sp_quantity_parse(const char *text, const char *unit, double *value, sp_error *error)
{
    sp_locale change;
    if (!text || !unit || !value)
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "a quantity needs a text, a unit and a place to go to");
    if (!sp_locale_enter(&change, error))
        return false;
    bool good = parse_quantity(text, unit, value, error);
    sp_locale_leave(&change);
    return good;
}
