/* Triangles laid in one plane, to be asked which of them a further one would overlap. */
#ifndef ATLAS_PLANE_H
#define ATLAS_PLANE_H

#include <sprayplan/error.h>

#include <stddef.h>
#include <stdint.h>

/* How deep two triangles must lie in each other to overlap, in parts of the lower of their least heights. Below it lie
 * the rounding of coordinates in files and the slight excess of angle around a vertex of a saddle. */
#define SP_OVERLAP_TOLERANCE 1e-2

/* True where the interiors of two anticlockwise triangles overlap by more than the tolerance. */
bool sp_triangles_overlap(const double a[3][2], const double b[3][2]);

typedef struct sp_plane sp_plane;

/* For triangles whose corners stand in `flat` [triangle_count], which is borrowed. NULL when memory runs out. */
sp_plane *sp_plane_create(const double (*flat)[3][2], size_t triangle_count, sp_error *error);
void sp_plane_destroy(sp_plane *plane);
/* Takes all triangles away. */
void sp_plane_clear(sp_plane *plane);
/* Lays a triangle where `flat` says. Returns false when memory runs out. */
bool sp_plane_add(sp_plane *plane, uint32_t triangle, sp_error *error);
/* How many of the laid triangles overlap this one, counting up to `limit`; adds to `tests` those that it was held
 * against. */
size_t sp_plane_overlaps(const sp_plane *plane, const double triangle[3][2], size_t limit, size_t *tests);

#endif
