/* Lines against triangles and through kd-trees. */
#ifndef SPRAYPLAN_TRACE_LINE_H
#define SPRAYPLAN_TRACE_LINE_H

#include "trace/kd/kd_tree.h"
#include "trace/ray/search.h"

/* A line x(t) = origin + velocity t, made ready. */
typedef struct {
    double origin[3], velocity[3];
    int x, y, z;             /* axes; z is the one of the largest component of velocity */
    double shear_x, shear_y; /* velocity[x], velocity[y] over velocity[z] */
    double inverse_z;        /* 1 / velocity[z] */
} sp_line;

/* False where the velocity is zero or not finite: such a line hits nothing. */
bool sp_line_start(sp_line *line, const sp_ray *ray);
/* Where a line is at the time of a hit, it is less far from the triangle than this, relative to the distance of the
 * farthest corner from its origin; with a good margin. */
#define SP_LINE_MARGIN 0x1p-36

/* Tests one triangle. */
void sp_line_test(const sp_line *line, const sp_corners corners, uint32_t triangle, sp_ray_search *search);
/* Searches all triangles. */
void sp_line_search_all(const sp_line *line, const sp_corners *corners, size_t count, sp_ray_search *search);
/* Searches those that the line passes in the tree. */
void sp_line_search_tree(const sp_line *line, const sp_corners *corners, const sp_kd_tree *tree, sp_ray_search *search);

#endif
