/* What a tracer's hierarchy holds in a region of any shape. */
#ifndef SPRAYPLAN_TRACE_VISIT_H
#define SPRAYPLAN_TRACE_VISIT_H

#include <sprayplan/trace.h>

/* Whether a box (m) may have something of the region in it; false only where it has nothing. */
typedef bool sp_box_test(const void *region, const double low[3], const double high[3]);
/* One triangle; false ends the visit. */
typedef bool sp_triangle_visitor(const void *region, uint32_t triangle);

/* Calls `visit` with every triangle that lies in the region in part, and with others. False where it was ended. */
bool sp_tracer_visit(const sp_tracer *tracer, sp_box_test *test, sp_triangle_visitor *visit, const void *region);

/* The boxes of the hierarchy's leaves, low x, y, z and high x, y, z in m, as they are looked into: wider by rounding
 * than what they hold. boxes: [count], the caller's, NULL to be told the count alone, which is 0 of other accelerators.
 */
size_t sp_tracer_leaves(const sp_tracer *tracer, double (*boxes)[6]);

#endif
