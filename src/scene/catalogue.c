/* The nozzle catalogue. */
#include "scene/edit_distance.h"
#include "scene/state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *pattern_name(sp_pattern pattern)
{
    return sp_key_of(&sp_block_type, "pattern")->words[pattern];
}

bool sp_scene_read_pattern(const sp_fields *in, sp_nozzle_type *type)
{
    int pattern = 0;
    if (!sp_read_choice(in, "pattern", &pattern))
        return false;
    type->pattern = (sp_pattern)pattern;
    return true;
}

/* A key that belongs to one pattern is needed there and stands nowhere else. */
static bool check_pattern_key(const sp_reader *reader, const sp_yaml *node, const sp_nozzle_type *type, const char *key,
                              sp_pattern owner)
{
    const sp_yaml *child = sp_yaml_get(node, key);
    if (type->pattern == owner && !child)
        return sp_read_message(reader, node, key, "found nothing, expected this key in a %s", pattern_name(owner));
    if (type->pattern != owner && child)
        return sp_read_message(reader, child, key, "found in a %s, expected in a %s only", pattern_name(type->pattern),
                               pattern_name(owner));
    return true;
}

/* `key` is a list of two values, rising, around `value`; absent: the value alone. */
static bool read_adjustable(const sp_fields *in, const char *key, double value, double limits[2])
{
    const sp_reader *reader = in->reader;
    const sp_yaml *list = sp_yaml_get(in->map, key);
    limits[0] = limits[1] = value;
    if (!list)
        return true;
    const sp_key *each = sp_key_of(in->block, key);
    if (list->kind != SP_YAML_LIST || list->count != 2)
        return sp_read_fail(reader, list, key, "a list of two values such as [%s, ...]", each->dimension->example);
    if (!sp_read_quantity_at(reader, list->first, each, &limits[0]) ||
        !sp_read_quantity_at(reader, list->last, each, &limits[1]))
        return false;
    if (!(limits[0] < limits[1]))
        return sp_read_message(reader, list, key, "found '%.60s' before '%.60s', expected the smaller first",
                               list->first->text, list->last->text);
    if (value < limits[0] || value > limits[1])
        return sp_read_message(reader, list, key,
                               "found '%.60s' to '%.60s', expected a range that contains the type's own",
                               list->first->text, list->last->text);
    return true;
}

static bool read_turning(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type);

/* A cluster has the angles of its members, and an image was measured at one. */
static bool check_angles(const sp_reader *reader, const sp_yaml *node, const sp_nozzle_type *type)
{
    const sp_yaml *range = sp_yaml_get(node, "angle_range");
    if (type->pattern == SP_PATTERN_MEASURED && range)
        return sp_read_message(reader, range, "angle_range", "found in a measured, expected in another pattern only");
    static const char *const angles[] = {"angle", "angle_range"};
    for (int i = 0; i < 2 && type->pattern == SP_PATTERN_CLUSTER; i++) {
        const sp_yaml *child = sp_yaml_get(node, angles[i]);
        if (child)
            return sp_read_message(reader, child, angles[i], "found in a cluster, expected angles in its members only");
    }
    return true;
}

bool sp_scene_read_shape(const sp_fields *in, sp_nozzle_type *type)
{
    const sp_reader *reader = in->reader;
    const sp_yaml *node = in->map;
    double limits[2];
    if (type->pattern == SP_PATTERN_ROTATING)
        return read_turning(reader, node, type);
    if (!check_angles(reader, node, type))
        return false;
    if (type->pattern == SP_PATTERN_SOLID_STREAM)
        type->angle = M_PI / 180;
    else if (type->pattern != SP_PATTERN_CLUSTER && !sp_yaml_get(node, "angle"))
        return sp_read_message(reader, node, "angle", "found nothing, expected this key in a %s",
                               pattern_name(type->pattern));
    if (!check_pattern_key(reader, node, type, "rotation", SP_PATTERN_ROTATING) ||
        !check_pattern_key(reader, node, type, "hollow", SP_PATTERN_HOLLOW_CONE) ||
        !check_pattern_key(reader, node, type, "thickness", SP_PATTERN_FLAT_FAN) ||
        !check_pattern_key(reader, node, type, "members", SP_PATTERN_CLUSTER) ||
        !check_pattern_key(reader, node, type, "image", SP_PATTERN_MEASURED) ||
        !sp_read_quantity(in, "angle", &type->angle) || !sp_read_quantity(in, "hollow", &type->hollow) ||
        !sp_read_quantity(in, "thickness", &type->thickness) ||
        !read_adjustable(in, "angle_range", type->angle, limits))
        return false;
    type->angle_min = limits[0];
    type->angle_max = limits[1];
    return true;
}

