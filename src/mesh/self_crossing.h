/* Outlines that cross themselves. */
#ifndef MESH_SELF_CROSSING_H
#define MESH_SELF_CROSSING_H

#include <sprayplan/error.h>

#include <stddef.h>

/* Whether two edges of a closed outline in the plane run through each other by more than a millionth of its extent:
 * what only touches, or runs back on itself, does not. False only when memory runs out. */
bool sp_find_self_crossing(const double (*points)[2], size_t count, bool *tangled, sp_error *error);

#endif
