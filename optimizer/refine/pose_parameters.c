#include "refine/pose_parameters.h"

#include "candidates/ranges.h"

static void add(sp_pose_parameters *parameters, sp_unknown kind, sp_vec3 move, double value, double low, double high)
{
    if (!(high - low > 1e-9 * (fabs(high) + fabs(low))))
        return;
    size_t i = parameters->count++;
    parameters->kind[i] = kind;
    parameters->move[i] = move;
    parameters->value[i] = fmin(high, fmax(low, value));
    parameters->low[i] = low;
    parameters->high[i] = high;
}

/* A move along a line on which the mount allows [from, to], the nozzle's origin being at `origin`. */
static void add_move(sp_pose_parameters *parameters, sp_vec3 direction, double from, double to, double origin,
                     double limit)
{
    double value = sp_dot(sp_sub(parameters->start.position, parameters->origin.position), direction);
    add(parameters, SP_UNKNOWN_PLACE, direction, value, fmax(from - origin, -limit), fmin(to - origin, limit));
}

static void add_place(sp_pose_parameters *parameters, const sp_place_options *options, const sp_mount *mount)
{
    sp_vec3 at = parameters->origin.position;
    double limit = sp_move_limit(options, mount);
    sp_vec3 along = sp_sub(mount->to, mount->from), unit = sp_unit(along);
    switch (mount->kind) {
    case SP_MOUNT_PORT:
        add_move(parameters, mount->axis, mount->depth_from, mount->depth_to,
                 sp_dot(sp_sub(at, mount->position), mount->axis), limit);
        break;
    case SP_MOUNT_LINE:
        add_move(parameters, unit, 0, sp_length(along), sp_dot(sp_sub(at, mount->from), unit), limit);
        break;
    case SP_MOUNT_BOX:
        add_move(parameters, sp_v(1, 0, 0), mount->from.x, mount->to.x, at.x, limit);
        add_move(parameters, sp_v(0, 1, 0), mount->from.y, mount->to.y, at.y, limit);
        add_move(parameters, sp_v(0, 0, 1), mount->from.z, mount->to.z, at.z, limit);
        break;
    case SP_MOUNT_SURFACE: {
        /* along the tangent plane; whoever applies the move brings it back to the standoff */
        sp_frame frame = sp_nozzle_frame(parameters->reference, 0, parameters->up);
        add_move(parameters, frame.x, -INFINITY, INFINITY, 0, limit);
        add_move(parameters, frame.y, -INFINITY, INFINITY, 0, limit);
        break;
    }
    }
}

/* Turned by `angle` about the unit vector `about`: Rodrigues' formula. */
static sp_vec3 turned(sp_vec3 v, sp_vec3 about, double angle)
{
    sp_vec3 along = sp_scale(about, sp_dot(about, v) * (1 - cos(angle)));
    return sp_add(sp_add(sp_scale(v, cos(angle)), sp_scale(sp_cross(about, v), sin(angle))), along);
}

static double angle_between(sp_vec3 a, sp_vec3 b)
{
    return atan2(sp_length(sp_cross(a, b)), sp_dot(a, b));
}

/* The axis brought within `limit` of `centre`. */
static sp_vec3 leaned(sp_vec3 axis, sp_vec3 centre, double limit)
{
    double away = angle_between(axis, centre);
    if (away <= limit)
        return axis;
    sp_vec3 about = sp_unit(sp_cross(centre, axis));
    return sp_unit(turned(centre, about, limit));
}

/* The frame's roll jumps where the axis passes the vertical, this one does not. */
double sp_carried_roll(const sp_nozzle *nozzle, sp_vec3 axis, sp_vec3 up)
{
    sp_frame from = sp_nozzle_frame(nozzle->axis, nozzle->roll, up);
    sp_frame to = sp_nozzle_frame(axis, 0, up);
    sp_vec3 about = sp_unit(sp_cross(from.z, axis));
    sp_vec3 x = turned(from.x, about, angle_between(from.z, axis));
    return atan2(sp_dot(x, to.y), sp_dot(x, to.x));
}

static double carried_roll(const sp_pose_parameters *parameters, sp_vec3 axis)
{
    return sp_carried_roll(&parameters->origin, axis, parameters->up);
}

/* The roll with which a nozzle turned to this axis is listed, `roll` past the one carried along. What is the
 * same at every roll keeps its own, so that no layout asks for turns that mean nothing. */
static double listed_roll(const sp_pose_parameters *parameters, sp_vec3 axis, double roll)
{
    bool rolls = sp_type_roll_period(parameters->start.type) > 0;
    return rolls ? carried_roll(parameters, axis) + roll : parameters->start.roll;
}

