#include "candidates/ranges.h"

#define ROUND_OFF 1e-9 /* share of a flow */

void sp_angle_range(const sp_place_options *options, const sp_nozzle_type *type, double *low, double *high)
{
    double change = sp_type_is_uniform(type) ? options->refine.angle : 0;
    double least = fmax(type->angle_min, type->angle - change), most = fmin(type->angle_max, type->angle + change);
    *low = sp_step_nearest(type->angle_step, type->angle, least, least, most);
    *high = sp_step_nearest(type->angle_step, type->angle, most, least, most);
}

double sp_fed_pressure(const sp_nozzle_type *type, double pressure)
{
    return sp_step_nearest(type->pressure_step, 0, pressure, sp_step_size(type->pressure_step), INFINITY);
}

void sp_flow_range(const sp_place_options *options, const sp_setup *setup, const sp_nozzle_type *type, double pressure,
                   double *low, double *high)
{
    sp_trajectory trajectory = type->trajectory == SP_TRAJECTORY_AUTO ? setup->fidelity.trajectory : type->trajectory;
    bool breaks_up = trajectory == SP_TRAJECTORY_DRAG && sp_type_is_stream(type);
    double change = sp_type_is_uniform(type) && !breaks_up ? options->refine.flow : 0;
    double least = fmax(type->flow_min, type->flow * (1 - change));
    double most = fmin(type->flow_max, type->flow * (1 + change));
    *low =
        sp_type_flow(type, sp_step_nearest(type->flow_step, type->flow, least, least, most), pressure, &setup->liquid);
    *high =
        sp_type_flow(type, sp_step_nearest(type->flow_step, type->flow, most, least, most), pressure, &setup->liquid);
}

double sp_flow_within(const sp_place_options *options, const sp_setup *setup, const sp_nozzle_type *type,
                      double pressure, double most)
{
    double low, high, size = sp_step_size(type->flow_step);
    sp_flow_range(options, setup, type, pressure, &low, &high);
    if (high <= most * (1 + ROUND_OFF))
        return high;
    if (low > most * (1 + ROUND_OFF))
        return 0;
    if (!(size > 0))
        return fmax(low, most);
    /* settings are those of the flow as rated */
    double rated = type->flow / sp_type_flow(type, type->flow, pressure, &setup->liquid);
    double value = sp_step_nearest(type->flow_step, type->flow, most * rated, low * rated, high * rated);
    if (value > most * rated * (1 + ROUND_OFF))
        value = sp_step_nearest(type->flow_step, type->flow, value - size, low * rated, high * rated);
    return sp_type_flow(type, value, pressure, &setup->liquid);
}

double sp_move_limit(const sp_place_options *options, const sp_mount *mount)
{
    double spacing = mount->kind == SP_MOUNT_PORT ? mount->depth_spacing : mount->spacing;
    double between = mount->kind == SP_MOUNT_SURFACE ? spacing : 0.5 * spacing;
    return options->refine.position < 0 ? between : options->refine.position;
}
