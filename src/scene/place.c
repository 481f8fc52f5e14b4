/* place: what may be proposed, and where. */
#include "mounts/mount_geometry.h"
#include "scene/state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* That a mount alone does not give more points than all together may. */
static bool check_spacing(const sp_reader *reader, const sp_yaml *node, double spacing, sp_vec3 extent)
{
    double points = 1, sizes[3] = {extent.x, extent.y, extent.z};
    bool flat = true;
    for (int i = 0; i < 3; i++) {
        flat = flat && sizes[i] == 0;
        points *= sp_mount_points_along(sizes[i], spacing);
    }
    if (flat)
        return true;
    if (!sp_yaml_get(node, "spacing"))
        return sp_read_message(reader, node, "spacing",
                               "found nothing, expected this key where there is more than a point");
    if (points > SP_MOUNTING_POINTS)
        return sp_read_fail(reader, sp_yaml_get(node, "spacing"), "spacing",
                            "one that gives at most %d points, not %.0f", SP_MOUNTING_POINTS, points);
    return true;
}

static bool read_depth(const sp_reader *reader, const sp_yaml *node, sp_mount *mount)
{
    const sp_yaml *depth = sp_yaml_get(node, "depth");
    const sp_fields in = {reader, &sp_block_depth, depth};
    if (!depth)
        return true;
    if (!sp_read_block(&in, "depth") || !sp_read_quantity(&in, "from", &mount->depth_from) ||
        !sp_read_quantity(&in, "to", &mount->depth_to) || !sp_read_quantity(&in, "spacing", &mount->depth_spacing))
        return false;
    if (mount->depth_to < mount->depth_from)
        return sp_read_fail(reader, sp_yaml_get(depth, "to"), "to", "a length of at least `from`, %g m",
                            mount->depth_from);
    return check_spacing(reader, depth, mount->depth_spacing, sp_v(mount->depth_to - mount->depth_from, 0, 0));
}

/* The bore, and that what was named to fit passes it. */
static bool read_bore(const sp_reader *reader, const sp_yaml *node, sp_mount *mount)
{
    const sp_fields in = {reader, &sp_block_port, node};
    const sp_yaml *types = sp_yaml_get(node, "types");
    if (!sp_read_quantity(&in, "bore", &mount->bore))
        return false;
    const sp_yaml *child = types ? types->first : NULL;
    for (size_t i = 0; i < mount->type_count && child; i++, child = child->next)
        if (!sp_mount_takes(mount, mount->types[i]))
            return sp_read_message(reader, child, "types",
                                   "found '%s', which is %g mm wide, expected types that pass the bore, %g mm",
                                   mount->types[i]->name, 1e3 * mount->types[i]->body, 1e3 * mount->bore);
    return true;
}

/* What of a lance can be set. */
static bool read_lance_steps(const sp_reader *reader, const sp_yaml *node, sp_mount *mount)
{
    const sp_yaml *step = sp_yaml_get(node, "step");
    const sp_fields in = {reader, &sp_block_lance_step, step};
    return !step || (sp_read_block(&in, "step") && sp_read_step(&in, "depth", &mount->depth_step) &&
                     sp_read_step(&in, "tilt", &mount->tilt_step));
}

static bool read_port(sp_scene *scene, const sp_fields *in, sp_mount *mount)
{
    const sp_reader *reader = in->reader;
    const sp_yaml *node = in->map;
    const sp_nozzle_type ***types = &scene->mount_types[scene->mount_count];
    if (!sp_read_block(in, "port") || !sp_read_vector(in, "position", &mount->position) ||
        !sp_read_axis(in, "axis", &mount->axis) || !sp_read_quantity(in, "tilt", &mount->tilt) ||
        !read_depth(reader, node, mount) ||
        !sp_scene_read_types(scene, reader, node, "types", types, &mount->type_count))
        return false;
    mount->types = *types;
    return read_bore(reader, node, mount) && read_lance_steps(reader, node, mount);
}

static bool find_part(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_mount *mount)
{
    char names[240] = "";
    const char *name = sp_read_text(reader, node, "part", "the name of a part");
    if (!name)
        return false;
    for (size_t i = 0; i < scene->mesh->part_count; i++) {
        const sp_part *part = &scene->mesh->parts[i];
        size_t used = strlen(names);
        if (part->geometry != mount->geometry)
            continue;
        snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", part->name);
        if (strcmp(part->name, name) == 0) {
            mount->part = (uint32_t)i;
            return true;
        }
    }
    return sp_read_fail(reader, node, "part", "a part of that geometry: %s", names);
}

