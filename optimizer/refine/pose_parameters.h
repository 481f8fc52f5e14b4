/* What refinement may change of one nozzle: its place within the mount, axis, roll, angle and flow. */
#ifndef OPTIMIZER_POSE_PARAMETERS_H
#define OPTIMIZER_POSE_PARAMETERS_H

#include "scoring/partial.h"

#define SP_UNKNOWNS 8 /* at most: three of place, two of axis, roll, angle, flow */

typedef enum { SP_UNKNOWN_PLACE, SP_UNKNOWN_AXIS, SP_UNKNOWN_ROLL, SP_UNKNOWN_ANGLE, SP_UNKNOWN_FLOW } sp_unknown;

typedef struct {
    sp_nozzle start;  /* what is not free stays as it is here */
    sp_nozzle origin; /* the candidate that the limits count from */
    sp_vec3 up;
    sp_vec3 reference; /* the mount's axis */
    double tilt, axis_limit;
    sp_vec3 across[2]; /* with origin.axis an orthonormal frame */
    size_t count;
    sp_unknown kind[SP_UNKNOWNS];
    sp_vec3 move[SP_UNKNOWNS];                  /* place: unit direction */
    double value[SP_UNKNOWNS];                  /* at the start; m from the origin's position, rad, m³/s */
    double low[SP_UNKNOWNS], high[SP_UNKNOWNS]; /* low < high */
} sp_pose_parameters;

/* Nothing, where kernels do not sum the nozzle's type. */
sp_pose_parameters sp_pose_parameters_create(const sp_search *search, const sp_placed *placed);
/* The nozzle at these values, its axis brought back within the limits of tilt and refinement. */
sp_nozzle sp_pose_parameters_nozzle(const sp_pose_parameters *parameters, const double *values);
/* The same put where the mounting point has come to lie, its axis within the tilt from that point's. */
sp_nozzle sp_pose_parameters_nozzle_at(const sp_pose_parameters *parameters, const double *values, const sp_site *site);
/* The roll at which a nozzle with this axis keeps the x of the one given as far as turning the axis alone allows. */
double sp_carried_roll(const sp_nozzle *nozzle, sp_vec3 axis, sp_vec3 up);

#endif
