/* How far a point is from surfaces, by a tracer's hierarchy. All accelerators give the same answers. */
#ifndef SPRAYPLAN_TRACE_DISTANCE_H
#define SPRAYPLAN_TRACE_DISTANCE_H

#include <sprayplan/trace.h>

/* The triangle nearest to `point` (of equal distance the first), among those of `part` or, with SP_NONE, all; SP_NONE
 * where there is none. */
uint32_t sp_tracer_nearest_triangle(const sp_tracer *tracer, uint32_t part, sp_vec3 point);
/* True where no triangle but those of part `own` (SP_NONE: no exception) is nearer than `clearance` (m). */
bool sp_tracer_is_clear(const sp_tracer *tracer, sp_vec3 point, double clearance, uint32_t own);
/* The same of a way from `from` to `to`: true where no triangle comes as near to any point of it. */
bool sp_tracer_way_is_clear(const sp_tracer *tracer, sp_vec3 from, sp_vec3 to, double clearance);

#endif
