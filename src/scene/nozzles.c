/* nozzles: the engineer's own layout. */
#include "scene/state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* `angle` overrides the type's within its range. */
static bool read_angle(const sp_reader *reader, const sp_yaml *node, sp_nozzle *nozzle)
{
    const sp_fields in = {reader, &sp_block_nozzle, node};
    const sp_nozzle_type *type = nozzle->type;
    const sp_yaml *child = sp_yaml_get(node, "angle");
    if (!child)
        return true;
    if (!(type->angle_min < type->angle_max))
        return sp_read_fail(reader, child, "angle",
                            "this key only with an adjustable type, and '%s' has no angle_range", type->name);
    if (!sp_read_quantity(&in, "angle", &nozzle->angle))
        return false;
    const double slack = 1e-12 * type->angle_max;
    if (nozzle->angle < type->angle_min - slack || nozzle->angle > type->angle_max + slack)
        return sp_read_fail(reader, child, "angle", "an angle within the range of '%s', %g deg to %g deg", type->name,
                            type->angle_min * 180 / M_PI, type->angle_max * 180 / M_PI);
    return true;
}

/* `flow` overrides the type's within its range, which is rated: for water at `at`. */
static bool read_flow(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_nozzle *nozzle)
{
    const sp_fields in = {reader, &sp_block_nozzle, node};
    const sp_nozzle_type *type = nozzle->type;
    const sp_yaml *child = sp_yaml_get(node, "flow");
    if (!child)
        return true;
    if (!(type->flow_min < type->flow_max))
        return sp_read_fail(reader, child, "flow", "this key only with an adjustable type, and '%s' has no flow_range",
                            type->name);
    if (!sp_read_quantity(&in, "flow", &nozzle->flow))
        return false;
    double low = sp_type_flow(type, type->flow_min, nozzle->pressure, &scene->setup.liquid);
    double high = sp_type_flow(type, type->flow_max, nozzle->pressure, &scene->setup.liquid);
    if (nozzle->flow < low * (1 - 1e-9) || nozzle->flow > high * (1 + 1e-9))
        return sp_read_fail(reader, child, "flow",
                            "a flow within the range of '%s' at this pressure, %g L/min to %g L/min", type->name,
                            low * 6e4, high * 6e4);
    return true;
}

static bool read_nozzle(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_nozzle *nozzle)
{
    const sp_fields in = {reader, &sp_block_nozzle, node};
    return sp_read_block(&in, "nozzles") && sp_read_name(&in, "name", nozzle->name) &&
           (nozzle->type = sp_scene_find_type(scene, reader, sp_yaml_get(node, "type"), "type")) &&
           sp_read_vector(&in, "position", &nozzle->position) && sp_read_axis(&in, "axis", &nozzle->axis) &&
           sp_read_quantity(&in, "roll", &nozzle->roll) && sp_read_quantity(&in, "pressure", &nozzle->pressure) &&
           read_angle(reader, node, nozzle) && read_flow(scene, reader, node, nozzle) &&
           sp_read_quantity(&in, "speed", &nozzle->speed) && sp_read_count(&in, "jets", &nozzle->jets) &&
           sp_read_flag(&in, "keep", &nozzle->keep);
}

bool sp_scene_read_nozzles(sp_scene *scene, const sp_reader *reader)
{
    const sp_yaml *list = sp_yaml_get(scene->tree, "nozzles");
    size_t count = list ? list->count : 0, done = 0;
    if (list && !sp_read_is_list(reader, list, "nozzles", "nozzles"))
        return false;
    if (count > SP_MAX_ITEMS)
        return sp_read_message(reader, list, "nozzles", "found %zu nozzles, expected at most %d", count, SP_MAX_ITEMS);
    scene->layout = sp_layout_create(NULL, count, reader->error);
    if (!scene->layout)
        return false;
    for (const sp_yaml *node = list ? list->first : NULL; node; node = node->next) {
        sp_nozzle *nozzle = &scene->layout->nozzles[done];
        if (!read_nozzle(scene, reader, node, nozzle))
            return false;
        for (size_t i = 0; i < done; i++)
            if (strcmp(scene->layout->nozzles[i].name, nozzle->name) == 0)
                return sp_read_fail(reader, sp_yaml_get(node, "name"), "name", "a name that no other nozzle has");
        done++;
    }
    return true;
}
