/* rotation: of a catalogue type that turns about two axes. */
#include "nozzle/rotation.h"
#include "scene/state.h"

#define WIDEST 90 /* deg: the mean over a jet is told well up to there */

static bool read_teeth(const sp_reader *reader, const sp_yaml *node, unsigned gears[2])
{
    if (node->kind != SP_YAML_LIST || node->count != 2)
        return sp_read_fail(reader, node, "gears", "two numbers of teeth such as [43, 47]");
    const sp_yaml *child = node->first;
    for (int i = 0; i < 2; i++, child = child->next) {
        double teeth;
        if (!sp_read_quantity_at(reader, child, sp_key_of(&sp_block_rotation, "gears"), &teeth))
            return false;
        if (teeth != floor(teeth))
            return sp_read_fail(reader, child, "gears", "a whole number of teeth");
        gears[i] = (unsigned)teeth;
    }
    return true;
}

/* What only a head with gears has. */
static bool refuse_without_gears(const sp_reader *reader, const sp_yaml *rotation)
{
    static const char *const owned[] = {"jets", "speed", "turns"};
    for (size_t i = 0; i < sizeof owned / sizeof *owned; i++) {
        const sp_yaml *child = sp_yaml_get(rotation, owned[i]);
        if (child)
            return sp_read_fail(reader, child, owned[i], "this key only beside gears, of what turns about two axes");
    }
    return true;
}

/* The jet of a two-axis head points outwards from its hub, and is no fan. */
static bool check_jet(const sp_reader *reader, const sp_yaml *rotation, const sp_nozzle_type *type)
{
    static const char *const leaning[] = {"tilt", "roll"};
    const sp_yaml *jet = sp_yaml_get(rotation, "jet");
    for (size_t i = 0; i < sizeof leaning / sizeof *leaning; i++) {
        const sp_yaml *child = sp_yaml_get(jet, leaning[i]);
        if (child)
            return sp_read_fail(reader, child, leaning[i], "none beside gears: jets on a hub point outwards from it");
    }
    if (!sp_pattern_fits_hub(type->rotation.jet))
        return sp_read_fail(reader, sp_yaml_get(jet, "pattern"), "pattern",
                            "full_cone, hollow_cone or solid_stream beside gears");
    if (type->angle > WIDEST * acos(-1) / 180 * (1 + 1e-12))
        return sp_read_fail(reader, sp_yaml_get(jet, "angle"), "angle", "an angle of at most %d deg beside gears",
                            WIDEST);
    return true;
}

bool sp_scene_read_gears(const sp_reader *reader, const sp_yaml *rotation, sp_nozzle_type *type)
{
    const sp_fields in = {reader, &sp_block_rotation, rotation};
    const sp_yaml *gears = sp_yaml_get(rotation, "gears");
    if (!gears)
        return refuse_without_gears(reader, rotation);
    if (!sp_yaml_get(rotation, "jets"))
        return sp_read_message(reader, rotation, "jets", "found nothing, expected this key beside gears");
    uint64_t jets = 0, turns = 0;
    if (!read_teeth(reader, gears, type->rotation.gears) || !sp_read_count(&in, "jets", &jets) ||
        !sp_read_quantity(&in, "speed", &type->rotation.speed) || !sp_read_count(&in, "turns", &turns))
        return false;
    type->rotation.jets = (unsigned)jets;
    type->rotation.turns = (unsigned)turns;
    return check_jet(reader, rotation, type);
}
