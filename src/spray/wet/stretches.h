/* Stretches: what of the lines where others cross or touch a triangle lies in one cell of it, as weights of the
 * triangle's second and third corner. */
#ifndef SPRAY_STRETCHES_H
#define SPRAY_STRETCHES_H

#include <sprayplan/mesh.h>

#define SP_CELL 0x80000000u /* a child that is a cell: its number with this bit */

/* A straight cut through a triangle: the distance (m) of the point (1-u-v, u, v) from it is a u + b v + c. */
typedef struct {
    double a, b, c;
    uint32_t child[2]; /* where that is below 0 and where it is above: a cut, or a cell with SP_CELL */
} sp_cut;

typedef struct {
    double from[2], to[2];
} sp_stretch;

/* The straight line through p and q in a triangle's plane. */
sp_cut sp_cut_through(const sp_mesh *mesh, uint32_t triangle, sp_vec3 p, sp_vec3 q);

/* m, of a point from a cut's line. */
static inline double sp_cut_distance(const sp_cut *cut, const double at[2])
{
    return cut->a * at[0] + cut->b * at[1] + cut->c;
}

double sp_stretch_length(const sp_mesh *mesh, uint32_t triangle, const sp_stretch *part);

/* Leaves the part of a stretch where the distance from a line is below 0 (way -1) or above (way 1); false where that is
 * no more than contact. */
bool sp_stretch_clip(sp_stretch *part, const sp_cut *line, int way, double contact);

/* Of lines that have half of the stretches' middles to either side, the one with fewest on its fuller side, where those
 * that it crosses count on both; as many are returned. All are longer than contact; `places` is room for [count >= 1].
 */
size_t sp_stretches_halve(const sp_mesh *mesh, uint32_t triangle, const sp_stretch *parts, size_t count, double contact,
                          double *places, sp_cut *line);

#endif
