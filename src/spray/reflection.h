/* What becomes of a jet at the wall that it meets. */
#ifndef SPRAY_REFLECTION_H
#define SPRAY_REFLECTION_H

#include "drag/chain.h"
#include "spray/state/state.h"

/* Where a ray without drag, whose flight is all one piece, has come to: its hit, of something. `acceleration`: m/s². */
sp_landing sp_landing_of(const sp_ray *ray, const sp_hit *hit, sp_vec3 acceleration);
/* Turns the ray and its flow (m³/s) into what flies on from where it has landed: v' = v_t - e v_n. False
 * where it stays on the wall. */
bool sp_bounce(const sp_evaluator *evaluator, const sp_landing *landing, sp_vec3 acceleration, sp_ray *ray,
               double *flow);

#endif