static bool read_surface(sp_scene *scene, const sp_fields *in, sp_mount *mount)
{
    const sp_reader *reader = in->reader;
    const sp_yaml *node = in->map;
    uint64_t geometry = 0;
    mount->axis = sp_v(0, 0, 0);
    mount->part = SP_NONE;
    if (!sp_read_block(in, "surface") || !sp_read_count(in, "geometry", &geometry) ||
        !sp_read_quantity(in, "spacing", &mount->spacing) || !sp_read_quantity(in, "standoff", &mount->standoff) ||
        !sp_read_quantity(in, "tilt", &mount->tilt))
        return false;
    size_t files = sp_yaml_get(scene->tree, "geometry")->count;
    if (geometry >= files)
        return sp_read_fail(reader, sp_yaml_get(node, "geometry"), "geometry", "a whole number from 0 to %zu",
                            files - 1);
    mount->geometry = (uint32_t)geometry;
    const sp_yaml *part = sp_yaml_get(node, "part");
    return !part || find_part(scene, reader, part, mount);
}

static bool read_line(sp_scene *scene, const sp_fields *in, sp_mount *mount)
{
    const sp_reader *reader = in->reader;
    const sp_yaml *node = in->map;
    (void)scene;
    return sp_read_block(in, "line") && sp_read_vector(in, "from", &mount->from) &&
           sp_read_vector(in, "to", &mount->to) && sp_read_quantity(in, "spacing", &mount->spacing) &&
           sp_read_axis(in, "axis", &mount->axis) && sp_read_quantity(in, "tilt", &mount->tilt) &&
           check_spacing(reader, node, mount->spacing, sp_v(sp_distance(mount->from, mount->to), 0, 0));
}

static bool read_box(sp_scene *scene, const sp_fields *in, sp_mount *mount)
{
    const sp_reader *reader = in->reader;
    const sp_yaml *node = in->map;
    (void)scene;
    if (!sp_read_block(in, "box") || !sp_read_vector(in, "min", &mount->from) ||
        !sp_read_vector(in, "max", &mount->to) || !sp_read_quantity(in, "spacing", &mount->spacing) ||
        !sp_read_axis(in, "axis", &mount->axis) || !sp_read_quantity(in, "tilt", &mount->tilt))
        return false;
    sp_vec3 extent = sp_sub(mount->to, mount->from);
    if (extent.x < 0 || extent.y < 0 || extent.z < 0)
        return sp_read_fail(reader, sp_yaml_get(node, "max"), "max", "no coordinate below that of `min`");
    return check_spacing(reader, node, mount->spacing, extent);
}

/* What mounts of any kind have. */
static bool read_common(const sp_scene *scene, const sp_fields *in, sp_mount *mount)
{
    const sp_reader *reader = in->reader;
    const sp_yaml *node = in->map;
    uint64_t most = 0;
    if (!sp_read_name(in, "name", mount->name) ||
        (mount->kind != SP_MOUNT_PORT && !sp_read_count(in, "max_nozzles", &most)) ||
        !sp_scene_read_cost(scene, reader, node, &mount->cost))
        return false;
    mount->most = most;
    for (size_t i = 0; mount->name[0] && i < scene->mount_count; i++)
        if (strcmp(scene->mounts[i].name, mount->name) == 0) {
            bool ports = mount->kind == SP_MOUNT_PORT && scene->mounts[i].kind == SP_MOUNT_PORT;
            return sp_read_fail(reader, sp_yaml_get(node, "name"), "name", "a name that no other %s has",
                                ports ? "port" : "mount");
        }
    return true;
}

static bool read_mount(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_mount *mount)
{
    const sp_fields in = {reader, &sp_block_mount, node};
    static bool (*const readers[])(sp_scene *, const sp_fields *, sp_mount *) = {read_port, read_surface, read_line,
                                                                                 read_box};
    if (!sp_read_block(&in, "mounts"))
        return false;
    if (node->count != 1)
        return sp_read_message(reader, node, "mounts", "found %zu keys, expected one of port, surface, line, box",
                               node->count);
    int kind = 0;
    while (strcmp(sp_block_mount.keys[kind].name, node->first->key) != 0)
        kind++;
    *mount = (sp_mount){.kind = (sp_mount_kind)kind, .axis = sp_scale(scene->setup.up, -1)};
    const sp_fields own = {reader, sp_block_mount.keys[kind].block, node->first};
    bool good = readers[kind](scene, &own, mount) && read_common(scene, &own, mount);
    mount->position = sp_sub(mount->position, scene->setup.origin);
    mount->from = sp_sub(mount->from, scene->setup.origin);
    mount->to = sp_sub(mount->to, scene->setup.origin);
    return good;
}

static bool read_mounts(sp_scene *scene, const sp_reader *reader, const sp_yaml *list)
{
    if (!list)
        return true;
    if (!sp_read_is_list(reader, list, "mounts", "mounts"))
        return false;
    if (list->count > SP_MAX_ITEMS)
        return sp_read_message(reader, list, "mounts", "found %zu mounts, expected at most %d", list->count,
                               SP_MAX_ITEMS);
    scene->mounts = calloc(list->count + 1, sizeof *scene->mounts);
    scene->mount_types = calloc(list->count + 1, sizeof *scene->mount_types);
    if (!scene->mounts || !scene->mount_types)
        return sp_fail_memory(reader->error);
    for (const sp_yaml *node = list->first; node; node = node->next) {
        /* Counted even when it fails: its types are then freed with the others. */
        bool good = read_mount(scene, reader, node, &scene->mounts[scene->mount_count]);
        scene->mount_count++;
        if (!good)
            return false;
    }
    return true;
}

