/* Settings given beside the file: "simulate.jets=20000". */
#include "scene/state.h"

#include <stdlib.h>
#include <string.h>

static bool fail(const char *setting, const char *message, sp_error *error)
{
    return sp_fail(error, SP_ERROR_INPUT, setting, 0, 0, "%s", message);
}

/* An override has no lines of its own to point at. */
static void forget_places(sp_yaml *node)
{
    node->line = node->column = node->key_line = node->key_column = 0;
    for (sp_yaml *child = node->first; child; child = child->next)
        forget_places(child);
}

/* The block called `key` in `map`, made where there is none or nothing in it. */
static sp_yaml *enter(sp_yaml *map, const char *key, const char *setting, sp_error *error)
{
    sp_yaml *child = sp_yaml_get(map, key);
    if (child && child->kind == SP_YAML_MAP)
        return child;
    if (child && !child->empty) {
        fail(setting, "found a key below one that has a single value, expected a block there", error);
        return NULL;
    }
    child = sp_yaml_create(SP_YAML_MAP, key, NULL, error);
    if (child)
        sp_yaml_replace(map, child);
    return child;
}

/* Walks `path` ("simulate.jets", cut up on the way) and puts `value` at its end. Owns the value. */
static bool put(sp_yaml *map, char *path, sp_yaml *value, const char *setting, sp_error *error)
{
    char *dot;
    while (map && (dot = strchr(path, '.'))) {
        *dot = '\0';
        map = enter(map, path, setting, error);
        path = dot + 1;
    }
    value->key = map ? strdup(path) : NULL;
    if (value->key) {
        sp_yaml_replace(map, value);
        return true;
    }
    sp_yaml_destroy(value);
    return map && sp_fail_memory(error);
}

bool sp_scene_override(sp_yaml *tree, const char *setting, sp_error *error)
{
    const char *equals = strchr(setting, '=');
    bool known = strncmp(setting, "simulate.", 9) == 0 || strncmp(setting, "place.", 6) == 0 ||
                 strncmp(setting, "report.", 7) == 0;
    if (!equals)
        return fail(setting, "found no '=', expected a setting such as simulate.jets=20000", error);
    size_t size = (size_t)(equals - setting);
    const char *gap = strstr(setting, "..");
    if (!known || setting[size - 1] == '.' || (gap && gap < equals))
        return fail(setting, "found another key, expected one of simulate, place or report, such as simulate.jets",
                    error);
    char *path = strndup(setting, size);
    if (!path)
        return sp_fail_memory(error);
    sp_yaml *value = sp_yaml_parse(setting, equals + 1, strlen(equals + 1), error);
    if (value)
        forget_places(value);
    else if (error)
        error->line = error->column = 0;
    bool good = value && put(tree, path, value, setting, error);
    free(path);
    return good;
}
