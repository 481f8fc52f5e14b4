/* image: of a measured type of the catalogue, or of a measured member of a cluster. */
#include "nozzle/layers.h"
#include "scene/state.h"

#include <sprayplan/image.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The scene's own where it was read before. */
static const sp_scene_image *find(const sp_scene *scene, const char *path, double angle)
{
    for (size_t i = 0; i < scene->image_count; i++)
        if (scene->images[i].angle == angle && strcmp(scene->images[i].path, path) == 0)
            return &scene->images[i];
    return NULL;
}

/* One channel of two. */
static float *channel_of(const sp_image *image, int channel, sp_error *error)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    float *own = malloc(count * sizeof *own);
    for (size_t i = 0; own && i < count; i++)
        own[i] = image->values[i * (size_t)image->channels + (size_t)channel];
    return own ? own : sp_fail_memory(error);
}

static size_t make_layers(const sp_image *image, double angle, sp_speed_layer *layers, sp_error *error)
{
    size_t columns = (size_t)image->width, rows = (size_t)image->height, count = 0;
    if (image->channels == 1) {
        layers[0] = (sp_speed_layer){sp_patternation_create(image->values, columns, rows, angle, error), 1, 1};
        return layers[0].patternation != NULL;
    }
    float *liquid = channel_of(image, 0, error), *speeds = liquid ? channel_of(image, 1, error) : NULL;
    if (speeds)
        count = sp_patternation_layers(liquid, speeds, columns, rows, angle, layers, error);
    free(liquid);
    free(speeds);
    return count;
}

static bool read_layers(sp_scene_image *own, sp_error *error)
{
    static const char *const names[2] = {"liquid", "speed"};
    sp_image image = sp_image_read(own->path, SP_PATTERNATION_COLUMNS, SP_PATTERNATION_ROWS, names, error);
    own->speeds = image.channels == 2;
    if (image.values)
        own->layer_count = make_layers(&image, own->angle, own->layers, error);
    free(image.values);
    return own->layer_count > 0;
}

/* Reads it for the scene, which then owns path and patternations. */
static const sp_scene_image *add(sp_scene *scene, const sp_reader *reader, const sp_yaml *image, char *path,
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
    *added = (sp_scene_image){.path = path, .angle = angle};
    if (read_layers(added, &problem))
        return added;
    if (problem.kind == SP_ERROR_MEMORY)
        return sp_fail_memory(reader->error);
    sp_read_message(reader, image, "image",
                    "found '%.200s': %.200s; expected an image of liquid per solid angle, and perhaps of its speed as "
                    "a second channel",
                    image->text, problem.message);
    return NULL;
}

bool sp_scene_read_image(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    const sp_yaml *image = sp_yaml_get(node, "image");
    if (!sp_type_is_measured(type))
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
    const sp_scene_image *own = find(scene, path, type->angle);
    if (own)
        free(path);
    else
        own = add(scene, reader, image, path, type->angle);
    if (own && own->speeds)
        return sp_type_take_layers(type, own->layers, own->layer_count, reader->error);
    type->patternation = own ? own->layers[0].patternation : NULL;
    return own != NULL;
}
