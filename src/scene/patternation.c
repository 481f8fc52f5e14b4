/* image: of a measured type of the catalogue, or of a measured member of a cluster. */
#include "scene/state.h"

#include <sprayplan/image.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The scene's own where it was read before. */
static const sp_patternation *find(const sp_scene *scene, const char *path, double angle)
{
    for (size_t i = 0; i < scene->image_count; i++)
        if (scene->images[i].angle == angle && strcmp(scene->images[i].path, path) == 0)
            return scene->images[i].patternation;
    return NULL;
}

static sp_patternation *read_patternation(const char *path, double angle, sp_error *error)
{
    int width = 0, height = 0;
    float *values = sp_image_read(path, SP_PATTERNATION_COLUMNS, SP_PATTERNATION_ROWS, &width, &height, error);
    sp_patternation *patternation =
        values ? sp_patternation_create(values, (size_t)width, (size_t)height, angle, error) : NULL;
    free(values);
    return patternation;
}

/* Reads it for the scene, which then owns path and patternation. */
static const sp_patternation *add(sp_scene *scene, const sp_reader *reader, const sp_yaml *image, char *path,
                                  double angle)
{
    sp_scene_image *images = realloc(scene->images, (scene->image_count + 1) * sizeof *images);
    sp_error problem = {0};
    if (!images) {
        free(path);
        return sp_fail_memory(reader->error);
    }
    scene->images = images;
    sp_scene_image *added = &images[scene->image_count++];
    *added = (sp_scene_image){path, angle, read_patternation(path, angle, &problem)};
    if (!added->patternation && problem.kind == SP_ERROR_MEMORY)
        return sp_fail_memory(reader->error);
    if (!added->patternation)
        sp_read_message(
            reader, image, "image",
            "found '%.200s': %.200s; expected an image of liquid per solid angle, in one channel (a second, "
            "of exit speed, is not supported yet)",
            image->text, problem.message);
    return added->patternation;
}

bool sp_scene_read_image(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    const sp_yaml *image = sp_yaml_get(node, "image");
    if (type->pattern != SP_PATTERN_MEASURED)
        return true;
    char *directory = sp_path_directory(image->file, reader->error);
    char *path = directory ? sp_scene_file(directory, "the catalogue", reader, image, "image") : NULL;
    free(directory);
    if (!path)
        return false;
    if (strlen(image->text) >= sizeof type->image) {
        free(path);
        return sp_read_message(reader, image, "image", "found a path of %zu bytes, expected at most %zu",
                               strlen(image->text), sizeof type->image - 1);
    }
    snprintf(type->image, sizeof type->image, "%s", image->text);
    type->patternation = find(scene, path, type->angle);
    if (type->patternation)
        free(path);
    else
        type->patternation = add(scene, reader, image, path, type->angle);
    return type->patternation != NULL;
}
