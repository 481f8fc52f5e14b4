/* The corners of one triangle's part of one texel. */
#include "atlas/texels.h"

#include <math.h>

/* Weights of the second and third corner of a point in the local plane. */
static void weights(const double t[3][2], const double point[2], double *u, double *v)
{
    double bx = t[1][0] - t[0][0], by = t[1][1] - t[0][1], cx = t[2][0] - t[0][0], cy = t[2][1] - t[0][1];
    double px = point[0] - t[0][0], py = point[1] - t[0][1], twice = bx * cy - by * cx;
    *u = fmin(1, fmax(0, (px * cy - py * cx) / twice));
    *v = fmin(1 - *u, fmax(0, (bx * py - by * px) / twice));
}

int sp_atlas_fragment_polygon(const sp_atlas *atlas, const sp_mesh *mesh, uint32_t texel, uint32_t fragment,
                              sp_vec3 polygon[SP_FRAGMENT_POINTS])
{
    uint32_t triangle = atlas->fragments[fragment].triangle;
    if (atlas->triangle_start[triangle + 1] - atlas->triangle_start[triangle] == 1) {
        for (int i = 0; i < 3; i++) /* the whole triangle, even where it has no area on the page */
            polygon[i] = mesh->vertices[mesh->triangles[triangle][i]];
        return 3;
    }
    sp_local_triangle local = sp_local((const double(*)[2])atlas->uv[triangle]);
    sp_polygon strip, cell;
    sp_clip_row((const double(*)[2])local.corner, atlas->texel_y[texel] - local.y, &strip);
    sp_clip_column(&strip, atlas->texel_x[texel] - local.x, &cell);
    if (cell.count > SP_FRAGMENT_POINTS || !(sp_polygon_area(&cell) > 0))
        return 0;
    for (int i = 0; i < cell.count; i++) {
        double u, v;
        weights((const double(*)[2])local.corner, cell.point[i], &u, &v);
        polygon[i] = sp_triangle_point(mesh, triangle, u, v);
    }
    return cell.count;
}
