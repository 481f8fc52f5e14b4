/* What may be set of a type: its pressure, angle and flow. */
#ifndef OPTIMIZER_RANGES_H
#define OPTIMIZER_RANGES_H

#include <sprayplan/place.h>

/* True of a type whose liquid is spread evenly over one region, as sp_spray_is_uniform: it is judged from what a view
 * of its site holds, and refinement may change it. What any other brings is found by footprints, and it stays at the
 * poses of candidates. */
static inline bool sp_type_is_uniform(const sp_nozzle_type *type)
{
    return type->pattern == SP_PATTERN_FULL_CONE || type->pattern == SP_PATTERN_HOLLOW_CONE ||
           type->pattern == SP_PATTERN_FLAT_FAN || type->pattern == SP_PATTERN_SOLID_STREAM;
}

/* The pressure at which a type is fed that is offered one: the nearest that can be set. */
double sp_fed_pressure(const sp_nozzle_type *type, double pressure);
/* What refinement may set, between settings where there are steps: angle (rad), and flow (m³/s) of a type at a
 * pressure. With drag the flow of a stream stays: how far it flies before it breaks up depends on it, and with that all
 * flights. */
void sp_angle_range(const sp_place_options *options, const sp_nozzle_type *type, double *low, double *high);
void sp_flow_range(const sp_place_options *options, const sp_setup *setup, const sp_nozzle_type *type, double pressure,
                   double *low, double *high);

#endif
