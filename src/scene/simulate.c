/* simulate: how faithfully. */
#include "scene/state.h"

static bool is_auto(const sp_yaml *map, const char *key)
{
    return sp_text_is(sp_yaml_get(map, key), "auto");
}

/* Whole numbers and lengths that may also be auto, which the defaults are already. */
static bool read_sizes(const sp_reader *reader, const sp_yaml *node, sp_fidelity *fidelity)
{
    uint64_t reflections = 0;
    bool counted = sp_yaml_get(node, "reflections") && !is_auto(node, "reflections");
    if (counted && !sp_read_count(reader, node, "reflections", 0, 1000, &reflections))
        return false;
    if (counted)
        fidelity->reflections = (int)reflections;
    if (!is_auto(node, "jets") && !sp_read_count(reader, node, "jets", 1, SP_MAX_JETS, &fidelity->jets))
        return false;
    return is_auto(node, "texel") ||
           sp_read_quantity(reader, node, "texel", &sp_length_unit, sp_above(0), &fidelity->texel);
}

bool sp_scene_read_trajectory(const sp_reader *reader, const sp_yaml *map, sp_trajectory *trajectory)
{
    static const char *const trajectories[] = {"auto", "line", "parabola", "drag", NULL};
    int choice = *trajectory;
    if (!sp_read_choice(reader, map, "trajectory", trajectories, &choice))
        return false;
    *trajectory = (sp_trajectory)choice;
    return true;
}

bool sp_scene_read_simulate(sp_scene *scene, const sp_reader *reader)
{
    static const sp_key keys[] = {{"trajectory", false}, {"evaluator", false}, {"reflections", false}, {"jets", false},
                                  {"texel", false},      {"splat", false},     {"accuracy", false},    {"seed", false},
                                  {"atlas", false},      {NULL, false}};
    static const char *const methods[] = {"auto", "forward", "inverse", NULL};
    static const char *const splats[] = {"nearest", "linear", NULL};
    static const char *const atlases[] = {"unfold", "reuse", NULL};
    const sp_yaml *node = sp_yaml_get(scene->tree, "simulate");
    sp_fidelity *fidelity = &scene->setup.fidelity;
    int method = fidelity->method, splat = fidelity->splat, atlas = 0;
    if (!node)
        return true;
    if (!sp_read_keys(reader, node, "simulate", "the simulation", keys) ||
        !sp_scene_read_trajectory(reader, node, &fidelity->trajectory) ||
        !sp_read_choice(reader, node, "evaluator", methods, &method) || !read_sizes(reader, node, fidelity) ||
        !sp_read_choice(reader, node, "splat", splats, &splat) ||
        !sp_read_choice(reader, node, "atlas", atlases, &atlas) ||
        !sp_read_quantity(reader, node, "accuracy", &sp_share_unit, sp_above_to(0, 1), &fidelity->accuracy) ||
        !sp_read_count(reader, node, "seed", 0, UINT64_MAX, &fidelity->seed))
        return false;
    fidelity->method = (sp_method)method;
    fidelity->splat = (sp_splat)splat;
    scene->reuse = atlas == 1;
    return true;
}
