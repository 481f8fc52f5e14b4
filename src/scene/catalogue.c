/* The nozzle catalogue. */
#include "scene/slips.h"
#include "scene/state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const pattern_names[] = {"full_cone", "hollow_cone", "flat_fan", "solid_stream",
                                            "cluster",   "rotating",    "measured", NULL};

bool sp_scene_read_pattern(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    int pattern = 0;
    if (!sp_read_choice(reader, node, "pattern", pattern_names, &pattern))
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
        return sp_read_message(reader, node, key, "found nothing, expected this key in a %s", pattern_names[owner]);
    if (type->pattern != owner && child)
        return sp_read_message(reader, child, key, "found in a %s, expected in a %s only", pattern_names[type->pattern],
                               pattern_names[owner]);
    return true;
}

/* `key` is a list of two values, rising, around `value`; absent: the value alone. */
static bool read_adjustable(const sp_reader *reader, const sp_yaml *node, const char *key,
                            const sp_dimension *dimension, sp_range range, double value, double limits[2])
{
    const sp_yaml *list = sp_yaml_get(node, key);
    limits[0] = limits[1] = value;
    if (!list)
        return true;
    if (list->kind != SP_YAML_LIST || list->count != 2)
        return sp_read_fail(reader, list, key, "a list of two values such as [%s, ...]", dimension->example);
    if (!sp_read_quantity_at(reader, list->first, key, dimension, range, &limits[0]) ||
        !sp_read_quantity_at(reader, list->last, key, dimension, range, &limits[1]))
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

bool sp_scene_read_shape(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    const double pi = acos(-1);
    double limits[2];
    if (type->pattern == SP_PATTERN_ROTATING)
        return read_turning(reader, node, type);
    if (!check_angles(reader, node, type))
        return false;
    if (type->pattern == SP_PATTERN_SOLID_STREAM)
        type->angle = pi / 180;
    else if (type->pattern != SP_PATTERN_CLUSTER && !sp_yaml_get(node, "angle"))
        return sp_read_message(reader, node, "angle", "found nothing, expected this key in a %s",
                               pattern_names[type->pattern]);
    if (!check_pattern_key(reader, node, type, "rotation", SP_PATTERN_ROTATING) ||
        !check_pattern_key(reader, node, type, "hollow", SP_PATTERN_HOLLOW_CONE) ||
        !check_pattern_key(reader, node, type, "thickness", SP_PATTERN_FLAT_FAN) ||
        !check_pattern_key(reader, node, type, "members", SP_PATTERN_CLUSTER) ||
        !check_pattern_key(reader, node, type, "image", SP_PATTERN_MEASURED) ||
        !sp_read_quantity(reader, node, "angle", &sp_angle_unit, sp_above_to(0, 2 * pi), &type->angle) ||
        !sp_read_quantity(reader, node, "hollow", &sp_share_unit, sp_from_below(0, 1), &type->hollow) ||
        !sp_read_quantity(reader, node, "thickness", &sp_angle_unit, sp_above_to(0, pi), &type->thickness) ||
        !read_adjustable(reader, node, "angle_range", &sp_angle_unit, sp_above_to(0, 2 * pi), type->angle, limits))
        return false;
    type->angle_min = limits[0];
    type->angle_max = limits[1];
    return true;
}

/* The pattern that turns: its angles become the type's. */
static bool read_jet(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    static const sp_key keys[] = {{"pattern", true}, {"angle", false}, {"hollow", false}, {"thickness", false},
                                  {"tilt", false},   {"roll", false},  {NULL, false}};
    const double pi = acos(-1);
    sp_rotation *rotation = &type->rotation;
    sp_nozzle_type jet = {0};
    const sp_yaml *pattern = sp_yaml_get(node, "pattern");
    if (sp_text_is(pattern, "rotating") || sp_text_is(pattern, "cluster") || sp_text_is(pattern, "measured"))
        return sp_read_fail(reader, pattern, "pattern", "full_cone, hollow_cone, flat_fan or solid_stream in a jet");
    if ((node->kind == SP_YAML_MAP && !sp_scene_read_pattern(reader, node, &jet)) ||
        !sp_read_keys(reader, node, "jet", "a jet", keys) || !sp_scene_read_shape(reader, node, &jet) ||
        !sp_read_quantity(reader, node, "tilt", &sp_angle_unit, sp_between(0, pi), &rotation->tilt) ||
        !sp_read_quantity(reader, node, "roll", &sp_angle_unit, sp_any(), &rotation->roll))
        return false;
    rotation->jet = jet.pattern;
    type->angle = type->angle_min = type->angle_max = jet.angle;
    type->hollow = jet.hollow;
    type->thickness = jet.thickness;
    return true;
}

static bool read_turning(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    static const sp_key keys[] = {{"jet", true},    {"jets", false},  {"gears", false},
                                  {"speed", false}, {"turns", false}, {NULL, false}};
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
    return sp_read_keys(reader, rotation, "rotation", "a rotation", keys) &&
           read_jet(reader, sp_yaml_get(rotation, "jet"), type) && sp_scene_read_gears(reader, rotation, type);
}

static bool read_flow(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    double limits[2];
    type->cv = 0.95;
    type->drop = 1e-3;
    if (!sp_scene_read_flow(reader, node, type) ||
        !sp_read_quantity(reader, node, "cv", &sp_ratio_unit, sp_above_to(0, 1), &type->cv) ||
        !sp_read_quantity(reader, node, "drop", &sp_length_unit, sp_above(0), &type->drop) ||
        !sp_scene_read_trajectory(reader, node, &type->trajectory) ||
        !read_adjustable(reader, node, "flow_range", &sp_flow_unit, sp_above(0), type->flow, limits))
        return false;
    type->flow_min = limits[0];
    type->flow_max = limits[1];
    return true;
}

/* What can be set of it; of what cannot be changed there are no steps. */
static bool read_steps(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    static const sp_key keys[] = {{"angle", false}, {"flow", false}, {"pressure", false}, {NULL, false}};
    static const char *const ranges[] = {"angle_range", "flow_range"};
    const sp_yaml *step = sp_yaml_get(node, "step");
    if (!step)
        return true;
    if (!sp_read_keys(reader, step, "step", "a step", keys) ||
        !sp_read_step(reader, step, "angle", &sp_angle_unit, 1e-6, &type->angle_step) ||
        !sp_read_step(reader, step, "flow", &sp_flow_unit, 1e-9, &type->flow_step) ||
        !sp_read_step(reader, step, "pressure", &sp_pressure_unit, 1, &type->pressure_step))
        return false;
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const sp_yaml *child = sp_yaml_get(step, keys[i].name);
        if (child && !sp_yaml_get(node, ranges[i]))
            return sp_read_message(reader, child, keys[i].name, "found in a type without %s, expected beside it only",
                                   ranges[i]);
    }
    return true;
}

