/* datum: what fitters measure from. */
#include "scene/state.h"

#define SQUARE_LEAST 1e-3 /* rad between the directions */

/* `zero` made square to the axis. */
static bool square(const sp_reader *reader, const sp_yaml *node, sp_datum *datum)
{
    const sp_yaml *zero = sp_yaml_get(node, "zero");
    sp_vec3 across = sp_sub(datum->zero, sp_scale(datum->axis, sp_dot(datum->zero, datum->axis)));
    if (!(sp_length(across) > SQUARE_LEAST))
        return zero ? sp_read_fail(reader, zero, "zero", "a direction across the datum's axis")
                    : sp_read_message(reader, node, "zero",
                                      "found nothing, expected this key beside an axis along x: the direction of "
                                      "azimuth 0");
    datum->zero = sp_unit(across);
    return true;
}

bool sp_scene_read_datum(sp_scene *scene, const sp_reader *reader)
{
    const sp_yaml *node = sp_yaml_get(scene->tree, "datum");
    const sp_fields in = {reader, &sp_block_datum, node};
    sp_datum *datum = &scene->setup.datum;
    datum->axis = scene->setup.up;
    return !node || (sp_read_block(&in, "datum") && sp_read_name(&in, "name", datum->name) &&
                     sp_read_vector(&in, "origin", &datum->origin) && sp_read_axis(&in, "axis", &datum->axis) &&
                     sp_read_axis(&in, "zero", &datum->zero) && square(reader, node, datum));
}
