/* up, cavity, caps, liquid, air, gravity, criterion. */
#include "scene/state.h"

#include <stdlib.h>

/* What liquid and air have. */
static bool read_fluid(const sp_fields *in, const char *key, sp_fluid *fluid)
{
    return sp_read_block(in, key) && sp_read_quantity(in, "density", &fluid->density) &&
           sp_read_quantity(in, "viscosity", &fluid->viscosity);
}

static bool read_fluids(sp_scene *scene, const sp_reader *reader)
{
    const sp_fields liquid = {reader, &sp_block_liquid, sp_yaml_get(scene->tree, "liquid")};
    const sp_fields air = {reader, &sp_block_air, sp_yaml_get(scene->tree, "air")};
    sp_fluid *of = &scene->setup.liquid;
    return (!liquid.map || (read_fluid(&liquid, "liquid", of) &&
                            sp_read_quantity(&liquid, "surface_tension", &of->surface_tension))) &&
           (!air.map || read_fluid(&air, "air", &scene->setup.air));
}

static bool read_cavity(sp_scene *scene, const sp_reader *reader)
{
    const sp_fields in = {reader, &sp_block_scene, scene->tree};
    const sp_yaml *node = sp_yaml_get(scene->tree, "cavity");
    if (!node)
        return true;
    if (sp_text_is(node, "outside")) {
        scene->setup.cavity = SP_CAVITY_OUTSIDE;
        return true;
    }
    if (node->kind != SP_YAML_LIST)
        return sp_read_fail(reader, node, "cavity", "a point such as [0 m, 0 m, 1 m], or outside");
    scene->setup.cavity = SP_CAVITY_POINT;
    return sp_read_vector(&in, "cavity", &scene->setup.cavity_point);
}

static bool read_cap(const sp_reader *reader, const sp_yaml *node, sp_cap *cap)
{
    const sp_fields in = {reader, &sp_block_cap, node};
    return sp_read_block(&in, "caps") && sp_read_vector(&in, "point", &cap->point) &&
           sp_read_axis(&in, "normal", &cap->normal) && sp_read_quantity(&in, "radius", &cap->radius);
}

static bool read_caps(sp_scene *scene, const sp_reader *reader)
{
    const sp_yaml *list = sp_yaml_get(scene->tree, "caps");
    if (!list)
        return true;
    if (!sp_read_is_list(reader, list, "caps", "caps such as {point: [..], normal: [0, 0, 1], radius: 50 mm}"))
        return false;
    scene->caps = calloc(list->count + 1, sizeof *scene->caps);
    if (!scene->caps)
        return sp_fail_memory(reader->error);
    for (const sp_yaml *node = list->first; node; node = node->next)
        if (!read_cap(reader, node, &scene->caps[scene->setup.cap_count++]))
            return false;
    return true;
}

static bool read_criterion(sp_scene *scene, const sp_reader *reader, sp_criterion *criterion)
{
    const sp_yaml *node = sp_yaml_get(scene->tree, "criterion");
    const sp_fields in = {reader, &sp_block_criterion, node};
    int combine = criterion->combine;
    if (!node)
        return true;
    if (!sp_read_block(&in, "criterion") || !sp_read_quantity(&in, "flux", &criterion->flux) ||
        !sp_read_quantity(&in, "dose", &scene->dose) ||
        !sp_read_quantity(&in, "impact_speed", &criterion->impact_speed) ||
        !sp_read_quantity(&in, "incidence", &criterion->incidence) ||
        !sp_read_quantity(&in, "film", &criterion->film) || !sp_read_choice(&in, "combine", &combine))
        return false;
    criterion->combine = combine == 1 ? SP_COMBINE_SINGLE : SP_COMBINE_SUM;
    return true;
}

bool sp_scene_read_physics(sp_scene *scene, const sp_reader *reader)
{
    const sp_fields in = {reader, &sp_block_scene, scene->tree};
    sp_setup *setup = &scene->setup;
    int up = 0;
    if (!sp_read_choice(&in, "up", &up) || !read_cavity(scene, reader) || !read_caps(scene, reader) ||
        !read_fluids(scene, reader) || !sp_read_quantity(&in, "gravity", &setup->gravity) ||
        !read_criterion(scene, reader, &setup->criterion))
        return false;
    setup->up = up == 1 ? sp_v(0, 1, 0) : sp_v(0, 0, 1);
    return true;
}