static void add_axis(sp_pose_parameters *parameters, double limit)
{
    if (!(limit > 0) || !(parameters->tilt > 0))
        return;
    sp_vec3 axis = parameters->start.axis, centre = parameters->origin.axis;
    double away = angle_between(axis, centre);
    sp_vec3 direction = sp_unit(sp_sub(axis, sp_scale(centre, sp_dot(axis, centre))));
    for (int i = 0; i < 2; i++)
        add(parameters, SP_UNKNOWN_AXIS, parameters->across[i], away * sp_dot(direction, parameters->across[i]), -limit,
            limit);
}

sp_pose_parameters sp_pose_parameters_create(const sp_search *search, const sp_placed *placed)
{
    const sp_place_options *options = search->options;
    const sp_mount *mount = &options->mounts[placed->site.mount];
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    const sp_nozzle_type *type = placed->nozzle.type;
    sp_pose_parameters parameters = {.start = placed->nozzle,
                                     .origin = placed->origin,
                                     .up = setup->up,
                                     .reference = placed->site.axis,
                                     .tilt = mount->tilt,
                                     .axis_limit = fmin(M_PI, options->refine.axis)};
    sp_frame frame = sp_nozzle_frame(placed->origin.axis, 0, setup->up);
    parameters.across[0] = frame.x;
    parameters.across[1] = frame.y;
    if (!sp_type_is_uniform(type))
        return parameters;
    add_place(&parameters, options, mount);
    add_axis(&parameters, parameters.axis_limit);
    sp_vec3 none = {0, 0, 0};
    double period = sp_type_roll_period(type);
    if (options->refine.roll && period > 0) {
        double roll = remainder(placed->nozzle.roll - carried_roll(&parameters, placed->nozzle.axis), period);
        add(&parameters, SP_UNKNOWN_ROLL, none, roll, -0.5 * period, 0.5 * period);
    }
    double low, high;
    sp_angle_range(options, type, &low, &high);
    add(&parameters, SP_UNKNOWN_ANGLE, none, sp_nozzle_angle(&placed->nozzle), low, high);
    sp_flow_range(options, setup, type, placed->nozzle.pressure, &low, &high);
    add(&parameters, SP_UNKNOWN_FLOW, none, placed->flow, low, high);
    return parameters;
}

sp_nozzle sp_pose_parameters_nozzle(const sp_pose_parameters *parameters, const double *values)
{
    sp_nozzle nozzle = parameters->start;
    sp_vec3 position = parameters->start.position, lean = {0, 0, 0};
    double roll = 0;
    bool leans = false, rolls = false;
    for (size_t i = 0; i < parameters->count; i++) {
        double value = fmin(parameters->high[i], fmax(parameters->low[i], values[i]));
        switch (parameters->kind[i]) {
        case SP_UNKNOWN_PLACE:
            position = sp_along(position, value - parameters->value[i], parameters->move[i]);
            break;
        case SP_UNKNOWN_AXIS:
            lean = sp_along(lean, value, parameters->move[i]);
            leans = true;
            break;
        case SP_UNKNOWN_ROLL:
            roll = value;
            rolls = true;
            break;
        case SP_UNKNOWN_ANGLE:
            nozzle.angle = value;
            break;
        case SP_UNKNOWN_FLOW:
            nozzle.flow = value;
            break;
        }
    }
    nozzle.position = position;
    if (leans) {
        double away = fmin(parameters->axis_limit, sp_length(lean));
        sp_vec3 about = sp_unit(sp_cross(parameters->origin.axis, lean));
        nozzle.axis =
            leaned(sp_unit(turned(parameters->origin.axis, about, away)), parameters->reference, parameters->tilt);
    }
    if (leans || rolls)
        nozzle.roll = listed_roll(parameters, nozzle.axis, roll);
    return nozzle;
}

sp_nozzle sp_pose_parameters_nozzle_at(const sp_pose_parameters *parameters, const double *values, const sp_site *site)
{
    sp_nozzle nozzle = sp_pose_parameters_nozzle(parameters, values);
    double roll = nozzle.roll - carried_roll(parameters, nozzle.axis);
    nozzle.position = site->position;
    if (angle_between(nozzle.axis, site->axis) > parameters->tilt) {
        nozzle.axis = leaned(nozzle.axis, site->axis, parameters->tilt);
        nozzle.roll = listed_roll(parameters, nozzle.axis, roll);
    }
    return nozzle;
}
