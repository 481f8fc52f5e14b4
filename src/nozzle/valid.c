#include "valid.h"

#include "rotation.h"

#include "valid_range.h"

#include <string.h>

static sp_owner of_type(const sp_nozzle_type *type)
{
    return (sp_owner){"type", type->name};
}

static bool fail(const sp_nozzle_type *type, const char *what, sp_error *error)
{
    return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "type %.*s: %s", SP_NAME - 1, type->name, what);
}

/* A pattern that there is, with what it is made from. */
static bool has_pattern(const sp_nozzle_type *type, sp_error *error)
{
    if (type->pattern >= sp_form_count)
        return fail(type, "expected one of the patterns", error);
    if (sp_type_rotates(type) && !sp_pattern_turns(type->rotation.jet))
        return fail(type, "rotating, expected a cone, fan or stream as jet", error);
    if (sp_type_has_tracks(type) && !sp_pattern_fits_hub(type->rotation.jet))
        return fail(type, "a two-axis head, expected cones or streams as jets", error);
    if (sp_type_has_tracks(type) && !(type->rotation.gears[0] && type->rotation.gears[1]))
        return fail(type, "a two-axis head, expected gears with teeth", error);
    if (type->pattern == SP_PATTERN_MEASURED && !type->patternation)
        return fail(type, "measured, expected a patternation", error);
    return sp_is_word(of_type(type), "trajectory", type->trajectory, SP_TRAJECTORY_DRAG, error);
}

/* Of what rotates its jet's. */
static bool has_angles(const sp_nozzle_type *type, sp_error *error)
{
    bool rotates = sp_type_rotates(type), hub = sp_type_has_tracks(type);
    const sp_rotation *rotation = &type->rotation;
    sp_pattern jet = rotates ? rotation->jet : type->pattern;
    const sp_limit limits[] = {
        sp_above_to("angle", "rad", type->angle, 0, hub ? 0.5 * SP_HALF_TURN : SP_FULL_TURN),
        sp_from_below("hollow", "", jet == SP_PATTERN_HOLLOW_CONE ? type->hollow : 0, 0, 1),
        sp_above_to("thickness", "rad", jet == SP_PATTERN_FLAT_FAN ? type->thickness : 1, 0, SP_HALF_TURN),
        sp_from_to("rotation's tilt", "rad", rotates && !hub ? rotation->tilt : 0, 0, SP_HALF_TURN),
        sp_from_to("rotation's roll", "rad", rotates && !hub ? rotation->roll : 0, -SP_FINITE, SP_FINITE),
        sp_from_to("rotation's speed", "rad/s", rotates ? rotation->speed : 0, 0, SP_FINITE),
    };
    return sp_are_within(of_type(type), limits, sizeof limits / sizeof *limits, error);
}

/* Of all members the shares add up. */
static bool is_member(const sp_nozzle_type *cluster, const sp_member *member, sp_error *error)
{
    const sp_limit roll = sp_from_to("member's roll", "rad", member->roll, -SP_FINITE, SP_FINITE);
    if (member->type.pattern == SP_PATTERN_CLUSTER)
        return fail(cluster, "a cluster, expected members that are no clusters", error);
    if (!(member->share > 0 && member->share < 1e300))
        return fail(cluster, "a cluster, expected members with a share of the flow above 0", error);
    if (!(member->speed >= 0 && member->speed < 1e300))
        return fail(cluster, "a cluster, expected members with a part of the exit speed of 0 (all of it) or more",
                    error);
    return sp_type_is_valid(&member->type, error) && sp_are_within(of_type(cluster), &roll, 1, error) &&
           sp_is_place(of_type(cluster), "member's offset", member->offset, error) &&
           sp_is_direction(of_type(cluster), "member's axis", member->axis, error);
}

