/* sweep: of geometry that is moved past the nozzles, and the dose that goes with it. */
#include "scene/state.h"

static bool equal(sp_vec3 a, sp_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

bool sp_scene_read_sweep(sp_scene *scene, const sp_reader *reader, const sp_yaml *piece, bool *moves)
{
    const sp_yaml *node = sp_yaml_get(piece, "sweep");
    const sp_fields in = {reader, &sp_block_sweep, node};
    sp_sweep sweep = {.speed = 0}, *known = &scene->setup.sweep;
    if (!node)
        return true;
    if (!sp_read_block(&in, "sweep") || !sp_read_vector(&in, "from", &sweep.from) ||
        !sp_read_vector(&in, "to", &sweep.to) || !sp_read_quantity(&in, "speed", &sweep.speed))
        return false;
    if (!(sp_distance(sweep.from, sweep.to) > 0))
        return sp_read_message(reader, sp_yaml_get(node, "to"), "to", "found the same place as from, expected another");
    if (known->speed > 0 &&
        !(equal(known->from, sweep.from) && equal(known->to, sweep.to) && known->speed == sweep.speed))
        return sp_read_message(reader, node, "sweep",
                               "found another one than of the geometry before it, expected the same: all that moves, "
                               "moves together");
    *known = sweep;
    *moves = true;
    return true;
}

bool sp_scene_settle_dose(sp_scene *scene, const sp_reader *reader)
{
    const sp_yaml *criterion = sp_yaml_get(scene->tree, "criterion");
    const sp_yaml *dose = criterion ? sp_yaml_get(criterion, "dose") : NULL,
                  *flux = criterion ? sp_yaml_get(criterion, "flux") : NULL,
                  *film = criterion ? sp_yaml_get(criterion, "film") : NULL;
    bool moves = scene->setup.sweep.speed > 0;
    if (dose && !moves)
        return sp_read_message(reader, dose, "dose",
                               "found without geometry that has a sweep, expected flux: what stands has no pass over "
                               "which liquid adds up");
    if (flux && moves)
        return sp_read_message(
            reader, flux, "flux",
            "found beside a sweep, where it changes as the goods pass, expected dose, such as 2 L/m2");
    if (film && moves)
        return sp_read_message(reader, film, "film",
                               "found beside a sweep, expected none: what runs down goods that move is not known yet");
    if (moves)
        scene->setup.criterion.flux = scene->dose / sp_sweep_duration(&scene->setup.sweep);
    return true;
}