/* The pattern that turns: its angles become the type's. */
static bool read_jet(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    const sp_fields in = {reader, &sp_block_jet, node};
    sp_rotation *rotation = &type->rotation;
    sp_nozzle_type jet = {0};
    const sp_yaml *pattern = sp_yaml_get(node, "pattern");
    if (sp_text_is(pattern, "rotating") || sp_text_is(pattern, "cluster") || sp_text_is(pattern, "measured"))
        return sp_read_fail(reader, pattern, "pattern", "full_cone, hollow_cone, flat_fan or solid_stream in a jet");
    if ((node->kind == SP_YAML_MAP && !sp_scene_read_pattern(&in, &jet)) || !sp_read_block(&in, "jet") ||
        !sp_scene_read_shape(&in, &jet) || !sp_read_quantity(&in, "tilt", &rotation->tilt) ||
        !sp_read_quantity(&in, "roll", &rotation->roll))
        return false;
    rotation->jet = jet.pattern;
    type->angle = type->angle_min = type->angle_max = jet.angle;
    type->hollow = jet.hollow;
    type->thickness = jet.thickness;
    return true;
}

static bool read_turning(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    static const char *const jets_own[] = {"angle", "hollow", "thickness", "angle_range"};
    for (size_t i = 0; i < sizeof jets_own / sizeof *jets_own; i++) {
        const sp_yaml *child = sp_yaml_get(node, jets_own[i]);
        if (child)
            return sp_read_message(reader, child, jets_own[i],
                                   i < 3 ? "found in a rotating, expected in its jet"
                                         : "found in a rotating, expected in another pattern only");
    }
    if (!check_pattern_key(reader, node, type, "members", SP_PATTERN_CLUSTER) ||
        !check_pattern_key(reader, node, type, "image", SP_PATTERN_MEASURED) ||
        !check_pattern_key(reader, node, type, "rotation", SP_PATTERN_ROTATING))
        return false;
    const sp_yaml *rotation = sp_yaml_get(node, "rotation");
    const sp_fields in = {reader, &sp_block_rotation, rotation};
    return sp_read_block(&in, "rotation") && read_jet(reader, sp_yaml_get(rotation, "jet"), type) &&
           sp_scene_read_gears(reader, rotation, type);
}

static bool read_flow(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    const sp_fields in = {reader, &sp_block_type, node};
    double limits[2];
    type->cv = 0.95;
    type->drop = 1e-3;
    if (!sp_scene_read_flow(reader, node, type) || !sp_read_quantity(&in, "cv", &type->cv) ||
        !sp_read_quantity(&in, "drop", &type->drop) || !sp_scene_read_trajectory(&in, &type->trajectory) ||
        !read_adjustable(&in, "flow_range", type->flow, limits))
        return false;
    type->flow_min = limits[0];
    type->flow_max = limits[1];
    return true;
}

/* What can be set of it; of what cannot be changed there are no steps. */
static bool read_steps(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    static const char *const settings[] = {"angle", "flow"}, *const ranges[] = {"angle_range", "flow_range"};
    const sp_yaml *step = sp_yaml_get(node, "step");
    const sp_fields in = {reader, &sp_block_type_step, step};
    if (!step)
        return true;
    if (!sp_read_block(&in, "step") || !sp_read_step(&in, "angle", &type->angle_step) ||
        !sp_read_step(&in, "flow", &type->flow_step) || !sp_read_step(&in, "pressure", &type->pressure_step))
        return false;
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const sp_yaml *child = sp_yaml_get(step, settings[i]);
        if (child && !sp_yaml_get(node, ranges[i]))
            return sp_read_message(reader, child, settings[i], "found in a type without %s, expected beside it only",
                                   ranges[i]);
    }
    return true;
}

/* How it is mounted, and what is ordered with it. */
static bool read_body(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    const sp_fields in = {reader, &sp_block_type, node};
    return sp_read_name(&in, "thread", type->thread) && sp_read_name(&in, "insert", type->insert) &&
           sp_read_quantity(&in, "body", &type->body);
}

/* Where to buy it. */
static bool read_source(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    const sp_fields in = {reader, &sp_block_type, node};
    static const char expected[] = "an address such as https://example.com/nozzle";
    const sp_yaml *child = sp_yaml_get(node, "url");
    if (!sp_read_name(&in, "order_code", type->order_code))
        return false;
    if (!child)
        return true;
    const char *text = sp_read_text(reader, child, "url", expected);
    if (!text)
        return false;
    snprintf(type->url, sizeof type->url, "%s", text);
    return sp_is_url(text) || sp_read_fail(reader, child, "url", "%s", expected);
}

