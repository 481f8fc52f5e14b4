#include "candidates/valid_options.h"

#include "valid_range.h"
#include "nozzle/valid.h"

#define SLACK 1e-9 /* of an end of a range, that a value may be written beyond it */

static const sp_owner of_place = {"place", ""};

static bool are_listed(sp_owner owner, const char *name, const sp_nozzle_type *const *types, size_t count,
                       sp_error *error)
{
    if (!sp_is_listed(owner, name, types, count, error))
        return false;
    for (size_t i = 0; i < count; i++)
        if (!sp_type_is_valid(types[i], error))
            return false;
    return true;
}

/* Beyond what evaluating asks: its ranges hold its own angle and flow, and its steps are some. */
static bool is_adjustable(const sp_nozzle_type *type, sp_error *error)
{
    bool angles = type->pattern != SP_PATTERN_CLUSTER;
    double angle = type->angle, flow = type->flow, more = 1 + SLACK, less = 1 - SLACK;
    const sp_limit limits[] = {
        sp_from_to("angle_min", "rad", angles ? type->angle_min : 0, 0, angle * more),
        sp_from_to("angle_max", "rad", angles ? type->angle_max : angle, angle * less, SP_FULL_TURN),
        sp_from_to("flow_min", "m3/s", type->flow_min, 0, flow * more),
        sp_from_to("flow_max", "m3/s", type->flow_max, flow * less, SP_FINITE),
        sp_from_to("angle_step", "", type->angle_step.count, 0, SP_FINITE),
        sp_from_to("angle_step's unit", "rad", type->angle_step.unit, 0, SP_FINITE),
        sp_from_to("flow_step", "", type->flow_step.count, 0, SP_FINITE),
        sp_from_to("flow_step's unit", "m3/s", type->flow_step.unit, 0, SP_FINITE),
        sp_from_to("pressure_step", "", type->pressure_step.count, 0, SP_FINITE),
        sp_from_to("pressure_step's unit", "Pa", type->pressure_step.unit, 0, SP_FINITE),
        sp_from_to("body", "m", type->body, 0, SP_FINITE),
    };
    return sp_type_is_rated(type, error) &&
           sp_are_within((sp_owner){"type", type->name}, limits, sizeof limits / sizeof *limits, error);
}

static bool has_numbers(const sp_mount *mount, sp_error *error)
{
    bool port = mount->kind == SP_MOUNT_PORT;
    const sp_limit limits[] = {
        sp_from_to("cost", "m3/s", mount->cost, 0, SP_FINITE),
        sp_from_to("tilt", "rad", mount->tilt, 0, SP_HALF_TURN),
        sp_from_to("spacing", "m", mount->spacing, 0, SP_FINITE),
        sp_from_to("standoff", "m", mount->standoff, 0, SP_FINITE),
        sp_from_to("depth_from", "m", mount->depth_from, 0, SP_FINITE),
        sp_from_to("depth_to", "m", mount->depth_to, port ? mount->depth_from : 0, SP_FINITE),
        sp_from_to("depth_spacing", "m", mount->depth_spacing, 0, SP_FINITE),
        sp_from_to("bore", "m", mount->bore, 0, SP_FINITE),
        sp_from_to("depth_step", "", mount->depth_step.count, 0, SP_FINITE),
        sp_from_to("depth_step's unit", "m", mount->depth_step.unit, 0, SP_FINITE),
        sp_from_to("tilt_step", "", mount->tilt_step.count, 0, SP_FINITE),
        sp_from_to("tilt_step's unit", "rad", mount->tilt_step.unit, 0, SP_FINITE),
    };
    return sp_are_within((sp_owner){"mount", mount->name}, limits, sizeof limits / sizeof *limits, error);
}

/* Its place and axis, as far as it has them. */
static bool has_place(const sp_mount *mount, sp_error *error)
{
    const sp_owner owner = {"mount", mount->name};
    if (mount->kind == SP_MOUNT_SURFACE)
        return true;
    const sp_vec3 low = mount->from, high = mount->to;
    bool ordered = mount->kind != SP_MOUNT_BOX || (low.x <= high.x && low.y <= high.y && low.z <= high.z);
    return sp_is_direction(owner, "axis", mount->axis, error) &&
           sp_is_place(owner, "position", mount->position, error) && sp_is_place(owner, "from", low, error) &&
           sp_is_place(owner, "to", high, error) &&
           (ordered || sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                               "mount: a box from (%g, %g, %g) to (%g, %g, %g) found, expected the smaller first",
                               low.x, low.y, low.z, high.x, high.y, high.z));
}

bool sp_mounts_are_valid(const sp_place_options *options, sp_error *error)
{
    if (!sp_is_listed(of_place, "mounts", options->mounts, options->mount_count, error))
        return false;
    for (size_t i = 0; i < options->mount_count; i++) {
        const sp_mount *mount = &options->mounts[i];
        const sp_owner owner = {"mount", mount->name};
        if (!sp_is_word(owner, "kind", mount->kind, SP_MOUNT_BOX, error) || !has_numbers(mount, error) ||
            !has_place(mount, error) || !are_listed(owner, "types", mount->types, mount->type_count, error))
            return false;
    }
    return true;
}

static bool are_numbers(const sp_place_options *options, sp_error *error)
{
    const sp_refine *refine = &options->refine;
    const sp_limit limits[] = {
        sp_from_to("max_water", "m3/s", options->max_water, 0, INFINITY),
        sp_from_to("clearance", "m", options->clearance, 0, SP_FINITE),
        sp_from_to("memory", "bytes", options->memory, 0, INFINITY),
        sp_from_to("refine.position", "m", refine->position == -1 ? 0 : refine->position, 0, SP_FINITE),
        sp_from_to("refine.axis", "rad", refine->axis, 0, SP_FINITE),
        sp_from_to("refine.angle", "rad", refine->angle, 0, INFINITY),
        sp_from_to("refine.flow", "", refine->flow, 0, INFINITY),
    };
    return sp_are_within(of_place, limits, sizeof limits / sizeof *limits, error);
}

static bool are_pressures(const sp_place_options *options, sp_error *error)
{
    if (!sp_is_listed(of_place, "pressures", options->pressures, options->pressure_count, error))
        return false;
    for (size_t i = 0; i < options->pressure_count; i++) {
        const sp_limit limit = sp_from_to("pressure", "Pa", options->pressures[i], 0, SP_FINITE);
        if (!sp_are_within(of_place, &limit, 1, error))
            return false;
    }
    return true;
}

bool sp_options_are_valid(const sp_place_options *options, sp_error *error)
{
    if (!sp_run_is_valid(&options->run, error) || !are_numbers(options, error) ||
        !sp_is_word(of_place, "objective", options->objective, SP_OBJECTIVE_MAX_COVERAGE, error) ||
        !are_pressures(options, error) || !sp_mounts_are_valid(options, error) ||
        !sp_is_listed(of_place, "others", options->others, options->other_count, error) ||
        !are_listed(of_place, "types", options->types, options->type_count, error))
        return false;
    for (size_t i = 0; i < options->type_count; i++)
        if (!is_adjustable(options->types[i], error))
            return false;
    if (!sp_is_listed(of_place, "known", options->known, options->known_count, error))
        return false;
    return !options->kept || sp_layout_is_valid(options->kept, error);
}
