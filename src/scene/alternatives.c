/* place.alternatives: what else could be built, each with its own mounts, types and limits. */
#include "scene/state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ALTERNATIVES = 12 }; /* as many as a table has columns for */

void sp_scene_free_alternatives(sp_scene *scene)
{
    for (size_t i = 0; i < scene->alternative_count; i++) {
        free(scene->alternatives[i].mounts);
        free(scene->alternatives[i].pressures);
        free(scene->alternatives[i].types);
    }
    free(scene->alternatives);
}

/* The mount of that name; NULL with an error that tells the names there are. */
static const sp_mount *find_mount(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node)
{
    char names[240] = "";
    const char *name = sp_read_text(reader, node, "mounts", "the name of a mount");
    for (size_t i = 0; name && i < scene->mount_count; i++) {
        size_t used = strlen(names);
        if (strcmp(scene->mounts[i].name, name) == 0)
            return &scene->mounts[i];
        if (scene->mounts[i].name[0])
            snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", scene->mounts[i].name);
    }
    if (name)
        sp_read_fail(reader, node, "mounts", "the `name` of one of place's mounts%s%s",
                     names[0] ? ": " : ", none has one", names);
    return NULL;
}

/* A name, or {mount: shell, max_nozzles: 1}, which says how many nozzles it takes here. */
static const sp_mount *read_choice(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node, size_t *most)
{
    const sp_fields in = {reader, &sp_block_limited_mount, node};
    uint64_t count = 0;
    if (node->kind != SP_YAML_MAP)
        return find_mount(scene, reader, node);
    if (!sp_read_block(&in, "mounts") || !sp_read_count(&in, "max_nozzles", &count))
        return NULL;
    const sp_mount *mount = find_mount(scene, reader, sp_yaml_get(node, "mount"));
    *most = count;
    if (!mount || mount->kind != SP_MOUNT_PORT)
        return mount;
    sp_read_fail(reader, sp_yaml_get(node, "max_nozzles"), "max_nozzles", "none beside a port, which takes one nozzle");
    return NULL;
}

/* In place's order, whatever the list's: that decides between equals. */
static bool read_mounts(const sp_scene *scene, const sp_reader *reader, const sp_yaml *list,
                        sp_scene_alternative *alternative)
{
    if (!list)
        return true;
    if (list->kind != SP_YAML_LIST || list->count == 0)
        return sp_read_fail(reader, list, "mounts", "a list of names of place's mounts");
    bool *chosen = calloc(scene->mount_count + 1, sizeof *chosen), good = true;
    alternative->mounts = calloc(scene->mount_count + 1, sizeof *alternative->mounts);
    if (!chosen || !alternative->mounts) {
        free(chosen);
        return sp_fail_memory(reader->error);
    }
    memcpy(alternative->mounts, scene->mounts, scene->mount_count * sizeof *scene->mounts);
    for (const sp_yaml *node = list->first; good && node; node = node->next) {
        size_t most = 0;
        const sp_mount *mount = read_choice(scene, reader, node, &most);
        size_t at = mount ? (size_t)(mount - scene->mounts) : scene->mount_count;
        good = mount && (!chosen[at] || sp_read_fail(reader, node, "mounts", "each mount once"));
        chosen[at] = true;
        alternative->mounts[at].most = most ? most : alternative->mounts[at].most;
    }
    size_t count = 0;
    for (size_t i = 0; i < scene->mount_count; i++)
        if (chosen[i])
            alternative->mounts[count++] = alternative->mounts[i];
    free(chosen);
    alternative->options.others = scene->mounts;
    alternative->options.other_count = scene->mount_count;
    alternative->options.mounts = alternative->mounts;
    alternative->options.mount_count = count;
    return good;
}

static bool read_limits(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node,
                        sp_scene_alternative *alternative)
{
    const sp_fields in = {reader, &sp_block_alternative, node};
    sp_place_options *options = &alternative->options;
    uint64_t nozzles = options->max_nozzles;
    size_t types = 0, pressures = 0;
    if (!sp_read_count(&in, "max_nozzles", &nozzles) || !sp_read_quantity(&in, "max_water", &options->max_water) ||
        !sp_scene_read_types(scene, reader, node, "types", &alternative->types, &types) ||
        !sp_scene_read_pressures(&in, &alternative->pressures, &pressures))
        return false;
    options->max_nozzles = nozzles;
    if (alternative->types) {
        options->types = alternative->types;
        options->type_count = types;
    }
    if (alternative->pressures) {
        options->pressures = alternative->pressures;
        options->pressure_count = pressures;
    }
    return true;
}

/* What a column of a report can be called: layouts of other roles have names of their own. */
static bool read_own_name(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node,
                          sp_scene_alternative *alternative)
{
    const sp_fields in = {reader, &sp_block_alternative, node};
    static const char *const taken[] = {"manual", "greedy", "proposed"};
    const sp_yaml *name = sp_yaml_get(node, "name");
    if (!sp_read_name(&in, "name", alternative->name))
        return false;
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++)
        if (strcmp(taken[i], alternative->name) == 0)
            return sp_read_fail(reader, name, "name",
                                "another name than those of layouts, manual, greedy and proposed");
    for (const sp_scene_alternative *other = scene->alternatives; other != alternative; other++)
        if (strcmp(other->name, alternative->name) == 0)
            return sp_read_fail(reader, name, "name", "a name that no other alternative has");
    return true;
}

static bool read_alternative(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node,
                             sp_scene_alternative *alternative)
{
    const sp_fields in = {reader, &sp_block_alternative, node};
    return sp_read_block(&in, "alternatives") && read_own_name(scene, reader, node, alternative) &&
           read_mounts(scene, reader, sp_yaml_get(node, "mounts"), alternative) &&
           read_limits(scene, reader, node, alternative);
}

bool sp_scene_read_alternatives(sp_scene *scene, const sp_reader *reader, const sp_yaml *list)
{
    if (!list)
        return true;
    if (!sp_read_is_list(reader, list, "alternatives", "alternatives"))
        return false;
    if (list->count > MAX_ALTERNATIVES)
        return sp_read_message(reader, list, "alternatives", "found %zu alternatives, expected at most %d", list->count,
                               MAX_ALTERNATIVES);
    if (list->count > 0 && scene->mount_count == 0)
        return sp_read_message(reader, list, "alternatives",
                               "found some without mounts, expected `mounts` beside them");
    scene->alternatives = calloc(list->count + 1, sizeof *scene->alternatives);
    if (!scene->alternatives)
        return sp_fail_memory(reader->error);
    for (const sp_yaml *node = list->first; node; node = node->next) {
        sp_scene_alternative *alternative = &scene->alternatives[scene->alternative_count++];
        alternative->options = scene->place;
        if (!read_alternative(scene, reader, node, alternative))
            return false;
    }
    return true;
}

size_t sp_scene_alternative_count(const sp_scene *scene)
{
    return scene ? scene->alternative_count : 0;
}

const char *sp_scene_alternative_name(const sp_scene *scene, size_t index)
{
    return scene->alternatives[index].name;
}

sp_place_options sp_scene_alternative_options(const sp_scene *scene, size_t index)
{
    return scene->alternatives[index].options;
}