/* How it is mounted, and what is ordered with it. */
static bool read_body(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    return sp_read_name(reader, node, "thread", type->thread) && sp_read_name(reader, node, "insert", type->insert) &&
           sp_read_quantity(reader, node, "body", &sp_length_unit, sp_above(0), &type->body);
}

/* Where to buy it. */
static bool read_source(const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    static const char expected[] = "an address such as https://example.com/nozzle";
    const sp_yaml *child = sp_yaml_get(node, "url");
    if (!sp_read_name(reader, node, "order_code", type->order_code))
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
    static const sp_key keys[] = {
        {"name", true},         {"pattern", true},     {"angle", false},      {"hollow", false}, {"thickness", false},
        {"flow", true},         {"at", true},          {"exponent", false},   {"cv", false},     {"drop", false},
        {"angle_range", false}, {"flow_range", false}, {"order_code", false}, {"url", false},    {"image", false},
        {"members", false},     {"rotation", false},   {"thread", false},     {"insert", false}, {"body", false},
        {"step", false},        {"trajectory", false}, {NULL, false}};
    *type = (sp_nozzle_type){0};
    /* Which keys belong to it depends on its pattern. */
    return (node->kind != SP_YAML_MAP || sp_scene_read_pattern(reader, node, type)) &&
           sp_read_keys(reader, node, "nozzles", "a catalogue type", keys) &&
           sp_read_name(reader, node, "name", type->name) && sp_scene_read_shape(reader, node, type) &&
           read_flow(reader, node, type) && read_source(reader, node, type) && read_body(reader, node, type) &&
           read_steps(reader, node, type) && sp_scene_read_members(scene, reader, node, type) &&
           sp_scene_read_image(scene, reader, node, type);
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
    static const sp_key keys[] = {{"nozzles", true}, {NULL, false}};
    return sp_read_keys(reader, catalogue, "catalogue", "a catalogue", keys) &&
           read_types(scene, reader, sp_yaml_get(catalogue, "nozzles"));
}

bool sp_scene_read_catalogue(sp_scene *scene, const sp_reader *reader)
{
    const sp_yaml *node = sp_yaml_get(scene->tree, "catalogue");
    if (!node)
        return true;
    char *path = sp_scene_file(scene->directory, "the scene", reader, node, "catalogue");
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
        size_t slips = sp_text_slips(name, scene->types[i].name);
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
