/* What of all that meets a wall the criterion counts, by its speed and incidence. */
#ifndef SPRAY_CRITERION_H
#define SPRAY_CRITERION_H

#include <sprayplan/evaluator.h>
#include <sprayplan/vector.h>

#include <math.h>
#include <stdbool.h>

/* m/s, of a velocity, in the plane of this unit normal. */
static inline double sp_speed_along(sp_vec3 velocity, sp_vec3 normal)
{
    return sp_length(sp_cross(velocity, normal));
}
/* rad from the unit normal, of what meets a wall with this velocity (m/s), of which `against`, no less than 0, is along
 * the normal. A cosine would lose digits near it. */
static inline double sp_incidence(sp_vec3 velocity, sp_vec3 normal, double against)
{
    return atan2(sp_speed_along(velocity, normal), against);
}
static inline bool sp_is_fast_enough(const sp_criterion *criterion, double speed)
{
    return speed >= criterion->impact_speed;
}
static inline bool sp_is_steep_enough(const sp_criterion *criterion, double incidence)
{
    return incidence <= criterion->incidence;
}
/* The same of an arrival, whose angle is only computed where one is asked for. */
static inline bool sp_arrives_steeply(const sp_criterion *criterion, const sp_arrival *arrival)
{
    return criterion->incidence >= M_PI / 2 || sp_is_steep_enough(criterion, sp_arrival_incidence(arrival));
}
static inline bool sp_impact_passes(const sp_criterion *criterion, double speed, double incidence)
{
    return sp_is_fast_enough(criterion, speed) && sp_is_steep_enough(criterion, incidence);
}
/* What all nozzles so far and one more come to, in the unit of both. */
static inline double sp_combined(const sp_criterion *criterion, double all, double one)
{
    return criterion->combine == SP_COMBINE_SINGLE ? fmax(all, one) : all + one;
}
/* The share of a patch that is covered by what all nozzles bring, as sp_deposits has it. */
static inline double sp_share_covered(const sp_criterion *criterion, double even, double dry, double film)
{
    const sp_wetting wetting = {even, dry, 0};
    return criterion->film > 0 && film >= criterion->film ? 1 : sp_wetting_share(&wetting, criterion->flux);
}

#endif
