/* Candidate poses: mounting point x type x pressure x angle x axis x roll. */
#ifndef OPTIMIZER_CANDIDATES_H
#define OPTIMIZER_CANDIDATES_H

#include "candidates/mounts.h"

#include <sprayplan/launch.h>

/* A type at a pressure and an angle. */
typedef struct {
    const sp_nozzle_type *type;
    double pressure; /* Pa */
    double angle;    /* rad */
    double flow;     /* m³/s */
    size_t launch;   /* of the candidates' launches */
    sp_spray spray;
    double reach;      /* rad, half-angle of the cone that holds the pattern */
    size_t roll_count; /* 1 where it is the same at every roll */
} sp_make;

/* True of a type whose liquid is spread evenly over one region, as sp_spray_is_uniform: it is judged from what a view
 * of its site holds, and refinement may change it. What any other brings is found by footprints, and it stays at the
 * poses of candidates. */
static inline bool sp_type_is_uniform(const sp_nozzle_type *type)
{
    return type->pattern == SP_PATTERN_FULL_CONE || type->pattern == SP_PATTERN_HOLLOW_CONE ||
           type->pattern == SP_PATTERN_FLAT_FAN || type->pattern == SP_PATTERN_SOLID_STREAM;
}

/* Axes within a mount's tilt, about +z. */
typedef struct {
    size_t count; /* 0: the type does not fit the mount */
    sp_vec3 *axes;
} sp_axes;

typedef struct {
    size_t make_count;
    sp_make *makes;         /* by type, then pressure, then angle */
    sp_launch_table *table; /* of all that a layout may hold */
    size_t launch_count;
    sp_launch *launches; /* of makes, distinct */
    size_t mount_count;
    sp_axes *axes;      /* [mount_count x make_count] */
    size_t *pose_start; /* [site_count + 1], poses of site i are [start[i], start[i + 1]) */
} sp_candidates;

/* One pose. `make`, `axis` and `roll` number within `site`'s own choice. */
typedef struct {
    uint32_t site, make, axis, roll;
} sp_pose;

bool sp_candidates_create(const sp_evaluator *evaluator, const sp_place_options *options, const sp_sites *sites,
                          sp_candidates *candidates, sp_error *error);
void sp_candidates_free(sp_candidates *candidates);

static inline const sp_axes *sp_candidates_axes(const sp_candidates *candidates, uint32_t mount, size_t make)
{
    return &candidates->axes[mount * candidates->make_count + make];
}
/* The pose's number among all, by site. */
size_t sp_candidates_number(const sp_candidates *candidates, const sp_sites *sites, sp_pose pose);
/* Turns an axis about +z to lie about the z of a frame: for a site sp_nozzle_frame(site->axis, 0, up). */
sp_vec3 sp_frame_axis(const sp_frame *frame, sp_vec3 axis);
/* The pressure at which a type is fed that is offered one: the nearest that can be set. */
double sp_fed_pressure(const sp_nozzle_type *type, double pressure);
/* What refinement may set, between settings where there are steps: angle (rad), and flow (m³/s) of a type at a
 * pressure. With drag the flow of a stream stays: how far it flies before it breaks up depends on it, and with that all
 * flights. */
void sp_angle_range(const sp_place_options *options, const sp_nozzle_type *type, double *low, double *high);
void sp_flow_range(const sp_place_options *options, const sp_setup *setup, const sp_nozzle_type *type, double pressure,
                   double *low, double *high);
/* The roll of step i. */
double sp_make_roll(const sp_make *make, size_t i);
/* The pose as a nozzle without a name. */
sp_nozzle sp_pose_nozzle(const sp_candidates *candidates, const sp_sites *sites, sp_pose pose, sp_vec3 up);

#endif
