/* What rays of one origin see of boxes. For the kernels, which are compiled once for each set of instructions. */
#ifndef TRACE_SEEN_H
#define TRACE_SEEN_H

#include "trace/bvh/bvh.h"
#include "trace/bvh/wide.h"

/* The bounds of eight boxes along one axis, seen from the origin. */
static inline void see_bounds(const sp_bvh_node *node, int axis, float origin, wide *low, wide *high)
{
    wide corner = wide_set(node->origin[axis] - origin), step = wide_set(node->step[axis]);
    *low = wide_multiply_add(wide_bytes(node->low[axis]), step, corner);
    *high = wide_multiply_add(wide_bytes(node->high[axis]), step, corner);
}

#endif
