/* Delaunay triangulation of points in the plane. */
#ifndef VESSEL_DELAUNAY_H
#define VESSEL_DELAUNAY_H

/* Triangles of the points' convex hull, anticlockwise, malloc'd, the caller frees. NULL when memory runs out. Meant for
 * some thousand points without four of them on one empty circle: Bowyer's and Watson's insertion, testing every circle.
 */
int (*delaunay(const double (*points)[2], int count, int *triangle_count))[3];

#endif
