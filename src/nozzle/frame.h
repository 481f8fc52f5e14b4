/* Directions in a nozzle's own frame. */
#ifndef NOZZLE_FRAME_H
#define NOZZLE_FRAME_H

#include <sprayplan/nozzle.h>

/* Of one of the world. */
static inline sp_vec3 sp_frame_local(const sp_frame *frame, sp_vec3 direction)
{
    return sp_v(sp_dot(direction, frame->x), sp_dot(direction, frame->y), sp_dot(direction, frame->z));
}
/* rad, from z. */
static inline double sp_polar_angle(sp_vec3 local)
{
    return atan2(hypot(local.x, local.y), local.z);
}

#endif