bool sp_scene_read_pressures(const sp_fields *in, double **pressures, size_t *count)
{
    const sp_reader *reader = in->reader;
    const sp_key *key = sp_key_of(in->block, "pressure");
    const sp_yaml *node = sp_yaml_get(in->map, "pressure");
    if (!node)
        return true;
    bool list = node->kind == SP_YAML_LIST;
    if (list && node->count == 0)
        return sp_read_fail(reader, node, "pressure", "a pressure or several");
    if (list && node->count > SP_MAX_ITEMS)
        return sp_read_message(reader, node, "pressure", "found %zu pressures, expected at most %d", node->count,
                               SP_MAX_ITEMS);
    *pressures = calloc(list ? node->count : 1, sizeof **pressures);
    if (!*pressures)
        return sp_fail_memory(reader->error);
    for (const sp_yaml *child = list ? node->first : node; child; child = list ? child->next : NULL) {
        double *pressure = &(*pressures)[(*count)++];
        if (!sp_read_quantity_at(reader, child, key, pressure))
            return false;
        for (const double *other = *pressures; other < pressure; other++)
            if (*other == *pressure)
                return sp_read_fail(reader, child, "pressure", "each pressure once");
    }
    return true;
}

static bool read_refine(const sp_reader *reader, const sp_yaml *node, sp_refine *refine)
{
    const sp_fields in = {reader, &sp_block_refine, node};
    if (!node)
        return true;
    if (sp_text_is(node, "none")) {
        *refine = (sp_refine){0};
        return true;
    }
    if (node->kind != SP_YAML_MAP)
        return sp_read_fail(reader, node, "refine", "none, or keys such as {position: 50 mm, axis: 15 deg}");
    return sp_read_block(&in, "refine") && sp_read_quantity(&in, "position", &refine->position) &&
           sp_read_quantity(&in, "axis", &refine->axis) && sp_read_flag(&in, "roll", &refine->roll) &&
           sp_read_quantity(&in, "angle", &refine->angle) && sp_read_quantity(&in, "flow", &refine->flow);
}

static bool read_aims(const sp_reader *reader, const sp_yaml *node, sp_place_options *place)
{
    const sp_fields in = {reader, &sp_block_place, node};
    int objective = place->objective;
    uint64_t nozzles = place->max_nozzles;
    if (!sp_read_choice(&in, "objective", &objective) || !sp_read_quantity(&in, "coverage", &place->coverage) ||
        !sp_read_count(&in, "max_nozzles", &nozzles) || !sp_read_quantity(&in, "max_water", &place->max_water) ||
        !sp_read_quantity(&in, "clearance", &place->clearance))
        return false;
    place->objective = (sp_objective)objective;
    place->max_nozzles = nozzles;
    return true;
}

/* All types of the catalogue where the block names none. */
static bool read_place_types(sp_scene *scene, const sp_reader *reader, const sp_yaml *node)
{
    size_t *count = &scene->place.type_count;
    if (sp_yaml_get(node, "types"))
        return sp_scene_read_types(scene, reader, node, "types", &scene->place_types, count);
    scene->place_types = calloc(scene->type_count + 1, sizeof *scene->place_types);
    if (!scene->place_types)
        return sp_fail_memory(reader->error);
    for (size_t i = 0; i < scene->type_count; i++)
        scene->place_types[(*count)++] = &scene->types[i];
    return true;
}

bool sp_scene_read_place(sp_scene *scene, const sp_reader *reader)
{
    const sp_yaml *node = sp_yaml_get(scene->tree, "place");
    const sp_fields in = {reader, &sp_block_place, node};
    sp_place_options *place = &scene->place;
    if (node &&
        (!sp_read_block(&in, "place") || !read_aims(reader, node, place) ||
         !sp_scene_read_pressures(&in, &scene->pressures, &place->pressure_count) ||
         !sp_scene_read_water_cost(scene, reader, node) || !read_mounts(scene, reader, sp_yaml_get(node, "mounts")) ||
         !read_refine(reader, sp_yaml_get(node, "refine"), &place->refine)))
        return false;
    if (!read_place_types(scene, reader, node))
        return false;
    if (scene->mount_count > 0 && place->pressure_count == 0)
        return sp_read_message(reader, node, "pressure", "found nothing, expected this key beside mounts");
    if (scene->mount_count > 0 && place->type_count == 0)
        return sp_read_message(reader, node, "types", "found no types, expected a catalogue with types to choose from");
    place->types = scene->place_types;
    place->pressures = scene->pressures;
    place->mounts = scene->mounts;
    place->mount_count = scene->mount_count;
    place->kept = scene->layout;
    return sp_scene_read_alternatives(scene, reader, sp_yaml_get(node, "alternatives"));
}
