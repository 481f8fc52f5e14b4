/* Candidate poses: mounting point x type x pressure x angle x axis x roll. */
#ifndef OPTIMIZER_CANDIDATES_H
#define OPTIMIZER_CANDIDATES_H

#include "candidates/mounts.h"
#include "candidates/ranges.h"

#include <sprayplan/launch.h>

/* A nozzle variant: a type at a pressure and an angle. */
typedef struct {
    const sp_nozzle_type *type;
    double pressure; /* Pa */
    double angle;    /* rad */
    double flow;     /* m³/s */
    size_t launch;   /* of the candidates' launches */
    sp_spray spray;
    double reach;      /* rad, half-angle of the cone that holds the pattern */
    size_t roll_count; /* 1 where it is the same at every roll */
} sp_variant;

/* Axes within a mount's tilt, about +z. */
typedef struct {
    size_t count; /* 0: the type does not fit the mount */
    sp_vec3 *axes;
} sp_axes;

typedef struct {
    size_t variant_count;
    sp_variant *variants;   /* by type, then pressure, then angle */
    sp_launch_table *table; /* of all that a layout may hold */
    size_t launch_count;
    sp_launch *launches; /* of variants, distinct */
    size_t mount_count;
    sp_axes *axes;      /* [mount_count x variant_count] */
    size_t *pose_start; /* [site_count + 1], poses of site i are [start[i], start[i + 1]) */
} sp_candidates;

/* One pose. `variant`, `axis` and `roll` number within `site`'s own choice. */
typedef struct {
    uint32_t site, variant, axis, roll;
} sp_pose;

bool sp_candidates_create(const sp_evaluator *evaluator, const sp_place_options *options, const sp_sites *sites,
                          sp_candidates *candidates, sp_error *error);
void sp_candidates_free(sp_candidates *candidates);

static inline const sp_axes *sp_candidates_axes(const sp_candidates *candidates, uint32_t mount, size_t variant)
{
    return &candidates->axes[mount * candidates->variant_count + variant];
}
/* The pose's number among all, by site. */
size_t sp_candidates_number(const sp_candidates *candidates, const sp_sites *sites, sp_pose pose);
/* Turns an axis about +z to lie about the z of a frame: for a site sp_nozzle_frame(site->axis, 0, up). */
sp_vec3 sp_frame_axis(const sp_frame *frame, sp_vec3 axis);
/* The roll of step i. */
double sp_variant_roll(const sp_variant *variant, size_t i);
/* The pose as a nozzle without a name. */
sp_nozzle sp_pose_nozzle(const sp_candidates *candidates, const sp_sites *sites, sp_pose pose, sp_vec3 up);

#endif
