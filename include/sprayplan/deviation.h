/* How far liquid that flies straight is from liquid that falls: what the trajectory `line` can do to a coverage. */
#ifndef SPRAYPLAN_DEVIATION_H
#define SPRAYPLAN_DEVIATION_H

#include <sprayplan/evaluator.h>
#include <sprayplan/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The largest angle (rad) at `from` between the straight way to `to` and the low parabola there that leaves at `speed`
 * (m/s) under `gravity` (m/s²): asin(ε f sin ζ / 2), with ε = g d/v² < 1/2, f² = 2 / (1 - ε + √(1 - 2ε)) and
 * ζ the angle between the way and gravity. INFINITY where ε is 1/2 or more: the end may be out of reach.
 *
 * With T² = 2 d²/(b + √D), the squared flight time (see sp_flights), it leaves along r - g T²/2, of length v T, so
 * that the sine of the angle is g T sin ζ / 2v. And T is at most f d/v: b = v² + r·g is no less than v² (1 - ε),
 * and D = (b - g d)(b + g d) no less than v⁴ (1 - 2ε). */
SP_API double sp_line_deviation(sp_vec3 from, sp_vec3 to, double speed, sp_vec3 gravity);

/* How much the coverage that flights along straight lines give and the one that parabolas give can differ at most, as a
 * share of the counted area: the share that patches have of which it is not proved that lines and parabolas cover all
 * of each, or none. Both coverages are to the first impact. It holds for the true areas (at every point of the other
 * patches sp_points_judge says the same of both) and for sp_evaluate_inverse on these patches, but for round-off: where
 * liquid grazes the edge of a pattern or of a surface, or meets a criterion, to within 1e-9. It is about the trajectory
 * alone: what texels do to either coverage is no part of it, and nor are jets. On the evaluator's own trajectory, and
 * on its method, it does not depend. 0 without gravity. 1 says nothing; so it is where the liquid is slow for where it
 * goes (ε of sp_line_deviation 1/2 or more), and where goods move. `decided` is NULL or [patches], the caller's: the
 * patches of which it is proved. */
SP_API bool sp_bound_lines(const sp_evaluator *evaluator, const sp_layout *layout, double *bound, bool *decided,
                           sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
