/* up, cavity, caps, liquid, air, gravity, criterion. */
#include "scene/state.h"

#include <stdlib.h>

static bool read_fluid(const sp_scene *scene, const sp_reader *reader, const char *key, const char *what,
                       const sp_key *keys, sp_fluid *fluid)
{
    const sp_yaml *node = sp_yaml_get(scene->tree, key);
    return !node ||
           (sp_read_keys(reader, node, key, what, keys) &&
            sp_read_quantity(reader, node, "density", &sp_density_unit, sp_above(0), &fluid->density) &&
            sp_read_quantity(reader, node, "viscosity", &sp_viscosity_unit, sp_above(0), &fluid->viscosity) &&
            sp_read_quantity(reader, node, "surface_tension", &sp_tension_unit, sp_above(0), &fluid->surface_tension));
}

static bool read_fluids(sp_scene *scene, const sp_reader *reader)
{
    static const sp_key liquid[] = {
        {"density", false}, {"viscosity", false}, {"surface_tension", false}, {NULL, false}};
    static const sp_key air[] = {{"density", false}, {"viscosity", false}, {NULL, false}};
    return read_fluid(scene, reader, "liquid", "the liquid", liquid, &scene->setup.liquid) &&
           read_fluid(scene, reader, "air", "the air", air, &scene->setup.air);
}

static bool read_cavity(sp_scene *scene, const sp_reader *reader)
{
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
    return sp_read_vector(reader, scene->tree, "cavity", &sp_length_unit, &scene->setup.cavity_point);
}

static bool read_cap(const sp_reader *reader, const sp_yaml *node, sp_cap *cap)
{
    static const sp_key keys[] = {{"point", true}, {"normal", true}, {"radius", true}, {NULL, false}};
    return sp_read_keys(reader, node, "caps", "a cap", keys) &&
           sp_read_vector(reader, node, "point", &sp_length_unit, &cap->point) &&
           sp_read_axis(reader, node, "normal", &cap->normal) &&
           sp_read_quantity(reader, node, "radius", &sp_length_unit, sp_above(0), &cap->radius);
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
    static const sp_key keys[] = {{"flux", false},      {"dose", false},    {"impact_speed", false},
                                  {"incidence", false}, {"combine", false}, {"film", false},
                                  {NULL, false}};
    static const char *const combines[] = {"sum", "single", NULL};
    const sp_yaml *node = sp_yaml_get(scene->tree, "criterion");
    int combine = criterion->combine;
    if (!node)
        return true;
    if (!sp_read_keys(reader, node, "criterion", "the criterion", keys) ||
        !sp_read_quantity(reader, node, "flux", &sp_flux_unit, sp_from(0), &criterion->flux) ||
        !sp_read_quantity(reader, node, "dose", &sp_dose_unit, sp_from(0), &scene->dose) ||
        !sp_read_quantity(reader, node, "impact_speed", &sp_speed_unit, sp_from(0), &criterion->impact_speed) ||
        !sp_read_quantity(reader, node, "incidence", &sp_angle_unit, sp_above_to(0, acos(-1) / 2),
                          &criterion->incidence) ||
        !sp_read_quantity(reader, node, "film", &sp_width_flow_unit, sp_above(0), &criterion->film) ||
        !sp_read_choice(reader, node, "combine", combines, &combine))
        return false;
    criterion->combine = combine == 1 ? SP_COMBINE_SINGLE : SP_COMBINE_SUM;
    return true;
}

bool sp_scene_read_physics(sp_scene *scene, const sp_reader *reader)
{
    static const char *const ups[] = {"z", "y", NULL};
    sp_setup *setup = &scene->setup;
    int up = 0;
    if (!sp_read_choice(reader, scene->tree, "up", ups, &up) || !read_cavity(scene, reader) ||
        !read_caps(scene, reader) || !read_fluids(scene, reader) ||
        !sp_read_quantity(reader, scene->tree, "gravity", &sp_acceleration_unit, sp_from(0), &setup->gravity) ||
        !read_criterion(scene, reader, &setup->criterion))
        return false;
    setup->up = up == 1 ? sp_v(0, 1, 0) : sp_v(0, 0, 1);
    return true;
}
