/* Where a scene stands: the files that it was read from, and the lines of its settings. */
#include "scene/state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* All but the images of its catalogue. */
static size_t named_files(const sp_scene *scene)
{
    return 1 + sp_yaml_get(scene->tree, "geometry")->count + (sp_yaml_get(scene->tree, "catalogue") != NULL);
}

size_t sp_scene_file_count(const sp_scene *scene)
{
    return scene ? named_files(scene) + scene->image_count : 0;
}

char *sp_scene_file_path(const sp_scene *scene, size_t index, sp_error *error)
{
    if (index >= sp_scene_file_count(scene)) {
        sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "a scene has no file %zu", index);
        return NULL;
    }
    const char *known = index == 0                    ? scene->path
                        : index >= named_files(scene) ? scene->images[index - named_files(scene)].path
                                                      : NULL;
    if (known) {
        char *path = strdup(known);
        return path ? path : sp_fail_memory(error);
    }
    const sp_yaml *geometry = sp_yaml_get(scene->tree, "geometry")->first;
    while (geometry && --index > 0)
        geometry = geometry->next;
    const sp_yaml *file = geometry ? sp_yaml_get(geometry, "file") : sp_yaml_get(scene->tree, "catalogue");
    return sp_path_join(scene->directory, file->text, error);
}

/* The nozzle that a message "nozzles: NAME at [..." or "nozzles: NAME, of type '..." speaks of; the list where there is
 * none. */
static const sp_yaml *find_nozzle(const sp_yaml *list, const char *text)
{
    for (const sp_yaml *entry = list->first; entry; entry = entry->next) {
        const sp_yaml *name = sp_yaml_get(entry, "name");
        size_t size = name && name->text ? strlen(name->text) : 0;
        if (size && !strncmp(text, name->text, size) &&
            (!strncmp(text + size, " at [", 5) || !strncmp(text + size, ", of type '", 11)))
            return entry;
    }
    return list;
}

/* The entry of a list of types that a message "types: found 'NAME', ..." speaks of; NULL where there is none. */
static const sp_yaml *find_type(const sp_yaml *list, const char *message)
{
    for (const sp_yaml *entry = list ? list->first : NULL; entry; entry = entry->next) {
        char start[SP_NAME + 20];
        snprintf(start, sizeof start, "types: found '%.*s',", SP_NAME, entry->text);
        if (!strncmp(message, start, strlen(start)))
            return entry;
    }
    return NULL;
}

/* The same, of the types that may be placed, here or in an alternative, or of a port. */
static const sp_yaml *find_placed_type(const sp_yaml *place, const char *message)
{
    const sp_yaml *mounts = sp_yaml_get(place, "mounts"), *found = find_type(sp_yaml_get(place, "types"), message);
    for (const sp_yaml *mount = mounts ? mounts->first : NULL; mount && !found; mount = mount->next)
        found = find_type(sp_yaml_get(mount->first, "types"), message);
    const sp_yaml *alternatives = sp_yaml_get(place, "alternatives");
    for (const sp_yaml *other = alternatives ? alternatives->first : NULL; other && !found; other = other->next)
        found = find_type(sp_yaml_get(other, "types"), message);
    return found;
}

/* The mount that a message "mounts: KIND 'NAME' (number 1): ..." speaks of, among those that places choose by name as
 * well; the list where there is none. */
static const sp_yaml *find_mount(const sp_yaml *list, const char *message)
{
    size_t number = 0;
    for (const sp_yaml *entry = list->first; entry; entry = entry->next) {
        const sp_yaml *mount = entry->first, *name = sp_yaml_get(mount, "name");
        char start[SP_NAME + 80];
        number++;
        if (name)
            snprintf(start, sizeof start, "mounts: %s '%.*s' (", mount->key, SP_NAME, name->text);
        else
            snprintf(start, sizeof start, "mounts: %s (number %zu)", mount->key, number);
        if (!strncmp(message, start, strlen(start)))
            return entry;
    }
    return list;
}

/* The setting that a message "key: ..." speaks of, the scene as a whole where there is none. */
static const sp_yaml *find_setting(const sp_yaml *tree, const char *message)
{
    char key[40];
    size_t size = strcspn(message, ":");
    if (size >= sizeof key)
        return tree;
    memcpy(key, message, size);
    key[size] = '\0';
    const sp_yaml *found = sp_yaml_get(tree, key);
    if (found && !strcmp(key, "nozzles") && !strncmp(message + size, ": ", 2))
        found = find_nozzle(found, message + size + 2);
    if (!strcmp(key, "types"))
        found = find_placed_type(sp_yaml_get(tree, "place"), message);
    static const char *const blocks[] = {"criterion", "simulate", "place"};
    for (size_t i = 0; !found && i < sizeof blocks / sizeof *blocks; i++)
        found = sp_yaml_get(sp_yaml_get(tree, blocks[i]), key);
    if (found && !strcmp(key, "mounts"))
        found = find_mount(found, message);
    return found && found->file ? found : tree;
}

void sp_scene_locate(const sp_scene *scene, sp_error *error)
{
    bool input = error && (error->kind == SP_ERROR_INPUT || error->kind == SP_ERROR_UNSUPPORTED);
    if (!scene || !input || error->file[0] || error->line > 0)
        return;
    const sp_yaml *node = find_setting(scene->tree, error->message);
    snprintf(error->file, sizeof error->file, "%s", node->file);
    error->line = node->line;
    error->column = node->column;
}
