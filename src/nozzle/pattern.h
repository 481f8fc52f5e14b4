/* What is asked of patterns besides what <sprayplan/nozzle.h> tells. */
#ifndef NOZZLE_PATTERN_H
#define NOZZLE_PATTERN_H

#include "form.h"

/* True of a type whose liquid is spread evenly over one region, as sp_spray_is_uniform, of which sweeps know the
 * outline (outline.h): what it brings is known from what a view of its mounting point holds, and refinement may set its
 * angle and flow and turn it. What any other brings is traced pose by pose, and it stays at these. */
static inline bool sp_type_is_uniform(const sp_nozzle_type *type)
{
    return sp_form_of(type->pattern)->outline != NULL;
}
/* By how much (rad) a nozzle is rolled about its axis until it sprays the same again; 0: it sprays the same however it
 * is rolled. */
static inline double sp_pattern_roll_period(sp_pattern pattern)
{
    return sp_form_of(pattern)->period;
}
static inline double sp_type_roll_period(const sp_nozzle_type *type)
{
    return sp_pattern_roll_period(type->pattern);
}
/* A stream that stands still: it strikes a wall in one piece, or breaks up on its way. */
static inline bool sp_type_is_stream(const sp_nozzle_type *type)
{
    return sp_form_of(type->pattern)->stream;
}
/* The least angle (rad) to which a swept type has to be opened for its region to reach a polar angle. */
static inline double sp_type_angle_reaching(const sp_nozzle_type *type, double polar)
{
    return sp_form_of(type->pattern)->angle_reaching(type, polar);
}
/* The most (sr) that the solid angle of a swept type comes to, opened to an angle between; by up to 1e-9 of it more. */
double sp_type_solid_angle_most(const sp_nozzle_type *type, double low, double high);
/* Half-angle (rad) of the smallest cone about the body's axis that holds all that a type opened to an angle sprays, if
 * the members of a cluster had no offsets. cluster.c. */
double sp_type_reach(const sp_nozzle_type *type, double angle);

/* A region that is a ring about the axis, or a cone: all between the polar angles `low` and `high`. */
static inline bool sp_spray_is_round(const sp_spray *spray)
{
    return sp_pattern_roll_period(spray->kind) == 0;
}
/* It sprays as much in all directions, wherever its axis points. */
static inline bool sp_spray_is_isotropic(const sp_spray *spray)
{
    return sp_form_of(spray->kind)->outline && sp_spray_is_round(spray) && spray->low <= 0 && spray->high >= M_PI;
}
/* Whether there may be directions within the region that get no liquid. */
static inline bool sp_spray_has_gaps(const sp_spray *spray)
{
    return sp_form_of(spray->kind)->gaps;
}
/* Whether two sprays have the same region. */
bool sp_spray_is_same(const sp_spray *a, const sp_spray *b);
/* The latitude asin(y), up to π/2 rad, beyond which on either side nothing is sprayed. */
double sp_spray_latitude(const sp_spray *spray);
/* Whether a unit direction of the world gets any liquid. */
bool sp_spray_holds(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction);
/* sp_spray_margin and, where `gradient` is not NULL, how that changes with the direction. */
static inline double sp_spray_margin_slope(const sp_spray *spray, sp_vec3 direction, sp_vec3 *gradient)
{
    return sp_form_of(spray->kind)->margin_slope(spray, direction, gradient);
}
/* The outline of a posed spray whose type is uniform. `slack`: how far beyond (rad) an edge may lie, for shares that
 * must not be too small. */
sp_outline sp_spray_outline(const sp_spray *spray, const sp_frame *frame, double slack);
/* A spray, of one kind with two others that have an outline and are opened to the least and the most angle, that holds
 * all directions of any opened to an angle between whose axis is turned by up to `turn` any way and which is rolled by
 * up to `roll`; by about `slack` more than it must. All in rad. */
sp_spray sp_spray_widened(const sp_spray *narrow, const sp_spray *wide, double turn, double roll, double slack);
/* Direction i of `count`, an even number, along the region's edge, unit, in the nozzle's frame. */
sp_vec3 sp_spray_rim(const sp_spray *spray, int i, int count);

#endif
