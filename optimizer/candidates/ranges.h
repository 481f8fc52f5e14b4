/* What may be set of a type, its pressure, angle and flow, and how far its place may be moved. */
#ifndef OPTIMIZER_RANGES_H
#define OPTIMIZER_RANGES_H

#include "nozzle/pattern.h"

#include <sprayplan/place.h>

/* The pressure at which a type is fed that is offered one: the nearest that can be set. */
double sp_fed_pressure(const sp_nozzle_type *type, double pressure);
/* What refinement may set, between settings where there are steps: angle (rad), and flow (m³/s) of a type at a
 * pressure. With drag the flow of a stream stays: how far it flies before it breaks up depends on it, and with that all
 * flights. */
void sp_angle_range(const sp_place_options *options, const sp_nozzle_type *type, double *low, double *high);
void sp_flow_range(const sp_place_options *options, const sp_setup *setup, const sp_nozzle_type *type, double pressure,
                   double *low, double *high);
/* The most of that, m³/s, that is no more than `most`; 0 where there is none. */
double sp_flow_within(const sp_place_options *options, const sp_setup *setup, const sp_nozzle_type *type,
                      double pressure, double most);
/* m that refinement may move a nozzle from where it was mounted, along each direction that the mount has; along a
 * surface in all. Where nothing else is asked it gets to every place between the mounting points: those of a surface
 * are laid so that hardly any place of it is farther than a spacing from the nearest. */
double sp_move_limit(const sp_place_options *options, const sp_mount *mount);

#endif
