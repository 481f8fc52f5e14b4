/* Exact geometric predicates in the plane. */
#ifndef MESH_PREDICATE_H
#define MESH_PREDICATE_H

/* Above 0 where c lies left of the line from a to b, below 0 where right, 0 exactly on it: the sign is that of the
 * exact determinant of the coordinates as they stand. For coordinates whose products neither overflow nor underflow. */
double sp_orientation(const double a[2], const double b[2], const double c[2]);

#endif
