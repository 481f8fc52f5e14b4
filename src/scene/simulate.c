/* simulate: how faithfully. */
#include "scene/state.h"

static bool is_auto(const sp_yaml *map, const char *key)
{
    return sp_text_is(sp_yaml_get(map, key), "auto");
}

/* Whole numbers and lengths that may also be auto, which the defaults are already. */
static bool read_sizes(const sp_reader *reader, const sp_yaml *node, sp_fidelity *fidelity)
{
    const sp_fields in = {reader, &sp_block_simulate, node};
    uint64_t reflections = 0;
    bool counted = sp_yaml_get(node, "reflections") && !is_auto(node, "reflections");
    if (counted && !sp_read_count(&in, "reflections", &reflections))
        return false;
    if (counted)
        fidelity->reflections = (int)reflections;
    if (!is_auto(node, "jets") && !sp_read_count(&in, "jets", &fidelity->jets))
        return false;
    return is_auto(node, "texel") || sp_read_quantity(&in, "texel", &fidelity->texel);
}

bool sp_scene_read_trajectory(const sp_fields *in, sp_trajectory *trajectory)
{
    int choice = *trajectory;
    if (!sp_read_choice(in, "trajectory", &choice))
        return false;
    *trajectory = (sp_trajectory)choice;
    return true;
}

bool sp_scene_read_simulate(sp_scene *scene, const sp_reader *reader)
{
    const sp_yaml *node = sp_yaml_get(scene->tree, "simulate");
    const sp_fields in = {reader, &sp_block_simulate, node};
    sp_fidelity *fidelity = &scene->setup.fidelity;
    int method = fidelity->method, splat = fidelity->splat, atlas = 0;
    if (!node)
        return true;
    if (!sp_read_block(&in, "simulate") || !sp_scene_read_trajectory(&in, &fidelity->trajectory) ||
        !sp_read_choice(&in, "evaluator", &method) || !read_sizes(reader, node, fidelity) ||
        !sp_read_choice(&in, "splat", &splat) || !sp_read_choice(&in, "atlas", &atlas) ||
        !sp_read_quantity(&in, "accuracy", &fidelity->accuracy) || !sp_read_count(&in, "seed", &fidelity->seed))
        return false;
    fidelity->method = (sp_method)method;
    fidelity->splat = (sp_splat)splat;
    scene->reuse = atlas == 1;
    return true;
}