bool sp_type_is_valid(const sp_nozzle_type *type, sp_error *error)
{
    if (!type)
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "type: none found, expected one");
    if (!memchr(type->name, 0, SP_NAME))
        return fail(type, "expected a name that ends", error);
    if (!has_pattern(type, error))
        return false;
    if (type->pattern != SP_PATTERN_CLUSTER)
        return has_angles(type, error);
    if (!type->members || type->member_count < 1 || type->member_count > SP_MEMBERS)
        return fail(type, "a cluster, expected 1 to 1000 members", error);
    for (size_t i = 0; i < type->member_count; i++)
        if (!is_member(type, &type->members[i], error))
            return false;
    return true;
}

static bool is_flow_valid(const sp_nozzle_type *type, sp_error *error)
{
    const sp_limit limits[] = {
        sp_from_to("flow", "m3/s", type->flow, 0, SP_FINITE),
        sp_above_to("at", "Pa", type->at, 0, SP_FINITE),
        sp_from_to("exponent", "", type->exponent, 0, 1),
    };
    return sp_are_within(of_type(type), limits, sizeof limits / sizeof *limits, error);
}

static bool is_speed_valid(const sp_nozzle_type *type, sp_error *error)
{
    const sp_limit cv = sp_from_to("cv", "", type->cv, 0, 1);
    return sp_are_within(of_type(type), &cv, 1, error);
}

bool sp_type_is_rated(const sp_nozzle_type *type, sp_error *error)
{
    return is_flow_valid(type, error) && is_speed_valid(type, error);
}

static bool has_type(const sp_nozzle *nozzle, sp_error *error)
{
    return nozzle->type || sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "nozzle %.*s: no type found, expected one",
                                   SP_NAME - 1, nozzle->name);
}

bool sp_nozzle_is_valid(const sp_nozzle *nozzle, sp_error *error)
{
    const sp_owner owner = {"nozzle", nozzle->name};
    if (!memchr(nozzle->name, 0, SP_NAME))
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "nozzle %.*s: expected a name that ends", SP_NAME - 1,
                       nozzle->name);
    if (!has_type(nozzle, error) || !sp_type_is_valid(nozzle->type, error))
        return false;
    const sp_limit limits[] = {
        sp_from_to("pressure", "Pa", nozzle->pressure, 0, SP_FINITE),
        sp_from_to("angle", "rad", nozzle->angle, 0,
                   sp_type_has_tracks(nozzle->type) ? 0.5 * SP_HALF_TURN : SP_FULL_TURN),
        sp_from_to("flow", "m3/s", nozzle->flow, 0, SP_FINITE),
        sp_from_to("speed", "m/s", nozzle->speed, 0, SP_FINITE),
        sp_from_to("roll", "rad", nozzle->roll, -SP_FINITE, SP_FINITE),
    };
    return sp_are_within(owner, limits, sizeof limits / sizeof *limits, error) &&
           (nozzle->flow > 0 || is_flow_valid(nozzle->type, error)) &&
           (nozzle->speed > 0 || is_speed_valid(nozzle->type, error)) &&
           sp_is_place(owner, "position", nozzle->position, error) &&
           sp_is_direction(owner, "axis", nozzle->axis, error);
}

static bool has_nozzles(const sp_layout *layout, sp_error *error)
{
    return sp_is_listed((sp_owner){"layout", ""}, "nozzles", layout->nozzles, layout->count, error);
}

bool sp_layout_has_types(const sp_layout *layout, sp_error *error)
{
    if (!has_nozzles(layout, error))
        return false;
    for (size_t i = 0; i < layout->count; i++)
        if (!has_type(&layout->nozzles[i], error))
            return false;
    return true;
}

bool sp_layout_is_valid(const sp_layout *layout, sp_error *error)
{
    if (!has_nozzles(layout, error))
        return false;
    for (size_t i = 0; i < layout->count; i++)
        if (!sp_nozzle_is_valid(&layout->nozzles[i], error))
            return false;
    return true;
}