static bool read_type(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    const sp_fields in = {reader, &sp_block_type, node};
    *type = (sp_nozzle_type){0};
    /* Which keys belong to it depends on its pattern. */
    return (node->kind != SP_YAML_MAP || sp_scene_read_pattern(&in, type)) && sp_read_block(&in, "nozzles") &&
           sp_read_name(&in, "name", type->name) && sp_scene_read_shape(&in, type) && read_flow(reader, node, type) &&
           read_source(reader, node, type) && read_body(reader, node, type) && read_steps(reader, node, type) &&
           sp_scene_read_members(scene, reader, node, type) && sp_scene_read_image(scene, reader, node, type);
}

static bool read_types(sp_scene *scene, const sp_reader *reader, const sp_yaml *list)
{
    if (!sp_read_is_list(reader, list, "nozzles", "catalogue types"))
        return false;
    if (list->count > SP_MAX_ITEMS)
        return sp_read_message(reader, list, "nozzles", "found %zu types, expected at most %d", list->count,
                               SP_MAX_ITEMS);
    scene->types = calloc(list->count ? list->count : 1, sizeof *scene->types);
    if (!scene->types)
        return sp_fail_memory(reader->error);
    for (const sp_yaml *node = list->first; node; node = node->next) {
        /* Counted even when it fails: its members are then freed with the others'. */
        sp_nozzle_type *type = &scene->types[scene->type_count++];
        if (!read_type(scene, reader, node, type))
            return false;
        for (size_t i = 0; i + 1 < scene->type_count; i++)
            if (strcmp(scene->types[i].name, type->name) == 0)
                return sp_read_fail(reader, sp_yaml_get(node, "name"), "name", "a name that no other type has");
    }
    return true;
}

bool sp_scene_read_types_of(sp_scene *scene, const sp_reader *reader, const sp_yaml *catalogue)
{
    const sp_fields in = {reader, &sp_block_catalogue, catalogue};
    return sp_read_block(&in, "catalogue") && read_types(scene, reader, sp_yaml_get(catalogue, "nozzles"));
}

bool sp_scene_read_catalogue(sp_scene *scene, const sp_reader *reader)
{
    const sp_yaml *node = sp_yaml_get(scene->tree, "catalogue");
    if (!node)
        return true;
    char *path = sp_scene_file(scene->directory, sp_scene_place_of_files(scene), reader, node, "catalogue");
    sp_yaml *tree = path ? sp_yaml_load(path, reader->error) : NULL;
    bool good = tree && sp_scene_read_types_of(scene, reader, tree);
    sp_yaml_destroy(tree);
    free(path);
    return good;
}

const sp_nozzle_type *sp_scene_find_type(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node,
                                         const char *key)
{
    const char *name = sp_read_text(reader, node, key, "the name of a type in the catalogue");
    const char *near = NULL;
    size_t least = SIZE_MAX;
    if (!name)
        return NULL;
    for (size_t i = 0; i < scene->type_count; i++) {
        if (strcmp(scene->types[i].name, name) == 0)
            return &scene->types[i];
        size_t slips = sp_edit_distance(name, scene->types[i].name);
        if (slips < least)
            near = scene->types[i].name;
        least = slips < least ? slips : least;
    }
    if (scene->type_count == 0)
        sp_read_fail(reader, node, key, "a type of the catalogue, of which this scene has none (catalogue:)");
    else if (near)
        sp_read_fail(reader, node, key, "a type of the catalogue, perhaps '%s'", near);
    else
        sp_read_fail(reader, node, key, "a type of the catalogue, which has '%s'%s", scene->types[0].name,
                     scene->type_count > 1 ? " and others" : "");
    return NULL;
}

bool sp_scene_read_types(const sp_scene *scene, const sp_reader *reader, const sp_yaml *map, const char *key,
                         const sp_nozzle_type ***types, size_t *count)
{
    const sp_yaml *list = sp_yaml_get(map, key);
    if (!list)
        return true;
    if (list->kind != SP_YAML_LIST || list->count == 0)
        return sp_read_fail(reader, list, key, "a list of type names");
    *types = calloc(list->count, sizeof **types);
    if (!*types)
        return sp_fail_memory(reader->error);
    for (const sp_yaml *node = list->first; node; node = node->next) {
        const sp_nozzle_type *type = sp_scene_find_type(scene, reader, node, key);
        if (!type)
            return false;
        for (size_t i = 0; i < *count; i++)
            if ((*types)[i] == type)
                return sp_read_fail(reader, node, key, "each type once");
        (*types)[(*count)++] = type;
    }
    return true;
}
